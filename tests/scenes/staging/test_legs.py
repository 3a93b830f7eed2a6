"""Legs of a path end where their speeds, times and directions say; a turn heads where it says."""

import itertools
import math

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import place

from texvent.errors import ConfigError
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.scene_input import describe_scene
from texvent_scenes.spec.scene import Motion, Relation, Scene, SceneObject
from texvent_scenes.staging.idle_fields import TURNS
from texvent_scenes.staging.tracks.phases import YAWS

WAYS = ("right", "away", "left", "towards")
GOERS = [("drone", "fly", 2.0), ("man", "walk", 1.4), ("bird", "fly", 5.0), ("dog", "run", 3.0),
         ("ball", "slide", 1.0), ("box", "slide", 0.7)]  # fmt: skip
MOVED = [("ball", "roll", 2.0), ("man", "walk", 1.4), ("child", "run", 2.5), ("car", "drive", 8.0),
         ("drone", "fly", 4.0), ("dog", "run", 4.0), ("bird", "fly", 6.0), ("box", "slide", 1.0),
         ("mobile robot", "drive", 1.0)]  # fmt: skip
FLYING = ("drone", "bird", "balloon", "butterfly", "helicopter")
UPRIGHT = [("rise", None, 1), ("rise", "up", 1), ("sink", None, -1), ("sink", "down", -1),
           ("fly", "up", 1), ("fly", "down", -1)]  # fmt: skip


def follow(noun, *legs, height_m=None):
    """The track of a body and the times of the ends of its legs.

    A leg is a kind, a way, a speed and a duration; one that goes nowhere has a speed of None.
    """
    times = np.cumsum([0.0, *(duration_s for *_, duration_s in legs)])
    motions = [
        Motion(kind, way, speed_m_s=speed, start_s=float(start_s) or None)
        for (kind, way, speed, _), start_s in zip(legs, times, strict=False)
    ]
    one = SceneObject(noun, position_m=(1.0, -2.0), height_m=height_m, motions=tuple(motions))
    return place(one, duration_s=float(times[-1]))[0].track, times


def gone(track, time_s):
    return np.subtract(track.at(time_s).position, track.at(0.0).position)


def way_of(direction):
    """[3] the way that a direction says, of length 1."""
    upright = {"up": 1.0, "rise": 1.0, "down": -1.0, "sink": -1.0}.get(direction)
    if upright:
        return np.array([0.0, 0.0, upright])
    return np.array([math.cos(YAWS[direction]), math.sin(YAWS[direction]), 0.0])


@for_every(itertools.product(GOERS, (0, 1, 2, 3), (1, -1), (1.0, 1.5)))
def test_a_square_of_legs_closes_and_its_corners_are_symmetric(row):
    (noun, kind, speed), first, step, leg_s = row
    track, _ = follow(noun, *((kind, WAYS[(first + step * n) % 4], speed, leg_s) for n in range(4)))
    np.testing.assert_allclose(gone(track, 4.0 * leg_s)[:2], 0.0, atol=1e-3)
    turned = track.at(leg_s).yaw - track.at(0.0).yaw
    assert math.remainder(turned - step * math.pi / 4.0, math.tau) == pytest.approx(0.0, abs=0.02)
    fastest = max(track.at(t).speed_m_s for t in np.linspace(0.0, 4.0 * leg_s, 81))
    assert fastest < 1.05 * speed


@for_every([
    *((goer, way, faster) for goer in GOERS for way in ("away", "diagonal", "towards", "left")
      for faster in (0.6, 1.0, 1.6)),
    *itertools.product(MOVED, ["right"], (0.5, 1.0, 2.0)),
])  # fmt: skip
def test_a_leg_is_its_speed_times_its_duration_long_and_heads_along_it(row):
    (noun, kind, speed), way, faster = row
    track, _ = follow(noun, (kind, "right", speed, 1.5), (kind, way, faster * speed, 1.5))
    end = speed * 1.5 * (way_of("right") + faster * way_of(way))
    np.testing.assert_allclose(gone(track, 3.0)[:2], end[:2], atol=2e-3)
    assert math.cos(track.at(3.0).yaw - YAWS[way]) == pytest.approx(1.0, abs=1e-3)


