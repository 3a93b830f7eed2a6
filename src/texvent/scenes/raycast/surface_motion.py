"""What image points show: depth, shape, each instance on its own; and where it goes (Numba)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.threads import count_threads, run_parts, split
from texvent.scenes.raycast.addresses import list_at
from texvent.scenes.raycast.records import World
from texvent.scenes.raycast.render import world_at
from texvent.scenes.raycast.trace import (
    SKY,
    background_hit,
    first_hit,
    hit_again,
    plane_direction,
    tile_at,
)
from texvent.scenes.raycast.vectors import plane_point
from texvent.scenes.scene import Float64Array, Scene, place_in_image
from texvent.sensor import SensorSize
from texvent.video import Motion


@jit(error_model="numpy")
def cast_points(
    instants: NDArray[Any], points: Float64Array, depth: Float64Array, number: NDArray[np.int32]
) -> None:
    """First surface behind each image point.

    Args:
        instants: `World.instant` of the scene.
        points: [k, 2] x and y, pixels, inside the image.
        depth: [k] metres along the optical axis is written; inf for the sky.
        number: [k] shape number, or GROUND, SKY, ROOM or NOTHING, is written.
    """
    instant = instants[0]
    for index in range(len(points)):
        t, found, _, _ = first_hit(instant, points[index, 0], points[index, 1])
        depth[index], number[index] = t, found


@jit(error_model="numpy")
def see_from(
    instants: NDArray[Any],
    points: Float64Array,
    depth: Float64Array,
    number: NDArray[np.int32],
    motion: tuple[Float64Array, Float64Array],
    pose: tuple[Float64Array, Float64Array],
    seen: Float64Array,
) -> None:
    """Where surfaces seen through image points are for a camera at another instant.

    Args:
        instants: `World.instant` of the scene at the first instant.
        points: [k, 2] x and y, pixels.
        depth: [k] m.
        number: [k] shape number, or GROUND, SKY or ROOM.
        motion: [n, 3, 3] turn and [n, 3] shift, m, that take each shape to the other instant.
        pose: [3, 3] axes and [3] position, m, of the camera at the other instant.
        seen: [k, 3] along its axes, m, is written; for the sky, a direction.
    """
    instant = instants[0]
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
    instants: NDArray[Any],
    instance: NDArray[np.int32],
    points: Float64Array,
    counts: NDArray[np.int64],
) -> None:
    """At how many points of the image each instance would be seen if nothing stood before it.

    Args:
        instants: `World.instant` of the scene.
        instance: [n] instance of each shape.
        points: [k, 2] x and y, pixels.
        counts: [1 + highest instance] is added to.
    """
    instant = instants[0]
    lists = instant.lists
    last = np.full(len(counts), -1, dtype=np.int64)
    for number in range(len(points)):
        x, y = points[number]
        u, v = plane_point(instant, x, y)
        if math.isnan(u):
            continue
        cell = tile_at(instant, u, v)
        direction = plane_direction(instant, u, v)
        behind = background_hit(instant, direction)[0]
        for index in range(list_at(lists, cell), list_at(lists, cell + 1)):
            one = instance[list_at(lists, index)]
            if last[one] == number:
                continue
            t, _ = hit_again(instant, x, y, list_at(lists, index))
            if t < behind:
                last[one] = number
                counts[one] += 1


@dataclass(frozen=True, eq=False)
class Seen:
    """What the pixel centres show at one instant."""

    world: World
    """The scene at that instant."""
    points: Float64Array
    """[H · W, 2] image points, pixels."""
    depth: Float64Array
    """[H · W] metres."""
    number: NDArray[np.int32]
    """[H · W] shape number, GROUND, SKY or ROOM."""


def frame_motion(
    scene: Scene, time_s: float, before_s: float | None, after_s: float | None, size: SensorSize
) -> Motion:
    """Motion of every pixel to the frames before and after, and depth.

    Args:
        scene: the scene.
        time_s: time of the frame, s.
        before_s: time of the frame before it, s, if there is one.
        after_s: time of the frame after it, s, if there is one.
        size: image size, pixels.

    Returns:
        Vectors to both, exact; NaN where the surface is not in front of the camera then.
    """
    seen = cast_centres(world_at(scene, time_s, size), size)

    def vectors(to_s: float | None) -> NDArray[np.float32] | None:
        if to_s is None:
            return None
        place = move_to(scene, (time_s, to_s), size, seen)
        moved = np.where(place[:, 2:] > 0.0, place[:, :2] - seen.points, np.nan)
        return moved.astype(np.float32).reshape(*size.shape, 2)

    return Motion(
        forward=vectors(after_s),
        backward=vectors(before_s),
        depth=seen.depth.astype(np.float32).reshape(size.shape),
    )


def cast_centres(world: World, size: SensorSize) -> Seen:
    """What the pixel centres show."""
    row, column = np.indices(size.shape)
    points = np.stack([column.ravel() + 0.5, row.ravel() + 0.5], axis=1)
    return Seen(world, points, *cast(world, points))


def cast(world: World, points: Float64Array) -> tuple[Float64Array, NDArray[np.int32]]:
    """Depth, m, and shape number of the first surface behind [k, 2] image points."""
    depth = np.empty(len(points), dtype=np.float64)
    number = np.empty(len(points), dtype=np.int32)
    parts = split(len(points), count_threads())
    run_parts(lambda one: cast_points(world.instant, points[one], depth[one], number[one]), parts)
    return depth, number


def move_to(
    scene: Scene, times_s: tuple[float, float], size: SensorSize, seen: Seen
) -> Float64Array:
    """Image point and depth at t1 of the surface seen through each pixel centre at t0, [H · W, 3].

    Its depth is not positive where it is beside or behind the camera, and ± inf for the sky.
    """
    start, stop = (scene.primitives(time_s).to_world for time_s in times_s)
    # What takes the surface of each shape from t0 to t1: one matrix and one shift.
    turn = stop[:, :, :3] @ np.linalg.inv(start[:, :, :3])
    shift = stop[:, :, 3] - (turn @ start[:, :, 3:])[..., 0]
    rests = (start == stop).all(axis=(1, 2))
    turn[rests], shift[rests] = np.eye(3), 0.0
    after = scene.camera(times_s[1])
    pose = (
        np.ascontiguousarray(after.rotation, dtype=np.float64),
        np.ascontiguousarray(after.position, dtype=np.float64),
    )
    place = np.empty((len(seen.points), 3), dtype=np.float64)

    def work(one: slice) -> None:
        arrays = seen.points[one], seen.depth[one], seen.number[one]
        see_from(seen.world.instant, *arrays, (turn, shift), pose, place[one])

    run_parts(work, split(len(place), count_threads()))
    place = place_in_image(after, size, place)
    far = seen.number == SKY
    place[far, 2] = np.where(place[far, 2] > 0.0, np.inf, -np.inf)
    return place
