"""Light and shadow of lamps: falloff, casters by direction, lamps that reach a surface."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent_scenes.raycast.acceleration import Bins, IntArray, bin_rectangles
from texvent_scenes.raycast.addresses import lamp_at, list_at, shape_at
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.trace import (
    ROOM,
    SHADOW_BIAS_M,
    SKY,
    ray_direction,
    shadow_point,
    stands_between,
    sun_reaches,
    surface_normal,
    widened_hit,
)
from texvent_scenes.raycast.vectors import Vector, along, dot, mapped, triple, turned
from texvent_scenes.rendered_scene import Colour, Float64Array, Primitives, Shape


@jit(error_model="numpy", inner=True)
def beam_share(lamp: Record, away: Vector) -> float:
    """Share of a lamp's light that it sends along a unit vector: a beam with a soft edge."""
    if lamp.full < -1.0:
        return 1.0
    cosine = lamp.beam[0] * away[0] + lamp.beam[1] * away[1] + lamp.beam[2] * away[2]
    if cosine <= lamp.dark:
        return 0.0
    if cosine >= lamp.full:
        return 1.0
    share = (cosine - lamp.dark) / (lamp.full - lamp.dark)
    return float(share * share * (3.0 - 2.0 * share))


@jit(error_model="numpy", inner=True)
def falloff(lamp: Record, towards: Vector) -> tuple[float, float]:
    """(light on a surface that faces the lamp, as a share of that at 1 m; distance in metres).

    `towards` leads from the surface to the lamp, metres. A disc of radius r gives 1 / (d² + r²)
    on its axis; the square of 1 - d² / reach² lets it end at its reach.
    """
    square = dot(towards, towards)
    reach = lamp.reach * lamp.reach
    distance = math.sqrt(square) + 1e-9
    if square >= reach:
        return 0.0, distance
    step = -1.0 / distance
    share = beam_share(lamp, (step * towards[0], step * towards[1], step * towards[2]))
    window = 1.0 - square / reach
    return share * window * window / (square + lamp.radius * lamp.radius), distance


@jit(error_model="numpy", inner=True)
def towards_lamp(lamp: Record, point: Vector) -> Vector:
    """Vector from a point to a lamp, metres."""
    return along(triple(lamp.place), point, -1.0)


@jit(error_model="numpy")
def lamp_light(instant: Record, point: Vector, normal: Vector, lit: int) -> Colour:
    """Light of all lamps on a surface.

    Args:
        instant: the scene.
        point: metres.
        normal: of the surface, unit vector.
        lit: bit 1 + k: whether the k-th of the lamps that cast shadows is visible from there.
    """
    light = (0.0, 0.0, 0.0)
    shadow_lamps = instant.shadow_lamps
    for index in range(instant.lamp_count):
        if index < shadow_lamps and not (lit >> (index + 1)) & 1:
            continue
        lamp = lamp_at(instant.lamps, index)
        towards = towards_lamp(lamp, point)
        facing = dot(towards, normal)
        if facing <= 0.0:
            continue
        share, distance = falloff(lamp, towards)
        light = along(light, triple(lamp.light), share * facing / distance)
    return light


@jit(error_model="numpy", inner=True)
def light_through(instant: Record, point: Vector) -> Colour:
    """Light of all lamps at a point in the air, from all sides, without shadows."""
    light = (0.0, 0.0, 0.0)
    for index in range(instant.lamp_count):
        lamp = lamp_at(instant.lamps, index)
        share, _ = falloff(lamp, towards_lamp(lamp, point))
        light = along(light, triple(lamp.light), share)
    return light


LONGITUDES, LATITUDES = 96, 64
"""Cells of the grid of directions around a lamp: around the vertical, and by the sine of the
height."""
FINE = 16
"""Parts of a cell's sides, by which the shapes that it lists are told apart."""
CASTER = 6
"""Numbers of a caster in a cell: that of its shape, its distance, mm, and its first and last column
and row of parts of cells."""
MOST_SHADOW_LAMPS = 4
"""Lamps that can cast shadows at one instant."""


