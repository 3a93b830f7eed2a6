"""Materials: tiles against plain averages, their means, their look in scenes, and no aliasing."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.scenes.hand_scenes import HandScene, MovingShape, day, look_at, still

from texvent.scenes.raycast.records import INSTANT_RECORD, describe_surroundings
from texvent.scenes.raycast.render import render
from texvent.scenes.raycast.shading.material import patch_axes, tile_average
from texvent.scenes.raycast.shading.road import strip_place
from texvent.scenes.raycast.surfaces.catalogue import (
    CHANNELS,
    LEVELS,
    SURFACES,
    build_tile,
)
from texvent.scenes.raycast.surfaces.fields import SIDE
from texvent.scenes.scene import Ground, Shape, Texture
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.sensor import SensorSize

Floats = np.ndarray
PLACE = st.floats(0.0, 1.0)


def finest(texture: Texture) -> Floats:
    """[SIDE, SIDE, CHANNELS] level 0 of a tile."""
    return build_tile(texture)[: SIDE * SIDE].reshape(SIDE, SIDE, CHANNELS).astype(np.float64)


def plain_average(texels: Floats, centre: Floats, right: Floats, down: Floats) -> Floats:
    """Mean of the texels under many points of a parallelogram, in tiles."""
    steps = (np.arange(120) + 0.5) / 120 - 0.5
    points = centre + steps[:, None, None] * right + steps[None, :, None] * down
    column, row = np.moveaxis(np.floor(points * SIDE).astype(int) % SIDE, -1, 0)
    return np.asarray(texels[row, column].mean(axis=(0, 1)))


@pytest.mark.parametrize("texture", SURFACES, ids=lambda texture: str(texture.name))
def test_what_a_pixel_shows_is_the_mean_of_what_it_covers(texture: Texture) -> None:
    texels, address = finest(texture), build_tile(texture).ctypes.data
    rng = np.random.default_rng(5)
    errors = []
    for _ in range(60):
        width, angle = 2.0 ** rng.uniform(0.0, 6.0) / SIDE, rng.uniform(0.0, np.pi)
        axis = np.array([np.cos(angle), np.sin(angle)])
        right = width * rng.uniform(1.0, 4.0) * axis
        down = width * np.array([-axis[1], axis[0]])
        centre = rng.uniform(0.0, 1.0, 2)
        shown = tile_average(address, *centre, patch_axes((*right, *down)))
        errors.append(np.array(shown) - plain_average(texels, centre, right, down))
    spread = texels[..., :2].sum(axis=-1).std()
    error = np.sqrt(np.mean(np.square(np.array(errors)[:, :2].sum(axis=1))))
    assert error < 0.16 * spread


@pytest.mark.parametrize("texture", SURFACES, ids=lambda texture: str(texture.name))
def test_a_material_keeps_its_mean_at_every_size(texture: Texture) -> None:
    tile = build_tile(texture).astype(np.float64)
    ends = list(itertools.accumulate(SIDE * SIDE >> (2 * level) for level in range(LEVELS)))
    assert tile.shape == (ends[-1], CHANNELS)
    means = [tile[a:b].mean(axis=0) for a, b in itertools.pairwise([0, *ends])]
    np.testing.assert_allclose(means, np.broadcast_to(means[0], (LEVELS, CHANNELS)), atol=1e-5)
    assert means[0][:2].sum() == pytest.approx(1.0, abs=1e-5)
    assert np.abs(means[0][2:]).max() < 0.05


@pytest.mark.parametrize("texture", SURFACES, ids=lambda texture: str(texture.name))
def test_a_tile_repeats_without_a_seam(texture: Texture) -> None:
    brightness = finest(texture)[..., :2].sum(axis=-1)
    for axis in (0, 1):
        steps = np.abs(np.diff(brightness, axis=axis)).mean(axis=1 - axis)
        ends = np.abs(brightness.take(0, axis) - brightness.take(-1, axis)).mean()
        assert ends <= 1.3 * steps.max()


@given(u=PLACE, v=PLACE)
@settings(max_examples=60)
def test_a_patch_smaller_than_a_texel_blends_the_texels_around_it(u: float, v: float) -> None:
    texels = finest(Texture.BRICK)
    x, y = u * SIDE - 0.5, v * SIDE - 0.5
    column, row = int(np.floor(x)), int(np.floor(y))
    expected = np.zeros(CHANNELS)
    for j in (0, 1):
        for i in (0, 1):
            weight = (x - column if i else column + 1 - x) * (y - row if j else row + 1 - y)
            expected += weight * texels[(row + j) % SIDE, (column + i) % SIDE]
    tiny = patch_axes((1e-4, 0.0, 0.0, 1e-4))
    shown = tile_average(build_tile(Texture.BRICK).ctypes.data, u, v, tiny)
    np.testing.assert_allclose(shown, expected, atol=1e-9)


def textured_plane(texture: Texture, speed: float) -> HandScene:
    """A wall of a material that slides past a still camera, metres per second."""
    wall = MovingShape(
        Shape.BOX,
        (6.0, 0.1, 6.0),
        lambda time: (speed * time, 3.0, 0.0),
        colour=(0.25, 0.22, 0.2),
        second=(0.35, 0.3, 0.22),
        texture=texture,
    )
    flat = replace(day(Ground.NONE), shadows=False)
    return HandScene((wall,), lambda time: look_at((0.0, 1.0, 0.0), (0.0, 3.0, 0.0)), flat)


def count_events(log_frames: Floats, threshold: float = 0.2) -> int:
    """Events of an ideal sensor whose light changes in straight lines between frames."""
    level, count = log_frames[0].copy(), 0
    for frame in log_frames[1:]:
        steps = np.trunc((frame - level) / threshold)
        level += threshold * steps
        count += int(np.abs(steps).sum())
    return count


SLOW = (Texture.GRASS, Texture.GRAVEL, Texture.BRICK, Texture.BARK, Texture.PAVING, Texture.ROOFING)


@pytest.mark.parametrize("texture", SLOW)
def test_a_slow_texture_fires_as_many_events_at_few_frames_as_at_many(texture: Texture) -> None:
    size = SensorSize(64, 48)
    scene = textured_plane(texture, 2.0 * 1.9 / 64)  # two pixels per second
    weights = np.array([0.299, 0.587, 0.114])
    logs = np.array([np.log(render(scene, k / 240, size) @ weights + 1.0) for k in range(241)])
    many, few = count_events(logs), count_events(logs[::10])
    assert many > 50
    assert few == pytest.approx(many, rel=0.05)


def local_contrast(image: Floats) -> float:
    """Median over 9 × 9 windows of the standard deviation of log luma (BT.601)."""
    log = np.log(image @ np.array([0.299, 0.587, 0.114]) + 1.0)
    windows = np.lib.stride_tricks.sliding_window_view(log, (9, 9))
    return float(np.median(windows.std(axis=(2, 3))))


@pytest.mark.parametrize(
    "ground", [Ground.GRASS, Ground.ROAD, Ground.CITY, Ground.SAND, Ground.DIRT_ROAD, Ground.PLAIN]
)
def test_grounds_have_the_contrast_of_real_ones(ground: Ground) -> None:
    camera = look_at((0.0, -8.0, 2.5), (0.0, 0.0, 0.0))
    scene = HandScene((), lambda time: camera, day(ground))
    image = render(scene, 0.0, SensorSize(346, 260))[130:]
    assert 0.08 < local_contrast(image) < 0.24


def test_a_material_is_as_large_on_a_big_box_as_on_a_small_one() -> None:
    def image(half: float) -> Floats:
        box = MovingShape(Shape.BOX, (half, 0.1, half), still(0.0, 2.0, 0.0), texture=Texture.BRICK)
        flat = replace(day(Ground.NONE), shadows=False)
        camera = look_at((0.0, -2.0, 0.0), (0.0, 2.0, 0.0))
        return render(HandScene((box,), lambda time: camera, flat), 0.0, SensorSize(96, 72))

    middle = np.s_[24:48, 36:60]
    np.testing.assert_allclose(image(1.2)[middle], image(2.4)[middle], atol=1e-3)


@given(
    x=st.floats(-30, 30),
    y=st.floats(-30, 30),
    angle=st.floats(-3, 3),
    bend=st.floats(-0.04, 0.04).filter(lambda bend: bend == 0.0 or abs(bend) > 1e-3),
)
@settings(max_examples=100)
def test_the_drawn_road_lies_on_the_line_of_the_staging(
    x: float, y: float, angle: float, bend: float
) -> None:
    line = RoadLine(angle, (2.0, -1.0), bend)
    environment = replace(
        day(Ground.ROAD), road_angle=angle, road_offset=np.array([2.0, -1.0]), road_curvature=bend
    )
    instant = np.zeros(1, dtype=INSTANT_RECORD)
    describe_surroundings(instant[0], environment, shadows=True)
    along, across, cosine, sine = strip_place(instant[0], x, y)
    assert across == pytest.approx(line.across(np.array([x, y])), abs=1e-6)
    assert abs(across) == pytest.approx(float(line.distance(np.array([[x, y]]))[0]), abs=1e-6)
    foot_x, foot_y, heading = line.at(along)
    assert (cosine, sine) == pytest.approx((np.cos(heading), np.sin(heading)), abs=1e-6)
    assert (foot_x - sine * across, foot_y + cosine * across) == pytest.approx((x, y), abs=1e-6)
