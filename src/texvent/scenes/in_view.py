"""Visibility check: which objects of a staged scene are out of view or a few pixels large.

Rays through a coarse grid of image points find all large objects. For each other one every pixel
of its box in the image is looked at, so that the pixels of small things are counted exactly.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.description import AMID, SceneDescription
from texvent.scenes.projection import project
from texvent.scenes.raycast.records import OwnedWorld, World
from texvent.scenes.raycast.render import world_and_shapes
from texvent.scenes.raycast.surface_motion import cast
from texvent.scenes.scene import Float64Array, Primitives, Scene
from texvent.sensor import SensorSize

INSTANTS = 7
"""Instants of the clip at which it is looked for objects; what is in view at one of them is."""
MOST_POINTS = 2000
"""Points of a grid over the image, or over the box of an object."""
LEAST_PIXELS = 6
"""Pixels below which an object is too small to be told."""
MOST_COUNTED = 6
"""Copies of an object that are counted one by one; of more, some may hide each other."""
_CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
"""Of the box around a unit shape."""


class Unseen(NamedTuple):
    """What a clip does not show of the objects of its scene."""

    out_of_view: tuple[str, ...]
    """Such as "tree", or "dog (2 of 3)"."""
    too_small: tuple[str, ...]
    """Such as "bird (2 pixels)"."""


def find_unseen(
    scene: Scene,
    description: SceneDescription,
    object_of: Mapping[int, int],
    size: SensorSize,
    duration_s: float,
) -> Unseen:
    """What the camera never shows, or never larger than a few pixels.

    An object without a body of its own is part of another one's, as a worn coat is, unless it was
    to stand around others. `object_of` gives the object's index of each instance.
    """
    pixels = count_pixels(scene, list(object_of), size, duration_s)
    around = {i for one in description.relations if one.kind in AMID for i in one.targets}
    outside: list[str] = []
    small: list[str] = []
    for index, thing in enumerate(description.objects):
        copies = [pixels[one] for one, owner in object_of.items() if owner == index]
        most, lost = max(copies, default=0), copies.count(0)
        if not copies and index not in around:
            continue
        if most == 0:
            outside.append(thing.noun)
        elif most < LEAST_PIXELS:
            small.append(f"{thing.noun} ({most} pixel{'s' if most > 1 else ''})")
        elif lost and len(copies) <= MOST_COUNTED and index not in around:
            outside.append(f"{thing.noun} ({lost} of {len(copies)})")
    return Unseen(tuple(dict.fromkeys(outside)), tuple(dict.fromkeys(small)))


def count_pixels(
    scene: Scene, instances: list[int], size: SensorSize, duration_s: float
) -> dict[int, int]:
    """Instance id → its pixels at the instant that shows most of it; of large ones about."""
    most = dict.fromkeys(instances, 0)
    whole = (np.zeros(2), np.array([size.width, size.height], dtype=np.float64))
    everywhere, share = _grid(*whole)
    for time_s in np.linspace(0.0, duration_s, INSTANTS):
        world, shapes = world_and_shapes(scene, float(time_s), size, shadows=False)
        owner = np.append(shapes.instance.astype(np.int64), 0)
        seen = _count(world, owner, everywhere)
        for one in instances:
            most[one] = max(most[one], round(share * seen[one]))
            if most[one] < LEAST_PIXELS * share and (box := _box(scene, time_s, size, shapes, one)):
                points, each = _grid(*box)
                most[one] = max(most[one], round(each * _count(world, owner, points)[one]))
    return most


def _count(
    world: World | OwnedWorld, owner: NDArray[np.int64], points: Float64Array
) -> Counter[int]:
    """Points that show each instance."""
    _, number = cast(world, points)
    return Counter(owner[np.where(number >= 0, number, -1)].tolist())


def _grid(low: Float64Array, high: Float64Array) -> tuple[Float64Array, float]:
    """Centres of pixels [k, 2] of a box, at most about `MOST_POINTS`; and pixels for each."""
    step = max(1, math.ceil(math.sqrt(float(np.prod(high - low)) / MOST_POINTS)))
    x, y = (np.arange(low[axis] + step // 2, high[axis], step) + 0.5 for axis in (0, 1))
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2), float(step * step)


def _box(
    scene: Scene, time_s: float, size: SensorSize, shapes: Primitives, instance: int
) -> tuple[Float64Array, Float64Array] | None:
    """Whole pixels around an instance, low and high corner; None where it is not in the image."""
    to_world = shapes.to_world[shapes.instance == instance].astype(np.float64)
    corners = _CORNERS @ to_world[:, :, :3].transpose(0, 2, 1) + to_world[:, None, :, 3]
    seen = project(scene.camera(float(time_s)), size, corners.reshape(-1, 3))
    low, high = np.zeros(2), np.array([size.width, size.height], dtype=np.float64)
    if (seen[:, 2] > 0.0).all() and np.isfinite(seen).all():
        low, high = (
            np.clip(np.floor(seen[:, :2].min(axis=0)), low, high),
            np.clip(np.ceil(seen[:, :2].max(axis=0)), low, high),
        )
    is_shown = np.any(seen[:, 2] > 0.0) and np.all(high > low)
    return (low, high) if is_shown else None
