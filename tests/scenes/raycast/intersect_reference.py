"""Ray meets unit shape, said as plainly as possible in NumPy float64: what the kernel must equal.

Every unit shape is an intersection of simpler solids (slabs, a ball, an infinite cylinder, a
double cone cut at its apex). A ray is inside such a solid between two parameters, and inside the
shape between the last entry and the first exit.
"""

import numpy as np

from texvent_scenes.rendered_scene import Float64Array, Shape

_Span = tuple[Float64Array, Float64Array]


def hit_shape_reference(
    shape: Shape, origins: Float64Array, directions: Float64Array
) -> Float64Array:
    """Ray parameters at which rays enter a unit shape from outside.

    Args:
        shape: the unit shape.
        origins: [k, 3] ray origins, unit-shape coordinates.
        directions: [k, 3] ray directions, any length but 0.

    Returns:
        [k] parameters > 0; inf where a ray misses, starts inside or points away.
    """
    spans = {
        Shape.ELLIPSOID: lambda: [_quadric(origins, directions, (1.0, 1.0, 1.0), -1.0)],
        Shape.BOX: lambda: [_slab(origins, directions, axis) for axis in range(3)],
        Shape.CYLINDER: lambda: [
            _quadric(origins, directions, (1.0, 1.0, 0.0), -1.0),
            _slab(origins, directions, 2),
        ],
        Shape.CONE: lambda: [_cone(origins, directions), _slab(origins, directions, 2)],
    }[shape]()
    enter = np.max([span[0] for span in spans], axis=0)
    leave = np.min([span[1] for span in spans], axis=0)
    return np.where((enter < leave) & (enter > 0.0), enter, np.inf)


def _slab(origins: Float64Array, directions: Float64Array, axis: int) -> _Span:
    """Where rays are between the planes -1 and +1 of an axis."""
    o, d = origins[:, axis], directions[:, axis]
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (-1.0 - o) / d, (1.0 - o) / d
    inside = np.abs(o) <= 1.0
    low = np.where(d == 0.0, np.where(inside, -np.inf, np.inf), np.minimum(first, second))
    high = np.where(d == 0.0, np.where(inside, np.inf, -np.inf), np.maximum(first, second))
    return low, high


def _quadric(
    origins: Float64Array, directions: Float64Array, weighted: tuple[float, ...], constant: float
) -> _Span:
    """Where `Σ weight · coordinate² + constant <= 0`, for a solid without holes."""
    weights = np.array(weighted)
    a = (weights * directions**2).sum(axis=1)
    b = 2.0 * (weights * origins * directions).sum(axis=1)
    c = (weights * origins**2).sum(axis=1) + constant
    return _between_roots(a, b, c)


def _between_roots(a: Float64Array, b: Float64Array, c: Float64Array) -> _Span:
    """Where a t² + b t + c <= 0 with a >= 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(b * b - 4.0 * a * c)
        low, high = (-b - root) / (2.0 * a), (-b + root) / (2.0 * a)
    along = a == 0.0
    low = np.where(along, np.where(c <= 0.0, -np.inf, np.inf), low)
    high = np.where(along, np.where(c <= 0.0, np.inf, -np.inf), high)
    missed = np.isnan(low)
    return np.where(missed, np.inf, low), np.where(missed, -np.inf, high)


def _cone(origins: Float64Array, directions: Float64Array) -> _Span:
    """Where x² + y² <= w² and w >= 0, with w = (1 - z) / 2."""
    w, dw = 0.5 * (1.0 - origins[:, 2]), -0.5 * directions[:, 2]
    a = directions[:, 0] ** 2 + directions[:, 1] ** 2 - dw**2
    b = 2.0 * (origins[:, 0] * directions[:, 0] + origins[:, 1] * directions[:, 1] - w * dw)
    c = origins[:, 0] ** 2 + origins[:, 1] ** 2 - w**2
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(b * b - 4.0 * a * c)
        first, second = (-b - root) / (2.0 * a), (-b + root) / (2.0 * a)
    low, high = np.minimum(first, second), np.maximum(first, second)
    below = w + dw * np.stack([low, high]) >= 0.0
    # A steep ray (a < 0) is inside both nappes, outside between the roots: keep the lower nappe.
    steep_low = np.where(dw > 0.0, high, -np.inf)
    steep_high = np.where(dw > 0.0, np.inf, low)
    low = np.where(a < 0.0, steep_low, np.where(below[0], low, np.inf))
    high = np.where(a < 0.0, steep_high, np.where(below[1], high, -np.inf))
    missed = np.isnan(root)
    return np.where(missed, np.inf, low), np.where(missed, -np.inf, high)
