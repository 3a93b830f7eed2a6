"""Arithmetic of three numbers, for kernels (compiled by Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.scene import Float64Array

Vector = tuple[float, float, float]


@jit(error_model="numpy", inner=True)
def triple(values: Float64Array) -> Vector:
    """Three numbers of a record as a tuple."""
    return values[0], values[1], values[2]


@jit(error_model="numpy", inner=True)
def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@jit(error_model="numpy", inner=True)
def times(a: Vector, b: Vector) -> Vector:
    """Product, element by element."""
    return a[0] * b[0], a[1] * b[1], a[2] * b[2]


@jit(error_model="numpy", inner=True)
def scaled(a: Vector, factor: float) -> Vector:
    """All three times `factor`."""
    return a[0] * factor, a[1] * factor, a[2] * factor


@jit(error_model="numpy", inner=True)
def along(start: Vector, step: Vector, share: float) -> Vector:
    """`start` + `share` · `step`."""
    return start[0] + share * step[0], start[1] + share * step[1], start[2] + share * step[2]


@jit(error_model="numpy", inner=True)
def unit(a: Vector) -> Vector:
    """The vector at length 1."""
    return scaled(a, 1.0 / math.sqrt(dot(a, a)))


@jit(error_model="numpy", inner=True)
def turned(m: Float64Array, v: Vector) -> Vector:
    """A [3, 4] map's linear part, applied to a direction."""
    return (
        m[0, 0] * v[0] + m[0, 1] * v[1] + m[0, 2] * v[2],
        m[1, 0] * v[0] + m[1, 1] * v[1] + m[1, 2] * v[2],
        m[2, 0] * v[0] + m[2, 1] * v[1] + m[2, 2] * v[2],
    )


@jit(error_model="numpy", inner=True)
def mapped(m: Float64Array, p: Vector) -> Vector:
    """A [3, 4] map, applied to a point."""
    x, y, z = turned(m, p)
    return x + m[0, 3], y + m[1, 3], z + m[2, 3]


@jit(error_model="numpy", inner=True)
def on_axis(axis: int, length: float) -> Vector:
    """A vector along one axis: 0 = x, 1 = y, 2 = z."""
    return (
        length if axis == 0 else 0.0,
        length if axis == 1 else 0.0,
        length if axis == 2 else 0.0,
    )
