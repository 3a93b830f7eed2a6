"""Motions of files hold as they are stated: falls, rest of what works, ways straight up, belts."""

import itertools
import math
import re

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import SIZE, place

from texvent_scenes.description import report_of
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.scene_input import describe_scene, understand
from texvent_scenes.spec.scene import Light, Motion, Place, Relation, Scene, SceneObject
from texvent_scenes.staging.compose import compose_scene

PLACE = Place("plain", is_empty=True)
FALLING = ["crate", "box", "bottle", "mug", "book", "football", "cube", "suitcase"]
WORKING = sorted(name for name, one in NOUNS.items()
                 if one.is_working and name not in nouns_with("works on demand"))  # fmt: skip
FLYING = sorted(name for name, one in NOUNS.items()
                if one.habitat == "air" and one.motion == "fly")  # fmt: skip
GRAVITY, REBOUND = 9.81, 0.09


def compose(*objects, duration_s=2.0, **fields):
    scene = Scene(objects=objects, **{"place": PLACE, **fields})
    return compose_scene(describe_scene(scene, NOUNS), seed=1, size=SIZE, duration_s=duration_s)


@for_every(itertools.product(FALLING, (0.8, 1.5), (None, 0.0, 0.5), (1.5, 3.0)))
def test_a_bare_fall_begins_at_its_time_and_rebounds_to_a_tenth(row):
    noun, height_m, start_s, duration_s = row
    thing = SceneObject(noun, height_m=height_m, motions=(Motion("fall", start_s=start_s),))
    (one,) = compose(thing, duration_s=duration_s).actors
    assert abs(one.lowest_m(0.0) - height_m) < 0.02

    def height(time_s):
        return one.track.at(time_s).position[2] - one.track.floor_m

    begin_s, drop_m = start_s or 0.0, height(0.0)
    down_s = math.sqrt(2.0 * drop_m / GRAVITY)
    assert abs(drop_m - height_m) < 0.06
    assert height(begin_s) == drop_m
    assert abs(height(begin_s + 0.5 * down_s) - 0.75 * drop_m) < 1e-9
    assert abs(height(begin_s + down_s)) < 1e-9
    assert abs(height(begin_s + 1.3 * down_s) - REBOUND * drop_m) < 1e-9


@for_every(WORKING)
def test_what_works_stands_still_where_a_file_says_no_more_than_that(noun):
    def change(*motions):
        scene = compose(SceneObject(noun, motions=motions, position_m=(0.0, 0.0)))
        (one,) = scene.actors
        states = [[(each.emission, *each.to_body.ravel()) for each in one.place(at).parts]
                  for at in (0.0, 0.43, 1.27)]  # fmt: skip
        return max(float(np.abs(np.subtract(states[0], each)).max()) for each in states[1:])

    assert change(Motion("stand")) == 0.0
    if noun not in nouns_with("flat pattern"):
        assert change(Motion("work")) > 0.0


def test_a_fan_of_a_sentence_that_stands_somewhere_works():
    said = understand("a fan stands on a table", NOUNS)
    assert said.objects[0].motion.kind == "work"


@for_every(itertools.product(FLYING, ("up", "down"), (None, 1.0)))
def test_what_flies_up_or_down_does_so_straight_but_for_aircraft_with_wings(row):
    noun, way, speed = row
    motion = Motion("fly", way, speed_m_s=speed)
    (one,) = compose(
        SceneObject(noun, motions=(motion,), position_m=(1.0, 2.0), height_m=9.0)
    ).actors
    first, last = (np.array(one.track.at(at).position) for at in (0.0, 2.0))
    assert (last[2] > first[2]) == (way == "up")
    aside = float(np.hypot(*(last - first)[:2]))
    if noun in nouns_with("takes off"):
        assert aside > 1.0
        return
    assert aside < 0.05 * abs(last[2] - first[2])
    if speed:
        assert abs(abs(last[2] - first[2]) - 2.0 * speed) < 0.3


@for_every(itertools.product(("fish", "diver", "penguin", "dog", "woman", "whale"), ("up", "down"),
                             (0.0, 0.5), (None, 0.6)))  # fmt: skip
def test_what_swims_up_or_down_from_a_stated_time_on_does_so_straight(row):
    noun, way, start_s, speed = row
    motion = Motion("swim", way, start_s=start_s, speed_m_s=speed)
    said = SceneObject(noun, motions=(motion,), position_m=(1.0, 2.0), height_m=6.0)
    (one,) = compose(said, place=Place("underwater")).actors
    times = (0.0, max(start_s - 0.3, 0.0), 2.0)
    first, then, last = (np.array(one.track.at(at).position) for at in times)
    assert np.hypot(*(last - first)[:2]) < 0.05 * abs(last[2] - first[2])
    assert (last[2] > first[2]) == (way == "up")
    np.testing.assert_allclose(first, then, atol=0.03)
    if speed:
        assert abs(last[2] - first[2]) == pytest.approx(speed * (2.0 - start_s), abs=0.2)


@for_every(
    itertools.product(("box", "bottle", "cup"), (0.1, 0.5), ("left", "right"), (True, False))
)
def test_a_belt_that_runs_on_is_told(row):
    noun, speed, way, is_stated = row
    belt = SceneObject("conveyor belt", id="belt", position_m=(0.0, 0.0),
                       motions=(Motion("work", way, speed_m_s=speed),))  # fmt: skip
    place = {"position_m": (0.0, 0.0)} if is_stated else {}
    thing = SceneObject(noun, relations=(Relation("on", ("belt",)),), **place)
    scene = compose(belt, thing, duration_s=6.0)
    told = [one for one in scene.notes if "the belt runs on" in one]
    track = scene.actors[1].track
    rests = math.dist(track.at(5.0).position, track.at(5.9).position) < 1e-9
    assert len(told) == rests
    assert rests == (speed == 0.5)


