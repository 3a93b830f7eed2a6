"""Images: exact repeatability, smooth edges, calm textures, any size."""

from dataclasses import replace

import numpy as np
import pytest

from texvent.runtime.jit import jit
from texvent.runtime.threads import THREADS_VARIABLE
from texvent.sensor import SensorSize
from texvent_scenes.raycast.render import light_of_rows, render, world_at
from texvent_scenes.raycast.trace import (
    background_hit,
    first_listed,
    hit_again,
    ray_direction,
    shapes_near,
)
from texvent_scenes.rendered_scene import Environment, Ground, Shape

from ..hand_scenes import HandScene, MovingShape, day, look_at, moving, showcase, still

SMALL = SensorSize(96, 72)
BACKDROP = 0.0625


def dark() -> Environment:
    """A plain backdrop of linear light `BACKDROP`, and no light but what shapes give off."""
    black, grey = np.zeros(3, dtype=np.float32), np.full(3, BACKDROP, dtype=np.float32)
    return replace(
        day(Ground.NONE), sky_top=grey, sky_horizon=grey, sun_colour=black, ambient=black
    )


def glowing(**options: object) -> MovingShape:
    """A shape that shows at linear light 0.5 in the dark."""
    white = {"colour": (0.5, 0.5, 0.5), "emission": 1.0}
    return MovingShape(**{**white, **options})  # type: ignore[arg-type]


def linear(image: np.ndarray) -> np.ndarray:
    """Undo the sRGB curve: 0..255 to linear 0..1."""
    coded = image.astype(np.float64) / 255.0
    return np.where(coded <= 0.04045, coded / 12.92, ((coded + 0.055) / 1.055) ** 2.4)


@pytest.mark.parametrize("size", [SMALL, SensorSize(101, 67)])
def test_the_number_of_threads_does_not_change_a_bit(size, monkeypatch):
    monkeypatch.setenv(THREADS_VARIABLE, "1")
    one = render(showcase(), 0.3, size)
    for threads in ("2", "5"):
        monkeypatch.setenv(THREADS_VARIABLE, threads)
        np.testing.assert_array_equal(render(showcase(), 0.3, size), one)


@pytest.mark.parametrize("ground", list(Ground))
def test_every_ground_gives_finite_light_in_range(ground):
    image = render(showcase(ground), 0.2, SMALL)
    assert image.dtype == np.float32
    assert image.shape == (72, 96, 3)
    assert np.isfinite(image).all()
    assert image.min() >= 0.0
    assert image.max() <= 255.0
    assert np.unique(image).size > 256  # not rounded to whole levels


@pytest.mark.parametrize("size", [(1, 1), (1, 40), (33, 1), (16, 16), (17, 31), (640, 360)])
def test_any_size_can_be_drawn(size):
    image = render(showcase(), 0.0, SensorSize(*size))
    assert image.shape == (size[1], size[0], 3)
    assert np.isfinite(image).all()


def test_an_edge_crosses_a_pixel_in_small_steps():
    # The camera is 10 m away and 96 pixels see 10 m: the box moves 1 pixel in 1 s.
    pixel = 10.0 / 96.0
    box = glowing(
        shape=Shape.BOX, scale=(1.0, 0.01, 1.0), place=moving((0.0, 0.0, 0.0), (pixel, 0.0, 0.0))
    )
    scene = HandScene((box,), lambda t: look_at((0.0, -10.0, 0.0), (0.0, 0.0, 0.0)), dark())
    row = [linear(render(scene, step / 64.0, SMALL))[36, :, 0] for step in range(65)]
    steps = np.abs(np.diff(row, axis=0)).max(axis=1)
    assert steps.max() <= 2.0 * (0.5 - BACKDROP) / 64.0 + 1e-5  # it moves 1/64 pixel at a time
    assert np.ptp(np.array(row)[:, 48:].sum(axis=1)) > 0.4  # and the edge did move


def test_a_shape_thinner_than_a_pixel_neither_flickers_nor_vanishes():
    pixel = 10.0 / 96.0
    pole = glowing(
        shape=Shape.CYLINDER,
        scale=(0.15 * pixel, 0.15 * pixel, 1.0),
        place=moving((0.0, 0.0, 0.0), (pixel, 0.0, 0.0)),
    )
    scene = HandScene((pole,), lambda t: look_at((0.0, -10.0, 0.0), (0.0, 0.0, 0.0)), dark())
    light = [linear(render(scene, step / 40.0, SMALL))[36, :, 0] for step in range(41)]
    excess = (np.array(light) - BACKDROP).sum(axis=1)
    np.testing.assert_allclose(excess, (0.5 - BACKDROP) * 0.3, rtol=0.3)


