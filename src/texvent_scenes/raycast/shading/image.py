"""Images on meshes and on faces of boxes, averaged over what one pixel covers (Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent_scenes.raycast.addresses import image_at, shape_at, texel_at, triangle_at
from texvent_scenes.raycast.meshes.hit import slopes_of, weights_at
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.shading.value_noise import mix
from texvent_scenes.raycast.vectors import Vector, along, mapped, scaled, times, triple, turned
from texvent_scenes.rendered_scene import Colour

IMAGE_FACE = 1
"""The side of a box that shows an image: +x, its right along y."""
MOST_TAPS = 16
"""A footprint is taken to be at most this many times as long as wide."""
Footprint = tuple[tuple[float, float], tuple[float, float]]
"""Change of (u, v) from one pixel to the next, to the right and down."""


@jit(error_model="numpy", inner=True)
def mesh_colour(
    instant: Record, number: int, face: int, point: Vector, patch: tuple[Vector, Vector]
) -> Colour:
    """Reflectance of a mesh at a world point: colour of its corners times its image.

    Args:
        instant: the scene.
        number: shape number.
        face: triangle that was hit.
        point: metres.
        patch: what one pixel covers there, from `surface_patch`.
    """
    shape, triangle = shape_at(instant.shapes, number), triangle_at(instant.triangles, face)
    a, b, c = weights_at(triangle, mapped(shape.inverse, point))
    corners = triangle.colour
    colour = (
        a * corners[0, 0] + b * corners[1, 0] + c * corners[2, 0],
        a * corners[0, 1] + b * corners[1, 1] + c * corners[2, 1],
        a * corners[0, 2] + b * corners[1, 2] + c * corners[2, 2],
    )
    colour = times(colour, triple(shape.colour))
    if triangle.image < 0:
        return colour
    uv = triangle.uv
    u = a * uv[0, 0] + b * uv[1, 0] + c * uv[2, 0]
    v = a * uv[0, 1] + b * uv[1, 1] + c * uv[2, 1]
    right = slopes_of(triangle, turned(shape.inverse, patch[0]))
    down = slopes_of(triangle, turned(shape.inverse, patch[1]))
    u1, u2, v1, v2 = uv[1, 0] - uv[0, 0], uv[2, 0] - uv[0, 0], uv[1, 1] - uv[0, 1], 0.0
    v2 = uv[2, 1] - uv[0, 1]
    footprint = (
        (right[0] * u1 + right[1] * u2, right[0] * v1 + right[1] * v2),
        (down[0] * u1 + down[1] * u2, down[0] * v1 + down[1] * v2),
    )
    return times(colour, image_colour(instant, triangle.image, u, v, footprint))


@jit(error_model="numpy", inner=True)
def shown_colour(
    instant: Record, number: int, point: Vector, patch: tuple[Vector, Vector]
) -> Colour:
    """Colour of a box's side +x that shows an image upright, its own colour around the image.

    Arguments as for `mesh_colour`.
    """
    shape = shape_at(instant.shapes, number)
    p = mapped(shape.inverse, point)
    right, down = turned(shape.inverse, patch[0]), turned(shape.inverse, patch[1])
    fit = shape.image_fit
    u, v = 0.5 + 0.5 * p[1] * fit[0], 0.5 - 0.5 * p[2] * fit[1]
    footprint = (
        (0.5 * fit[0] * right[1], -0.5 * fit[1] * right[2]),
        (0.5 * fit[0] * down[1], -0.5 * fit[1] * down[2]),
    )
    colour = image_colour(instant, shape.image, u, v, footprint)
    share = _overlap(u, abs(footprint[0][0]) + abs(footprint[1][0]))
    share *= _overlap(v, abs(footprint[0][1]) + abs(footprint[1][1]))
    return mix(triple(shape.colour), colour, share)


@jit(error_model="numpy", inner=True)
def _overlap(place: float, width: float) -> float:
    """Share of an interval of a width around a place that lies within 0..1."""
    half = 0.5 * max(width, 1e-12)
    inside = min(place + half, 1.0) - max(place - half, 0.0)
    return min(max(inside / (2.0 * half), 0.0), 1.0)


@jit(error_model="numpy", inner=True)
def image_colour(instant: Record, number: int, u: float, v: float, footprint: Footprint) -> Colour:
    """Mean of an image over a pixel's footprint.

    Trilinear samples of the mip pyramid, two to a pixel across the footprint's shorter side and as
    dense along its longer one: a simple form of Feline (McCormack et al. 1999).
    """
    image = image_at(instant.images, number)
    width, height = float(image.width), float(image.height)
    right = math.hypot(footprint[0][0] * width, footprint[0][1] * height)
    down = math.hypot(footprint[1][0] * width, footprint[1][1] * height)
    is_wide = right >= down
    longest, shortest = max(right, down), min(right, down)
    long_step = footprint[0] if is_wide else footprint[1]
    short_step = footprint[1] if is_wide else footprint[0]
    cell = max(0.5 * max(shortest, longest / MOST_TAPS), 1.0)
    level = math.log2(cell)
    columns = min(max(math.ceil(longest / cell), 1), 2 * MOST_TAPS)
    rows = 2 if shortest > 1.0 else 1
    total = (0.0, 0.0, 0.0)
    for row in range(rows):
        b = (row + 0.5) / rows - 0.5
        for column in range(columns):
            a = (column + 0.5) / columns - 0.5
            x = u + a * long_step[0] + b * short_step[0]
            y = v + a * long_step[1] + b * short_step[1]
            total = along(total, _trilinear(instant, image, x, y, level), 1.0)
    return scaled(total, 1.0 / (rows * columns))


@jit(error_model="numpy", inner=True)
def _trilinear(instant: Record, image: Record, u: float, v: float, level: float) -> Colour:
    level = min(level, image.levels - 1.0)
    low = int(level)
    colour = _bilinear(instant, image, u, v, low)
    if level > low:
        colour = mix(colour, _bilinear(instant, image, u, v, low + 1), level - low)
    return colour


@jit(error_model="numpy", inner=True)
def _bilinear(instant: Record, image: Record, u: float, v: float, level: int) -> Colour:
    width, height = max(image.width >> level, 1), max(image.height >> level, 1)
    x, y = u * width - 0.5, v * height - 0.5
    left, top = math.floor(x), math.floor(y)
    share_x, share_y = x - left, y - top
    i0, i1 = _texel(int(left), width, image.repeats), _texel(int(left) + 1, width, image.repeats)
    j0, j1 = _texel(int(top), height, image.repeats), _texel(int(top) + 1, height, image.repeats)
    start = image.start[level]
    upper = mix(
        _at(instant, start + 3 * (j0 * width + i0)),
        _at(instant, start + 3 * (j0 * width + i1)),
        share_x,
    )
    lower = mix(
        _at(instant, start + 3 * (j1 * width + i0)),
        _at(instant, start + 3 * (j1 * width + i1)),
        share_x,
    )
    return mix(upper, lower, share_y)


@jit(error_model="numpy", inner=True)
def _texel(index: int, count: int, repeats: int) -> int:
    if repeats:
        return index % count
    return min(max(index, 0), count - 1)


@jit(error_model="numpy", inner=True)
def _at(instant: Record, index: int) -> Colour:
    texels = instant.texels
    return texel_at(texels, index), texel_at(texels, index + 1), texel_at(texels, index + 2)
