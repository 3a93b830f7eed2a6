"""Mirrored light: Fresnel's share of the sky, and images where a mirror puts them."""

from dataclasses import replace

import numpy as np
import pytest

from texvent.camera import camera_rays
from texvent.sensor import SensorSize
from texvent_scenes.raycast.optics import widened
from texvent_scenes.raycast.render import render_light
from texvent_scenes.raycast.surfaces.catalogue import SURFACES
from texvent_scenes.rendered_scene import Ground, Shape, Texture

from ..hand_scenes import HandScene, MovingShape, day, look_at, still

SIZE = SensorSize(64, 48)
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
    light = render_light(HandScene((ball,), camera, environment_base=EVEN), 0.0, SIZE)
    rays = camera_rays(camera(0.0), SIZE)
    x, y = np.arange(SIZE.width) + 0.5, np.arange(SIZE.height)[:, None] + 0.5
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
    image = render_light(seen, 0.0, SIZE)
    expected = render_light(behind, 0.0, SIZE)[:, ::-1]
    share = SURFACES[Texture.MIRROR].gloss
    body = np.abs(render_light(replace(seen, shapes=things), 0.0, SIZE) - SKY).max(axis=2) > 0.01
    compared = ~widened(body, 1)  # there the bodies hide the mirror
    off = np.abs(image - share * expected)[compared]
    assert np.abs(expected - SKY).max(axis=2)[compared].mean() > 0.05
    assert np.median(off) < 0.05
    assert np.mean(off > 0.12) < 0.03
