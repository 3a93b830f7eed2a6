"""Ray meets unit shape: hand-computed cases, and the compiled kernel against its reference."""

import numpy as np
import pytest
from tests.scenes.raycast.intersect_reference import hit_shape_reference

from texvent_scenes.raycast.trace import hit_shape
from texvent_scenes.rendered_scene import Shape

UNIT_SHAPES = [shape for shape in Shape if shape is not Shape.MESH]


def rays(seed: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Rays from around the unit shapes towards points in and beside them."""
    generator = np.random.default_rng(seed)
    origins = generator.normal(size=(count, 3)) * 3.0
    targets = generator.uniform(-1.6, 1.6, size=(count, 3))
    return origins, (targets - origins) * generator.uniform(0.1, 2.0, size=(count, 1))


@pytest.mark.parametrize("shape", UNIT_SHAPES)
def test_the_kernel_equals_the_reference_on_random_rays(shape):
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
