"""Ray meets mesh (Numba).

Triangles: Woop, Benthin, Wald, Watertight Ray/Triangle Intersection (2013): an edge is decided by
the same two numbers in both triangles that share it, so no ray slips between them. Boxes are
passed with the slack that rounding needs (Ize, Robust BVH Ray Traversal, 2013). The tree is walked
in the order of its nodes; a box that is missed is skipped with all in it.
"""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent_scenes.raycast.addresses import node_at, shape_at, triangle_at
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.vectors import (
    Vector,
    along,
    dot,
    mapped,
    scaled,
    triple,
    world_normal,
)

_SLACK = 1.0 + 8.0 * 2.0**-53
_FLAT = 1e-300


@jit(error_model="numpy", inner=True)
def _component(v: Vector, axis: int) -> float:
    if axis == 0:
        return v[0]
    return v[1] if axis == 1 else v[2]


@jit(error_model="numpy", inner=True)
def _hit_triangle(triangle: Record, o: Vector, shear: Vector, axes: tuple[int, int, int]) -> float:
    """Ray parameter at a triangle, from either side; inf if the ray misses it.

    `axes` are the ray's longest axis last, and two more; `shear` makes it run along that axis at
    length 1.
    """
    kx, ky, kz = axes
    c = triangle.corner
    ox, oy, oz = _component(o, kx), _component(o, ky), _component(o, kz)
    az, bz, cz = c[0, kz] - oz, c[1, kz] - oz, c[2, kz] - oz
    ax, ay = (c[0, kx] - ox) - shear[0] * az, (c[0, ky] - oy) - shear[1] * az
    bx, by = (c[1, kx] - ox) - shear[0] * bz, (c[1, ky] - oy) - shear[1] * bz
    cx, cy = (c[2, kx] - ox) - shear[0] * cz, (c[2, ky] - oy) - shear[1] * cz
    u, v, w = cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax
    if (u < 0.0 or v < 0.0 or w < 0.0) and (u > 0.0 or v > 0.0 or w > 0.0):
        return math.inf
    total = u + v + w
    if total == 0.0:
        return math.inf
    return float((u * az + v * bz + w * cz) * shear[2] / total)


@jit(error_model="numpy", inner=True)
def _meets_box(node: Record, o: Vector, inverse: Vector, near: float, far: float) -> bool:
    """Whether the ray is in a box between two parameters, with slack."""
    for axis in range(3):
        start, slope = _component(o, axis), _component(inverse, axis)
        first, second = (node.low[axis] - start) * slope, (node.high[axis] - start) * slope
        near = max(near, min(first, second))
        far = min(far, max(first, second) * _SLACK)
    return near <= far


@jit(error_model="numpy", inner=True)
def hit_mesh(
    instant: Record, root: int, o: Vector, d: Vector, near: float, any_hit: bool
) -> tuple[float, int]:
    """First intersection of the ray `o + t · d`, in the mesh's coordinates, from either side.

    Args:
        instant: the scene.
        root: first node of the mesh.
        o: ray origin.
        d: ray direction, any length but 0.
        near: hits at t <= near do not count.
        any_hit: whether any hit is enough, not the first one: shadows.

    Returns:
        (t, triangle), (inf, 0) where it is missed.
    """
    nodes, triangles = instant.nodes, instant.triangles
    inverse = (
        1.0 / (d[0] if d[0] != 0.0 else _FLAT),
        1.0 / (d[1] if d[1] != 0.0 else _FLAT),
        1.0 / (d[2] if d[2] != 0.0 else _FLAT),
    )
    axes = _long_axis_last(d)
    length = _component(d, axes[2])
    shear = (_component(d, axes[0]) / length, _component(d, axes[1]) / length, 1.0 / length)
    hit = (math.inf, 0)
    current, end = root, int(node_at(nodes, root).skip)
    while current < end:
        node = node_at(nodes, current)
        if not _meets_box(node, o, inverse, near, hit[0]):
            current = int(node.skip)
            continue
        current += 1
        if node.count > 0:
            hit = _hit_leaf(triangles, node, (o, shear), axes, near, hit)
            if any_hit and hit[0] < math.inf:
                break
    return hit


@jit(error_model="numpy", inner=True)
def _hit_leaf(
    triangles: int,
    node: Record,
    ray: tuple[Vector, Vector],
    axes: tuple[int, int, int],
    near: float,
    hit: tuple[float, int],
) -> tuple[float, int]:
    """The nearer of `hit` and what the ray (origin, shear) meets in a leaf."""
    best, found = hit
    for index in range(node.first, node.first + node.count):
        t = _hit_triangle(triangle_at(triangles, index), ray[0], ray[1], axes)
        if near < t < best:
            best, found = t, index
    return best, found


