"""Colour of a shape's surface, averaged over the patch that one pixel covers (Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent_scenes.raycast.addresses import shape_at
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.shading.image import IMAGE_FACE, mesh_colour, shown_colour
from texvent_scenes.raycast.shading.material import patch_axes, sample_material
from texvent_scenes.raycast.shading.value_noise import mix, square_wave
from texvent_scenes.raycast.trace import MESH
from texvent_scenes.raycast.vectors import (
    Vector,
    along,
    dot,
    mapped,
    scaled,
    times,
    triple,
    turned,
    unit,
)
from texvent_scenes.rendered_scene import FIRST_SURFACE, Colour

_PLAIN = 0
_BLEND = 0.8
"""A view along an axis counts where its component of the normal is above this share of the
largest."""
_STEEPEST = 0.04
"""A surface seen at less than this slope is taken to be at it, so that its patch stays finite."""


@jit(error_model="numpy", inner=True)
def surface_patch(
    steps: tuple[Vector, Vector], direction: Vector, depth: float, normal: Vector
) -> tuple[Vector, Vector]:
    """Metres of surface from one pixel to the next, to the right and down, as world vectors.

    Args:
        steps: change of direction per pixel, from `pixel_steps`.
        direction: of the ray, as `ray_direction`.
        depth: of the surface, metres.
        normal: unit normal of the surface.
    """
    right, down = steps
    facing = min(dot(direction, normal), -_STEEPEST)
    return (
        scaled(along(right, direction, -(dot(right, normal) / facing)), depth),
        scaled(along(down, direction, -(dot(down, normal) / facing)), depth),
    )


@jit(error_model="numpy", inner=True)
def patch_extent(patch: tuple[Vector, Vector]) -> Colour:
    """Metres that a patch spans in x and in y, and its longest side."""
    right, down = patch
    longest = max(dot(right, right), dot(down, down))
    return abs(right[0]) + abs(down[0]), abs(right[1]) + abs(down[1]), math.sqrt(longest)


@jit(error_model="numpy", inner=True)
def surface_look(
    instant: Record, number: int, face: int, point: Vector, look: tuple[Vector, Vector, Vector]
) -> tuple[Colour, Vector]:
    """Reflectance of shape `number` at a world point, and its normal with the material's relief.

    Args:
        instant: the scene.
        number: shape number.
        face: face that was hit.
        point: metres.
        look: unit normal of the shape, and what one pixel covers there, from `surface_patch`.
    """
    shape = shape_at(instant.shapes, number)
    plain = triple(shape.colour)
    normal, right, down = look
    if shape.kind == MESH:
        return mesh_colour(instant, number, face, point, (right, down)), normal
    if shape.image >= 0 and face == IMAGE_FACE:
        return shown_colour(instant, number, point, (right, down)), normal
    if shape.texture == _PLAIN:
        return plain, normal
    m = shape.inverse
    if shape.texture >= FIRST_SURFACE:
        return _material_look(instant, number, point, look)
    scale = shape.texture_scale
    right, down = turned(m, right), turned(m, down)
    steps = (
        scale * (abs(right[0]) + abs(down[0])),
        scale * (abs(right[1]) + abs(down[1])),
        scale * (abs(right[2]) + abs(down[2])),
    )
    share = _pattern(shape.texture, scaled(mapped(m, point), scale), steps)
    return mix(plain, triple(shape.second_colour), share), normal


@jit(error_model="numpy", inner=True)
def _material_look(
    instant: Record, number: int, point: Vector, look: tuple[Vector, Vector, Vector]
) -> tuple[Colour, Vector]:
    """As `surface_look`, for a material: seen along the local axes that the surface faces."""
    shape = shape_at(instant.shapes, number)
    normal, right, down = look
    m, extent = shape.inverse, triple(shape.extent)
    place = times(mapped(m, point), extent)
    right, down = times(turned(m, right), extent), times(turned(m, down), extent)
    x_axis = (extent[0] * m[0, 0], extent[0] * m[0, 1], extent[0] * m[0, 2])
    y_axis = (extent[1] * m[1, 0], extent[1] * m[1, 1], extent[1] * m[1, 2])
    z_axis = (extent[2] * m[2, 0], extent[2] * m[2, 1], extent[2] * m[2, 2])
    shares = _facing_shares(dot(normal, x_axis), dot(normal, y_axis), dot(normal, z_axis))
    fine = shape.texture_scale
    shift = 0.377 * number
    first, second = 0.0, 0.0
    bent = normal
    if shares[0] > 0.0:
        axes = patch_axes((right[1], right[2], down[1], down[2]))
        one = sample_material(instant, shape.texture, place[1] + shift, place[2], axes, fine)
        first, second = shares[0] * one[0], shares[0] * one[1]
        bent = along(along(bent, y_axis, -shares[0] * one[2]), z_axis, -shares[0] * one[3])
    if shares[1] > 0.0:
        axes = patch_axes((right[0], right[2], down[0], down[2]))
        one = sample_material(instant, shape.texture, place[0] + shift, place[2], axes, fine)
        first, second = first + shares[1] * one[0], second + shares[1] * one[1]
        bent = along(along(bent, x_axis, -shares[1] * one[2]), z_axis, -shares[1] * one[3])
    if shares[2] > 0.0:
        axes = patch_axes((right[0], right[1], down[0], down[1]))
        one = sample_material(instant, shape.texture, place[0], place[1] + shift, axes, fine)
        first, second = first + shares[2] * one[0], second + shares[2] * one[1]
        bent = along(along(bent, x_axis, -shares[2] * one[2]), y_axis, -shares[2] * one[3])
    colour = along(scaled(triple(shape.colour), first), triple(shape.second_colour), second)
    return colour, unit(bent)


@jit(error_model="numpy", inner=True)
def _facing_shares(x: float, y: float, z: float) -> Colour:
    """Shares of the views along three axes, for a surface whose normal has these components."""
    a, b, c = abs(x), abs(y), abs(z)
    largest = max(a, b, c)
    a, b, c = (
        max(a - _BLEND * largest, 0.0),
        max(b - _BLEND * largest, 0.0),
        max(c - _BLEND * largest, 0.0),
    )
    total = a + b + c
    return a / total, b / total, c / total


@jit(error_model="numpy", inner=True)
def _pattern(texture: int, p: Colour, steps: Colour) -> float:
    """Share of the second colour at texture coordinates `p`, averaged over `steps`."""
    if texture == 2:
        return square_wave(p[2], steps[2])
    x = 2.0 * square_wave(0.5 * p[0] + 0.01, 0.5 * steps[0]) - 1.0
    y = 2.0 * square_wave(0.5 * p[1] + 0.01, 0.5 * steps[1]) - 1.0
    z = 2.0 * square_wave(0.5 * p[2] + 0.01, 0.5 * steps[2]) - 1.0
    return 0.5 + 0.5 * x * y * z
