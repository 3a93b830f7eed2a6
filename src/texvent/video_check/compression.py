"""What lossy compression leaves: edges of its blocks, and images renewed at every key frame."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array
from texvent.video_check.blocks import SeenFrame, block_means

BLOCK = 8
"""Side of the blocks of MPEG and JPEG; those of H.264 and HEVC lie on the same grid."""
HIGHEST_STEP = 8.0
"""Levels at which a step between neighbours stops counting: blocks differ by less, edges of things
by more."""
LINES = 180
"""Of taller images only every second, third ... row is read, so that about so many are."""
LEAST_STEP = 0.25
"""Levels: steps and changes finer than a quarter of a code value are no detail."""
PEAK_DEVIATIONS, PEAK_RATIO = 6.0, 1.5
"""A pair renews the image if its resting blocks change by so many deviations (1.4826 median
absolute deviations) above the median, and by this many times the median."""
LEAST_PERIOD, LEAST_PEAKS = 4, 4
REGULAR_SHARE = 0.75
"""Share of the distances between peaks that must be equal, to one frame."""


class Compression:
    """Takes steps between neighbours by their place, and the change of resting blocks by pair."""

    def __init__(self) -> None:
        self._steps = (np.zeros(BLOCK), np.zeros(BLOCK))
        self._previous: NDArray[np.float32] | None = None
        self._resting: list[float] = []

    def add(self, seen: SeenFrame) -> None:
        """Take one frame."""
        if seen.is_sampled and min(seen.luma.shape) > BLOCK:
            self._steps[0][:] += steps_by_place(_thinned(seen.luma.T).T, 0)
            self._steps[1][:] += steps_by_place(_thinned(seen.luma), 1)
        luma = _thinned(seen.luma)
        if self._previous is not None:
            moved = block_means(np.abs(luma - self._previous))
            self._resting.append(float(np.median(moved)))
        self._previous = luma

    def measures(self) -> dict[str, float]:
        """By name.

        Returns:
            `blockiness`: mean step between neighbouring pixels at the edges of 8×8 blocks over
            that elsewhere, mean of rows and columns; 1 without blocks. Steps above 8 levels count
            as 8. `key_period`: frames from key frame to key frame, 0 if none is seen; `key_ratio`:
            how many times more resting blocks change there than elsewhere; `key_levels`: by how
            much, levels. Half of the blocks, those that change least, are resting.
        """
        period, levels, ratio = find_renewals(np.array(self._resting))
        sides = [blockiness(steps) for steps in self._steps]
        return {
            "blockiness": float(np.mean(sides)),
            "key_period": float(period),
            "key_levels": levels,
            "key_ratio": ratio,
        }


def _thinned(luma: NDArray[np.float32]) -> NDArray[np.float32]:
    return luma[:: max(1, len(luma) // LINES)]


def steps_by_place(luma: NDArray[np.float32], axis: int) -> Float64Array:
    """Mean of min(|step|, 8) between neighbours along an axis, by place in blocks of 8.

    Returns:
        [8], levels: the i-th for the steps from pixel 8n + i to pixel 8n + i + 1.
    """
    step = np.minimum(np.abs(np.diff(luma, axis=axis)), np.float32(HIGHEST_STEP))
    mean = step.mean(axis=1 - axis, dtype=np.float64)
    whole = len(mean) // BLOCK * BLOCK
    return np.asarray(mean[:whole].reshape(-1, BLOCK).mean(axis=0))


def blockiness(steps: Float64Array) -> float:
    """The largest of the steps by place over the mean of the others; 1 in a flat image.

    The place of the grid is not known: video may be cropped.
    """
    if steps.sum() <= 0:
        return 1.0
    largest = float(steps.max())
    others = (float(steps.sum()) - largest) / (len(steps) - 1)
    return max(1.0, largest / max(others, LEAST_STEP))


def find_renewals(resting: Float64Array) -> tuple[int, float, float]:
    """How regularly an image that rests is renewed.

    Args:
        resting: change of the resting blocks of each pair, levels, [n].

    Returns:
        Period in frames, median change of the pairs that renew, levels, and how many times the
        median of all pairs that is. (0, 0, 1) without at least four peaks at equal distances.
    """
    nothing = 0, 0.0, 1.0
    if len(resting) < LEAST_PERIOD * (LEAST_PEAKS - 1):
        return nothing
    middle = float(np.median(resting))
    deviation = 1.4826 * float(np.median(np.abs(resting - middle)))
    least = max(middle + PEAK_DEVIATIONS * deviation, PEAK_RATIO * middle, LEAST_STEP)
    peaks = np.flatnonzero(resting > least)
    if len(peaks) < LEAST_PEAKS:
        return nothing
    apart = np.diff(peaks)
    period = int(np.median(apart))
    is_regular = float((np.abs(apart - period) <= 1).mean()) >= REGULAR_SHARE
    if period < LEAST_PERIOD or not is_regular:
        return nothing
    levels = float(np.median(resting[peaks]))
    return period, levels, levels / max(middle, LEAST_STEP)
