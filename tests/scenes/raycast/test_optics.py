"""A lens: its point spread is a convolution that loses no light, its vignetting cos⁴."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from texvent.camera import camera_rays
from texvent.lens import Lens, undistort
from texvent.sensor import SensorSize
from texvent_scenes.raycast.optics import Optics, widened
from texvent_scenes.raycast.render import world_at

from ..hand_scenes import HandScene, MovingShape, still

SIZE = SensorSize(22, 13)
EVERYWHERE = np.ones(SIZE.shape, dtype=np.bool_)
BALL = HandScene((MovingShape(0, (1.0, 1.0, 1.0), still(0.0, 0.0, 1.0)),))
LENSES = [Optics(0.7), Optics(1.9), Optics(7.0), Optics(0.7, vignetting=True)]
"""The third reaches further than the picture is high."""


@pytest.fixture(scope="module")
def world():
    return world_at(BALL, 0.0, SIZE)


@pytest.fixture
def light():
    return np.random.default_rng(1).uniform(0.0, 1.0, (*SIZE.shape, 3)).astype(np.float32)


def passed(optics, light, world):
    return optics.passed(light, world, EVERYWHERE).reshape(light.shape)


def convolved(light, spread_px):
    """The definition: each pixel gives to those around it, mirrored at the edges, by a Gaussian."""
    reach = int(np.ceil(3.0 * spread_px))
    padded = np.pad(light.astype(np.float64), [(reach, reach), (reach, reach), (0, 0)], "symmetric")
    total, weights = np.zeros(light.shape), 0.0
    for dy, dx in itertools.product(range(-reach, reach + 1), repeat=2):
        weight = np.exp(-0.5 * (dx * dx + dy * dy) / spread_px**2)
        at = padded[reach + dy :, reach + dx :][: SIZE.height, : SIZE.width]
        total, weights = total + weight * at, weights + weight
    return total / weights


@pytest.mark.parametrize("optics", LENSES[:3])
def test_the_point_spread_is_a_convolution(optics, light, world):
    expected = convolved(light, optics.point_spread_px)
    np.testing.assert_allclose(passed(optics, light, world), expected, rtol=1e-5)


@pytest.mark.parametrize("optics", LENSES[:3])
def test_no_light_is_lost_and_what_is_uniform_stays(optics, light, world):
    spread = passed(optics, light, world)
    np.testing.assert_allclose(spread.sum(axis=(0, 1)), light.sum(axis=(0, 1)), rtol=1e-5)
    even = np.full_like(light, 0.3)
    np.testing.assert_allclose(passed(optics, even, world), even, rtol=1e-6)


@pytest.mark.parametrize("optics", LENSES)
def test_some_pixels_are_those_of_all(optics, light, world):
    drawn = np.random.default_rng(2).random(SIZE.shape) < 0.03
    touched = optics.touched(drawn)
    whole = passed(optics, light, world)
    np.testing.assert_array_equal(optics.passed(light, world, touched), whole[touched])
    light[drawn] = 0.0
    others = passed(optics, light, world)
    assert not (others != whole)[~touched].any()
    assert (others != whole)[drawn].all()


def test_a_perfect_lens_passes_light_as_it_is(light, world):
    np.testing.assert_array_equal(passed(Optics(), light, world), light)


def test_light_falls_off_with_the_fourth_power_of_the_cosine(world):
    rays = camera_rays(BALL.camera(0.0), SIZE)
    x, y = np.arange(SIZE.width) + 0.5, np.arange(SIZE.height)[:, None] + 0.5
    seen = rays.corner + x[:, None] * rays.right + y[..., None] * rays.down
    cosine = 1.0 / np.linalg.norm(seen, axis=-1)  # along the optical axis, rays have length 1
    share = passed(Optics(vignetting=True), np.ones((*SIZE.shape, 3), np.float32), world)
    np.testing.assert_allclose(share[..., 0], cosine**4, rtol=1e-6)
    assert share.min() < 0.75


@pytest.mark.parametrize("distortion", ["radtan", "equidistant"])
def test_a_lens_that_distorts_passes_what_each_pixel_sees(distortion):
    """cosθ times the solid angle: that of the cone through the pixel's four corners."""
    lens = Lens(14.0, 15.0, 11.0, 6.5, distortion, (-0.05, 0.01, 0.0, 0.0))
    scene = replace(BALL, camera_at=lambda time: replace(BALL.camera(time), lens=lens))
    share = passed(
        Optics(vignetting=True), np.ones((*SIZE.shape, 3), np.float32), world_at(scene, 0.0, SIZE)
    )
    corners = np.stack(np.meshgrid(np.arange(SIZE.width + 1), np.arange(SIZE.height + 1)), -1)
    plane = undistort(lens, (corners - [lens.cx, lens.cy]) / [lens.fx, lens.fy])
    rays = np.dstack([plane, np.ones(plane.shape[:2])])
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    across, back = rays[1:, 1:] - rays[:-1, :-1], rays[1:, :-1] - rays[:-1, 1:]
    angle = 0.5 * np.linalg.norm(np.cross(across, back), axis=-1)
    cosine = 0.25 * (rays[1:, 1:] + rays[:-1, :-1] + rays[1:, :-1] + rays[:-1, 1:])[..., 2]
    np.testing.assert_allclose(share[..., 0], angle * cosine * lens.fx * lens.fy, rtol=1e-2)


def test_what_is_widened_reaches_as_far_on_both_axes():
    point = np.zeros((9, 11), dtype=np.bool_)
    point[3, 9] = True
    rows, columns = np.nonzero(widened(point, 2))
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (1, 5, 7, 10)
    assert len(rows) == 20
