"""Framing: the camera position from which everything that matters fits the image, large enough."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.camera import PosedCamera
from texvent_scenes.rendered_scene import Float64Array

USUAL_FOCAL = 1.1
"""Focal length over image width."""
VERTICAL = 1e-6
"""Share of a way that leads aside up to which it is vertical."""
NEAREST_M = 0.04
"""Least distance from the camera to what it looks at, m."""
_LARGE = 0.3
"""Geometric mean of the shares of the image's width and height that a subject should extend over:
a person two thirds as high as the image, a car four tenths as wide. What is thin comes nearer."""
_LARGE_GROUP, _LARGE_COPY = 0.65, 0.13
"""Share of the image's width or height that a group should extend over together, and each of it."""
_HALVINGS, _FIT_STEPS = 6, 4


@dataclass(frozen=True)
class Framing:
    """A camera position: looks from `target + distance · offset` at the target."""

    target: Float64Array
    """[3] m."""
    azimuth: float
    """Azimuth of the camera about the target: 0 = south, looking north; radians, anticlockwise."""
    elevation: float
    """Elevation of the camera above the target, radians."""
    distance_m: float
    focal: float

    @property
    def offset(self) -> Float64Array:
        """[3] unit vector from the target to the camera."""
        return direction(self.azimuth, self.elevation)


def pose(position: Sequence[float], target: Sequence[float]) -> Framing:
    """The framing of a camera at a point, m, that looks at another one.

    A camera that looks straight down or up has the right of the picture at x.
    """
    away = np.subtract(position, target)
    distance = float(np.linalg.norm(away))
    is_vertical = math.hypot(*away[:2]) <= VERTICAL * distance
    azimuth = 0.0 if is_vertical else math.atan2(away[0], -away[1])
    elevation = math.asin(min(max(away[2] / distance, -1.0), 1.0))
    return Framing(np.array(target, dtype=np.float64), azimuth, elevation, distance, USUAL_FOCAL)


def seen_through(framing: Framing, field_of_view_deg: float | None, *, is_fixed: bool) -> Framing:
    """The framing with another horizontal field of view, 1 to 150°; None leaves it as it is.

    Unless the camera is fixed, what it looks at keeps its size in the image.
    """
    if field_of_view_deg is None:
        return framing
    focal = 0.5 / math.tan(math.radians(0.5 * field_of_view_deg))
    distance = framing.distance_m * (1.0 if is_fixed else focal / framing.focal)
    return replace(framing, focal=focal, distance_m=distance)


def direction(azimuth: float, elevation: float) -> Float64Array:
    """[3] unit vector; azimuth 0 and elevation 0 point south (towards the default viewer)."""
    flat = math.cos(elevation)
    return np.array([flat * math.sin(azimuth), -flat * math.cos(azimuth), math.sin(elevation)])


def look_at(
    position: Float64Array, target: Float64Array, focal: float, azimuth: float = 0.0
) -> PosedCamera:
    """A camera at `position` that looks at `target`, the horizon level.

    The azimuth is that of one that looks straight up or down.
    """
    forward = np.asarray(target - position, dtype=np.float64)
    forward = forward / np.linalg.norm(forward)
    right = np.array([forward[1], -forward[0], 0.0])
    flat = float(np.linalg.norm(right))
    level = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    right = level if flat <= VERTICAL else right / flat
    (fx, fy, fz), (rx, ry, rz) = forward, right
    down = (fy * rz - fz * ry, fz * rx - fx * rz, fx * ry - fy * rx)
    axes = np.array([right, down, forward])
    return PosedCamera(np.asarray(position, dtype=np.float64), axes, focal)


def fit(
    points: Float64Array, *, azimuth: float, elevation: float, aspect: float, fill: float,
    lift: float = 0.0, focal: float = USUAL_FOCAL,
) -> Framing:  # fmt: skip
    """The nearest station from which points [n, 3], m, fill that share of the image at most.

    A point (r right, u up, f further than the target) is inside when |r| is at most
    fill · (distance + f) / (2 · focal), and likewise for u with the image's height: each point
    needs a distance; the largest is taken. The camera looks above their middle by `lift` half image
    heights, as far as they still fit: the sky comes into the upper part of the image.
    """
    back = direction(azimuth, elevation)
    right = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    up = np.cross(back, right)
    target = 0.5 * (points.min(axis=0) + points.max(axis=0))
    for step in range(_FIT_STEPS):
        local = points - target
        sideways, upwards, nearer = local @ right, local @ up, local @ back
        asked = np.maximum(np.abs(sideways), np.abs(upwards) / aspect) * 2.0 * focal / fill
        distance = max(float(np.max(asked + nearer)), NEAREST_M)
        depth = np.maximum(distance - nearer, 1e-3)
        x, y = sideways / depth, upwards / depth
        if step < _FIT_STEPS - 1:
            middle = (x.min() + x.max()) * right + (y.min() + y.max()) * up
            target = target + 0.5 * distance * middle
    half_height = 0.5 * aspect / focal
    room_m = max(float(np.min(upwards + fill * half_height * depth)), 0.0)
    target = target + min(lift * half_height * distance, room_m) * up
    return Framing(target, azimuth, elevation, distance, focal)


def image_of(camera: PosedCamera, points: Float64Array) -> Float64Array:
    """[..., 3] of points: x and y in image widths from the middle, y down; and depth, m."""
    seen = (points - camera.position) @ camera.rotation.T
    seen[..., :2] *= camera.focal / np.maximum(seen[..., 2:], 1e-3)
    return np.asarray(seen)


def measure_prominence(camera: PosedCamera, boxes: Float64Array, aspect: float) -> float:
    """Prominence of boxes [copies, 8, 3] of an object; 1 = as large as a subject should be."""
    image = image_of(camera, boxes)[..., :2] / [1.0, aspect]
    copy = float(np.sqrt(np.prod(np.ptp(image, axis=1), axis=1)).max())
    if len(image) == 1:
        return copy / _LARGE
    group = float(np.ptp(image, axis=(0, 1)).max())
    return max(copy / _LARGE, min(copy / _LARGE_COPY, group / _LARGE_GROUP))


def come_near(
    framings: Sequence[Framing], prominence: Callable[[Framing], float], goals: Sequence[float]
) -> Framing:
    """The framing that shows as much as it can with a subject that is large enough.

    Framings go from the one that shows all to the one that shows the subject alone; they look the
    same way, so that what is in the image from two places is so from those between them. The camera
    goes on to the next one until the subject is as prominent as the next goal.
    """
    found, reached = framings[0], prominence(framings[0])
    for near, goal in zip(framings[1:], goals, strict=True):
        most = prominence(near)
        if reached >= goal or most <= reached:
            continue
        wide, low, high = found, 0.0, 1.0
        for _ in range(_HALVINGS if most >= goal else 0):
            middle = 0.5 * (low + high)
            is_enough = prominence(_between(wide, near, middle)) >= goal
            low, high = (low, middle) if is_enough else (middle, high)
        found = _between(wide, near, high)
        reached = prominence(found)
    return found


def _between(one: Framing, other: Framing, share: float) -> Framing:
    """The framing at a share of the way from one to another."""
    target = one.target + share * (other.target - one.target)
    distance = one.distance_m + share * (other.distance_m - one.distance_m)
    return replace(one, target=target, distance_m=distance)
