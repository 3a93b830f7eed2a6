"""Every material on every shape, every ground, lamp and medium: what holds of any picture.

Light is linear; twice the pixels show the same; and where the whole world is turned and moved, with
all that is in it, nothing in its picture and its truth is another.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from tests.scenes.golden.golden import block_means

from texvent.camera import PosedCamera
from texvent.sensor import SensorSize
from texvent_scenes.raycast.ground_truth import ground_truth
from texvent_scenes.raycast.render import render_light
from texvent_scenes.rendered_scene import MEDIUM_RECORD, Ground, Shape, Texture

from ..hand_scenes import HandScene, MovingShape, day, lamp_row, look_at, moving, turned

SIZE, TWICE, T0_S, T1_S = SensorSize(40, 30), SensorSize(80, 60), 0.2, 0.3
TURN, SHIFT_M = turned(2.1), np.array([31.0, -17.0, 0.0])
"""Of the whole world."""
NAMES = {1: "thing", 2: "other thing"}
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


MEDIA = {
    "smoke": (2.0, 0.0, 0.0),
    "flame": (0.7, 3.0, 0.0),
    "uneven smoke": (2.0, 0.0, 1.0),
}
"""Optical depth, emission, detail."""


@dataclass(frozen=True)
class Elsewhere:
    """A scene of which the whole world is turned and moved."""

    scene: HandScene
    class_names = NAMES

    def primitives(self, time_s):
        shapes = self.scene.primitives(time_s)
        return replace(shapes, to_world=_elsewhere(shapes.to_world))

    def camera(self, time_s):
        camera = self.scene.camera(time_s)
        place = TURN @ camera.position + SHIFT_M
        return PosedCamera(place, camera.rotation @ TURN.T, camera.focal, camera.lens)

    def environment(self, time_s):
        found = self.scene.environment(time_s)
        lamps, media = found.lamps.copy(), found.media.copy()
        lamps["place"], lamps["beam"] = lamps["place"] @ TURN.T + SHIFT_M, lamps["beam"] @ TURN.T
        media["to_world"] = _elsewhere(media["to_world"])
        return replace(found, lamps=lamps, media=media, sun_direction=TURN @ found.sun_direction)


def _elsewhere(to_world):
    found = TURN @ to_world
    found[:, :, 3] += SHIFT_M
    return found


def scene_of(things, surroundings):
    return HandScene(
        things, lambda time: look_at((0.4, -5.0, 2.2 + time), (0.0, 0.0, 0.6)), surroundings,
        NAMES,
    )  # fmt: skip


def see(scene, size=SIZE):
    """[H, W, 3] light, and where it comes from."""
    return render_light(scene, T0_S, size), ground_truth(scene, T0_S, T1_S, size)


def lit(surroundings, factor):
    """Surroundings of which all light is that much brighter."""
    lamps, media = surroundings.lamps.copy(), surroundings.media.copy()
    lamps["light"] *= factor
    media["emission"] *= factor
    brighter = {name: factor * getattr(surroundings, name) for name in LIGHTS}
    return replace(surroundings, lamps=lamps, media=media, **brighter)


def thing(shape, texture):
    place = moving((-0.3, 0.0, 0.7), (0.5, -0.3, 0.2))
    return MovingShape(
        shape, (1.1, 0.8, 0.7), place, texture=texture, texture_scale=2.3, spin=1.3, instance=1
    )


def check_linear(things, surroundings, allowed):
    """Light and truth of things; twice the light that falls on them makes twice of theirs."""
    light, truth = see(scene_of(things, lit(surroundings, DIM)))
    brighter, _ = see(scene_of(things, lit(surroundings, 2 * DIM)))
    assert np.abs(brighter - 2 * light).mean() <= allowed * light.mean()
    assert (truth.instance == 1).mean() > 0.03
    assert light.min() >= 0


def check_size(things, surroundings, allowed):
    """A pixel is the mean of the four that it is at twice the size, and truth is as far apart."""
    light, truth = see(scene_of(things, surroundings))
    finer, larger = see(scene_of(things, surroundings), TWICE)
    assert np.abs(block_means(finer, 2) - light).mean() < allowed * light.mean()
    assert finer.mean() == pytest.approx(light.mean(), rel=allowed)
    fields = np.dstack([larger.instance, larger.depth, 0.5 * larger.flow])
    before = np.dstack([truth.instance, truth.depth, truth.flow])
    with np.errstate(invalid="ignore"):
        off = np.abs(block_means(fields, 2) - before) > (0.0, 0.02, 0.02, 0.02)
    assert off[truth.instance > 0].mean() < 0.3  # pixels at an outline


def check_elsewhere(things, surroundings):
    """Pictures and truth are those of the same world at another place."""
    light, truth = see(scene_of(things, surroundings))
    moved, other = see(Elsewhere(scene_of(things, surroundings)))
    assert np.mean(np.abs(moved - light).max(axis=2) > 1e-3 * light.mean()) < 0.01
    for name in ("instance", "occluded", "depth", "flow"):
        pair = (getattr(one, name).astype(float) for one in (truth, other))
        assert np.mean(~np.isclose(*pair, atol=1e-3, equal_nan=True)) < 0.01, name


OTHER = MovingShape(Shape.BOX, (0.3,) * 3, moving((0.8, -1.5, 0.4), (0.1, 0.0, 0.0)), instance=2)
TWO = thing(Shape.BOX, Texture.CHECKS), thing(Shape.CONE, Texture.PLAIN)
CLEAR = replace(AIR, clouds=0.0)
"""Clouds stay where they are when the world is moved."""


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("texture", Texture)
def test_every_material_on_every_shape(shape, texture):
    check_linear((thing(shape, texture),), AIR, 0.01)
    check_size((thing(shape, texture),), CLEAR, 0.02)
    check_elsewhere((thing(shape, texture), OTHER), CLEAR)


@pytest.mark.parametrize("lamps", [None, *LAMPS])
@pytest.mark.parametrize("ground", Ground)
def test_every_light_on_every_ground(ground, lamps):
    surroundings = replace(day(ground), fog_distance=40.0, clouds=0.7, road_angle=0.3)
    if lamps is not None:
        surroundings = replace(surroundings, lamps=LAMPS[lamps], clouds=0.0)
    # What glows is compressed; waves and clouds are sampled by their contrast.
    check_linear(TWO, surroundings, 0.13 if lamps == "glow" else 0.03)
    check_size(TWO, surroundings, 0.04)
    if ground == Ground.NONE:  # others have their places in the world
        check_elsewhere((*TWO, OTHER), replace(surroundings, clouds=0.0))


@pytest.mark.parametrize("kind", MEDIA)
def test_every_medium(kind):
    puff = np.zeros(1, MEDIUM_RECORD)
    puff["to_world"] = np.column_stack([np.diag((0.9, 0.6, 0.7)), (0.3, -1.2, 0.9)])
    puff["colour"] = 0.5
    puff["optical_depth"], puff["emission"], puff["detail"] = MEDIA[kind]
    for check, options in ((check_linear, [0.02]), (check_size, [0.03]), (check_elsewhere, [])):
        check((*TWO, OTHER), replace(CLEAR, media=puff), *options)
