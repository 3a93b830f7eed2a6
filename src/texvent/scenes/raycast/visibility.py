"""What is seen through given image points: depth, shape, and each instance on its own (Numba)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import OwnedWorld, World
from texvent.scenes.raycast.trace import (
    SKY,
    background_hit,
    first_hit,
    hit_again,
    plane_direction,
    tile_at,
)
from texvent.scenes.raycast.uncounted import uncounted_world
from texvent.scenes.raycast.vectors import plane_point
from texvent.scenes.scene import Float64Array


@jit(error_model="numpy")
def cast_points(
    owner: World | OwnedWorld, points: Float64Array, depth: Float64Array, number: NDArray[np.int32]
) -> None:
    """First surface behind each image point.

    Args:
        owner: the scene.
        points: [k, 2] x and y, pixels, inside the image.
        depth: [k] metres along the optical axis is written; inf for the sky.
        number: [k] shape number, or GROUND, SKY, ROOM or NOTHING, is written.
    """
    world = uncounted_world(owner)
    for index in range(len(points)):
        t, found, _, _ = first_hit(world, points[index, 0], points[index, 1])
        depth[index], number[index] = t, found


@jit(error_model="numpy")
def see_from(
    owner: World | OwnedWorld,
    points: Float64Array,
    depth: Float64Array,
    number: NDArray[np.int32],
    motion: tuple[Float64Array, Float64Array],
    pose: tuple[Float64Array, Float64Array],
    seen: Float64Array,
) -> None:
    """Where surfaces seen through image points are for a camera at another instant.

    Args:
        owner: the scene at the first instant.
        points: [k, 2] x and y, pixels.
        depth: [k] m.
        number: [k] shape number, or GROUND, SKY or ROOM.
        motion: [n, 3, 3] turn and [n, 3] shift, m, that take each shape to the other instant.
        pose: [3, 3] axes and [3] position, m, of the camera at the other instant.
        seen: [k, 3] along its axes, m, is written; for the sky, a direction.
    """
    world = uncounted_world(owner)
    instant = world.instant[0]
    (turn, shift), (axes, position) = motion, pose
    for k in range(len(points)):
        u, v = plane_point(instant, points[k, 0], points[k, 1])
        x, y, z = plane_direction(instant, u, v)
        one = number[k]
        if one != SKY:
            x = instant.origin[0] + depth[k] * x
            y = instant.origin[1] + depth[k] * y
            z = instant.origin[2] + depth[k] * z
            if one >= 0:
                x, y, z = (
                    turn[one, 0, 0] * x + turn[one, 0, 1] * y + turn[one, 0, 2] * z + shift[one, 0],
                    turn[one, 1, 0] * x + turn[one, 1, 1] * y + turn[one, 1, 2] * z + shift[one, 1],
                    turn[one, 2, 0] * x + turn[one, 2, 1] * y + turn[one, 2, 2] * z + shift[one, 2],
                )
            x, y, z = x - position[0], y - position[1], z - position[2]
        for axis in range(3):
            seen[k, axis] = axes[axis, 0] * x + axes[axis, 1] * y + axes[axis, 2] * z


@jit(error_model="numpy")
def count_unoccluded(
    owner: World | OwnedWorld,
    instance: NDArray[np.int32],
    points: Float64Array,
    counts: NDArray[np.int64],
) -> None:
    """At how many points of the image each instance would be seen if nothing stood before it.

    Args:
        owner: the scene.
        instance: [n] instance of each shape.
        points: [k, 2] x and y, pixels.
        counts: [1 + highest instance] is added to.
    """
    world = uncounted_world(owner)
    instant = world.instant[0]
    lists = world.lists
    last = np.full(len(counts), -1, dtype=np.int64)
    for number in range(len(points)):
        x, y = points[number]
        u, v = plane_point(instant, x, y)
        if math.isnan(u):
            continue
        cell = tile_at(instant, u, v)
        direction = plane_direction(instant, u, v)
        behind = background_hit(instant, direction)[0]
        for index in range(lists[cell], lists[cell + 1]):
            one = instance[lists[index]]
            if last[one] == number:
                continue
            t, _ = hit_again(world, x, y, lists[index])
            if t < behind:
                last[one] = number
                counts[one] += 1
