"""How large the subject is in the image, and how near the camera goes for it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.scene import Camera, Float64Array
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.camera.framing import Framing

_LARGE = 0.3
"""Geometric mean of the shares of the image's width and height that a subject should extend over:
a person two thirds as high as the image, a car four tenths as wide. What is thin comes nearer."""
_LARGE_GROUP = 0.65
"""Share of the image's width or height that a group should extend over together."""
_LARGE_COPY = 0.13
"""The same as `_LARGE` for each of a group."""
_HALVINGS = 6


def measure(camera: Camera, boxes: Float64Array, aspect: float) -> float:
    """How prominent the copies of an object are; 1 = as large as a subject should be.

    Args:
        camera: that sees them.
        boxes: [copies, 8, 3] their corners, m.
        aspect: image height over width.
    """
    seen = (boxes - camera.position) @ camera.rotation.T
    image = camera.focal * seen[..., :2] / np.maximum(seen[..., 2:], 1e-3)
    image[..., 1] /= aspect
    copy = float(np.sqrt(np.prod(np.ptp(image, axis=1), axis=1)).max())
    if len(image) == 1:
        return copy / _LARGE
    group = float(np.ptp(image, axis=(0, 1)).max())
    return max(copy / _LARGE, min(copy / _LARGE_COPY, group / _LARGE_GROUP))


def come_near(
    framings: Sequence[Framing], path_of: Callable[[Framing], CameraPath],
    prominence: Callable[[CameraPath], float], goals: Sequence[float],
) -> CameraPath:  # fmt: skip
    """The camera that shows as much as it can with a subject that is large enough.

    All framings look the same way, so that whatever is in the image from two places is so from
    every place on the line between them.

    Args:
        framings: from the one that shows all to the one that shows the subject alone.
        path_of: the camera over the clip from a framing.
        prominence: of the subject in it.
        goals: how prominent it must be for the camera to go on to each framing after the first.
    """
    path = path_of(framings[0])
    for framing, goal in zip(framings[1:], goals, strict=True):
        if prominence(path) >= goal:
            break
        nearest = path_of(framing)
        if prominence(nearest) > prominence(path):
            path = _between(path, nearest, prominence, goal)
    return path


def _between(
    wide: CameraPath, near: CameraPath, prominence: Callable[[CameraPath], float], goal: float
) -> CameraPath:
    """The widest between two cameras that reaches the goal, or the nearer one."""
    low, high = 0.0, 1.0
    if prominence(near) < goal:
        return near
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        is_enough = prominence(_mixed(wide, near, middle)) >= goal
        low, high = (low, middle) if is_enough else (middle, high)
    return _mixed(wide, near, high)


def _mixed(wide: CameraPath, near: CameraPath, share: float) -> CameraPath:
    one, other = wide.framing, near.framing
    framing = replace(
        one,
        target=one.target + share * (other.target - one.target),
        distance_m=one.distance_m + share * (other.distance_m - one.distance_m),
    )
    return replace(wide, framing=framing)
