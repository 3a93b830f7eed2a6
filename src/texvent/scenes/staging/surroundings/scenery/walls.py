"""Walls of corridors and alleys on both sides of the view, parapets across it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from texvent.scenes.models.protocol import Model
from texvent.scenes.scene import Camera, Float64Array

_GAP_M = 0.35
"""Between a wall along the view and what it must not touch."""
_STEP_M = 1.3
"""From what stands furthest off to a wall across the view."""

Spot = tuple[float, float, float]
"""x and y, m, and heading, radians."""


def stand_along(model: Model, cameras: Sequence[Camera], bodies: Float64Array) -> Spot | None:
    """Where walls along the view stand; None where bodies or the camera need more room.

    Args:
        model: two walls along its x axis.
        cameras: at some instants.
        bodies: [n, 3] x, y and radius of what stands or goes between them, m.
    """
    forward = _look(cameras)
    right = np.array([forward[1], -forward[0]])
    spots = np.array([camera.position[:2] for camera in cameras]) @ right
    low, high = [float(spots.min()) - _GAP_M], [float(spots.max()) + _GAP_M]
    aside = bodies[:, :2] @ right
    low += [float(one) for one in aside - bodies[:, 2]]
    high += [float(one) for one in aside + bodies[:, 2]]
    if max(high) - min(low) > inner_width(model):
        return None
    middle = np.array([camera.position[:2] for camera in cameras]).mean(axis=0)
    middle = middle + (0.5 * (max(high) + min(low)) - float(middle @ right)) * right
    return float(middle[0]), float(middle[1]), math.atan2(float(forward[1]), float(forward[0]))


def inner_width(model: Model) -> float:
    """Metres between two walls that are a tenth of their distance thick at most."""
    return 0.78 * float(model.width)


def stand_across(cameras: Sequence[Camera], bodies: Float64Array) -> Spot:
    """Where a parapet right across the view stands, its front to the camera."""
    forward = _look(cameras)
    ahead = bodies[:, :2] @ forward + bodies[:, 2]
    first = cameras[0].position[:2]
    reach = max(float(ahead.max(initial=-math.inf)) - float(first @ forward), 2.0) + _STEP_M
    spot = first + reach * forward
    return float(spot[0]), float(spot[1]), math.atan2(-float(forward[1]), -float(forward[0]))


def _look(cameras: Sequence[Camera]) -> Float64Array:
    """[2] which way the camera looks over the ground, in the middle of the clip."""
    forward = np.asarray(cameras[len(cameras) // 2].rotation[2, :2], dtype=np.float64)
    return forward / max(float(np.hypot(*forward)), 1e-9)
