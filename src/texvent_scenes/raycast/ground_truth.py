"""Exact ground truth of a scene: depth, instance ids, optical flow, occlusion, boxes.

It comes from the geometry that the images are drawn from, so it holds at any pair of instants.
Every value belongs to the ray through a pixel's centre; images average over the pixel's area.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.camera import place_in_image
from texvent.frames import MotionVectors
from texvent.ground_truth import Box, GroundTruth
from texvent.runtime.jit import jit
from texvent.runtime.threads import count_threads, run_parts, split
from texvent.sensor import SensorSize
from texvent_scenes.raycast.addresses import list_at
from texvent_scenes.raycast.records import World
from texvent_scenes.raycast.render import world_and_shapes, world_at
from texvent_scenes.raycast.trace import (
    SKY,
    background_hit,
    first_hit,
    hit_again,
    plane_direction,
    tile_at,
)
from texvent_scenes.raycast.vectors import plane_point
from texvent_scenes.rendered_scene import Float64Array, Primitives, RenderedScene

_DEPTH_TOLERANCE = 1e-6
"""Relative: a point this much behind the first surface is that surface, not hidden by it."""


def ground_truth(scene: RenderedScene, t0_s: float, t1_s: float, size: SensorSize) -> GroundTruth:
    """Ground truth at t0 and motion from t0 to t1.

    A piece of surface is followed through its shape's motion and the camera's. Ground, water
    surface and walls stand still; the sky is infinitely far, so only turning the camera moves it.
    Shadows, reflections, waves and clouds move without a surface moving: flow ignores them.

    Args:
        scene: the scene.
        t0_s: instant whose pixels are described, s.
        t1_s: instant that flow leads to, s; at t0 nothing moves or is hidden.
        size: image size, pixels.
    """
    world, shapes = world_and_shapes(scene, t0_s, size, shadows=False)
    seen = cast_centres(world, size)
    instances = _instances(shapes, seen.number)
    shape = size.shape
    flow, hidden = np.zeros((*shape, 2)), np.zeros(shape, dtype=np.bool_)
    if t1_s != t0_s:
        place = move_to(scene, (t0_s, t1_s), size, seen)
        in_front = place[:, 2] > 0.0
        flow = np.where(in_front[:, None], place[:, :2] - seen.points, np.nan)
        hidden = _hidden(world_at(scene, t1_s, size, shadows=False), place, size)
    return GroundTruth(
        depth=seen.depth.astype(np.float32).reshape(shape),
        instance=instances.reshape(shape),
        flow=flow.astype(np.float32).reshape(*shape, 2),
        occluded=hidden.reshape(shape),
        boxes=_boxes(scene, t0_s, seen, instances.reshape(shape)),
    )


def visible_instances(
    scene: RenderedScene, time_s: float, size: SensorSize, points: Float64Array
) -> tuple[Float64Array, NDArray[np.int32]]:
    """Depth and instance seen through image points at one instant.

    Args:
        scene: the scene.
        time_s: the instant, s.
        size: image size, pixels.
        points: [k, 2] x and y, pixels from the image's top left corner, inside the image.

    Returns:
        [k] depth along the optical axis, m, inf for the sky; and [k] instance ids.
    """
    world, shapes = world_and_shapes(scene, time_s, size, shadows=False)
    depth, number = cast(world, np.ascontiguousarray(points, np.float64))
    return depth, _instances(shapes, number)


def _instances(shapes: Primitives, number: NDArray[np.int32]) -> NDArray[np.int32]:
    """Instance ids of shape numbers; 0 for ground, sky and walls."""
    owner = np.append(shapes.instance.astype(np.int32), np.int32(0))
    return np.asarray(owner[np.where(number >= 0, number, -1)], dtype=np.int32)


def _hidden(world: World, place: Float64Array, size: SensorSize) -> NDArray[np.bool_]:
    """Whether something stands before the points, or they are out of the image."""
    x, y, depth = place.T
    inside = (depth > 0) & (x >= 0) & (x < size.width) & (y >= 0) & (y < size.height)
    hidden = ~inside
    index = np.flatnonzero(inside)
    first, _ = cast(world, np.ascontiguousarray(place[index, :2]))
    hidden[index] = first < depth[index] * (1.0 - _DEPTH_TOLERANCE)
    return np.asarray(hidden, dtype=np.bool_)


def _boxes(
    scene: RenderedScene, time_s: float, seen: Seen, instance: NDArray[np.int32]
) -> tuple[Box, ...]:
    """Boxes around the visible pixels of each object."""
    owner = scene.primitives(time_s).instance.astype(np.int32)
    alone = np.zeros(1 + max(owner.max(initial=0), 0), dtype=np.int64)
    count_unoccluded(seen.world.instant, owner, seen.points, alone)
    boxes = []
    for one in np.unique(instance[instance > 0]):
        rows, columns = np.nonzero(instance == one)
        boxes.append(
            Box(
                instance=int(one),
                class_name=scene.class_names[int(one)],
                x0=int(columns.min()),
                y0=int(rows.min()),
                x1=int(columns.max()) + 1,
                y1=int(rows.max()) + 1,
                visibility=len(rows) / int(alone[one]),
            )
        )
    return tuple(boxes)


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
    """Image points, for a camera at another instant, of the surfaces seen through image points.

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
    """Numbers of image points that would show each instance if nothing stood before it.

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
    """First hits through the pixel centres at one instant."""

    world: World
    """The scene at that instant."""
    points: Float64Array
    """[H · W, 2] image points, pixels."""
    depth: Float64Array
    """[H · W] metres."""
    number: NDArray[np.int32]
    """[H · W] shape number, GROUND, SKY or ROOM."""


def frame_motion(
    scene: RenderedScene,
    time_s: float,
    before_s: float | None,
    after_s: float | None,
    size: SensorSize,
) -> MotionVectors:
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
    seen = cast_centres(world_at(scene, time_s, size, shadows=False), size)

    def vectors(to_s: float | None) -> NDArray[np.float32] | None:
        if to_s is None:
            return None
        place = move_to(scene, (time_s, to_s), size, seen)
        moved = np.where(place[:, 2:] > 0.0, place[:, :2] - seen.points, np.nan)
        return moved.astype(np.float32).reshape(*size.shape, 2)

    return MotionVectors(
        forward=vectors(after_s),
        backward=vectors(before_s),
        depth=seen.depth.astype(np.float32).reshape(size.shape),
    )


def cast_centres(world: World, size: SensorSize) -> Seen:
    """First hits through the pixel centres."""
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
    scene: RenderedScene, times_s: tuple[float, float], size: SensorSize, seen: Seen
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