def order_lamps(lamps: NDArray[Any], *, shadows: bool) -> tuple[NDArray[Any], int]:
    """Lamps [m], `LAMP_RECORD`, those that cast shadows first, and how many these are.

    `shadows` False: none does.
    """
    casts = np.flatnonzero(lamps["casts"] > 0.0)[: MOST_SHADOW_LAMPS if shadows else 0]
    rest = np.setdiff1d(np.arange(len(lamps)), casts)
    return lamps[np.concatenate([casts, rest])], len(casts)


def list_casters(lamp: Any, shapes: NDArray[Any], primitives: Primitives) -> Bins:
    """The shapes that may stand in a lamp's light, by cells of directions from the lamp.

    Each has `CASTER` numbers, and nearer ones come first: what is farther than a surface cannot
    stand in its light, nor what lies in other directions. Shapes that glow, that hold the lamp or
    that its light does not reach are left out.

    Args:
        lamp: `LAMP_RECORD`.
        shapes: [n] `SHAPE_RECORD`; what thin ones are widened by is known.
        primitives: the shapes.
    """
    place = lamp["place"]
    local = shapes["inverse"][:, :, :3] @ place + shapes["inverse"][:, :, 3]
    is_round = primitives.shape == Shape.ELLIPSOID
    extent = np.where(is_round, np.linalg.norm(local, axis=1), np.abs(local).max(axis=1))
    numbers = np.flatnonzero((np.asarray(primitives.emission) <= 0.0) & (extent > 1.0))
    boxes = np.asarray(primitives.to_world, dtype=np.float64)[numbers]
    boxes[:, :, :3] /= shapes["shrink"][numbers][:, None, :]
    boxes[:, :, 3] -= place
    rectangles = np.empty((len(boxes), 4), np.int64)
    nearest = find_cells(boxes, rectangles)
    near = nearest < lamp["reach"]
    if lamp["full"] >= -1.0:
        near &= in_beam(lamp, boxes)
    order = np.flatnonzero(near)
    order = order[np.argsort(nearest[order], kind="stable")]
    # A range of columns may go round past either edge of the grid.
    columns = FINE * LONGITUDES
    around = rectangles[order] + columns * np.array([[-1], [0], [1]])[:, :, None] * [1, 1, 0, 0]
    touches = (around[:, :, 1] >= 0) & (around[:, :, 0] < columns)
    rank, turn = np.nonzero(touches.T)
    fine = around[turn, rank]
    bins = bin_rectangles(fine // FINE, np.arange(len(fine)), LONGITUDES, LATITUDES)
    chosen = order[rank]
    casters = np.column_stack([numbers[chosen], np.floor(1e3 * nearest[chosen]), fine])
    items = casters.astype(np.int32)[bins.items]
    return Bins(CASTER * bins.start, items.ravel(), LONGITUDES, LATITUDES)


def in_beam(lamp: Any, boxes: Float64Array) -> NDArray[np.bool_]:
    """Boxes, as for `find_cells`, that the beam touches: tested by the balls around them."""
    radius = np.sqrt((boxes[:, :, :3] ** 2).sum(axis=(1, 2)) * 3.0)
    distance = np.linalg.norm(boxes[:, :, 3], axis=1)
    cosine = boxes[:, :, 3] @ lamp["beam"] / np.maximum(distance, 1e-9)
    angle = np.arccos(np.clip(cosine, -1.0, 1.0))
    width = np.arcsin(np.clip(radius / np.maximum(distance, 1e-9), 0.0, 1.0))
    touches = angle - width <= np.arccos(np.clip(lamp["dark"], -1.0, 1.0))
    return np.asarray(touches | (distance <= radius), dtype=np.bool_)


@jit(error_model="numpy")
def find_cells(boxes: Float64Array, rectangles: IntArray) -> Float64Array:
    """Cells of the grid of directions that boxes cover, and how near to its middle they are.

    Args:
        boxes: [n, 3, 4] half axes and middle, m.
        rectangles: [n, 4] first and last column of parts of cells, beyond the grid where they go
            round, and first and last row, are written.

    Returns:
        [n] distances, m, at most those of their nearest points.
    """
    nearest = np.empty(len(boxes))
    for number in range(len(boxes)):
        box = boxes[number]
        middle = _along_diamond(box[0, 3], box[1, 3])
        first, last, reach = 0.0, 0.0, 0.0
        for corner in range(8):
            a, b, c = 1.0 - 2.0 * (corner & 1), 1.0 - (corner & 2), 1.0 - 0.5 * (corner & 4)
            x = box[0, 3] + a * box[0, 0] + b * box[0, 1] + c * box[0, 2]
            y = box[1, 3] + a * box[1, 0] + b * box[1, 1] + c * box[1, 2]
            turn = _along_diamond(x, y) - middle
            turn -= 4.0 * math.floor(0.25 * turn + 0.5)
            first, last, reach = min(first, turn), max(last, turn), max(reach, math.hypot(x, y))
        beside = _distance(box, 2)
        if last - first >= 2.0:  # it is around the vertical
            first, last, beside = -2.0, 2.0, 0.0
        half = abs(box[2, 0]) + abs(box[2, 1]) + abs(box[2, 2])
        low, high = box[2, 3] - half, box[2, 3] + half
        down = low / (math.hypot(low, beside if low < 0.0 else reach) + 1e-300)
        up = high / (math.hypot(high, beside if high > 0.0 else reach) + 1e-300)
        columns, rows = FINE * LONGITUDES, FINE * LATITUDES
        rectangles[number, 0] = math.floor(0.25 * columns * (middle + first) - 1e-5)
        rectangles[number, 1] = math.floor(0.25 * columns * (middle + last) + 1e-5)
        rectangles[number, 1] = min(rectangles[number, 1], rectangles[number, 0] + columns - 1)
        rectangles[number, 2] = math.floor(rows * (0.5 + 0.5 * down) - 1e-5)
        rectangles[number, 3] = math.floor(rows * (0.5 + 0.5 * up) + 1e-5)
        nearest[number] = _distance(box, 3)
    return nearest


@jit(error_model="numpy", inner=True)
def _distance(box: Float64Array, axes: int) -> float:
    """Lower bound of a box's distance from 0, in the plane of x and y (2 axes) or in space (3).

    The greatest separation along the normals of its faces, or along the line to its middle.
    """
    farthest = 0.0
    for normal in range(4):
        length, gap, half = 1e-300, 0.0, 0.0
        for axis in range(axes):
            length += box[axis, normal] * box[axis, normal]
            gap += box[axis, normal] * box[axis, 3]
        for side in range(3):
            part = 0.0
            for axis in range(axes):
                part += box[axis, normal] * box[axis, side]
            half += abs(part)
        farthest = max(farthest, (abs(gap) - half) / math.sqrt(length))
    return farthest


@jit(error_model="numpy", inner=True)
def _along_diamond(x: float, y: float) -> float:
    """Place where a direction crosses the diamond |x| + |y| = 1: 0..4 for 0..2π.

    It grows with the angle, and needs no trigonometry.
    """
    corner = y / (abs(x) + abs(y) + 1e-300)
    if x < 0.0:
        return float(2.0 - corner)
    return float(corner + 4.0 if y < 0.0 else corner)


LIT_BITS = 1 + MOST_SHADOW_LAMPS
"""Bits of a probe that tell what light reaches a surface: the sun, then lamps."""


@jit(error_model="numpy", inner=True)
def direction_parts(towards: Vector, distance: float) -> tuple[int, int]:
    """Column and row of the part of a cell, of a lamp's grid of directions, that a surface is in.

    `towards` leads to the lamp. Columns divide the outline of a diamond around it, rows the height.
    """
    corner = _along_diamond(-towards[0], -towards[1])
    height = 0.5 - 0.5 * towards[2] / distance
    column = min(int(corner * (0.25 * FINE * LONGITUDES)), FINE * LONGITUDES - 1)
    row = min(max(int(height * (FINE * LATITUDES)), 0), FINE * LATITUDES - 1)
    return column, row


@jit(error_model="numpy", inner=True)
def _blocked(
    instant: Record, lamp: int, ray: tuple[Vector, Vector], ends: tuple[float, float], is_wide: bool
) -> tuple[bool, bool]:
    """Whether a shape stands between a point and a lamp, and whether a thin one nearly.

    Args:
        instant: the scene.
        lamp: its number.
        ray: the point, and the vector to the lamp.
        ends: the distance of the lamp, metres, and the share of it beyond which shapes belong to
            the lamp itself.
        is_wide: whether thin ones are looked for.
    """
    point, towards = ray
    lists, thin = instant.lists, False
    column, row = direction_parts(towards, ends[0])
    cell = instant.lamp_cells + lamp * (LONGITUDES * LATITUDES + 1)
    cell += (row // FINE) * LONGITUDES + column // FINE
    reach_mm = 1e3 * math.sqrt(dot(towards, towards))
    for index in range(list_at(lists, cell), list_at(lists, cell + 1), CASTER):
        if list_at(lists, index + 1) > reach_mm:
            break
        if column < list_at(lists, index + 2) or column > list_at(lists, index + 3):
            continue
        if row < list_at(lists, index + 4) or row > list_at(lists, index + 5):
            continue
        shape = shape_at(instant.shapes, list_at(lists, index))
        d = turned(shape.inverse, towards)
        if stands_between(instant, shape, point, d, ends[1]):
            return True, thin
        if is_wide and shape.is_thin and not thin:
            thin = widened_hit(shape, mapped(shape.inverse, point), d, 0.0) < ends[1]
    return False, thin


@jit(error_model="numpy")
def lamps_reach(
    instant: Record, point: Vector, normal: Vector, wanted: int, is_wide: bool
) -> tuple[int, bool]:
    """Lamps that cast shadows and that a surface sees, and whether a thin shadow is near.

    Only the lamps whose bit is set in `wanted` are looked for, thin shadows where `is_wide`. Bit k
    belongs to lamp k. A lamp that the surface faces but whose light ends before it counts as seen.
    """
    seen, thin = 0, False
    for index in range(instant.shadow_lamps):
        if not (wanted >> index) & 1:
            continue
        lamp = lamp_at(instant.lamps, index)
        start = along(point, normal, SHADOW_BIAS_M)
        towards = towards_lamp(lamp, start)
        if dot(towards, normal) <= 0.0:
            continue
        seen |= 1 << index
        share, distance = falloff(lamp, towards)
        if share <= 0.0:
            continue
        ends = distance, 1.0 - min(lamp.radius / distance, 0.9)
        is_blocked, is_thin = _blocked(instant, index, (start, towards), ends, is_wide)
        thin = thin or is_thin
        if is_blocked:
            seen &= ~(1 << index)
    return seen, thin


ALL_LIGHTS = (1 << LIT_BITS) - 1
"""All bits of a probe that tell what light reaches a surface."""
SUN = 1
"""The sun's bit."""


@jit(error_model="numpy", inner=True)
def lit_by(
    instant: Record,
    x: float,
    y: float,
    hit: tuple[float, int, int],
    wanted: int,
    is_wide: bool,
) -> tuple[int, bool]:
    """Lights that reach a hit point (bit 0: sun, then lamps), and whether a thin shadow is near.

    Only the lights in `wanted` are looked for, and only lamps that cast shadows count; thin shadows
    are looked for where `is_wide`.
    """
    depth, number, face = hit
    if number == SKY or (number == ROOM and instant.shadow_lamps == 0):
        return 0, False
    point = along(triple(instant.origin), ray_direction(instant, x, y), depth)
    normal = surface_normal(instant, number, face, point)
    point = shadow_point(instant, number, face, point)
    is_sunlit, thin = False, False
    if number != ROOM and wanted & 1:
        is_sunlit, thin = sun_reaches(instant, point, normal, is_wide)
    lit = int(is_sunlit)
    if instant.shadow_lamps > 0:
        lamps, thin_lamp = lamps_reach(instant, point, normal, wanted >> 1, is_wide)
        lit |= lamps << 1
        thin = thin or thin_lamp
    return lit, thin
