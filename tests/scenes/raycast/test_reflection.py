"""Mirrored light: Fresnel's share of the sky, and images where a mirror puts them."""

from dataclasses import replace

import numpy as np

from texvent.camera import camera_rays, project
from texvent.sensor import SensorSize
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


def test_a_mirror_shows_a_body_as_far_behind_it_as_it_stands_before_it():
    mirror = MovingShape(Shape.BOX, (2, 0.1, 2), still(0, 0.1, 0), DARK, DARK, Texture.MIRROR)
    place = np.array([1.3, -2.0, 0.4])
    ball = MovingShape(
        Shape.ELLIPSOID, (0.3,) * 3, still(*place), (1.0, 0.0, 0.0), emission=1.0, instance=1
    )
    # From the side, so that the ball does not hide its image.
    aside = HandScene(
        (mirror, ball), lambda time: look_at((-1.5, -5.0, 0.0), (0.0, 0.0, 0.0)),
        environment_base=EVEN,
    )  # fmt: skip
    bare = replace(aside, shapes=(mirror,))
    difference = (render_light(aside, 0.0, SIZE) - render_light(bare, 0.0, SIZE))[..., 0]
    image = project(aside.camera(0.0), SIZE, place * [1, -1, 1])[:2]
    body = project(aside.camera(0.0), SIZE, place)[:2]
    rows, columns = np.mgrid[: SIZE.height, : SIZE.width] + 0.5
    near_body = np.hypot(columns - body[0], rows - body[1]) < 8.0
    weight = np.where(near_body, 0.0, np.abs(difference))
    centre = [(weight * one).sum() / weight.sum() for one in (columns, rows)]
    assert np.hypot(*(image - body)) > 12.0
    np.testing.assert_allclose(centre, image, atol=0.5)