@for_every(itertools.product(MOVED, WAYS, (0.8, 1.5, 2.2)))
def test_what_starts_and_stops_at_stated_times_is_where_its_legs_end(row):
    (noun, kind, speed), way, start_s = row
    rest = ("stand", None, None, 1.5)
    track, (*_, end_s) = follow(noun, (*rest[:3], start_s), (kind, way, speed, 1.5), rest)
    assert track.at(0.0).position[:2] == pytest.approx((1.0, -2.0), abs=2e-3)
    for at_s, leg_s in ((start_s + 0.75, 0.75), (end_s, 1.5)):
        np.testing.assert_allclose(gone(track, at_s)[:2], speed * leg_s * way_of(way)[:2],
                                   atol=2e-3)  # fmt: skip
    speeds = [track.at(t).speed_m_s for t in np.linspace(0.0, end_s, 81)]
    assert speeds[0] == speeds[-1] == 0.0
    assert max(speeds) <= speed + 1e-9


@for_every(itertools.product(("drone", "balloon", "helicopter"), ("rise", "sink"), (0.0, 0.5, 1.1),
                             (0.4, 1.0)))  # fmt: skip
def test_what_goes_up_or_down_at_a_stated_speed_is_as_high_as_its_legs_say(row):
    noun, kind, start_s, speed = row
    hover = ("hover", None, None)
    legs = [(*hover, start_s)] * (start_s > 0.0) + [(kind, None, speed, 1.2), (*hover, 1.2)]
    track, times = follow(noun, *legs, height_m=4.0)
    sways_m = 0.1 + 0.08 * NOUNS[noun].build(colour=None, scale=1.0, seed=0).height
    for at_s, leg_s, atol in ((start_s + 0.6, 0.6, 2e-3), (times[-2] + 0.35, 1.2, sways_m)):
        height = leg_s * speed * way_of(kind)[2]
        assert gone(track, at_s)[2] == pytest.approx(height, abs=atol)


@for_every([*itertools.product(FLYING, WAYS, UPRIGHT, WAYS, (0.7, 1.0), (0.8, 2.0))][::7])
def test_legs_over_upright_ones_end_where_their_speeds_and_times_say(row):
    noun, first, (kind, way, sign), last, leg_s, speed = row
    legs = ("fly", first, speed, leg_s), (kind, way, 1.5, leg_s), ("fly", last, speed, leg_s)
    track, _ = follow(noun, *legs, height_m=6.0)
    end = speed * leg_s * (way_of(first) + way_of(last)) + [0.0, 0.0, 1.5 * leg_s * sign]
    np.testing.assert_allclose(gone(track, 3 * leg_s), end, atol=2e-3)
    middle = gone(track, 1.5 * leg_s)[:2]
    np.testing.assert_allclose(middle, speed * leg_s * way_of(first)[:2], atol=2e-3)
    assert math.cos(track.at(3 * leg_s).yaw - YAWS[last]) == pytest.approx(1.0, abs=1e-6)


@for_every([*itertools.product(FLYING, UPRIGHT, WAYS, (0.0, 0.5), (0.7, 1.2))][::7])
def test_an_upright_leg_comes_first_or_last_too(row):
    noun, (kind, way, sign), level, start_s, leg_s = row
    up, fly = (kind, way, 1.5, leg_s), ("fly", level, 2.0, leg_s)
    rest = [("stand", None, None, start_s)] * (start_s > 0.0)
    wanted = 2.0 * leg_s * way_of(level) + [0.0, 0.0, 1.5 * leg_s * sign]
    for legs in ((*rest, up, fly), (fly, up)):
        track, times = follow(noun, *legs, height_m=6.0)
        np.testing.assert_allclose(gone(track, times[-1]), wanted, atol=2e-3)


@for_every(itertools.product(GOERS, WAYS, WAYS, (0.4, 0.8)))
def test_who_rests_between_legs_turns_before_the_next_which_ends_where_it_says(row):
    (noun, kind, speed), first, last, rest_s = row
    height_m = 2.0 if kind == "fly" else None
    legs = (kind, first, speed, 1.0), ("stand", None, None, rest_s), (kind, last, speed, 1.0)
    track, times = follow(noun, *legs, height_m=height_m)
    end = speed * (way_of(first) + way_of(last))
    np.testing.assert_allclose(gone(track, times[-1])[:2], end[:2], atol=2e-3)


