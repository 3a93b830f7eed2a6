"""Ray caster: which surface a ray meets first, and whether the sun reaches it (Numba kernels).

`tests/scenes/raycast/intersect_reference.py` defines how a ray meets a unit shape in NumPy; tests
compare the two.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent_scenes.raycast.acceleration import NEAR_M, SUN_CELLS, TILE
from texvent_scenes.raycast.addresses import list_at, shape_at, triangle_at
from texvent_scenes.raycast.meshes.hit import hit_mesh, mesh_normals, smooth_point
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.vectors import (
    NO_DISTORTION,
    Vector,
    along,
    dot,
    mapped,
    on_axis,
    plane_point,
    times,
    triple,
    turned,
    world_normal,
)

Listed = tuple[int, int, int]
"""Address of a list of shapes, front to back, its first place and the one past the last; −1: none
is chosen."""
FACE_SIDE = 0
FACE_TOP = 1
FACE_BOTTOM = 2
MISS = math.inf
_FLAT = 1e-300
"""Replaces a direction component of 0, so that dividing by it gives a huge number, not NaN."""


@jit(error_model="numpy", inner=True)
def hit_ellipsoid(o: Vector, d: Vector, near: float) -> tuple[float, int]:
    """Entry of a ray into the unit sphere: (parameter, face), (inf, 0) if it misses."""
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
    """Entry of a ray into the cube |x|, |y|, |z| <= 1; faces are 0..5 = -x, +x, -y, +y, -z, +z."""
    enter, leave = -MISS, MISS
    for axis in range(3):  # without branches: they take more time than the arithmetic
        first, second = _slab(o[axis], d[axis])
        enter, leave = max(enter, min(first, second)), min(leave, max(first, second))
    if not (enter < leave and enter > near):
        return MISS, 0
    for axis in range(3):
        first, second = _slab(o[axis], d[axis])
        if min(first, second) == enter:
            return enter, 2 * axis + int(first > second)
    return MISS, 0


@jit(error_model="numpy", inner=True)
def _slab(o: float, d: float) -> tuple[float, float]:
    """Parameters at which a ray crosses -1 and 1 along one axis."""
    inverse = 1.0 / (d if d != 0.0 else _FLAT)
    return (-1.0 - o) * inverse, (1.0 - o) * inverse


@jit(error_model="numpy", inner=True)
def _hit_disc(o: Vector, d: Vector, height: float) -> float:
    """Parameter where a ray crosses the unit disc at z = `height`; inf if it misses."""
    if d[2] == 0.0:
        return MISS
    t = (height - o[2]) / d[2]
    x, y = o[0] + t * d[0], o[1] + t * d[1]
    return t if x * x + y * y <= 1.0 else MISS


@jit(error_model="numpy", inner=True)
def hit_cylinder(o: Vector, d: Vector, near: float) -> tuple[float, int]:
    """Entry of a ray into x² + y² <= 1, |z| <= 1: side 0, top 1, bottom 2."""
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
    """Entry of a ray into the cone x² + y² <= ((1 - z) / 2)², |z| <= 1: side 0, base 2."""
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
    """Entry of the ray `o + t · d`, in unit-shape coordinates, into the shape from outside.

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


GROUND = -1
SKY = -2
ROOM = -3
NOTHING = -4
"""Hits other than shape number 0, 1, ...; NOTHING: the lens lets no ray through."""
CODES = 64
"""Numbers that `surface_code` keeps for each shape."""
BOX, MESH = 1, 4
_NO_GROUND = 10
_FLOOR = 6
SHADOW_BIAS_M = 2e-3
"""A shadow ray starts this far off the surface, so that rounding does not shade it."""


@jit(error_model="numpy")
def ray_direction(rays: Record, x: float, y: float) -> Vector:
    """Direction through image point (x, y); its component along the optical axis is 1."""
    u, v = plane_point(rays, x, y)
    return plane_direction(rays, u, v)


