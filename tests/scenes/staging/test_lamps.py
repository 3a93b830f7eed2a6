"""Which lamps are on, how they blink, and what light they shed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from texvent.scenes.description import (
    Illumination,
    ObjectMotion,
    SceneDescription,
    SceneObject,
    Surroundings,
)
from texvent.scenes.models.lamps import LAMPS
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(96, 72)
CAR = SceneObject("car", motion=ObjectMotion("drive", "left"))


def staged(*objects: SceneObject, light: str = "day", place: str = "road") -> ComposedScene:
    description = SceneDescription(
        "", objects=objects, light=Illumination(light), surroundings=Surroundings(place)
    )
    return compose_scene(description, seed=0, size=SIZE, duration_s=1.0)


def test_headlights_are_on_at_night_and_off_by_day():
    night, day = staged(CAR, light="night"), staged(CAR)
    beams = [row for row in night.environment(0.0).lamps if row[10] >= -1.0]
    assert len(beams) == 4  # two in front, two behind
    assert len(day.environment(0.0).lamps) == 0
    front = max(beams, key=lambda row: row[3:6].max())
    assert front[7] < -0.9  # it drives left


def test_lamps_move_with_what_carries_them():
    scene = staged(CAR, light="night")
    before, after = (scene.environment(t).lamps for t in (0.2, 0.4))
    car = scene.actors[0].trajectory
    moved = np.subtract(car.at(0.4).position, car.at(0.2).position)
    carried = before[:, 10] >= -1.0
    np.testing.assert_allclose(
        (after - before)[carried, :3], np.tile(moved, (carried.sum(), 1)), atol=1e-12
    )
    np.testing.assert_array_equal(after[~carried], before[~carried])


def test_lamps_can_be_switched_on_by_day_and_off_at_night():
    on, off = replace(CAR, is_lit=True), replace(CAR, is_lit=False)
    assert len(staged(on).environment(0.0).lamps) == 4
    dark = staged(off, light="night")
    assert not [row for row in dark.environment(0.0).lamps if row[10] >= -1.0]
    glow = dark.primitives(0.0)
    assert glow.emission[glow.instance == 1].max() == 0.0


@pytest.mark.parametrize("time_s", [0.0, 0.05, 0.0999, 0.1, 0.15, 0.1999, 0.2, 0.71])
def test_a_blinking_lamp_is_on_in_the_first_half_of_its_period_exactly(time_s):
    scene = staged(SceneObject("candle", blink_hz=5.0, is_lit=True), place="indoor")
    drone = staged(SceneObject("drone", blink_hz=5.0, motion=ObjectMotion("hover")), place="sky")
    light = drone.environment(time_s).lamps[:, 3:6]
    assert (light.max() > 0.0) == (time_s % 0.2 < 0.1)
    glowing = drone.primitives(time_s).emission.max()
    assert (glowing > 0.0) == (time_s % 0.2 < 0.1)
    assert drone.flicker_hz == 5.0
    assert scene.flicker_hz > 5.0  # a flame has beats faster than its main one


@pytest.mark.parametrize("noun", sorted(set(LAMPS) & set(NOUNS)))
def test_every_lamp_noun_sheds_light_when_it_is_lit(noun):
    scene = staged(SceneObject(noun, is_lit=True), light="night", place="plain")
    levels = [scene.environment(t).lamps[:, 3:6].max(initial=0.0) for t in (0.0, 0.1, 0.3)]
    assert max(levels) > 0.0
    rows = scene.environment(0.0).lamps
    assert (rows[:, 13] > 0.0).sum() <= 4
    assert np.isfinite(rows).all()
