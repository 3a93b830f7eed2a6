"""Legs of a path end where their speeds, times and directions say; a turn heads where it says."""

import itertools
import math

import numpy as np
import pytest
from tests.scenes.every_row import for_every

from texvent.errors import ConfigError
from texvent_scenes.defaults import complete
from texvent_scenes.description import to_description
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.scene_input import describe_scene
from texvent_scenes.spec.scene import Motion, Relation, Scene, SceneObject
from texvent_scenes.staging.idle_fields import TURNS
from texvent_scenes.staging.placement.object_placement import ObjectPlacer
from texvent_scenes.staging.tracks.phases import YAWS

LEVELS = {"air": 1.5, "water": 0.5, "clear": 0.0}
WAYS = ("right", "away", "left", "towards")
GOERS = [("drone", "fly", 2.0), ("man", "walk", 1.4), ("bird", "fly", 5.0), ("dog", "run", 3.0),
         ("ball", "slide", 1.0), ("box", "slide", 0.7)]  # fmt: skip


def place(one, duration_s):
    description = complete(to_description(Scene(objects=(one,))), NOUNS)
    placer = ObjectPlacer(description, NOUNS, seed=3, duration_s=duration_s, level_m=LEVELS)
    (actor,) = placer.place_all()
    return actor.track


def legs_of(kind, ways, speeds, leg_s):
    return tuple(
        Motion(kind, way, speed_m_s=speed, start_s=leg_s * n if n else None)
        for n, (way, speed) in enumerate(zip(ways, speeds, strict=True))
    )


@for_every(itertools.product(GOERS, (0, 1, 2, 3), (1, -1), (1.0, 1.5)))
def test_a_square_of_legs_closes_and_its_corners_are_symmetric(row):
    (noun, kind, speed), first, step, leg_s = row
    ways = [WAYS[(first + step * n) % 4] for n in range(4)]
    motions = legs_of(kind, ways, [speed] * 4, leg_s)
    track = place(SceneObject(noun, position_m=(-1.0, -1.0), motions=motions), 4.0 * leg_s)
    x, y = track.at(4.0 * leg_s).position[:2]
    assert (x, y) == pytest.approx((-1.0, -1.0), abs=1e-3)
    turned = track.at(leg_s).yaw - track.at(0.0).yaw
    assert math.remainder(turned - step * math.pi / 4.0, math.tau) == pytest.approx(0.0, abs=0.02)
    fastest = max(track.at(t).speed_m_s for t in np.linspace(0.0, 4.0 * leg_s, 81))
    assert fastest < 1.05 * speed


@for_every(itertools.product(GOERS[:4], ("away", "diagonal", "towards"), (0.6, 1.0, 1.6)))
def test_a_leg_is_its_speed_times_its_duration_long(row):
    (noun, kind, speed), way, faster = row
    motions = legs_of(kind, ("right", way), (speed, faster * speed), 1.5)
    track = place(SceneObject(noun, position_m=(0.0, 0.0), motions=motions), 3.0)
    angle = YAWS[way]
    end = speed * 1.5 * np.array([1.0, 0.0])
    end += faster * speed * 1.5 * np.array([math.cos(angle), math.sin(angle)])
    np.testing.assert_allclose(track.at(3.0).position[:2], end, atol=2e-3)


MOVED = [("ball", "roll", 2.0), ("man", "walk", 1.4), ("child", "run", 2.5), ("car", "drive", 8.0),
         ("drone", "fly", 4.0), ("dog", "run", 4.0), ("bird", "fly", 6.0), ("box", "slide", 1.0),
         ("mobile robot", "drive", 1.0)]  # fmt: skip


@for_every(itertools.product(MOVED, ("right", "left", "away", "towards"), (0.8, 1.5, 2.2)))
def test_what_starts_and_stops_at_stated_times_is_where_its_legs_end(row):
    (noun, kind, speed), way, start_s = row
    stop_s = start_s + 1.5
    motions = (Motion("stand"), Motion(kind, way, speed_m_s=speed, start_s=start_s),
               Motion("stand", start_s=stop_s))  # fmt: skip
    track = place(SceneObject(noun, position_m=(1.0, -2.0), motions=motions), stop_s + 1.5)
    along = np.array([math.cos(YAWS[way]), math.sin(YAWS[way])])
    for at_s, leg_s in ((0.0, 0.0), (start_s + 0.75, 0.75), (stop_s + 1.5, 1.5)):
        gone = track.at(at_s).position[:2] - np.array([1.0, -2.0])
        np.testing.assert_allclose(gone, speed * leg_s * along, atol=2e-3)
    speeds = [track.at(t).speed_m_s for t in np.linspace(0.0, stop_s + 1.5, 81)]
    assert speeds[0] == speeds[-1] == 0.0
    assert max(speeds) <= speed + 1e-9