@jit(error_model="numpy", inner=True)
def plane_direction(rays: Record, x: float, y: float) -> Vector:
    """Direction through a point of the image without distortion."""
    return (
        rays.corner[0] + x * rays.right[0] + y * rays.down[0],
        rays.corner[1] + x * rays.right[1] + y * rays.down[1],
        rays.corner[2] + x * rays.right[2] + y * rays.down[2],
    )


@jit(error_model="numpy", inner=True)
def _hit_one(instant: Record, shape: Record, direction: Vector) -> tuple[float, int, Vector]:
    """Hit of a camera ray on one shape: depth, face (of a mesh: triangle), local direction."""
    d = turned(shape.inverse, direction)
    if shape.kind == MESH:
        t, face = hit_mesh(instant, shape.root, triple(shape.eye), d, NEAR_M, False)
    else:
        t, face = hit_shape(shape.kind, triple(shape.eye), d, NEAR_M)
    return t, face, d


@jit(error_model="numpy", inner=True)
def hit_again(instant: Record, x: float, y: float, number: int) -> tuple[float, int]:
    """(depth, face) where the ray through (x, y) meets shape `number`, as if it stood alone."""
    t, face, _ = _hit_one(instant, shape_at(instant.shapes, number), ray_direction(instant, x, y))
    return t, face


@jit(error_model="numpy", inner=True)
def widened_hit(shape: Record, o: Vector, d: Vector, near: float) -> float:
    """Parameter where the ray from `o` meets a thin shape, widened; inf if even that misses.

    Of a mesh with thin parts the box around it is met.
    """
    s = triple(shape.shrink)
    kind = BOX if shape.kind == MESH else shape.kind
    return hit_shape(kind, times(o, s), times(d, s), near)[0]


@jit(error_model="numpy", inner=True)
def is_between(instant: Record, shape: Record, o: Vector, d: Vector, far: float) -> bool:
    """Whether the ray `o + t · d`, in the shape's coordinates, meets it at 0 < t < `far`."""
    if shape.kind == MESH:
        return hit_mesh(instant, shape.root, o, d, 0.0, far == math.inf)[0] < far
    return hit_shape(shape.kind, o, d, 0.0)[0] < far


@jit(error_model="numpy", inner=True)
def stands_between(instant: Record, shape: Record, point: Vector, d: Vector, far: float) -> bool:
    """As `is_between`, of a ray from a point of the world; of a box axis by axis, as most miss."""
    m = shape.inverse
    if shape.kind != BOX:
        return is_between(instant, shape, mapped(m, point), d, far)
    enter, leave = -MISS, MISS
    for axis in range(3):
        o = m[axis, 0] * point[0] + m[axis, 1] * point[1] + m[axis, 2] * point[2] + m[axis, 3]
        first, second = _slab(o, d[axis])
        enter, leave = max(enter, min(first, second)), min(leave, max(first, second))
        if enter >= leave or leave <= 0.0 or enter >= far:
            return False
    return enter > 0.0


@jit(error_model="numpy", inner=True)
def surface_code(instant: Record, number: int, face: int) -> int:
    """One number for what was hit, which differs between neighbouring surfaces."""
    if number >= 0 and shape_at(instant.shapes, number).kind == MESH:
        face = triangle_at(instant.triangles, face).code
    return number * CODES + face


