"""A lens, whose point spread loses no light and whose vignetting is cos⁴; and what mirrors show."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from texvent.camera import camera_rays
from texvent.lens import Lens, undistort
from texvent.sensor import SensorSize
from texvent_scenes.raycast.optics import Optics, widened
from texvent_scenes.raycast.render import render_light, world_at
from texvent_scenes.raycast.surfaces.catalogue import SURFACES
from texvent_scenes.rendered_scene import Ground, Shape, Texture

from ..hand_scenes import HandScene, MovingShape, day, look_at, still

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


@pytest.mark.parametrize("optics", [*LENSES, *(Optics(one) for one in (0.3, 0.55, 0.8, 1.1))])
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


LARGE = SensorSize(64, 48)
SKY, DARK = (0.4, 0.5, 0.6), (0.0, 0.0, 0.0)
EVEN = replace(
    day(), ground=Ground.NONE, sky_top=np.array(SKY), sky_horizon=np.array(SKY), clouds=0.0,
    sun_colour=np.array(DARK), ambient=np.array(DARK), exposure=1.0, fog_distance=np.inf,
)  # fmt: skip
"""Nothing but an even sky."""


def camera(time):
    return look_at((0.0, -5.0, 0.0), (0.0, 0.0, 0.0))


def test_a_clear_coat_mirrors_by_schlick():
    coat = SURFACES[Texture.LACQUER]
    ball = MovingShape(Shape.ELLIPSOID, (1, 1, 1), still(0, 0, 0), DARK, DARK, Texture.LACQUER)
    light = render_light(HandScene((ball,), camera, environment_base=EVEN), 0.0, LARGE)
    rays = camera_rays(camera(0.0), LARGE)
    x, y = np.arange(LARGE.width) + 0.5, np.arange(LARGE.height)[:, None] + 0.5
    seen = rays.corner + x[:, None] * rays.right + y[..., None] * rays.down
    seen /= np.linalg.norm(seen, axis=-1, keepdims=True)
    ahead = seen @ -rays.origin
    square = ahead**2 - rays.origin @ rays.origin + 1.0  # of half the chord through the ball
    facing = np.sqrt(np.maximum(square, 0.0))
    share = coat.gloss + (1.0 - coat.gloss) * (1.0 - facing) ** 5
    inside = facing > 0.35  # at the outline a pixel shows several angles
    assert share[inside].max() > 2.0 * share.min()
    np.testing.assert_allclose(light[inside], share[inside, None] * SKY, rtol=0.05)


@pytest.mark.parametrize("texture", [Texture.CHECKS, Texture.GRASS])
def test_a_mirror_shows_what_a_camera_behind_it_would_see(texture):
    mirror = MovingShape(Shape.BOX, (4, 0.1, 4), still(0, 0.1, 0), DARK, DARK, Texture.MIRROR)
    things = (
        MovingShape(Shape.BOX, (0.8, 0.4, 0.9), still(1.3, -2.0, 0.3), texture=texture, instance=1),
        MovingShape(Shape.ELLIPSOID, (0.5,) * 3, still(0.4, -3.2, -0.6), texture=texture),
        MovingShape(Shape.CONE, (0.03, 0.03, 0.9), still(2.2, -1.5, 0.0)),
    )
    lit = replace(EVEN, ambient=np.array((0.9, 0.8, 0.7)))
    eye = (-2.6, -4.0, 0.0)
    seen, behind = (
        HandScene(shapes, lambda time, eye=at: look_at(eye, (0.0, 0.0, 0.0)), environment_base=lit)
        for shapes, at in (((mirror, *things), eye), (things, (eye[0], -eye[1], eye[2])))
    )
    image = render_light(seen, 0.0, LARGE)
    expected = render_light(behind, 0.0, LARGE)[:, ::-1]
    share = SURFACES[Texture.MIRROR].gloss
    body = np.abs(render_light(replace(seen, shapes=things), 0.0, LARGE) - SKY).max(axis=2) > 0.01
    compared = ~widened(body, 1)  # there the bodies hide the mirror
    off = np.abs(image - share * expected)[compared]
    assert np.abs(expected - SKY).max(axis=2)[compared].mean() > 0.03
    assert np.median(off) < 0.05
    assert np.mean(off > 0.12) < 0.03


@pytest.mark.parametrize("texture", Texture)
def test_what_is_mirrored_has_the_mean_of_both_colours_of_a_pattern(texture):
    first, second = (0.8, 0.1, 0.05), (0.2, 0.7, 0.45)
    mean = first
    if texture in (Texture.STRIPES, Texture.CHECKS, Texture.MOTTLED):
        mean = tuple(0.5 * np.add(first, second))
    looks = [dict(colour=first, second=second, texture=texture), dict(colour=mean)]
    light = [world_at(HandScene((MovingShape(Shape.BOX, (1.0, 1.0, 1.0), still(0, 0, 1), **look),)),
                      0.0, SIZE).mirrored["light"] for look in looks]  # fmt: skip
    assert len(light[0]) == 1
    np.testing.assert_allclose(*light, rtol=1e-6)
