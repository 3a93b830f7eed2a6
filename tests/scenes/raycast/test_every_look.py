"""Light is linear: every material on every shape, every ground and kind of light."""

from dataclasses import replace

import numpy as np
import pytest

from texvent.sensor import SensorSize
from texvent_scenes.raycast.ground_truth import ground_truth
from texvent_scenes.raycast.render import render_light
from texvent_scenes.rendered_scene import Ground, Shape, Texture

from ..hand_scenes import HandScene, MovingShape, day, lamp_row, look_at, moving

SIZE, T0_S, T1_S = SensorSize(40, 30), 0.2, 0.3
DIM = 0.1
"""Share of daylight at which nothing is so bright that the camera compresses it."""
LIGHTS = ("sun_colour", "ambient", "sky_top", "sky_horizon", "fog_colour")
SHAPES = [one for one in Shape if one is not Shape.MESH]
AIR = replace(day(Ground.NONE), fog_distance=30.0, clouds=0.5)
LAMPS = {
    "lamp": lamp_row((1.0, -2.0, 3.0), casts=True),
    "beam": lamp_row((0.0, -3.0, 4.0), (9.0, 8.0, 7.0), beam=(0.0, 0.6, -0.8), cosines=(0.95, 0.8)),
    "glow": lamp_row((-1.0, -1.0, 2.5), radius=0.2, glows=True, reach=5.0),
    "several": np.concatenate([lamp_row((x, -2.0, 3.0), casts=True) for x in range(-3, 3)]),
}


def see(things, surroundings):
    """[H, W, 3] light, and where it comes from."""
    scene = HandScene(
        things, lambda time: look_at((0.4, -5.0, 2.2 + time), (0.0, 0.0, 0.6)), surroundings,
        {1: "thing"},
    )  # fmt: skip
    return render_light(scene, T0_S, SIZE), ground_truth(scene, T0_S, T1_S, SIZE)


def lit(surroundings, factor):
    """Surroundings of which all light is that much brighter."""
    lamps = surroundings.lamps.copy()
    lamps["light"] *= factor
    brighter = {name: factor * getattr(surroundings, name) for name in LIGHTS}
    return replace(surroundings, lamps=lamps, **brighter)


def thing(shape, texture):
    place = moving((-0.3, 0.0, 0.7), (0.5, -0.3, 0.2))
    return MovingShape(
        shape, (1.1, 0.8, 0.7), place, texture=texture, texture_scale=2.3, spin=1.3, instance=1
    )


def check_linear(things, surroundings, allowed):
    """Light and truth of things; twice the light that falls on them makes twice of theirs."""
    light, truth = see(things, lit(surroundings, DIM))
    brighter, _ = see(things, lit(surroundings, 2 * DIM))
    assert np.abs(brighter - 2 * light).mean() <= allowed * light.mean()
    assert (truth.instance == 1).mean() > 0.03
    return light, truth


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("texture", Texture)
def test_twice_the_light_on_a_material_is_twice_its_light(shape, texture):
    light, _truth = check_linear((thing(shape, texture),), AIR, 0.01)
    assert light.min() >= 0


@pytest.mark.parametrize("lamps", [None, *LAMPS])
@pytest.mark.parametrize("ground", Ground)
def test_twice_the_light_on_a_ground_is_twice_its_light(ground, lamps):
    surroundings = replace(day(ground), fog_distance=40.0, clouds=0.7, road_angle=0.3)
    if lamps is not None:
        surroundings = replace(surroundings, lamps=LAMPS[lamps], clouds=0.0)
    things = (thing(Shape.BOX, Texture.CHECKS), thing(Shape.CONE, Texture.PLAIN))
    # What glows is compressed; waves and clouds are sampled by their contrast.
    light, _truth = check_linear(things, surroundings, 0.13 if lamps == "glow" else 0.03)
    assert light.min() >= 0