@jit(error_model="numpy", inner=True)
def tile_at(instant: Record, x: float, y: float) -> int:
    """The screen tile at a point of the image without distortion."""
    corner = instant.plane_corner
    column = min(max(int(x - corner[0]) // TILE, 0), instant.tile_columns - 1)
    row = min(max(int(y - corner[1]) // TILE, 0), instant.tile_rows - 1)
    return int(row * instant.tile_columns + column)


@jit(error_model="numpy", inner=True)
def shows_code(instant: Record, x: float, y: float, code: int) -> bool:
    """Whether a mesh shows the surface of a `surface_code` at (x, y).

    In the middle between two legs of a chair it does not. Unit shapes are convex: the middle of
    their pieces is on them.
    """
    number = code // CODES
    if number < 0 or shape_at(instant.shapes, number).kind != MESH:
        return True
    depth, face = hit_again(instant, x, y, number)
    return depth < math.inf and surface_code(instant, number, face) == code


@jit(error_model="numpy", inner=True)
def shapes_at(instant: Record, x: float, y: float) -> Listed:
    """The shapes that the ray through image point (x, y) may meet: those of its tile."""
    x, y = plane_point(instant, x, y)
    if math.isnan(x):
        return instant.lists, 0, 0
    cell = tile_at(instant, x, y)
    return instant.lists, list_at(instant.lists, cell), list_at(instant.lists, cell + 1)


@jit(error_model="numpy", inner=True)
def shapes_near(
    instant: Record,
    box: tuple[float, float, float, float],
    near: NDArray[np.int32],
    is_wide: bool,
) -> Listed:
    """The shapes that rays through a rectangle within a tile may meet, in the order of the tile.

    Args:
        instant: the scene.
        box: lowest x, highest x, lowest y, highest y, pixels.
        near: [any] is written; with more shapes, or with a distorted lens, the tile's are given.
        is_wide: whether thin shapes that are only near count.
    """
    lists, first, last = shapes_at(instant, 0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]))
    if instant.distortion != NO_DISTORTION:
        return lists, -1, -1
    count = 0
    for index in range(first, last):
        number = list_at(lists, index)
        shape = shape_at(instant.shapes, number)
        window = shape.window
        edge = 0.0 if is_wide and shape.is_thin else instant.window_edge
        if box[1] < window[0] + edge or box[0] > window[1] - edge:
            continue
        if box[3] < window[2] + edge or box[2] > window[3] - edge:
            continue
        if count == len(near):
            return lists, first, last
        near[count] = number
        count += 1
    return int(np.int64(near.ctypes.data)), 0, count


@jit(error_model="numpy", inner=True)
def first_hit(instant: Record, x: float, y: float) -> tuple[float, int, int, bool]:
    """First hit of the ray through image point (x, y).

    Returns:
        (depth in metres, shape number or GROUND / SKY / ROOM / NOTHING, face, whether a thin
        shape is near).
    """
    return first_listed(instant, x, y, shapes_at(instant, x, y), True)


@jit(error_model="numpy", inner=True)
def first_listed(
    instant: Record, x: float, y: float, listed: Listed, is_wide: bool
) -> tuple[float, int, int, bool]:
    """As `first_hit`, among some shapes; thin ones that are near are looked for where `is_wide`."""
    if listed[1] < 0:
        listed = shapes_at(instant, x, y)
    lists = listed[0]
    x, y = plane_point(instant, x, y)
    if math.isnan(x):
        return math.inf, NOTHING, 0, False
    direction = plane_direction(instant, x, y)
    best, found, best_face = background_hit(instant, direction)
    thin = math.inf
    for index in range(listed[1], listed[2]):
        shape = shape_at(instant.shapes, list_at(lists, index))
        if shape.depth >= best:
            break
        window = shape.window
        edge = 0.0 if is_wide and shape.is_thin else instant.window_edge
        if x < window[0] + edge or x > window[1] - edge:
            continue
        if y < window[2] + edge or y > window[3] - edge:
            continue
        t, face, d = _hit_one(instant, shape, direction)
        if t < best:
            best, found, best_face = t, int(list_at(lists, index)), face
        if is_wide and shape.is_thin:
            thin = min(thin, widened_hit(shape, triple(shape.eye), d, NEAR_M))
    return best, found, best_face, thin < math.inf and thin <= best


@jit(error_model="numpy", inner=True)
def background_hit(instant: Record, direction: Vector) -> tuple[float, int, int]:
    """(depth, GROUND / SKY / ROOM, face) of the background behind all shapes."""
    return background_from(instant, triple(instant.origin), direction)


@jit(error_model="numpy", inner=True)
def background_from(instant: Record, origin: Vector, direction: Vector) -> tuple[float, int, int]:
    """As `background_hit`, of the ray from any point."""
    if instant.ground == _NO_GROUND:
        return math.inf, SKY, 0
    depth, what, face = math.inf, SKY, 0
    if direction[2] < 0.0 and origin[2] > 0.0:
        depth, what = -origin[2] / direction[2], GROUND
    if instant.ground == _FLOOR:
        for axis in range(3):
            side = (instant.room_x, instant.room, instant.ceiling)[axis]
            if axis < 2 or direction[2] > 0.0:
                wall = side if direction[axis] > 0.0 else -side
                step = direction[axis] if direction[axis] != 0.0 else 1e-300
                t = (wall - origin[axis]) / step
                if NEAR_M < t < depth:
                    depth, what, face = t, ROOM, axis
    return depth, what, face


@jit(error_model="numpy", inner=True)
def _blocked_in_cell(
    instant: Record, cell: int, point: Vector, place: Vector, is_wide: bool
) -> tuple[bool, bool]:
    """As `sun_blocked`, by the shapes that one cell of the sun grid lists.

    `place` is the point along the sun plane's axes and towards the sun.
    """
    lists = instant.lists
    thin = False
    for index in range(list_at(lists, cell), list_at(lists, cell + 1)):
        shape = shape_at(instant.shapes, list_at(lists, index))
        window = shape.sun_window
        if place[0] < window[0] or place[0] > window[1] or place[2] > window[4]:
            continue
        if place[1] < window[2] or place[1] > window[3]:
            continue
        d = triple(shape.sun)
        if stands_between(instant, shape, point, d, math.inf):
            return True, thin
        if is_wide and shape.is_thin and not thin:
            thin = widened_hit(shape, mapped(shape.inverse, point), d, 0.0) < math.inf
    return False, thin


@jit(error_model="numpy", inner=True)
def sun_blocked(instant: Record, point: Vector, is_wide: bool) -> tuple[bool, bool]:
    """Whether a shape stands between a point and the sun, and whether a thin one is close to.

    The latter is looked for where `is_wide`.
    """
    plane, sun, grid = instant.sun_plane, instant.sun, instant.sun_grid
    place = (dot(plane[0], point), dot(plane[1], point), dot(sun, point))
    column = math.floor((place[0] - grid[0]) * grid[2])
    row = math.floor((place[1] - grid[1]) * grid[3])
    thin = False
    if 0.0 <= column < SUN_CELLS and 0.0 <= row < SUN_CELLS:
        cell = instant.sun_cells + int(row) * SUN_CELLS + int(column)
        blocked, thin = _blocked_in_cell(instant, cell, point, place, is_wide)
        if blocked:
            return True, thin
    last = instant.sun_cells + SUN_CELLS * SUN_CELLS
    blocked, big_thin = _blocked_in_cell(instant, last, point, place, is_wide)
    return blocked, thin or big_thin


@jit(error_model="numpy", inner=True)
def surface_normal(instant: Record, number: int, face: int, point: Vector) -> Vector:
    """Unit normal of what was hit at `point`, metres."""
    if number in (GROUND, NOTHING):
        return (0.0, 0.0, 1.0)
    if number == ROOM:
        return on_axis(face, -1.0 if face == 2 or point[face] > 0.0 else 1.0)
    if shape_at(instant.shapes, number).kind == MESH:
        return mesh_normals(instant, number, face, point)[0]
    m = shape_at(instant.shapes, number).inverse
    return world_normal(
        m, local_normal(shape_at(instant.shapes, number).kind, face, mapped(m, point))
    )


@jit(error_model="numpy", inner=True)
def shadow_point(instant: Record, number: int, face: int, point: Vector) -> Vector:
    """Origin of a surface's shadow rays: its point, for a mesh that on the smooth surface."""
    if number >= 0 and shape_at(instant.shapes, number).kind == MESH:
        return smooth_point(instant, number, face, point)
    return point


@jit(error_model="numpy", inner=True)
def sun_reaches(instant: Record, point: Vector, normal: Vector, is_wide: bool) -> tuple[bool, bool]:
    """Whether direct light falls on a surface, and whether a thin shape's shadow is near.

    The latter is looked for where `is_wide`.
    """
    if dot(instant.sun, normal) <= 0.0:
        return False, False
    if not instant.shadows:
        return True, False
    blocked, thin = sun_blocked(instant, along(point, normal, SHADOW_BIAS_M), is_wide)
    return not blocked, thin
