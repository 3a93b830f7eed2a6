"""Ray meets unit shape: the innermost loop of the ray caster (compiled by Numba).

`tests/scenes/raycast/intersect_reference.py` defines it in NumPy; tests compare the two.
"""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.vectors import Vector, dot, on_axis

FACE_SIDE = 0
FACE_TOP = 1
FACE_BOTTOM = 2
MISS = math.inf
_FLAT = 1e-300
"""Replaces a direction component of 0, so that dividing by it gives a huge number, not NaN."""


@jit(error_model="numpy", inner=True)
def hit_ellipsoid(o: Vector, d: Vector, near: float) -> tuple[float, int]:
    """Where a ray enters the unit sphere: (parameter, face), (inf, 0) if it does not."""
    a, b, c = dot(d, d), dot(o, d), dot(o, o) - 1.0
    discriminant = b * b - a * c
    if discriminant <= 0.0:
        return MISS, FACE_SIDE
    t = (-b - math.sqrt(discriminant)) / a
    if t <= near:
        return MISS, FACE_SIDE
    return t, FACE_SIDE


@jit(error_model="numpy", inner=True)
def hit_box(o: Vector, d: Vector, near: float) -> tuple[float, int]:
    """Where a ray enters the cube |x|, |y|, |z| <= 1; faces are 0..5 = -x, +x, -y, +y, -z, +z."""
    enter, leave, face = -MISS, MISS, 0
    for axis in range(3):
        inverse = 1.0 / (d[axis] if d[axis] != 0.0 else _FLAT)
        first = (-1.0 - o[axis]) * inverse
        second = (1.0 - o[axis]) * inverse
        entry = 2 * axis
        if first > second:
            first, second = second, first
            entry += 1
        if first > enter:
            enter, face = first, entry
        leave = min(leave, second)
    if enter < leave and enter > near:
        return enter, face
    return MISS, 0


@jit(error_model="numpy", inner=True)
def _hit_disc(o: Vector, d: Vector, height: float) -> float:
    """Where a ray crosses the unit disc at z = `height`; inf if it passes by."""
    if d[2] == 0.0:
        return MISS
    t = (height - o[2]) / d[2]
    x, y = o[0] + t * d[0], o[1] + t * d[1]
    return t if x * x + y * y <= 1.0 else MISS


@jit(error_model="numpy", inner=True)
def hit_cylinder(o: Vector, d: Vector, near: float) -> tuple[float, int]:
    """Where a ray enters x² + y² <= 1, |z| <= 1: side 0, top 1, bottom 2."""
    a = d[0] * d[0] + d[1] * d[1]
    b = o[0] * d[0] + o[1] * d[1]
    c = o[0] * o[0] + o[1] * o[1] - 1.0
    if a > 0.0:
        discriminant = b * b - a * c
        if discriminant <= 0.0:
            return MISS, FACE_SIDE
        t = (-b - math.sqrt(discriminant)) / a
        if t > near and abs(o[2] + t * d[2]) <= 1.0:
            return t, FACE_SIDE
    if d[2] < 0.0:
        t, face = _hit_disc(o, d, 1.0), FACE_TOP
    else:
        t, face = _hit_disc(o, d, -1.0), FACE_BOTTOM
    if t > near:
        return t, face
    return MISS, FACE_SIDE


@jit(error_model="numpy", inner=True)
def hit_cone(o: Vector, d: Vector, near: float) -> tuple[float, int]:
    """Where a ray enters the cone x² + y² <= ((1 - z) / 2)², |z| <= 1: side 0, base 2."""
    w, dw = 0.5 * (1.0 - o[2]), -0.5 * d[2]
    a = d[0] * d[0] + d[1] * d[1] - dw * dw
    b = o[0] * d[0] + o[1] * d[1] - w * dw
    c = o[0] * o[0] + o[1] * o[1] - w * w
    best, face = MISS, FACE_SIDE
    discriminant = b * b - a * c
    if discriminant > 0.0 and a != 0.0:
        root = math.sqrt(discriminant)
        for t in ((-b - root) / a, (-b + root) / a):
            entering = a * t + b < 0.0
            if near < t < best and entering and abs(o[2] + t * d[2]) <= 1.0:
                best = t
    if d[2] > 0.0:
        t = _hit_disc(o, d, -1.0)
        if near < t < best:
            best, face = t, FACE_BOTTOM
    return best, face


@jit(error_model="numpy")
def hit_shape(shape: int, o: Vector, d: Vector, near: float) -> tuple[float, int]:
    """Where the ray `o + t · d`, in unit-shape coordinates, enters the shape from outside.

    Args:
        shape: a `Shape`.
        o: ray origin.
        d: ray direction, any length but 0.
        near: hits at t <= near do not count.

    Returns:
        (t, face): t is inf if the ray misses, or starts inside the shape.
    """
    if shape == 0:
        return hit_ellipsoid(o, d, near)
    if shape == 1:
        return hit_box(o, d, near)
    if shape == 2:
        return hit_cylinder(o, d, near)
    return hit_cone(o, d, near)


@jit(error_model="numpy")
def local_normal(shape: int, face: int, p: Vector) -> Vector:
    """Outward normal at point `p` of a unit shape, not normalised."""
    if shape == 1:
        sign = 1.0 if face % 2 == 1 else -1.0
        axis = face // 2
        return on_axis(axis, sign)
    if shape == 0:
        return p
    if face == FACE_TOP:
        return (0.0, 0.0, 1.0)
    if face == FACE_BOTTOM:
        return (0.0, 0.0, -1.0)
    if shape == 2:
        return (p[0], p[1], 0.0)
    return (p[0], p[1], 0.25 * (1.0 - p[2]))