@for_every(itertools.product(("drone", "balloon", "helicopter"), ("rise", "sink"), (0.0, 0.5, 1.1),
                             (0.4, 1.0)))  # fmt: skip
def test_what_goes_up_or_down_at_a_stated_speed_is_as_high_as_its_legs_say(row):
    noun, kind, start_s, speed = row
    leg = Motion(kind, speed_m_s=speed, start_s=start_s or None)
    motions = ((Motion("hover"),) if start_s else ()) + (
        leg,
        Motion("hover", start_s=start_s + 1.2),
    )
    one = SceneObject(noun, position_m=(0.0, 0.0), height_m=4.0, motions=motions)
    track = place(one, start_s + 2.4)
    first = track.at(0.0).position[2]
    sign = 1.0 if kind == "rise" else -1.0
    assert track.at(start_s + 1.2 + 0.35).position[2] - first == pytest.approx(
        1.2 * sign * speed,
        abs=0.1 + 0.08 * NOUNS[noun].build(colour=None, scale=1.0, seed=0).height,
    )
    half_s = start_s + 0.6
    assert track.at(half_s).position[2] - first == pytest.approx(0.6 * sign * speed, abs=2e-3)


STOPPING = [("dog", "run", "sit"), ("man", "walk", "wave"), ("cat", "walk", "lie"),
            ("woman", "run", "sit down")]  # fmt: skip


@for_every(itertools.product(STOPPING, (0.8, 1.5)))
def test_who_does_something_at_rest_after_a_leg_begins_it_at_its_time_where_that_ends(row):
    (noun, going, done), stop_s = row
    motions = (Motion(going, "right", speed_m_s=2.0), Motion(done, start_s=stop_s))
    track = place(SceneObject(noun, position_m=(0.0, 0.0), motions=motions), stop_s + 2.0)
    assert track.at(stop_s + 2.0).position[0] == pytest.approx(2.0 * stop_s, abs=2e-3)
    assert track.at(stop_s - 1e-3).activity == going
    assert track.at(stop_s + 1e-3).activity != going


@for_every(itertools.product(MOVED, (0.5, 1.0, 2.0)))
def test_a_leg_at_another_speed_is_as_long_as_its_time_says(row):
    (noun, kind, speed), faster = row
    motions = legs_of(kind, ("right", "right"), (speed, faster * speed), 1.5)
    track = place(SceneObject(noun, position_m=(0.0, 0.0), motions=motions), 3.0)
    assert track.at(3.0).position[0] == pytest.approx(1.5 * speed * (1.0 + faster), abs=2e-3)


@for_every(itertools.product(GOERS, (0.6, 1.0, 1.6), (1.0, 1.5)))
def test_who_turns_back_is_where_the_legs_there_and_back_end(row):
    (noun, kind, speed), faster, leg_s = row
    motions = legs_of(kind, ("right", "left"), (speed, faster * speed), leg_s)
    track = place(SceneObject(noun, position_m=(0.0, 0.0), motions=motions), 2.0 * leg_s)
    x, y = track.at(2.0 * leg_s).position[:2]
    assert (x, y) == pytest.approx((speed * leg_s * (1.0 - faster), 0.0), abs=2e-3)
    assert math.cos(track.at(2.0 * leg_s).yaw) == pytest.approx(-1.0, abs=1e-3)


@for_every(itertools.product(("car", "van", "bus", "bicycle"), (0.0, 180.0, 90.0, 270.0, 30.0),
                             ("towards", "away")))  # fmt: skip
def test_a_turn_towards_or_away_heads_there_from_any_heading(row):
    noun, heading, way = row
    motions = (Motion("drive", speed_m_s=6.0), Motion("turn", way, speed_m_s=6.0, start_s=1.0))
    one = SceneObject(noun, position_m=(0.0, 0.0), heading_deg=heading, motions=motions)
    track = place(one, 6.0)
    assert track.at(0.0).yaw == pytest.approx(math.radians(heading))
    assert math.cos(track.at(6.0).yaw - YAWS[way]) > 0.9


