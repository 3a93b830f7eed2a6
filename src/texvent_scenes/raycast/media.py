"""Participating media: light through translucent ellipsoids (compiled by Numba).

The density of a medium is (1 - r²)² at r of its radius, so its optical depth along a ray is a
polynomial: with h² = 1 - (distance of the ray from the middle)², the integral of (h² - s²)² over
s. It and its first two derivatives are 0 at the rim: a medium has no edge, and no part of it can
jump. Where media overlap, their optical depths add, as they do in nature. The mixture shines with
the mean of their colours, weighted by optical depth: exact where media of one colour overlap, and
without any order in which two of them could change places.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.camera import Rays
from texvent.runtime.jit import jit
from texvent.sensor import SensorSize
from texvent_scenes.raycast.acceleration import (
    TILE,
    Bins,
    bin_rectangles,
    invert_maps,
    screen_bounds,
)
from texvent_scenes.raycast.addresses import list_at, medium_at
from texvent_scenes.raycast.lamps.light import light_through
from texvent_scenes.raycast.records import SEEN_MEDIUM_RECORD, Record
from texvent_scenes.raycast.shading.value_noise import detail_fade, noise_3d
from texvent_scenes.raycast.trace import plane_direction, tile_at
from texvent_scenes.raycast.vectors import Vector, along, dot, plane_point, scaled, triple, turned
from texvent_scenes.rendered_scene import Colour

_DETAIL_SCALE = 2.8
"""Lumps of detail per radius of a medium."""
_DETAIL_STRENGTH = 2.2
"""Amplitude of detail in the logarithm of the optical depth."""


@jit(error_model="numpy")
def density_integral(half: float, start: float, stop: float) -> float:
    """∫ (h² - s²)² ds from start to stop, within -h..h."""
    start, stop = max(start, -half), min(stop, half)
    if stop <= start:
        return 0.0
    h2 = half * half
    first = start * (h2 * h2 - start * start * (2.0 / 3.0 * h2 - 0.2 * start * start))
    last = stop * (h2 * h2 - stop * stop * (2.0 / 3.0 * h2 - 0.2 * stop * stop))
    return max(last - first, 0.0)


@jit(error_model="numpy", inner=True)
def _medium_depth(medium: Record, direction: Vector, depth: float) -> tuple[float, Vector]:
    """(optical depth of one medium before `depth`, point of the ray nearest to its middle).

    The point is in the medium's own coordinates.
    """
    o, d = triple(medium.eye), turned(medium.inverse, direction)
    length = math.sqrt(dot(d, d))
    nearest = -dot(o, d) / length
    place = along(o, d, nearest / length)
    h2 = 1.0 - dot(place, place)
    if h2 <= 0.0:
        return 0.0, place
    stop = math.inf if depth == math.inf else depth * length - nearest
    mass = density_integral(math.sqrt(h2), -nearest, stop)
    metres = math.sqrt(dot(direction, direction)) / length
    return medium.thickness * metres * mass, place


@jit(error_model="numpy", inner=True)
def _with_detail(medium: Record, place: Vector, footprint: float) -> float:
    """Factor around 1: lumps in a medium, which fade where a pixel covers them."""
    if medium.detail == 0.0:
        return 1.0
    s, seed = _DETAIL_SCALE, medium.seed
    lumps = 0.0
    for octave in range(3):
        fade = detail_fade(s * footprint)
        if fade <= 0.0:
            break
        x, y, z = s * place[0] + seed, s * place[1] - 0.7 * seed, s * place[2] + 31.0 * octave
        lumps += 0.55**octave * fade * noise_3d(x, y, z)
        s *= 2.1
    return math.exp(_DETAIL_STRENGTH * float(medium.detail) * lumps)


@jit(error_model="numpy")
def optical_depth(instant: Record, u: float, v: float, depth: float) -> float:
    """Optical depth of all media before `depth`, at a point of the image without distortion."""
    lists = instant.lists
    direction = plane_direction(instant, u, v)
    cell = instant.medium_tiles + tile_at(instant, u, v)
    total = 0.0
    for index in range(list_at(lists, cell), list_at(lists, cell + 1)):
        medium = medium_at(instant.media, list_at(lists, index))
        if medium.depth >= depth:
            continue
        thickness, place = _medium_depth(medium, direction, depth)
        if thickness > 0.0:
            footprint = medium.depth * instant.step / medium.radius
            total += thickness * _with_detail(medium, place, footprint)
    return total


@jit(error_model="numpy", inner=True)
def _medium_light(instant: Record, medium: Record, direction: Vector, place: Vector) -> Colour:
    """Light that a medium scatters and gives off towards the camera.

    It is lit like a matt ball, softly: smoke scatters light many times.
    """
    colour = triple(medium.colour)
    m = medium.inverse
    view = turned(m, direction)
    back = math.sqrt(max(1.0 - dot(place, place), 0.0) / dot(view, view))
    x, y, z = along(place, view, -0.8 * back)
    normal = (
        m[0, 0] * x + m[1, 0] * y + m[2, 0] * z,
        m[0, 1] * x + m[1, 1] * y + m[2, 1] * z,
        m[0, 2] * x + m[1, 2] * y + m[2, 2] * z,
    )
    normal = scaled(normal, 1.0 / math.sqrt(dot(normal, normal) + 1e-12))
    facing = 0.5 + 0.5 * dot(normal, triple(instant.sun))
    light = scaled(triple(instant.ambient), 0.78 + 0.22 * normal[2])
    light = along(light, triple(instant.sun_colour), 0.15 + 0.65 * facing * facing)
    if instant.lamp_count > 0:
        distance = medium.depth + medium.radius
        point = along(triple(instant.origin), direction, distance)
        light = along(light, light_through(instant, point), 0.5)
    glow = medium.emission
    return (
        colour[0] * (light[0] + glow),
        colour[1] * (light[1] + glow),
        colour[2] * (light[2] + glow),
    )


@jit(error_model="numpy", inner=True)
def through_media(instant: Record, x: float, y: float, depth: float, light: Colour) -> Colour:
    """Light of a surface that all media transmit, plus the light that they scatter and emit.

    Args:
        instant: the scene.
        x: pixels from the left.
        y: pixels from the top.
        depth: of the surface, metres; inf for the sky.
        light: of the surface, linear.
    """
    lists = instant.lists
    u, v = plane_point(instant, x, y)
    if math.isnan(u):
        return light
    cell = instant.medium_tiles + tile_at(instant, u, v)
    if list_at(lists, cell) == list_at(lists, cell + 1):
        return light
    direction = plane_direction(instant, u, v)
    total, own = 0.0, (0.0, 0.0, 0.0)
    for index in range(list_at(lists, cell), list_at(lists, cell + 1)):
        medium = medium_at(instant.media, list_at(lists, index))
        window = medium.window
        is_beside = u < window[0] or u > window[1] or v < window[2] or v > window[3]
        if is_beside or medium.depth >= depth:
            continue
        thickness, place = _medium_depth(medium, direction, depth)
        if thickness <= 0.0:
            continue
        thickness *= _with_detail(medium, place, medium.depth * instant.step / medium.radius)
        colour = _medium_light(instant, medium, direction, place)
        if instant.fog > 0.0:
            share = math.exp(-instant.fog * medium.depth)
            colour = along(scaled(triple(instant.fog_colour), 1.0 - share), colour, share)
        own = along(own, colour, thickness)
        total += thickness
    if total <= 0.0:
        return light
    left = math.exp(-total)
    return along(scaled(light, left), own, (1.0 - left) / total)


WIDENED_PX = 1.5
"""Half extent of the smallest medium, pixels: one sample per pixel then sees all of it."""
_MASS = 15.0 / 16.0
"""1 / ∫ (1 - s²)² ds over -1..1: density in the middle for an optical depth of 1."""


def describe_media(media: NDArray[Any], rays: Rays, instant: Any) -> tuple[NDArray[Any], Bins]:
    """Records of the media, and which may be seen in each screen tile.

    Media are widened as a lens of `WIDENED_PX` would blur them, and thinned as much.

    Args:
        media: [k] `MEDIUM_RECORD`.
        rays: the camera's rays.
        instant: `INSTANT_RECORD` with the size of the grid of tiles.
    """
    columns, tile_rows = int(instant["tile_columns"]), int(instant["tile_rows"])
    if not len(media):
        none = np.zeros(0, np.int64)
        nowhere = bin_rectangles(none.reshape(0, 4), none, columns, tile_rows)
        return np.zeros(0, SEEN_MEDIUM_RECORD), nowhere
    to_world = media["to_world"].copy()
    pixel = float(instant["step"]) * np.linalg.norm(to_world[:, :, 3] - rays.origin, axis=1)
    half = np.maximum(np.linalg.norm(to_world[:, :, :3], axis=1), 1e-9)
    wide = np.hypot(half, WIDENED_PX * pixel[:, None])
    to_world[:, :, :3] *= (wide / half)[:, None, :]
    records = np.zeros(len(media), dtype=SEEN_MEDIUM_RECORD)
    inverse, exists = invert_maps(to_world)
    size = SensorSize(columns * TILE, tile_rows * TILE)
    bounds, depth = screen_bounds(np.ones(len(media), dtype=np.bool_), to_world, rays, size)
    records["inverse"], records["depth"], records["window"] = inverse, depth, bounds
    records["eye"] = inverse[:, :, :3] @ rays.origin + inverse[:, :, 3]
    for name in ("colour", "emission", "detail", "seed"):
        records[name] = media[name]
    records["radius"] = np.cbrt(wide.prod(axis=1))
    thinned = np.cbrt((half / wide).prod(axis=1)) ** 2
    records["thickness"] = _MASS * media["optical_depth"] * thinned / records["radius"]
    shown = exists & (bounds[:, 0] <= bounds[:, 1]) & (media["optical_depth"] > 0.0)
    numbers = np.flatnonzero(shown)
    corner = instant["plane_corner"][[0, 0, 1, 1]]
    rectangles = np.floor((bounds[numbers] - corner) / TILE).astype(np.int64)
    return records, bin_rectangles(rectangles, numbers, columns, tile_rows)