@jit(error_model="numpy", inner=True)
def _long_axis_last(d: Vector) -> tuple[int, int, int]:
    x, y, z = abs(d[0]), abs(d[1]), abs(d[2])
    if x >= y and x >= z:
        return 1, 2, 0
    if y >= z:
        return 2, 0, 1
    return 0, 1, 2


@jit(error_model="numpy", inner=True)
def weights_at(triangle: Record, p: Vector) -> tuple[float, float, float]:
    """Barycentric weights of a point of a triangle's plane."""
    second, third = slopes_of(triangle, along(p, triple(triangle.corner[0]), -1.0))
    return 1.0 - second - third, second, third


@jit(error_model="numpy", inner=True)
def cross(a: Vector, b: Vector) -> Vector:
    """Vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@jit(error_model="numpy", inner=True)
def slopes_of(triangle: Record, v: Vector) -> tuple[float, float]:
    """Slopes of the weights of a triangle's second and third corner along a vector."""
    a = triple(triangle.corner[0])
    e1 = along(triple(triangle.corner[1]), a, -1.0)
    e2 = along(triple(triangle.corner[2]), a, -1.0)
    n = cross(e1, e2)
    square = dot(n, n)
    return dot(cross(v, e2), n) / square, dot(cross(e1, v), n) / square


@jit(error_model="numpy", inner=True)
def mesh_normals(instant: Record, number: int, face: int, point: Vector) -> tuple[Vector, Vector]:
    """Unit normals of a mesh at a world point, towards the camera.

    Returns:
        That of the smooth surface, and that of the triangle.
    """
    shape, triangle = shape_at(instant.shapes, number), triangle_at(instant.triangles, face)
    m = shape.inverse
    a = triple(triangle.corner[0])
    e1 = along(triple(triangle.corner[1]), a, -1.0)
    e2 = along(triple(triangle.corner[2]), a, -1.0)
    flat = world_normal(m, cross(e1, e2))
    w = weights_at(triangle, mapped(m, point))
    n = triangle.normal
    smooth = world_normal(
        m,
        (
            w[0] * n[0, 0] + w[1] * n[1, 0] + w[2] * n[2, 0],
            w[0] * n[0, 1] + w[1] * n[1, 1] + w[2] * n[2, 1],
            w[0] * n[0, 2] + w[1] * n[1, 2] + w[2] * n[2, 2],
        ),
    )
    view = along(point, triple(instant.origin), -1.0)
    if dot(flat, view) > 0.0:
        flat = scaled(flat, -1.0)
    if dot(smooth, flat) < 0.0:
        smooth = scaled(smooth, -1.0)
    return smooth, flat


@jit(error_model="numpy", inner=True)
def smooth_point(instant: Record, number: int, face: int, point: Vector) -> Vector:
    """A point of a mesh moved out to the smooth surface that its corner normals stand for.

    Shadow rays start there, or triangles would shade each other where light grazes: Hanika,
    Hacking the Shadow Terminator (Ray Tracing Gems II, 2021).
    """
    shape, triangle = shape_at(instant.shapes, number), triangle_at(instant.triangles, face)
    p = mapped(shape.inverse, point)
    w = weights_at(triangle, p)
    a = triple(triangle.corner[0])
    e1 = along(triple(triangle.corner[1]), a, -1.0)
    outward = cross(e1, along(triple(triangle.corner[2]), a, -1.0))
    if dot(outward, along(triple(shape.eye), p, -1.0)) < 0.0:
        outward = scaled(outward, -1.0)
    offset = (0.0, 0.0, 0.0)
    for corner in range(3):
        n = triple(triangle.normal[corner])
        n = n if dot(n, outward) >= 0.0 else scaled(n, -1.0)
        below = dot(along(p, triple(triangle.corner[corner]), -1.0), n)
        share = _component(w, corner) * min(0.0, below)
        offset = along(offset, n, -share)
    # Local offsets are small; the inverse map's own inverse takes them to the world.
    m = shape.inverse
    c0 = cross((m[1, 0], m[1, 1], m[1, 2]), (m[2, 0], m[2, 1], m[2, 2]))
    c1 = cross((m[2, 0], m[2, 1], m[2, 2]), (m[0, 0], m[0, 1], m[0, 2]))
    c2 = cross((m[0, 0], m[0, 1], m[0, 2]), (m[1, 0], m[1, 1], m[1, 2]))
    scale = 1.0 / dot((m[0, 0], m[0, 1], m[0, 2]), c0)
    moved = along(along(scaled(c0, offset[0]), c1, offset[1]), c2, offset[2])
    return along(point, moved, scale)
