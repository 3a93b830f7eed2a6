"""Colour of a shape's surface, averaged over the patch that one pixel covers (Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import Record, World
from texvent.scenes.raycast.shading.sky import Colour, mix, triple
from texvent.scenes.raycast.shading.value_noise import detail_fade, noise_3d, smooth, square_wave
from texvent.scenes.raycast.trace import Vector, local_point
from texvent.scenes.scene import Float64Array

_STEEPEST = 0.04
"""A surface seen at less than this slope is taken to be at it, so that its patch stays finite."""


@jit(error_model="numpy")
def surface_patch(
    instant: Record, direction: Vector, depth: float, normal: Vector
) -> tuple[Vector, Vector]:
    """Metres of surface from one pixel to the next, to the right and down, as world vectors.

    Args:
        instant: the camera.
        direction: of the ray, as `ray_direction`.
        depth: of the surface, metres.
        normal: unit normal of the surface.
    """
    right, down = instant.right, instant.down
    facing = direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]
    facing = min(facing, -_STEEPEST)
    along = (right[0] * normal[0] + right[1] * normal[1] + right[2] * normal[2]) / facing
    below = (down[0] * normal[0] + down[1] * normal[1] + down[2] * normal[2]) / facing
    return (
        (
            depth * (right[0] - along * direction[0]),
            depth * (right[1] - along * direction[1]),
            depth * (right[2] - along * direction[2]),
        ),
        (
            depth * (down[0] - below * direction[0]),
            depth * (down[1] - below * direction[1]),
            depth * (down[2] - below * direction[2]),
        ),
    )


@jit(error_model="numpy")
def patch_extent(patch: tuple[Vector, Vector]) -> Colour:
    """Metres that a patch spans in x and in y, and its longest side."""
    (rx, ry, rz), (dx, dy, dz) = patch
    longest = max(rx * rx + ry * ry + rz * rz, dx * dx + dy * dy + dz * dz)
    return abs(rx) + abs(dx), abs(ry) + abs(dy), math.sqrt(longest)


@jit(error_model="numpy")
def _row(m: Float64Array, row: int, v: Vector) -> float:
    return float(m[row, 0] * v[0] + m[row, 1] * v[1] + m[row, 2] * v[2])


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
    p = local_point(world, number, point)
    right, down = patch
    steps = (
        scale * (abs(_row(m, 0, right)) + abs(_row(m, 0, down))),
        scale * (abs(_row(m, 1, right)) + abs(_row(m, 1, down))),
        scale * (abs(_row(m, 2, right)) + abs(_row(m, 2, down))),
    )
    scaled = (p[0] * scale, p[1] * scale, p[2] * scale)
    share = _pattern(shape.texture, face, scaled, steps)
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
