"""Which things of a scene its camera ever shows, and how well: what stays hidden is not shown."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.generate.landmarks import SKY, Landmark, is_marked
from texvent.scenes.inflection import pluralise
from texvent.scenes.projection import place_in_image, ray_directions
from texvent.scenes.raycast.render import world_and_shapes
from texvent.scenes.raycast.surface_motion import cast
from texvent.scenes.raycast.trace import GROUND
from texvent.scenes.raycast.visibility import count_unoccluded
from texvent.scenes.scene import Camera, Float64Array, Primitives, Scene, Shape
from texvent.sensor import SensorSize

INSTANTS = 9
"""Instants of the clip at which it is looked for things."""
MOST_COUNTED = 6
"""Things of a noun that are counted one by one; of more, some may hide each other."""
MOST_POINTS = 4000
"""Image points that are looked at per instant."""
LEAST_SIZE = 0.025
"""Share of the picture's width or height below which a thing is a speck."""
LEAST_AREA, SMALL_SIZE = 0.0015, 0.06
"""Share of the picture's points below which a thing up to this size is a speck too."""
LEAST_SEEN = 0.25
"""Share of a thing's silhouette of which less is hardly seen."""
LARGE_AREA = 0.03
"""Share of the picture's points from which on a thing is seen, however far it reaches beyond."""
LEAST_MARK = 0.003
"""Share of the picture's points that what a place is known by covers at least."""


@dataclass
class _Sight:
    """The most that is seen of a thing at any instant."""

    points: int = 0
    alone: int = 0
    """Points that would show it if nothing stood before it."""
    extent: float = 0.0
    """Of what lies in the image: share of the image's width or height, the greater one."""
    unhidden: float = 0.0
    """Share of what lies in the image that nothing hides."""
    inside: float = 0.0
    """Share of it that lies in the image, at the same instant."""
    seen: float = 0.0
    """Product of both, at the best instant."""
    most_inside: float = 0.0

    def add(self, points: int, alone: int, extent: float, inside: float) -> None:
        """Take an instant into account.

        Args:
            points: image points that show it.
            alone: those that would if nothing stood before it.
            extent: of its part in the image, as a share of the image's width or height.
            inside: which share of it lies in the image.
        """
        unhidden = points / max(alone, 1)
        self.points = max(self.points, points)
        self.alone = max(self.alone, alone)
        self.extent = max(self.extent, extent)
        self.most_inside = max(self.most_inside, inside)
        if unhidden * inside > self.seen:
            self.seen, self.unhidden, self.inside = unhidden * inside, unhidden, inside

    def fault(self, all_points: int) -> str | None:
        """Why it is not shown, or None."""
        share = self.points / all_points
        if not self.points and self.most_inside < LEAST_SEEN:
            return "out of view"
        if not self.points:
            return "hidden" if self.alone else "too small"
        if self.extent < LEAST_SIZE or (share < LEAST_AREA and self.extent < SMALL_SIZE):
            return "too small"
        if self.seen < LEAST_SEEN and share < LARGE_AREA:
            return "mostly hidden" if self.unhidden < self.inside else "cut off"
        return None


def list_unseen(
    scene: Scene,
    size: SensorSize,
    duration_s: float,
    *,
    landmarks: Sequence[Landmark] = (),
    scenery: Sequence[str] = (),
) -> tuple[str, ...]:
    """Things and places that the camera does not show, and why.

    Args:
        scene: the scene; its `class_names` are looked for.
        size: of the image, pixels.
        duration_s: of the clip, s.
        landmarks: what places and the sky are known by.
        scenery: noun of each shape of the scene that is scenery, "" for others.

    Returns:
        Their nouns with the reason, such as "dog (mostly hidden)"; or how many of them, such as
        "1 of 3 dogs (too small)", of at most `MOST_COUNTED`; and "forest (out of view)".
    """
    sights = {one: _Sight() for one in scene.class_names}
    marks: Counter[str] = Counter()
    points = image_points(size)
    for time_s in np.linspace(0.0, duration_s, INSTANTS):
        marks |= _look(scene, float(time_s), size, points, sights, scenery)
    least = LEAST_MARK * len(points)
    return (
        *_name_faults(scene.class_names, sights, len(points)),
        *(
            f"{landmark.word} (out of view)"
            for landmark in landmarks
            if all(marks[mark] < least for mark in landmark.marks)
        ),
    )


