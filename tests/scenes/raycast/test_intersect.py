"""Ray meets unit shape: hand-computed cases, and the compiled kernel against its reference."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.scenes.raycast.intersect_reference import hit_shape_reference

from texvent.scenes.raycast.intersect import hit_shape, local_normal
from texvent.scenes.scene import Shape

UNIT_SHAPES = [shape for shape in Shape if shape is not Shape.MESH]


@pytest.mark.parametrize(
    ("shape", "origin", "direction", "depth", "face"),
    [
        (Shape.ELLIPSOID, (0.0, -3.0, 0.0), (0.0, 1.0, 0.0), 2.0, 0),
        (Shape.ELLIPSOID, (0.6, -3.0, 0.0), (0.0, 2.0, 0.0), 1.1, 0),
        (Shape.BOX, (0.5, -3.0, 0.5), (0.0, 1.0, 0.0), 2.0, 2),
        (Shape.BOX, (4.0, 0.2, 0.0), (-1.0, 0.0, 0.0), 3.0, 1),
        (Shape.BOX, (0.0, 0.0, 5.0), (0.0, 0.0, -1.0), 4.0, 5),
        (Shape.CYLINDER, (0.0, -3.0, 0.9), (0.0, 1.0, 0.0), 2.0, 0),
        (Shape.CYLINDER, (0.3, 0.3, 5.0), (0.0, 0.0, -1.0), 4.0, 1),
        (Shape.CYLINDER, (0.3, 0.3, -5.0), (0.0, 0.0, 1.0), 4.0, 2),
        (Shape.CONE, (0.0, -3.0, 0.0), (0.0, 1.0, 0.0), 2.5, 0),
        (Shape.CONE, (0.2, 0.0, -5.0), (0.0, 0.0, 1.0), 4.0, 2),
        (Shape.CONE, (0.5, 0.0, 5.0), (0.0, 0.0, -1.0), 5.0, 0),
    ],
)
def test_a_ray_meets_each_shape_where_geometry_says(
    shape: Shape,
    origin: tuple[float, float, float],
    direction: tuple[float, float, float],
    depth: float,
    face: int,
) -> None:
    t, found = hit_shape(int(shape), origin, direction, 0.0)
    assert t == pytest.approx(depth, abs=1e-12)
    assert found == face


@pytest.mark.parametrize("shape", UNIT_SHAPES)
def test_a_ray_that_starts_inside_or_points_away_meets_nothing(shape: Shape) -> None:
    assert hit_shape(int(shape), (0.0, 0.0, -0.5), (0.3, 0.2, 0.1), 0.0)[0] == math.inf
    assert hit_shape(int(shape), (0.0, 0.0, -3.0), (0.1, 0.2, -1.0), 0.0)[0] == math.inf


def test_the_cone_has_no_second_nappe() -> None:
    assert hit_shape(int(Shape.CONE), (0.0, -5.0, 2.0), (0.0, 1.0, 0.0), 0.0)[0] == math.inf


def rays(seed: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Rays from around the unit shapes towards points in and beside them."""
    generator = np.random.default_rng(seed)
    origins = generator.normal(size=(count, 3)) * 3.0
    targets = generator.uniform(-1.6, 1.6, size=(count, 3))
    return origins, (targets - origins) * generator.uniform(0.1, 2.0, size=(count, 1))


@pytest.mark.parametrize("shape", UNIT_SHAPES)
def test_the_kernel_equals_the_reference_on_random_rays(shape: Shape) -> None:
    origins, directions = rays(int(shape), 3000)
    expected = hit_shape_reference(shape, origins, directions)
    found = np.array(
        [
            hit_shape(int(shape), tuple(origin), tuple(direction), 0.0)[0]
            for origin, direction in zip(origins, directions, strict=True)
        ]
    )
    both = np.isfinite(found) & np.isfinite(expected)
    assert both.sum() > 300
    np.testing.assert_allclose(found[both], expected[both], rtol=1e-8, atol=1e-9)
    # Rays that only graze the shape may go either way; a grazing ray stays inside hardly any time.
    assert np.mean(np.isfinite(found) != np.isfinite(expected)) < 1e-3


@given(
    shape=st.sampled_from(UNIT_SHAPES),
    origin=st.tuples(*[st.floats(-5, 5)] * 3),
    direction=st.tuples(*[st.floats(-2, 2)] * 3),
)
@settings(max_examples=300)
def test_what_is_hit_lies_on_the_surface_and_faces_the_ray(
    shape: Shape, origin: tuple[float, float, float], direction: tuple[float, float, float]
) -> None:
    if np.linalg.norm(direction) < 1e-2:
        return
    t, face = hit_shape(int(shape), origin, direction, 0.0)
    if t == math.inf:
        return
    p = tuple(float(value) for value in np.add(origin, np.multiply(t, direction)))
    if shape == Shape.BOX:
        assert max(abs(value) for value in p) == pytest.approx(1.0, abs=1e-9)
    elif shape == Shape.ELLIPSOID:
        assert np.linalg.norm(p) == pytest.approx(1.0, abs=1e-6)
    else:
        assert abs(p[2]) <= 1.0 + 1e-9
        radius = 1.0 if shape == Shape.CYLINDER else 0.5 * (1.0 - p[2])
        on_side = math.hypot(p[0], p[1]) == pytest.approx(radius, abs=1e-4)
        assert on_side or (face > 0 and math.hypot(p[0], p[1]) <= radius + 1e-9)
    normal = local_normal(int(shape), face, p)
    assert np.dot(normal, direction) <= 1e-4
