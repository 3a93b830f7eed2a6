"""Cuts: the crop of a video that a draw takes for a batch, and the truth that goes with it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.sensor import SensorSize
from texvent.training.draws import ClipDraw, Ranges
from texvent.training.sources import Clip
from texvent.truth.boxes import clip_boxes, detection_target


class CutPlan(NamedTuple):
    """Properties that every cut of a stream has."""

    size: SensorSize
    intervals: int
    """T, between the frames that are simulated."""
    intervals_per_window: int
    ranges: Ranges
    truth: tuple[str, ...]

    def check(self, clip: Clip, name: str) -> None:
        """Refuse a clip that no cut fits into.

        Raises:
            InputError: it is smaller, or shorter.
        """
        count, height, width = clip.frames.shape
        if width < self.size.width or height < self.size.height:
            raise InputError(
                f"{name} is {width}x{height}, smaller than crops of {self.size}; give a smaller "
                "size"
            )
        lowest = int(self.ranges.speed[0])
        if count < self.intervals * lowest + 1:
            raise InputError(
                f"{name} has {count} frames, of which {self.intervals * lowest + 1} are needed; "
                "give fewer frames, frames_per_grid or a lower speed, or more memory"
            )


class Cut(NamedTuple):
    """A cut; W windows."""

    frames: NDArray[np.uint8]
    """[T + 1, H, W]."""
    times_us: NDArray[np.int64]
    """[T + 1] since the first, µs."""
    truth: dict[str, Any]
    """`flow` [W, 2, H, W], `depth` [W, H, W]; `boxes`: of W instants, as `detection_target`."""
    place: tuple[int, int, int, int]
    """First frame, row, column, and speed."""


def cut_clip(clip: Clip, draw: ClipDraw, plan: CutPlan, frames: NDArray[np.uint8]) -> Cut:
    """Cut what a draw says out of a clip that `CutPlan.check` accepts.

    Args:
        clip: the clip.
        draw: what was drawn.
        plan: what all cuts have.
        frames: [T + 1, H, W], contiguous; those of the cut are written here.
    """
    count, height, width = clip.frames.shape
    (slow, fast), steps = plan.ranges.speed, plan.intervals
    fast = min(int(fast), (count - 1) // steps)
    speed = int(slow) + int(draw.speed * (fast - int(slow) + 1))
    shown = np.concatenate([[0], np.cumsum(np.where(draw.is_paused, 0, speed))])
    sides = np.array(
        [count - shown[-1], height - plan.size.height + 1, width - plan.size.width + 1]
    )
    first, top, left = (int(one) for one in draw.place * sides)
    rows, columns = slice(top, top + plan.size.height), slice(left, left + plan.size.width)
    clock = min(first, count - 1 - steps)  # pauses take no frames, but time
    times_us = clip.times_us[clock : clock + steps + 1]
    at = first + shown
    crops, before = clip.frames[:, rows, columns], -1
    for frame, number in enumerate(at.tolist()):
        frames[frame] = frames[frame - 1] if number == before else crops[number]
        before = number
    if draw.is_flipped:
        lines = frames.reshape(-1, plan.size.width)
        cv2.flip(lines, 1, dst=lines)  # several times as fast as NumPy
    truth = {
        name: _truth_of(clip, name, (at, rows, columns), plan, is_flipped=draw.is_flipped)
        for name in plan.truth
    }
    return Cut(frames, times_us - times_us[0], truth, (first, top, left, speed))


def _truth_of(
    clip: Clip, name: str, place: tuple[NDArray[np.int64], slice, slice], plan: CutPlan,
    *, is_flipped: bool,
) -> Any:  # fmt: skip
    at, rows, columns = place
    ends = at[plan.intervals_per_window :: plan.intervals_per_window]
    if name == "boxes":
        found = clip.truth["boxes"]
        return [
            _cut_boxes(found[found["t"] == t_us], (rows.start, columns.start), plan, is_flipped)
            for t_us in clip.times_us[ends]
        ]
    if name == "depth":
        depth = clip.truth["depth"][:, rows, columns][ends]
        return depth[..., ::-1] if is_flipped else depth
    before = at[:-1]
    flow = np.array(
        clip.truth["flow"][:, :, rows, columns][np.minimum(before, len(clip.times_us) - 2)]
    )
    flow[before == at[1:]] = 0  # paused
    if is_flipped:
        flow = flow[..., ::-1] * np.array([-1, 1], np.float32)[:, None, None]
    return flow


def _cut_boxes(
    boxes: NDArray[np.void], corner: Sequence[int], plan: CutPlan, is_flipped: bool
) -> dict[str, NDArray[Any]]:
    boxes = boxes.copy()
    boxes["x"] -= corner[1]
    boxes["y"] -= corner[0]
    if is_flipped:
        boxes["x"] = plan.size.width - boxes["x"] - boxes["w"]
    return detection_target(boxes[clip_boxes(boxes, plan.size)])
