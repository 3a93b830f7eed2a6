"""Agreement of a video with the scene that it was to follow: edges and motion in common."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.frames import Frame, FrameStream
from texvent.ground_truth import GroundTruth

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]

MOST_PAIRS = 12
"""Pairs of frames that are looked at, spread over the clip."""
SQUARE = np.ones((5, 5), np.uint8)
"""Neighbourhood in which an edge of the video counts as at a border."""
CHANCE = 0.2
"""Share of places without a border that change as much as a border has to."""
DEPTH_STEP = 1.25
"""Ratio of depths of neighbouring pixels from which one stands before the other."""
LEAST_MOTION_PX = 0.5
BLUR_PX = 1.0
LEAST_CHANGE = 2.0
"""Levels; smaller changes say nothing about motion."""
FEWEST = 50
"""Pixels below which a share says nothing."""


def measure_agreement(video: FrameStream, scene: Any) -> dict[str, float]:
    """Share of a scene's edges and motion that a video shows: 0 is chance, 1 is all.

    * edges: of the borders of things, those at which the video changes more than at 8 of 10 places
      without one.
    * flow: of the moving pixels, those that the next frame shows rather where the scene's flow
      leads than at the same place.

    Args:
        video: frames at the times and of the size of the scene's.
        scene: frames that know their ground truth.

    Returns:
        What can be said, of `edges` and `flow`; nothing of a scene without things or motion.
    """
    count = video.frame_count or 0
    firsts = np.unique(np.linspace(0, max(count - 2, 0), MOST_PAIRS).astype(int)).tolist()
    edges, flows = _Share(), _Share()
    first: Frame | None = None
    for index, frame in enumerate(video):
        if first is not None:
            truth = scene.ground_truth(first.t_us, frame.t_us)
            edges.add(_at_borders(first.float_luma, truth))
            after = scene.ground_truth(frame.t_us, frame.t_us).instance
            flows.add(_along_flow(first.float_luma, frame.float_luma, truth, after))
        first = frame if index in firsts else None
    found = {"edges": edges.above(CHANCE), "flow": flows.above(0.5)}
    return {name: round(share, 3) for name, share in found.items() if share is not None}


class _Share:
    """Share of true values."""

    def __init__(self) -> None:
        self._true = self._all = 0

    def add(self, values: Mask) -> None:
        self._true += int(values.sum())
        self._all += values.size

    def above(self, chance: float) -> float | None:
        """The share above chance, of all there is above it."""
        if self._all < FEWEST:
            return None
        return max(0.0, (self._true / self._all - chance) / (1 - chance))


def _at_borders(luma: Floats, truth: GroundTruth) -> Mask:
    """Whether the image changes at each border pixel."""
    border = borders_of(truth)
    is_near = _widen(border, times=2)
    if is_near.all() or not border.any():
        return np.zeros(0, bool)
    change = np.hypot(cv2.Sobel(luma, cv2.CV_32F, 1, 0), cv2.Sobel(luma, cv2.CV_32F, 0, 1))
    change = cv2.dilate(change, SQUARE)
    return np.asarray(change[border] > np.quantile(change[~is_near], 1 - CHANCE))


def _widen(mask: Mask, times: int = 1) -> Mask:
    return np.asarray(cv2.dilate(mask.astype(np.uint8), SQUARE, iterations=times) > 0)


def borders_of(truth: GroundTruth) -> Mask:
    """Pixels beside another object, or beside what is clearly nearer or farther."""
    border = np.zeros(truth.depth.shape, bool)
    inverse = 1 / np.maximum(truth.depth, np.float32(1e-3))
    rows = (slice(None, -1),), (slice(1, None),)
    columns = (slice(None), slice(None, -1)), (slice(None), slice(1, None))
    for one, other in (rows, columns):
        low = np.minimum(inverse[one], inverse[other])
        high = np.maximum(inverse[one], inverse[other])
        is_other = truth.instance[one] != truth.instance[other]
        border[one] |= is_other | (high > DEPTH_STEP * low)
    return border


def _along_flow(
    first: Floats, second: Floats, truth: GroundTruth, after: NDArray[np.int32]
) -> Mask:
    """Whether the flow explains the second image better than rest does, at each moving pixel.

    Of pixels inside things, only those that change count, since shading need not move with a
    surface; of those near a border, only where it moves: a mug that turns has one that stays.

    Args:
        first: luma of the earlier frame.
        second: luma of the later frame.
        truth: of the earlier frame, with the flow to the later one.
        after: ids of the later frame.
    """
    # Blurred: bilinear interpolation smooths noise, and would prefer the moved image by that.
    before: Any = cv2.GaussianBlur(first, (0, 0), BLUR_PX)
    later: Any = cv2.GaussianBlur(second, (0, 0), BLUR_PX)
    height, width = first.shape
    rows, columns = np.mgrid[:height, :width].astype(np.float32)
    flow = np.nan_to_num(truth.flow)
    there = cv2.remap(later, columns + flow[..., 0], rows + flow[..., 1], cv2.INTER_LINEAR)
    moved, rested = np.abs(there - before), np.abs(later - before)
    moves = np.hypot(flow[..., 0], flow[..., 1]) >= LEAST_MOTION_PX
    is_front = _widen(truth.instance != after)
    is_inside = ~_widen(borders_of(truth)) & (rested >= LEAST_CHANGE)
    counts = moves & ~truth.occluded & (is_inside | (is_front & (moved + rested >= LEAST_CHANGE)))
    return np.asarray((moved < rested)[counts])