@for_every(itertools.product(("led", "street lamp", "traffic light"), (4.0, 100.0)))
def test_a_lamp_that_blinks_does_not_make_it_night_in_a_file(row):
    noun, rate = row
    one = SceneObject(noun, blink_hz=rate, motions=(Motion("stand"),))
    for light in (Light(), Light("day"), Light("night")):
        said = describe_scene(Scene(objects=(one,), place=PLACE, light=light), NOUNS)
        assert said.light.kind == light.kind
    assert understand("an LED blinks", NOUNS).light.kind == "night"


@for_every(itertools.product(
    (one for one in sorted(nouns_with("flat pattern") | nouns_with("flat picture"))
     if not NOUNS[one].is_working),
    (-60, -150, 60, 120),
    ("clockwise", "counter-clockwise"), ((), ("rise",), ("tilt",)),
))  # fmt: skip
def test_a_board_that_spins_shows_its_stated_side_and_turns_as_the_camera_sees_it(row):
    noun, heading, way, later = row
    motions = (Motion("spin", way, rate_hz=0.2), *map(Motion, later))
    one = SceneObject(noun, heading_deg=heading, motions=motions)
    describe_scene(Scene(objects=(one,)), NOUNS)
    first, second = (place(one)[0].track.at(t).to_world()[:, :3] for t in (0.0, 0.4))
    front = [math.cos(math.radians(heading)), math.sin(math.radians(heading)), 0.0]
    np.testing.assert_allclose([first[:, 0], second[:, 0]], [front, front], atol=1e-6)
    # Its top goes to the right of who looks along y.
    assert (second[0, 2] - first[0, 2]) * (1.0 if way == "clockwise" else -1.0) > 0.1


@for_every(itertools.product(("box", "car", "turntable", "drone", "dog", "boat"), (0, 30, -135),
                             ("clockwise", "counter-clockwise", "left"), (None, 0.4)))  # fmt: skip
def test_what_spins_has_its_heading_at_time_0_and_its_sense(row):
    noun, heading, way, start_s = row
    one = SceneObject(noun, heading_deg=heading, motions=(Motion("spin", way, start_s=start_s),))
    describe_scene(Scene(objects=(one,)), NOUNS)
    yaws = [place(one)[0].track.at(t).yaw for t in (0.0, 1.0, 1.1)]
    assert math.cos(yaws[0] - math.radians(heading)) == pytest.approx(1.0)
    assert (yaws[2] - yaws[1]) * (-1.0 if way == "clockwise" else 1.0) > 0.1


LEANING = [Motion("sway", rate_hz=3.0), Motion("tilt"), Motion("tilt", "away", pace=1.5),
           Motion("sway", start_s=0.5), Motion("hover"), Motion("float")]  # fmt: skip
STANDING = sorted(name for name, one in NOUNS.items() if one.habitat in ("ground", "fixed")
                  and not nouns_with("hangs from a ceiling") & {name})  # fmt: skip


@for_every(itertools.product(STANDING[::4], LEANING))
def test_what_sways_or_tilts_does_not_cut_what_it_stands_on(row):
    noun, motion = row
    bodies = [place(SceneObject(noun, motions=(one,)))[0] for one in (Motion("stand"), motion)]
    own = [[each.to_body for each in bodies[1].place(at).parts] for at in (0.1, 0.8)]
    if len(own[0]) == len(own[1]) and np.allclose(*own):  # its own parts stay
        foot_m = bodies[0].lowest_m(0.0)
        lows = [bodies[1].lowest_m(at) - foot_m for at in np.linspace(0.0, 2.0, 11)]
        near_m = 0.01 + 0.002 * bodies[0].size_m
        assert min(lows) > -near_m
        assert max(lows) < near_m or motion.kind in ("hover", "float")


@for_every(itertools.product(("vase", "sign", "bottle", "checkerboard"), ("table", "box"),
                             ("sway", "tilt")))  # fmt: skip
def test_what_sways_on_a_thing_keeps_its_foot_there(row):
    noun, below, kind = row
    on = (Relation("on", (below,)),)
    objects = [SceneObject(noun, motions=(Motion(kind),), relations=on), SceneObject(below)]
    one, bearer = place(*objects)[:2]
    lows = [one.lowest_m(at) for at in np.linspace(0.0, 2.0, 25)]
    assert np.ptp(lows) < 0.01
    assert lows[0] > 0.5 * bearer.model.height


BELTS = sorted(name for name in NOUNS if trait_value("belt speed", name) is not None
               and name not in nouns_with("flat pattern"))  # fmt: skip
SIDES = [(), (None,), ("left",), ("right",), ("left", "right"), ("right", "left")]


@for_every(itertools.product(BELTS, (None, 0.0, 180.0), SIDES))
def test_a_belt_is_read_with_the_sides_that_are_stated_not_with_senses_of_turning(row):
    noun, heading_deg, sides = row
    motions = [Motion("work", side, start_s=float(n) or None) for n, side in enumerate(sides)]
    belt = SceneObject(noun, motions=motions, heading_deg=heading_deg)
    disc = SceneObject("dice", motions=(Motion("spin", "counter-clockwise"),))
    said = describe_scene(Scene(objects=(belt, disc), place=PLACE), NOUNS)
    line = report_of(said).scene[0]
    assert "clockwise" not in line
    told = re.findall(r'direction = "(\w+)"', line)
    stated = [side for side in sides if side is not None]
    assert told == stated or (not stated and heading_deg is not None and len(told) == 1)