@for_every(itertools.product(("drone", "balloon"), (("rise", "left"), ("sink", "away"))))
def test_another_direction_of_an_upright_leg_is_refused_with_what_it_does(row):
    noun, (kind, direction) = row

    def describe(way):
        motions = (Motion("fly", "right"), Motion(kind, way, start_s=1.0))
        describe_scene(Scene(objects=(SceneObject(noun, motions=motions),)), NOUNS)

    with pytest.raises(ConfigError, match=rf"'{kind}' of a {noun} goes straight (up|down); leave"):
        describe(direction)
    describe({"rise": "up", "sink": "down"}[kind])


STOPPING = [("dog", "run", "sit"), ("man", "walk", "wave"), ("cat", "walk", "lie"),
            ("woman", "run", "sit down")]  # fmt: skip


@for_every(itertools.product(STOPPING, (0.8, 1.5)))
def test_who_does_something_at_rest_after_a_leg_begins_it_at_its_time_where_that_ends(row):
    (noun, going, done), stop_s = row
    track, _ = follow(noun, (going, "right", 2.0, stop_s), (done, None, None, 2.0))
    assert gone(track, stop_s + 2.0)[0] == pytest.approx(2.0 * stop_s, abs=2e-3)
    assert track.at(stop_s - 1e-3).activity == going
    assert track.at(stop_s + 1e-3).activity != going


@for_every(itertools.product(("car", "van", "bus", "bicycle"), (0.0, 180.0, 90.0, 270.0, 30.0),
                             ("towards", "away")))  # fmt: skip
def test_a_turn_towards_or_away_heads_there_from_any_heading(row):
    noun, heading, way = row
    motions = (Motion("drive", speed_m_s=6.0), Motion("turn", way, speed_m_s=6.0, start_s=1.0))
    one = SceneObject(noun, position_m=(0.0, 0.0), heading_deg=heading, motions=motions)
    track = place(one, duration_s=6.0)[0].track
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
    track, _ = follow(noun, ("drive", "right", speed, leg_s), ("drive", "away", speed, leg_s))
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
    found = place(*ends, own)[2].track.at(0.0).position[:2]
    assert found == pytest.approx((0.0, 8.0), abs=0.05)


@for_every(itertools.product(("drone", "box", "chair", "man"), (0.25, 0.5, 1.5), (0.8, 1.0)))
def test_a_spin_between_stated_times_turns_as_often_as_its_rate_says(row):
    noun, rate_hz, start_s = row
    motions = (Motion("stand"), Motion("spin", rate_hz=rate_hz, start_s=start_s),
               Motion("stand", start_s=start_s + 1.0))  # fmt: skip
    one = SceneObject(noun, position_m=(0.0, 0.0), motions=motions)
    track = place(one, duration_s=start_s + 2.0)[0].track
    turned = track.at(start_s + 2.0).yaw - track.at(0.0).yaw
    assert abs(turned) == pytest.approx(math.tau * rate_hz, abs=1e-3)


LED = [("man", "walk", "dog"), ("car", "drive", "bus"), ("woman", "run", "child"),
       ("drone", "fly", "bird"), ("car", "drive", "motorcycle")]  # fmt: skip


@for_every(itertools.product(LED, (None, 1.5), (None, 0.5)))
def test_who_follows_in_a_file_goes_as_far_as_who_leads(row):
    (leader, kind, follower), speed, start_s = row
    motions = (Motion(kind, "right", speed_m_s=speed, start_s=start_s),)
    one = SceneObject(leader, position_m=(0.0, 4.0), motions=motions)
    bodies = place(one, SceneObject(follower, relations=(Relation("follow", (leader,)),)))
    ways = [each.track.at(2.0).position[0] - each.track.at(0.2).position[0] for each in bodies]
    assert ways[0] > 0.5
    assert ways[1] == pytest.approx(ways[0], rel=0.05)
