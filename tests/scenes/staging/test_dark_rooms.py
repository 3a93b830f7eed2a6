"""Rooms of scene files are dark at night but for lamps of the scene; those of sentences are lit."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.every_row import for_every

from texvent.sensor import SensorSize
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES
from texvent_scenes.raycast.render import render
from texvent_scenes.scene_input import describe_scene, understand
from texvent_scenes.spec.scene import Lamp, Light, Motion, Place, Scene, SceneObject
from texvent_scenes.staging.compose import compose_scene

ROOMS = sorted(name for name, one in PLACES.items() if one.is_room)
NIGHTS = ("night", "moonlight")
SIZE = SensorSize(48, 36)


def compose(description):
    return compose_scene(description, seed=0, size=SIZE, duration_s=1.0)


def seen(place, kind, lamps=(), **fields):
    """Mean light of the picture at .1 and at .6 s."""
    one = SceneObject("box", motions=(Motion("stand"),), **fields)
    scene = Scene(objects=(one,), light=Light(kind, lamps=lamps), place=Place(place))
    composed = compose(describe_scene(scene, NOUNS))
    return [float(np.mean(render(composed, time_s, SIZE))) for time_s in (0.1, 0.6)], composed


@for_every(itertools.product(ROOMS, NIGHTS))
def test_a_room_at_night_is_dark(row):
    place, kind = row
    (night, _), composed = seen(place, kind)
    (day, _), _ = seen(place, "day")
    assert night < 0.15 * day  # grey levels
    assert any("is dark" in note for note in composed.notes)


@for_every(itertools.product(ROOMS, NIGHTS))
def test_a_lamp_that_flickers_is_what_is_seen_of_a_room_at_night(row):
    place, kind = row
    lamp = Lamp((0.0, -1.0, 2.0), strength=2.0, frequency_hz=1.0, wave="switch")
    (on, off), _ = seen(place, kind, (lamp,))
    assert on > 3.0 * off
    (_, dark), _ = seen(place, kind)
    assert off == pytest.approx(dark, rel=1e-6)


@for_every(ROOMS)
def test_the_light_of_lamps_has_those_of_a_room_on(place):
    (lit, _), _ = seen(place, "lamp")
    (night, _), _ = seen(place, "night")
    assert lit > 2.0 * night


@pytest.mark.parametrize("room", ["an office", "a kitchen", "a laboratory"])
def test_in_a_room_of_a_sentence_the_light_is_on_at_night(room):
    said = understand(f"a man waves in {room} at night", NOUNS)
    lit = float(np.mean(render(compose(said), 0.1, SIZE)))
    unlit = replace(said, place=replace(said.place, is_lit=False))
    dark = float(np.mean(render(compose(unlit), 0.1, SIZE)))
    assert lit > 3.0 * dark


@for_every(itertools.product(ROOMS, NIGHTS))
def test_a_room_of_a_file_is_lit_at_night_where_it_says_so(row):
    place, kind = row
    one = SceneObject("box", motions=(Motion("stand"),))
    scene = Scene(objects=(one,), light=Light(kind), place=Place(place, is_lit=True))
    lit = float(np.mean(render(compose(describe_scene(scene, NOUNS)), 0.1, SIZE)))
    (dark, _), _ = seen(place, kind)
    assert lit > 2.0 * dark
