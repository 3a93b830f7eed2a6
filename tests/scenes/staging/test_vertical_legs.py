"""Legs straight up or down, and after a rest: each is its speed times its duration long."""

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
from texvent_scenes.spec.scene import Motion, Scene, SceneObject
from texvent_scenes.staging.placement.object_placement import ObjectPlacer
from texvent_scenes.staging.tracks.phases import YAWS

LEVELS = {"air": 1.5, "water": 0.5, "clear": 0.0}
FLYING = ("drone", "bird", "balloon", "butterfly", "helicopter")
LEVEL = ("right", "left", "away", "towards")
UPRIGHT = [("rise", None, 1), ("rise", "up", 1), ("sink", None, -1), ("sink", "down", -1),
           ("fly", "up", 1), ("fly", "down", -1)]  # fmt: skip


def place(noun, motions, duration_s, *, height_m=6.0):
    one = SceneObject(noun, position_m=(1.0, 2.0), height_m=height_m, motions=motions)
    description = complete(to_description(Scene(objects=(one,))), NOUNS)
    placer = ObjectPlacer(description, NOUNS, seed=3, duration_s=duration_s, level_m=LEVELS)
    return placer.place_all()[0].track


def way_of(direction):
    return np.array([math.cos(YAWS[direction]), math.sin(YAWS[direction]), 0.0])


@for_every(itertools.product(FLYING, LEVEL, UPRIGHT, LEVEL, (0.7, 1.0), (0.8, 2.0)))
def test_legs_over_upright_ones_end_where_their_speeds_and_times_say(row):
    noun, first, (kind, direction, sign), last, leg_s, speed = row
    motions = (Motion("fly", first, speed_m_s=speed),
               Motion(kind, direction, speed_m_s=1.5, start_s=leg_s),
               Motion("fly", last, speed_m_s=speed, start_s=2 * leg_s))  # fmt: skip
    track = place(noun, motions, 3 * leg_s)
    start = np.array(track.at(0.0).position)
    end = speed * leg_s * (way_of(first) + way_of(last)) + 1.5 * leg_s * sign * np.array([0, 0, 1])
    np.testing.assert_allclose(np.array(track.at(3 * leg_s).position) - start, end, atol=2e-3)
    middle = np.array(track.at(1.5 * leg_s).position) - start
    np.testing.assert_allclose(middle[:2], speed * leg_s * way_of(first)[:2], atol=2e-3)
    assert math.cos(track.at(3 * leg_s).yaw - YAWS[last]) == pytest.approx(1.0, abs=1e-6)


@for_every(itertools.product(FLYING, UPRIGHT, LEVEL, (0.0, 0.5), (0.7, 1.2)))
def test_an_upright_leg_comes_first_or_last_too(row):
    noun, (kind, direction, sign), level, start_s, leg_s = row
    up = Motion(kind, direction, speed_m_s=1.5, start_s=start_s)
    rest = (Motion("stand"),) if start_s else ()
    motions = (*rest, up, Motion("fly", level, speed_m_s=2.0, start_s=start_s + leg_s))
    end_s = start_s + 2 * leg_s
    track = place(noun, motions, end_s)
    gone = np.subtract(track.at(end_s).position, track.at(0.0).position)
    wanted = 1.5 * leg_s * sign * np.array([0, 0, 1]) + 2.0 * leg_s * way_of(level)
    np.testing.assert_allclose(gone, wanted, atol=2e-3)
    turned = (Motion("fly", level, speed_m_s=2.0),
              Motion(kind, direction, speed_m_s=1.5, start_s=leg_s))  # fmt: skip
    track = place(noun, turned, 2 * leg_s)
    gone = np.subtract(track.at(2 * leg_s).position, track.at(0.0).position)
    np.testing.assert_allclose(gone, wanted, atol=2e-3)


GOING = [("man", "walk", 1.4), ("dog", "run", 3.0), ("drone", "fly", 2.0), ("box", "slide", 0.7)]


@for_every(itertools.product(GOING, LEVEL, LEVEL, (0.4, 0.8)))
def test_who_rests_between_legs_turns_before_the_next_which_ends_where_it_says(row):
    (noun, kind, speed), first, last, rest_s = row
    motions = (Motion(kind, first, speed_m_s=speed), Motion("stand", start_s=1.0),
               Motion(kind, last, speed_m_s=speed, start_s=1.0 + rest_s))  # fmt: skip
    track = place(noun, motions, 2.0 + rest_s, height_m=2.0 if kind == "fly" else None)
    gone = np.subtract(track.at(2.0 + rest_s).position, track.at(0.0).position)
    np.testing.assert_allclose(gone[:2], speed * (way_of(first) + way_of(last))[:2], atol=2e-3)


@for_every(itertools.product(("drone", "balloon"), (("rise", "left"), ("sink", "away"))))
def test_another_direction_of_an_upright_leg_is_refused_with_what_it_does(row):
    noun, (kind, direction) = row
    motions = (Motion("fly", "right"), Motion(kind, direction, start_s=1.0))
    scene = Scene(objects=(SceneObject(noun, motions=motions),))
    with pytest.raises(ConfigError, match=rf"'{kind}' of a {noun} goes straight (up|down); leave"):
        describe_scene(scene, NOUNS)
    way = {"rise": "up", "sink": "down"}[kind]
    said = (motions[0], Motion(kind, way, start_s=1.0))
    describe_scene(Scene(objects=(SceneObject(noun, motions=said),)), NOUNS)
