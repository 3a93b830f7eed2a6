"""What is seen through given image points: depth, shape, and each instance on its own (Numba)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.scenes.raycast.lens_kernel import plane_point
from texvent.scenes.raycast.records import World
from texvent.scenes.raycast.trace import (
    background_hit,
    first_hit,
    hit_again,
    plane_direction,
    tile_at,
)
from texvent.scenes.raycast.uncounted import uncounted_world
from texvent.scenes.scene import Float64Array


@jit(error_model="numpy")
def cast_points(
    owner: World, points: Float64Array, depth: Float64Array, number: NDArray[np.int32]
) -> None:
    """First surface behind each image point.

    Args:
        owner: the scene.
        points: [k, 2] x and y, pixels, inside the image.
        depth: [k] metres along the optical axis is written; inf for the sky.
        number: [k] shape number, or GROUND, SKY or ROOM, is written.
    """
    world = uncounted_world(owner)
    for index in range(len(points)):
        t, found, _, _ = first_hit(world, points[index, 0], points[index, 1])
        depth[index], number[index] = t, found


@jit(error_model="numpy")
def count_unoccluded(
    owner: World, instance: NDArray[np.int32], height: int, width: int, counts: NDArray[np.int64]
) -> None:
    """How many pixels each instance would cover if no other object stood before it.

    Args:
        owner: the scene.
        instance: [n] instance of each shape.
        height: image height, pixels.
        width: image width, pixels.
        counts: [1 + highest instance] is added to.
    """
    world = uncounted_world(owner)
    instant = world.instant[0]
    lists = world.lists
    last = np.full(len(counts), -1, dtype=np.int64)
    for row in range(height):
        for column in range(width):
            u, v = plane_point(instant, column + 0.5, row + 0.5)
            cell = tile_at(instant, u, v)
            pixel = row * width + column
            direction = plane_direction(instant, u, v)
            behind = background_hit(instant, direction)[0]
            for index in range(lists[cell], lists[cell + 1]):
                one = instance[lists[index]]
                if last[one] == pixel:
                    continue
                t, _ = hit_again(world, column + 0.5, row + 0.5, lists[index])
                if t < behind:
                    last[one] = pixel
                    counts[one] += 1
