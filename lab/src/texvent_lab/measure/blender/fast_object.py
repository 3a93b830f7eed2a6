"""Which events lie where the fastest object of a film passes."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.video import Frame

RIM_PX = 2


def passed_pixels(frames: Sequence[Frame]) -> NDArray[np.bool_]:
    """Where the fastest object is, or passes until the next frame: [N - 1, H, W].

    Args:
        frames: with motion and ids.
    """
    object_id = fastest_id(frames)
    covered = [_mask(frame, object_id) for frame in frames]
    rim = np.ones((2 * RIM_PX + 1,) * 2, np.uint8)
    result = np.zeros((len(frames) - 1, *covered[0].shape), np.uint8)
    for mask, here, there in zip(result, covered[:-1], covered[1:], strict=True):
        either = cv2.dilate(here | there, rim)
        if either.any():
            cv2.fillConvexPoly(mask, cv2.convexHull(cv2.findNonZero(either)), 1)
    return result > 0


def fastest_id(frames: Sequence[Frame]) -> int:
    """The object whose visible pixels move by most, on average, in any frame."""
    fastest: dict[int, float] = {}
    for frame in frames:
        motion = frame.motion
        if motion is None or motion.forward is None or motion.instance is None:
            continue
        speed = np.hypot(motion.forward[..., 0], motion.forward[..., 1])
        for one in np.unique(motion.instance).tolist():
            mean = float(speed[motion.instance == one].mean())
            fastest[one] = max(mean, fastest.get(one, 0.0))
    return max(fastest, key=lambda one: fastest[one])


def is_passed(
    events: EventStream, frames: Sequence[Frame], passed: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """For each event, whether the object passes there between the frames around it."""
    times = np.array([frame.t_us for frame in frames])
    pair = np.clip(np.searchsorted(times, events.t, side="right") - 1, 0, len(passed) - 1)
    return np.asarray(passed[pair, events.y, events.x])


def _mask(frame: Frame, object_id: int) -> NDArray[np.uint8]:
    if frame.motion is None or frame.motion.instance is None:
        return np.zeros(frame.size.shape, np.uint8)
    return np.asarray(frame.motion.instance == object_id, dtype=np.uint8)
