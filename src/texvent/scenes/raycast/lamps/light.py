"""Light and shadow of lamps: columns of their table, casters by direction, what a surface sees."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.scenes.raycast.acceleration import CUBE, Bins, IntArray, bin_rectangles
from texvent.scenes.raycast.addresses import lamp_at, list_at, shape_at
from texvent.scenes.raycast.records import LAMP_RECORD, Record
from texvent.scenes.raycast.trace import (
    ROOM,
    SHADOW_BIAS_M,
    SKY,
    is_between,
    ray_direction,
    shadow_point,
    sun_reaches,
    surface_normal,
    widened_hit,
)
from texvent.scenes.raycast.vectors import Vector, along, dot, mapped, triple, turned
from texvent.scenes.scene import Colour, Float64Array, Primitives, Shape


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
    """From a point to a lamp, metres."""
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
MOST_SHADOW_LAMPS = 4
"""Lamps that can cast shadows at one instant."""
_LONGEST_PIECES = 8


def order_lamps(lamps: Float64Array, *, shadows: bool) -> tuple[NDArray[Any], int]:
    """Records of `Environment.lamps`, those that cast shadows first, and how many these are.

    `shadows` False: none does.
    """
    rows = np.ascontiguousarray(lamps, dtype=np.float64).view(LAMP_RECORD)[:, 0]
    casts = np.flatnonzero(rows["casts"] > 0.0)[: MOST_SHADOW_LAMPS if shadows else 0]
    rest = np.setdiff1d(np.arange(len(rows)), casts)
    return rows[np.concatenate([casts, rest])], len(casts)


Balls = tuple[IntArray, Float64Array, Float64Array]
"""Balls that together hold shapes: [k] number of the shape, [k, 3] centre and [k] radius, m."""


def cover_with_balls(primitives: Primitives) -> Balls:
    """The shapes that may cast shadows, several balls for a long one; those that glow do not."""
    chosen = np.flatnonzero(np.asarray(primitives.emission) <= 0.0)
    linear = np.asarray(primitives.to_world, dtype=np.float64)[chosen, :, :3]
    middle = np.asarray(primitives.to_world, dtype=np.float64)[chosen, :, 3]
    lengths = np.linalg.norm(linear, axis=1)
    longest = lengths.argmax(axis=1)
    rows = np.arange(len(chosen))
    second = np.sort(lengths, axis=1)[:, 1]
    pieces = np.ceil(lengths[rows, longest] / np.maximum(second, 1e-9)).astype(np.int64)
    pieces = np.clip(pieces, 1, _LONGEST_PIECES)
    owner = np.repeat(rows, pieces)
    step = np.arange(len(owner)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    axis = linear[rows, :, longest]
    place = (2.0 * step + 1.0) / pieces[owner] - 1.0
    linear[rows, :, longest] = axis / pieces[:, None]
    corners = np.einsum("nij,kj->nki", linear, CUBE)
    radius = np.linalg.norm(corners, axis=2).max(axis=1)
    return chosen[owner], middle[owner] + place[:, None] * axis[owner], radius[owner]


def list_casters(lamp: Any, balls: Balls, primitives: Primitives, inverse: Float64Array) -> Bins:
    """The shapes that may stand in a lamp's light, by cells of directions from the lamp.

    Each is followed by its distance from the lamp, mm, and nearer ones come first: what is
    farther than a surface cannot stand in its light. Shapes that hold the lamp or that its light
    does not reach are left out.

    Args:
        lamp: `LAMP_RECORD`.
        balls: of `cover_with_balls`.
        primitives: the shapes.
        inverse: [n, 3, 4] world → unit-shape coordinates.
    """
    place = lamp["place"]
    local = inverse[:, :, :3] @ place + inverse[:, :, 3]
    is_round = primitives.shape == Shape.ELLIPSOID
    extent = np.where(is_round, np.linalg.norm(local, axis=1), np.abs(local).max(axis=1))
    numbers, centre, radius = balls
    offset = centre - place
    distance = np.linalg.norm(offset, axis=1)
    near = (distance - radius < lamp["reach"]) & (extent[numbers] > 1.0)
    if lamp["full"] >= -1.0:
        near &= in_beam(lamp, offset, distance, radius)
    numbers, offset, distance, radius = (one[near] for one in (numbers, offset, distance, radius))
    start_mm = np.floor(1e3 * np.maximum(distance - radius, 0.0)).astype(np.int64)
    rectangles, owner = _rectangles(offset, distance, radius)
    order = np.argsort(start_mm[owner], kind="stable")
    rectangles, owner = rectangles[order], owner[order]
    bins = bin_rectangles(rectangles, np.arange(len(owner)), LONGITUDES, LATITUDES)
    shown = owner[bins.items]
    items = np.empty((len(shown), 2), np.int32)
    items[:, 0], items[:, 1] = numbers[shown], start_mm[shown]
    return Bins(2 * bins.start, items.ravel(), LONGITUDES, LATITUDES)


def in_beam(
    lamp: Any, offset: Float64Array, distance: Float64Array, radius: Float64Array
) -> NDArray[np.bool_]:
    """Which balls the beam touches."""
    angle = np.arccos(np.clip(offset @ lamp["beam"] / np.maximum(distance, 1e-9), -1.0, 1.0))
    width = np.arcsin(np.clip(radius / np.maximum(distance, 1e-9), 0.0, 1.0))
    touches = angle - width <= np.arccos(np.clip(lamp["dark"], -1.0, 1.0))
    return np.asarray(touches | (distance <= radius), dtype=np.bool_)


def _rectangles(
    offset: Float64Array, distance: Float64Array, radius: Float64Array
) -> tuple[IntArray, IntArray]:
    """Cells of the grid that balls cover: rectangles, and the ball that each belongs to."""
    inside = distance <= radius * (1.0 + 1e-9)
    safe = np.where(inside, 1.0, distance)
    width = np.where(inside, np.pi, np.arcsin(np.clip(radius / np.maximum(safe, radius), 0, 1)))
    latitude = np.arcsin(np.clip(offset[:, 2] / np.maximum(distance, 1e-12), -1.0, 1.0))
    low = np.maximum(latitude - width, -0.5 * np.pi)
    high = np.minimum(latitude + width, 0.5 * np.pi)
    has_pole = inside | (np.abs(latitude) + width >= 0.5 * np.pi)
    sine = np.sin(np.minimum(width, 0.5 * np.pi)) / np.maximum(np.cos(latitude), 1e-12)
    turn = np.where(has_pole, np.pi, np.arcsin(np.clip(sine, 0.0, 1.0)))
    longitude = np.arctan2(offset[:, 1], offset[:, 0])
    count = np.arange(len(distance))
    columns = LONGITUDES / 4.0
    first = np.floor(_along_diamond(longitude - turn) * columns - 1e-6).astype(np.int64)
    last = np.floor(_along_diamond(longitude + turn) * columns + 1e-6).astype(np.int64)
    last = np.minimum(last, first + LONGITUDES - 1)
    top = np.floor((0.5 + 0.5 * np.sin(low)) * LATITUDES - 1e-6).astype(np.int64)
    bottom = np.floor((0.5 + 0.5 * np.sin(high)) * LATITUDES + 1e-6).astype(np.int64)
    # A range of columns may go round past either edge of the grid.
    pieces = [np.stack([first + turns, last + turns, top, bottom], axis=1)
              for turns in (-LONGITUDES, 0, LONGITUDES)]  # fmt: skip
    rectangles = np.concatenate(pieces)
    owner = np.tile(count, len(pieces))
    touches = (rectangles[:, 1] >= 0) & (rectangles[:, 0] < LONGITUDES)
    return rectangles[touches], owner[touches]


def _along_diamond(angle: Float64Array) -> Float64Array:
    """Where a direction crosses the diamond |x| + |y| = 1: 0..4 for 0..2π, and so on.

    It grows with the angle, and needs no trigonometry where the direction is known.
    """
    x, y = np.cos(angle), np.sin(angle)
    corner = y / (np.abs(x) + np.abs(y))
    corner = np.where(x < 0.0, 2.0 - corner, np.where(y < 0.0, 4.0 + corner, corner))
    return np.asarray(corner + 4.0 * np.floor(angle / (2.0 * np.pi)))


LIT_BITS = 1 + MOST_SHADOW_LAMPS
"""Bits of a probe that tell what light reaches a surface: the sun, then lamps."""


@jit(error_model="numpy", inner=True)
def direction_cell(towards: Vector, distance: float) -> int:
    """The cell of a lamp's grid of directions that a surface is in; `towards` leads to the lamp.

    Columns divide the outline of a diamond around the lamp, rows the height: see `lamps.light`.
    """
    x, y = -towards[0], -towards[1]
    corner = y / (abs(x) + abs(y) + 1e-300)
    if x < 0.0:
        corner = 2.0 - corner
    elif y < 0.0:
        corner += 4.0
    height = 0.5 - 0.5 * towards[2] / distance
    column = min(int(corner * (0.25 * LONGITUDES)), LONGITUDES - 1)
    row = min(max(int(height * LATITUDES), 0), LATITUDES - 1)
    return row * LONGITUDES + column


@jit(error_model="numpy", inner=True)
def _blocked(
    instant: Record, cell: int, point: Vector, towards: Vector, near: float
) -> tuple[bool, bool]:
    """Whether a shape of one cell stands between a point and a lamp, and whether a thin one nearly.

    Shapes beyond the share `near` of the way belong to the lamp itself.
    """
    lists = instant.lists
    thin = False
    reach_mm = 1e3 * math.sqrt(dot(towards, towards))
    for index in range(list_at(lists, cell), list_at(lists, cell + 1), 2):
        if list_at(lists, index + 1) > reach_mm:
            break
        shape = shape_at(instant.shapes, list_at(lists, index))
        o, d = mapped(shape.inverse, point), turned(shape.inverse, towards)
        if is_between(instant, shape, o, d, near):
            return True, thin
        if shape.is_thin and not thin:
            thin = widened_hit(shape, o, d, 0.0) < near
    return False, thin


@jit(error_model="numpy")
def lamps_reach(instant: Record, point: Vector, normal: Vector, wanted: int) -> tuple[int, bool]:
    """Which of the lamps that cast shadows a surface sees, and whether a thin shadow is near.

    Only the lamps whose bit is set in `wanted` are looked for. Bit k belongs to lamp k. A lamp
    that the surface faces but whose light ends before it counts as seen.
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
        grid = instant.lamp_cells + index * (LONGITUDES * LATITUDES + 1)
        cell = grid + direction_cell(towards, distance)
        near = 1.0 - min(lamp.radius / distance, 0.9)
        is_blocked, is_thin = _blocked(instant, cell, start, towards, near)
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
    instant: Record, x: float, y: float, hit: tuple[float, int, int], wanted: int
) -> tuple[int, bool]:
    """What light reaches what was hit (bit 0: sun, then lamps), and whether a thin shadow is near.

    Only the lights in `wanted` are looked for; only lamps that cast shadows count.
    """
    depth, number, face = hit
    if wanted == 0 or number == SKY or (number == ROOM and instant.shadow_lamps == 0):
        return 0, False
    point = along(triple(instant.origin), ray_direction(instant, x, y), depth)
    normal = surface_normal(instant, number, face, point)
    point = shadow_point(instant, number, face, point)
    is_sunlit, thin = False, False
    if number != ROOM and wanted & 1:
        is_sunlit, thin = sun_reaches(instant, point, normal)
    lit = int(is_sunlit)
    if instant.shadow_lamps > 0:
        lamps, thin_lamp = lamps_reach(instant, point, normal, wanted >> 1)
        lit |= lamps << 1
        thin = thin or thin_lamp
    return lit, thin
