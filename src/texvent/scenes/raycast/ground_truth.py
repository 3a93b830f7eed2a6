"""Exact ground truth of a scene: depth, instance ids, optical flow, occlusion, boxes.

It comes from the geometry that the images are drawn from, so it holds at any pair of instants.
Every value belongs to the ray through a pixel's centre; images average over the pixel's area.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.raycast.records import World
from texvent.scenes.raycast.render import world_at
from texvent.scenes.raycast.surface_motion import (
    Seen,
    cast,
    cast_centres,
    count_unoccluded,
    move_to,
)
from texvent.scenes.scene import Float32Array, Float64Array, Scene
from texvent.sensor import SensorSize

_DEPTH_TOLERANCE = 1e-6
"""Relative: a point this much behind the first surface is that surface, not hidden by it."""


@dataclass(frozen=True)
class Box:
    """An object's place in the image."""

    instance: int
    """Its id in `GroundTruth.instance`."""
    class_name: str
    """Its noun, such as "car"."""
    x0: int
    """First column with a visible pixel."""
    y0: int
    """First row with a visible pixel."""
    x1: int
    """One past the last column with a visible pixel."""
    y1: int
    """One past the last row with a visible pixel."""
    visibility: float
    """Visible pixels as a share of those it would cover with nothing before it, within the
    image: above 0, at most 1."""


@dataclass(frozen=True, eq=False)
class GroundTruth:
    """What is true of each pixel's centre at t0, and where it goes until t1."""

    t0_s: float
    """First instant, s."""
    t1_s: float
    """Second instant, s; before or after the first."""
    depth: Float32Array
    """[H, W] metres along the optical axis; inf for the sky, and where a lens sees nothing."""
    instance: NDArray[np.int32]
    """[H, W] id of the object seen; 0 is ground, sky and scenery without an id."""
    flow: Float32Array
    """[H, W, 2] displacement (x to the right, y down) in pixels from t0 to t1 of the piece of
    surface seen at t0; NaN where it is not in front of the camera at t1, or its lens does not
    reach."""
    occluded: NDArray[np.bool_]
    """[H, W] true where that piece of surface cannot be seen at t1: something stands before it,
    or it is outside the image or behind the camera."""
    boxes: tuple[Box, ...]
    """Boxes at t0 of all objects with an id and at least one visible pixel, by id."""


def ground_truth(scene: Scene, t0_s: float, t1_s: float, size: SensorSize) -> GroundTruth:
    """Ground truth at t0 and motion from t0 to t1.

    A piece of surface is followed through its shape's motion and the camera's. Ground, water
    surface and walls stand still; the sky is infinitely far, so only turning the camera moves it.
    Shadows, reflections, waves and clouds move without a surface moving: flow ignores them.

    Args:
        scene: the scene.
        t0_s: instant whose pixels are described, s.
        t1_s: instant that flow leads to, s.
        size: image size, pixels.
    """
    world = world_at(scene, t0_s, size)
    seen = cast_centres(world, size)
    instances = _instances(scene, t0_s, seen.number)
    place = move_to(scene, (t0_s, t1_s), size, seen)
    in_front = place[:, 2] > 0.0
    flow = np.where(in_front[:, None], place[:, :2] - seen.points, np.nan)
    hidden = _hidden(world_at(scene, t1_s, size), place, size)
    shape = size.shape
    return GroundTruth(
        t0_s,
        t1_s,
        depth=seen.depth.astype(np.float32).reshape(shape),
        instance=instances.reshape(shape),
        flow=flow.astype(np.float32).reshape(*shape, 2),
        occluded=hidden.reshape(shape),
        boxes=_boxes(scene, t0_s, seen, instances.reshape(shape)),
    )


def visible_instances(
    scene: Scene, time_s: float, size: SensorSize, points: Float64Array
) -> tuple[Float64Array, NDArray[np.int32]]:
    """What is seen through image points at one instant.

    Args:
        scene: the scene.
        time_s: the instant, s.
        size: image size, pixels.
        points: [k, 2] x and y, pixels from the image's top left corner, inside the image.

    Returns:
        [k] depth along the optical axis, m, inf for the sky; and [k] instance ids.
    """
    depth, number = cast(world_at(scene, time_s, size), np.ascontiguousarray(points, np.float64))
    return depth, _instances(scene, time_s, number)


def _instances(scene: Scene, time_s: float, number: NDArray[np.int32]) -> NDArray[np.int32]:
    """Instance ids of shape numbers; 0 for ground, sky and walls."""
    owner = np.append(scene.primitives(time_s).instance.astype(np.int32), np.int32(0))
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


def _boxes(scene: Scene, time_s: float, seen: Seen, instance: NDArray[np.int32]) -> tuple[Box, ...]:
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
