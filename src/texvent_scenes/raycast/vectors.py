"""Arithmetic of three numbers, and the lens, for kernels (compiled by Numba)."""

from __future__ import annotations

import math

from texvent.lens import CONVERGED, ITERATIONS, WIDEST
from texvent.runtime.jit import jit
from texvent_scenes.raycast.records import Record
from texvent_scenes.rendered_scene import Float64Array

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
def world_normal(m: Float64Array, n: Vector) -> Vector:
    """Unit normal in the world, from one in a shape's coordinates; `m` leads into these."""
    normal = (
        m[0, 0] * n[0] + m[1, 0] * n[1] + m[2, 0] * n[2],
        m[0, 1] * n[0] + m[1, 1] * n[1] + m[2, 1] * n[2],
        m[0, 2] * n[0] + m[1, 2] * n[1] + m[2, 2] * n[2],
    )
    return scaled(normal, 1.0 / math.sqrt(dot(normal, normal) + 1e-300))


@jit(error_model="numpy", inner=True)
def on_axis(axis: int, length: float) -> Vector:
    """A vector along one axis: 0 = x, 1 = y, 2 = z."""
    return (
        length if axis == 0 else 0.0,
        length if axis == 1 else 0.0,
        length if axis == 2 else 0.0,
    )


NO_DISTORTION, RADTAN = 0, 1


@jit(error_model="numpy", inner=True)
def _undistorted_radtan(k: Record, tx: float, ty: float) -> tuple[float, float]:
    k1, k2, p1, p2, k3 = k[0], k[1], k[2], k[3], k[4]
    x, y, radius = tx, ty, math.hypot(tx, ty)
    if radius > k[5]:
        x, y = tx * (k[5] / radius), ty * (k[5] / radius)
    for _ in range(ITERATIONS):
        square = x * x + y * y
        radial = 1.0 + square * (k1 + square * (k2 + square * k3))
        slope = 2.0 * (k1 + square * (2.0 * k2 + 3.0 * k3 * square))
        miss_x = x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x * x) - tx
        miss_y = y * radial + 2.0 * p2 * x * y + p1 * (square + 2.0 * y * y) - ty
        xx = radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x
        xy = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y
        yy = radial + slope * y * y + 2.0 * p2 * x + 6.0 * p1 * y
        determinant = xx * yy - xy * xy
        step_x = (yy * miss_x - xy * miss_y) / determinant
        step_y = (xx * miss_y - xy * miss_x) / determinant
        x, y = x - step_x, y - step_y
        if abs(step_x) <= CONVERGED and abs(step_y) <= CONVERGED:
            break
    return x, y


@jit(error_model="numpy", inner=True)
def _undistorted_equidistant(k: Record, tx: float, ty: float) -> tuple[float, float]:
    distorted = math.hypot(tx, ty)
    if distorted == 0.0:
        return tx, ty
    angle = distorted
    for _ in range(ITERATIONS):
        a = angle * angle
        miss = angle * (1.0 + a * (k[0] + a * (k[1] + a * (k[2] + a * k[3])))) - distorted
        slope = 1.0 + a * (3.0 * k[0] + a * (5.0 * k[1] + a * (7.0 * k[2] + a * 9.0 * k[3])))
        step = miss / slope
        angle -= step
        if abs(step) <= CONVERGED:
            break
    if not 0.0 <= angle <= WIDEST:
        return math.nan, math.nan
    ratio = math.tan(angle) / distorted
    return tx * ratio, ty * ratio


@jit(error_model="numpy", inner=True)
def plane_point(instant: Record, x: float, y: float) -> tuple[float, float]:
    """Undistorted place of image point (x, y), pixels.

    NaN where the lens lets nothing through.
    """
    if instant.distortion == NO_DISTORTION:
        return x, y
    lens, k = instant.lens, instant.coefficients
    tx, ty = (x - lens[2]) / lens[0], (y - lens[3]) / lens[1]
    if instant.distortion == RADTAN:
        u, v = _undistorted_radtan(k, tx, ty)
    else:
        u, v = _undistorted_equidistant(k, tx, ty)
    return u * lens[0] + lens[2], v * lens[1] + lens[3]


@jit(error_model="numpy", inner=True)
def pixel_steps(instant: Record, x: float, y: float) -> tuple[Vector, Vector]:
    """Change of direction from one pixel to the next at (x, y), to the right and down."""
    right, down = triple(instant.right), triple(instant.down)
    if instant.distortion == NO_DISTORTION:
        return right, down
    left, west = plane_point(instant, x - 0.5, y), plane_point(instant, x, y - 0.5)
    near, low = plane_point(instant, x + 0.5, y), plane_point(instant, x, y + 0.5)
    if math.isnan(left[0] + west[0] + near[0] + low[0]):
        return right, down  # on the rim of what the lens lets through
    return (
        along(scaled(right, near[0] - left[0]), down, near[1] - left[1]),
        along(scaled(right, low[0] - west[0]), down, low[1] - west[1]),
    )
