"""Lamps at positions of a scene: how much light falls where, and how it is modulated."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.generate.scene_input import describe_scene, list_nouns
from texvent.scenes.raycast.render import render
from texvent.scenes.spec.scene import Camera, Lamp, Light, Place, Scene, SceneObject
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(48, 36)


def staged(*lamps: Lamp) -> ComposedScene:
    scene = Scene(
        objects=(SceneObject(noun="box", colour="white", position_m=(0.0, 0.0)),),
        camera=Camera(position_m=(0.0, -4.0, 1.5), look_at_m=(0.0, 0.0, 0.3)),
        light=Light(kind="night", lamps=lamps),
        place=Place(name="plain"),
    )
    return compose_scene(describe_scene(scene, list_nouns()), seed=1, size=SIZE, duration_s=1.0)


def light_of(scene: ComposedScene, time_s: float = 0.0) -> float:
    return float(render(scene, time_s, SIZE).mean())


def test_a_lamp_lights_the_scene_and_less_so_from_far_away():
    dark = light_of(staged())
    near = light_of(staged(Lamp(position_m=(-4.0, -4.0, 6.0), strength=40.0)))
    far = light_of(staged(Lamp(position_m=(-8.0, -8.0, 12.0), strength=40.0)))
    assert near > far + 5.0 > dark + 10.0


@pytest.mark.parametrize(
    ("wave", "levels"),
    [("sine", (1.0, 0.5, 0.0)), ("switch", (1.0, 1.0, 0.0)), ("strobe", (1.0, 1.0, 0.0))],
)
def test_lamps_are_modulated_at_their_frequency(wave, levels):
    position = (-1.0, -2.0, 2.0)
    lamp = Lamp(position_m=position, colour="#ff0000", frequency_hz=125.0, wave=wave)
    scene = staged(lamp, Lamp(position_m=position))
    assert scene.flicker_hz == 125.0
    for share, level in zip((0.0, 0.25, 0.5), levels, strict=True):
        lamps = scene.environment((7.0 + share) / 125.0).lamps
        np.testing.assert_allclose(lamps[0, :3], position)
        np.testing.assert_allclose(lamps[0, 3:6], (level, 0.0, 0.0), atol=1e-6)
        np.testing.assert_allclose(lamps[1, 3:6], 1.0)