@for_every(itertools.product(("car", "man", "drone"), ("up", "down", "across", "diagonal")))
def test_a_turn_that_goes_nowhere_is_refused(row):
    noun, way = row
    one = SceneObject(noun, motions=(Motion("turn", way),))
    with pytest.raises(ConfigError, match=r"^objects\[0\]\.motions\[0\]\.direction .* a turn goes"):
        describe_scene(Scene(objects=(one,)), NOUNS)
    for other in TURNS[:4]:
        describe_scene(Scene(objects=(SceneObject(noun, motions=(Motion("turn", other),)),)), NOUNS)


@for_every(
    itertools.product(("car", "van", "bicycle", "mobile robot"), (4.0, 6.0, 9.0), (0.8, 1.0, 2.0))
)
def test_what_is_steered_heads_where_its_next_leg_leads_in_the_end_if_its_radius_allows(row):
    noun, speed, leg_s = row
    motions = legs_of("drive", ("right", "away"), (speed, speed), leg_s)
    track = place(SceneObject(noun, position_m=(0.0, 0.0), motions=motions), 2.0 * leg_s)
    length = NOUNS[noun].build(colour=None, scale=1.0, seed=0).length
    if speed * (0.95 * leg_s - 0.4) < 0.5 * math.pi * 0.9 * length:
        return
    assert math.degrees(track.at(2.0 * leg_s).yaw) == pytest.approx(90.0, abs=2.0)


@for_every(itertools.product(("tree", "lamp", "box", "car"), ("bench", "man", "dog"), (3.0, 6.0)))
def test_what_is_between_things_at_stated_places_is_in_their_middle(row):
    noun, subject, apart_m = row
    ends = [SceneObject(noun, id=name, position_m=(x, 8.0), motions=(Motion("stand"),))
            for name, x in (("one", -apart_m), ("other", apart_m))]  # fmt: skip
    own = SceneObject(subject, relations=(Relation("between", ("one", "other")),))
    description = complete(to_description(Scene(objects=(*ends, own))), NOUNS)
    placer = ObjectPlacer(description, NOUNS, seed=3, duration_s=2.0, level_m=LEVELS)
    assert placer.place_all()[2].track.at(0.0).position[:2] == pytest.approx((0.0, 8.0), abs=0.05)


@for_every(itertools.product(("drone", "box", "chair", "man"), (0.25, 0.5, 1.5), (0.8, 1.0)))
def test_a_spin_between_stated_times_turns_as_often_as_its_rate_says(row):
    noun, rate_hz, start_s = row
    motions = (Motion("stand"), Motion("spin", rate_hz=rate_hz, start_s=start_s),
               Motion("stand", start_s=start_s + 1.0))  # fmt: skip
    track = place(SceneObject(noun, position_m=(0.0, 0.0), motions=motions), start_s + 2.0)
    turned = track.at(start_s + 2.0).yaw - track.at(0.0).yaw
    assert abs(turned) == pytest.approx(math.tau * rate_hz, abs=1e-3)


LED = [("man", "walk", "dog"), ("car", "drive", "bus"), ("woman", "run", "child"),
       ("drone", "fly", "bird"), ("car", "drive", "motorcycle")]  # fmt: skip


@for_every(itertools.product(LED, (None, 1.5), (None, 0.5)))
def test_who_follows_in_a_file_goes_as_far_as_who_leads(row):
    (leader, kind, follower), speed, start_s = row
    motions = (Motion(kind, "right", speed_m_s=speed, start_s=start_s),)
    one = SceneObject(leader, position_m=(0.0, 4.0), motions=motions)
    own = SceneObject(follower, relations=(Relation("follow", (leader,)),))
    description = complete(to_description(Scene(objects=(one, own))), NOUNS)
    placer = ObjectPlacer(description, NOUNS, seed=3, duration_s=2.0, level_m=LEVELS)
    ways = [each.track.at(2.0).position[0] - each.track.at(0.2).position[0]
            for each in placer.place_all()]  # fmt: skip
    assert ways[0] > 0.5
    assert ways[1] == pytest.approx(ways[0], rel=0.05)