def _look(
    scene: Scene,
    time_s: float,
    size: SensorSize,
    points: Float64Array,
    sights: Mapping[int, _Sight],
    scenery: Sequence[str],
) -> Counter[str]:
    """Notes what is seen of each thing at an instant; points of all marks of places."""
    world, shapes = world_and_shapes(scene, time_s, size)
    camera = scene.camera(time_s)
    depth, number = cast(world, points)
    owner = np.asarray(shapes.instance, dtype=np.int32)
    highest = max(int(owner.max(initial=0)), max(sights, default=0))
    seen = np.bincount(owner[number[number >= 0]], minlength=highest + 1)
    alone = np.zeros(highest + 1, dtype=np.int64)
    count_unoccluded(world, owner, points, alone)
    places = _place_in_frame(shapes, owner, camera, size, highest + 1)
    for one, sight in sights.items():
        sight.add(int(seen[one]), int(alone[one]), *(float(v) for v in places[one]))
    marks = Counter({SKY: int(np.isinf(depth).sum())})
    for one, name in scene.class_names.items():
        marks[name] += int(seen[one])
    if scenery:
        for shape, count in zip(*np.unique(number[number >= 0], return_counts=True), strict=True):
            marks[scenery[shape] if shape < len(scenery) else ""] += int(count)
    is_ground = number == GROUND
    rays = ray_directions(camera, size, points[is_ground]) * depth[is_ground, None]
    mark, where = is_marked(scene.environment(time_s), (camera.position + rays)[:, :2])
    marks[mark] += int(where.sum())
    return marks


def _place_in_frame(
    shapes: Primitives, owner: NDArray[np.int32], camera: Camera, size: SensorSize, count: int
) -> Float64Array:
    """[count, 2] of each instance: its extent within the image, and which share lies there.

    From the boxes around its shapes: the extent is a share of the image's width or height, the
    greater one.
    """
    axes = np.asarray(camera.rotation)
    linear = axes @ shapes.to_world[:, :, :3]
    middle = (shapes.to_world[:, :, 3] - camera.position) @ axes.T
    is_ball = (shapes.shape == Shape.ELLIPSOID)[:, None]
    reach = np.where(is_ball, np.linalg.norm(linear, axis=2), np.abs(linear).sum(axis=2))
    reach[:, 2] = 0.0
    found = np.zeros((count, 2))
    known = (middle[:, 2] > 0.0) & (owner > 0)
    low, high = (place_in_image(camera, size, middle[known] + sign * reach[known])[:, :2]
                 for sign in (-1.0, 1.0))  # fmt: skip
    edge = np.array([size.width, size.height], dtype=np.float64)
    inner_low, inner_high = np.clip(low, 0.0, edge), np.clip(high, 0.0, edge)
    whole, inner = np.prod(high - low, axis=1), np.prod(inner_high - inner_low, axis=1)
    one = owner[known]
    is_in = inner > 0.0
    first, last = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(first, one[is_in], inner_low[is_in])
    np.maximum.at(last, one[is_in], inner_high[is_in])
    found[:, 0] = np.maximum((last - first) / edge, 0.0).max(axis=1)
    areas = np.bincount(one, whole, count)
    found[:, 1] = np.bincount(one, inner, count) / np.where(areas > 0.0, areas, 1.0)
    return found


def _name_faults(
    names: Mapping[int, str], sights: Mapping[int, _Sight], all_points: int
) -> list[str]:
    """As in "dog (cut off)" or "1 of 3 dogs (too small)"."""
    found = []
    for noun, total in Counter(names.values()).items():
        faults = [sights[one].fault(all_points) for one in names if names[one] == noun]
        reasons = Counter(fault for fault in faults if fault is not None)
        if sum(reasons.values()) == total:
            found.append(f"{noun} ({reasons.most_common(1)[0][0]})")
        elif total <= MOST_COUNTED:
            found += [
                f"{count} of {total} {pluralise(noun)} ({why})" for why, count in reasons.items()
            ]
    return found


def image_points(size: SensorSize) -> Float64Array:
    """Centres of pixels [k, 2] (x, y), evenly spread; rows are shifted, so that poles are met too.

    Example:
        >>> image_points(SensorSize(3, 2)).tolist()[:3], len(image_points(SensorSize(346, 260)))
        ([[0.5, 0.5], [1.5, 0.5], [2.5, 0.5]], 3599)
    """
    step = max(1, math.ceil(math.sqrt(size.width * size.height / MOST_POINTS)))
    rows = np.arange(step // 2, size.height, step)
    found = []
    for number, row in enumerate(rows):
        columns = np.arange((2 * number) % step, size.width, step)
        found.append(np.stack([columns, np.full(len(columns), row)], axis=1))
    return np.asarray(np.concatenate(found) + 0.5, dtype=np.float64)
