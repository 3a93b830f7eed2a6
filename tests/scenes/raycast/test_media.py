"""Translucent media: exact along a ray, smooth at the rim, the same in any order."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.camera import camera_rays
from texvent.sensor import SensorSize
from texvent_scenes.raycast.media import WIDENED_PX, density_integral, optical_depth
from texvent_scenes.raycast.render import render_light, world_at
from texvent_scenes.rendered_scene import MEDIUM_RECORD, Environment, Ground

from ..hand_scenes import HandScene, MovingShape, day, look_at

SMALL = SensorSize(96, 72)
SKY = 0.3


def medium(
    place: tuple[float, float, float],
    radius: tuple[float, float, float] = (0.8, 0.8, 0.8),
    *,
    thickness: float = 1.0,
    colour: tuple[float, float, float] = (0.0, 0.0, 0.0),
    emission: float = 0.0,
    detail: float = 0.0,
) -> np.void:
    to_world = np.column_stack([np.diag(radius), place])
    return np.array((to_world, colour, thickness, emission, detail, 0.0), MEDIUM_RECORD)[()]


def air(*media: np.void) -> Environment:
    """Sky of one brightness, no light but what media give off."""
    black, grey = np.zeros(3, dtype=np.float32), np.full(3, SKY, dtype=np.float32)
    return replace(
        day(Ground.NONE), sky_top=grey, sky_horizon=grey, sun_colour=black, ambient=black,
        media=np.array(list(media), MEDIUM_RECORD),
    )  # fmt: skip


def scene_of(*media: np.void, shapes: tuple[MovingShape, ...] = ()) -> HandScene:
    return HandScene(
        shapes,
        camera_at=lambda time: look_at((0.0, -6.0, 0.0), (0.0, 0.0, 0.0)),
        environment_base=air(*media),
    )


def numeric_depth(row: np.void, scene: HandScene, point: tuple[float, float], stop: float):
    """Optical depth by summing the density (1 - r²)² of the medium, widened by a pixel."""
    camera = scene.camera(0.0)
    rays = camera_rays(camera, SMALL)
    direction = rays.corner + point[0] * rays.right + point[1] * rays.down
    centre, half = row["to_world"][:, 3], np.diag(row["to_world"][:, :3])
    pixel = np.linalg.norm(rays.right) * np.linalg.norm(centre - rays.origin)
    wide = np.hypot(half, WIDENED_PX * pixel)
    t = (np.arange(200_000) + 0.5) / 200_000 * min(stop, 20.0)
    place = rays.origin + t[:, None] * direction
    square = (((place - centre) / wide) ** 2).sum(axis=1)
    density = np.where(square < 1.0, (1.0 - np.minimum(square, 1.0)) ** 2, 0.0)
    thinned = np.cbrt((half / wide).prod()) ** 2 / np.cbrt(wide.prod())
    mass = density.mean() * min(stop, 20.0) * np.linalg.norm(direction)
    return 15.0 / 16.0 * row["optical_depth"] * thinned * mass


@given(half=st.floats(0.0, 1.0), start=st.floats(-1.5, 1.5), length=st.floats(0.0, 3.0))
def test_the_density_along_a_chord_is_its_integral(half, start, length):
    s = start + (np.arange(4000) + 0.5) / 4000 * length
    numeric = (np.maximum(half * half - s * s, 0.0) ** 2).mean() * length
    assert density_integral(half, start, start + length) == pytest.approx(numeric, abs=1e-4)


@pytest.mark.parametrize("point", [(48.0, 36.0), (52.5, 40.25), (40.0, 30.0), (20.0, 36.0)])
@pytest.mark.parametrize("stop", [np.inf, 6.1, 5.6, 2.0])
def test_optical_depth_is_the_integral_of_the_density(point, stop):
    row = medium((0.1, 0.2, -0.1), (0.8, 0.6, 1.1), thickness=1.7)
    scene = scene_of(row)
    world = world_at(scene, 0.0, SMALL)
    seen = optical_depth(world.instant[0], *point, stop)
    assert seen == pytest.approx(numeric_depth(row, scene, point, stop), abs=2e-4)


def test_overlapping_media_of_one_colour_solve_the_equation_of_transfer():
    rows = [medium((x, y, 0.0), thickness=t, colour=(0.4,) * 3, emission=1.0)
            for x, y, t in ((-0.3, -0.4, 0.7), (0.2, 0.3, 1.1), (0.0, 0.0, 0.4))]  # fmt: skip
    scene = scene_of(*rows)
    depth = sum(numeric_depth(row, scene, (48.5, 36.5), np.inf) for row in rows)
    expected = np.exp(-depth) * SKY + (1.0 - np.exp(-depth)) * 0.4
    np.testing.assert_allclose(render_light(scene, 0.0, SMALL)[36, 48], expected, rtol=1e-3)


@pytest.mark.parametrize("detail", [0.0, 1.0])
def test_a_moving_medium_changes_no_pixel_by_a_jump(detail):
    """1/32 pixel of motion: no pixel may change by more than 1/10 of what a whole pixel changes."""
    step = 6.0 / 96.0 / 32.0
    images = [
        render_light(scene_of(medium((x, 0.0, 0.0), thickness=2.0, detail=detail)), 0.0, SMALL)
        for x in step * np.array([0, 1, 2, 3, 32])
    ]
    whole = np.abs(images[-1] - images[0]).max()
    for before, after in pairwise(images[:4]):
        assert np.abs(after - before).max() < 0.1 * whole


def test_a_medium_smaller_than_a_pixel_hides_as_much_wherever_it_is():
    """What it takes from the image does not depend on where in a pixel it stands."""
    lost = [
        (SKY - render_light(scene_of(medium((x, 0.0, 0.0), (0.02,) * 3)), 0.0, SMALL)).sum()
        for x in (0.0, 0.02, 0.04)
    ]
    np.testing.assert_allclose(lost, lost[0], rtol=0.05)
    assert lost[0] > 0.0