def test_a_shape_that_reaches_behind_the_camera_is_drawn_where_it_is_in_front():
    wall = glowing(shape=Shape.BOX, scale=(0.1, 40.0, 5.0), place=still(1.0, 0.0, 0.0))
    scene = HandScene((wall,), lambda t: look_at((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)), dark())
    image = render(scene, 0.0, SMALL)
    assert (image[:, -1] > 150.0).all()
    np.testing.assert_allclose(linear(image)[:, 0], BACKDROP, atol=1e-6)


@pytest.mark.parametrize("half_width_m", [None, 1.5])
@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_floor_is_darker_along_every_wall_of_rooms_and_corridors(half_width_m, axis, side):
    light = np.full(3, 0.6, np.float32)
    room = replace(
        day(Ground.FLOOR), sun_colour=np.zeros(3, np.float32), ambient=light, room_half_size=4.0,
        corridor_half_width=half_width_m, ground_colour=light, ground_second_colour=light,
        wall_colour=np.full(3, 0.02, np.float32),
    )  # fmt: skip
    wall_m = 4.0 if axis or half_width_m is None else half_width_m
    levels = []
    for gap_m in (0.08, 1.2):
        at = np.zeros(2)
        at[axis] = side * (wall_m - gap_m)
        eye = (at[0], at[1] - 0.05, 1.2)
        scene = HandScene(camera_at=lambda _, eye=eye, at=at: look_at(eye, (*at, 0.0)),
                          environment_base=room)  # fmt: skip
        levels.append(linear(render(scene, 0.0, SensorSize(33, 33)))[12:21, 15:18].mean())
    assert levels[0] < 0.9 * levels[1]


@jit(error_model="numpy")
def _hits_of_pixels(instants, points, near, hits):
    """Depths and shapes of first hits, of all shapes and of those near the pixel, [k, 2, 2]."""
    for index in range(len(points)):
        x, y = points[index, 0], points[index, 1]
        depth, found, _ = background_hit(instants[0], ray_direction(instants[0], x, y))
        for number in range(instants[0].shape_count):
            other, _ = hit_again(instants[0], x, y, number)
            if other < depth:
                depth, found = other, number
        hits[index, 0, 0], hits[index, 0, 1] = depth, found
        column, row = np.floor(x), np.floor(y)
        listed = shapes_near(instants[0], (column, column + 1.0, row, row + 1.0), near, False)
        depth, found, _, _ = first_listed(instants[0], x, y, listed, False)
        hits[index, 1, 0], hits[index, 1, 1] = depth, found


@pytest.mark.parametrize("room", [1, 64])
def test_rays_through_a_pixel_meet_none_but_the_shapes_that_are_listed_near_it(room):
    rng = np.random.default_rng(4)
    shapes = tuple(
        MovingShape(Shape(k % 4), tuple(rng.uniform(0.03, 0.5, 3)), still(*rng.uniform(-3, 3, 3)))
        for k in range(120)
    )
    scene = HandScene(shapes, lambda t: look_at((0.0, -10.0, 0.0), (0.0, 0.0, 0.0)), day())
    points = rng.uniform((0.0, 0.0), (96.0, 72.0), (4000, 2))
    hits = np.empty((4000, 2, 2))
    world = world_at(scene, 0.0, SMALL)
    _hits_of_pixels(world.instant, points, np.empty(room, np.int32), hits)
    assert (hits[:, 0] == hits[:, 1]).all()
    assert len(np.unique(hits[:, 0, 1])) > 60


def test_a_pixel_drawn_alone_is_that_of_the_whole_picture():
    world = world_at(showcase(), 0.3, SMALL)
    whole = light_of_rows(world, (0, 72), SMALL)
    chosen = np.random.default_rng(5).uniform(size=(72, 96)) < 0.1
    few = light_of_rows(world, (0, 72), SMALL, wanted=chosen, light=np.zeros_like(whole))
    np.testing.assert_array_equal(few[chosen], whole[chosen])
    assert not few[~chosen].any()
