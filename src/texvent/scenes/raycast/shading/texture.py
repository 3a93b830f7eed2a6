"""Colour of a shape's surface, averaged over the patch that one pixel covers (Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import World
from texvent.scenes.raycast.shading.sky import mix
from texvent.scenes.raycast.shading.value_noise import detail_fade, noise_3d, smooth, square_wave
from texvent.scenes.raycast.vectors import Vector, along, dot, mapped, scaled, triple, turned
from texvent.scenes.scene import Colour

_STEEPEST = 0.04
"""A surface seen at less than this slope is taken to be at it, so that its patch stays finite."""


@jit(error_model="numpy")
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


@jit(error_model="numpy")
def patch_extent(patch: tuple[Vector, Vector]) -> Colour:
    """Metres that a patch spans in x and in y, and its longest side."""
    right, down = patch
    longest = max(dot(right, right), dot(down, down))
    return abs(right[0]) + abs(down[0]), abs(right[1]) + abs(down[1]), math.sqrt(longest)


@jit(error_model="numpy")
def surface_colour(
    world: World, number: int, face: int, point: Vector, patch: tuple[Vector, Vector]
) -> Colour:
    """Reflectance of shape `number` at a world point, with its texture.

    Args:
        world: the scene.
        number: shape number.
        face: face that was hit.
        point: metres.
        patch: what one pixel covers there, from `surface_patch`.
    """
    shape = world.shapes[number]
    plain = triple(shape.colour)
    if shape.texture == 0:
        return plain
    m, scale = shape.inverse, shape.texture_scale
    right, down = turned(m, patch[0]), turned(m, patch[1])
    steps = (
        scale * (abs(right[0]) + abs(down[0])),
        scale * (abs(right[1]) + abs(down[1])),
        scale * (abs(right[2]) + abs(down[2])),
    )
    share = _pattern(shape.texture, face, scaled(mapped(m, point), scale), steps)
    return mix(plain, triple(shape.second_colour), share)


@jit(error_model="numpy")
def _pattern(texture: int, face: int, p: Colour, steps: Colour) -> float:
    """Share of the second colour at texture coordinates `p`, averaged over `steps`."""
    if texture == 1:
        footprint = max(steps[0], steps[1], steps[2])
        total = 0.62 * detail_fade(2.0 * footprint) * noise_3d(2.0 * p[0], 2.0 * p[1], 2.0 * p[2])
        fine = detail_fade(4.6 * footprint)
        if fine > 0.0:
            total += 0.38 * fine * noise_3d(4.6 * p[0], 4.6 * p[1], 4.6 * p[2] + 31.0)
        return smooth(0.5 + 0.75 * total)
    if texture == 2:
        return square_wave(p[2], steps[2])
    if texture == 3:
        x = 2.0 * square_wave(0.5 * p[0] + 0.01, 0.5 * steps[0]) - 1.0
        y = 2.0 * square_wave(0.5 * p[1] + 0.01, 0.5 * steps[1]) - 1.0
        z = 2.0 * square_wave(0.5 * p[2] + 0.01, 0.5 * steps[2]) - 1.0
        return 0.5 + 0.5 * x * y * z
    if face >= 4:
        return 0.0
    along, step = (p[1], steps[1]) if face < 2 else (p[0], steps[0])
    return square_wave(along + 0.25, step) * square_wave(p[2] + 0.25, steps[2])
