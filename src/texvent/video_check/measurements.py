"""Measurements of a video in one pass, with flat memory: its levels, changes, repeats and cuts.

Most are taken on means over square blocks, 64 along the longer side.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array
from texvent.frames import MICROSECONDS, Frame
from texvent.pairs.instants import matching_luma
from texvent.pairs.scene_change import SceneChange, detect_scene_change
from texvent.pairs.time_jump import is_jump
from texvent.transfer import Transfer

Measurements = Mapping[str, float]
"""Name → number; see `VideoMeasurer.measurements`."""

GRID = 64
"""Blocks along the longer side."""
SAMPLED_EVERY = 4
"""The correlation of neighbours is measured on every fourth frame."""
FLAT_VARIANCE = 0.02
"""Variance in levels² below which an image is flat."""
BINS_PER_LEVEL = 16
BINS = 256 * BINS_PER_LEVEL

STILL_LEVELS = 0.02
"""Mean change of a pair below which it counts as still: an eighth of what a sensor's noise or a
codec leaves in a static shot."""
REPEAT_RATIO = 0.15
"""A pair that changes by less than this share of what the pairs around it do may be a repeat."""
BESIDE_RATIO = 0.5
"""The pairs before and after such pairs change by at least this share: motion that comes to rest
slows down first."""
AROUND = 12
"""Pairs to each side that are around."""
LONGEST_PATTERN = 30
LEAST_PERIODS = 3
PATTERN_AGREEMENT = 0.95
"""Share of the pairs that must be as the pattern says."""
IRREGULAR, ROUNDING_US = 0.1, 1_500
"""Frames are regular if no interval differs from the median by more than this share and this time:
times of a container are rounded to milliseconds."""


class VideoMeasurer:
    """Takes the measurements of a clip while its frames pass by.

    Keeps one frame, some arrays of block means, and a few numbers per frame.
    """

    def __init__(self) -> None:
        self._previous: Frame | None = None
        self._means: NDArray[np.float32] | None = None
        self._times_us: list[int] = []
        self._change: list[float] = []
        self._is_exact: list[bool] = []
        self._brightness: list[float] = []
        self._correlations: list[float] = []
        self._counts: NDArray[np.int64] = np.zeros(BINS, np.int64)
        self._lowest: NDArray[np.float32] | None = None
        self._highest: NDArray[np.float32] | None = None
        self._may_clip = True
        self.cut_times_us: list[int] = []
        """Times of the first frames of new shots, µs."""

    def add(self, frame: Frame) -> None:
        """Take one frame."""
        luma = np.asarray(matching_luma(frame), dtype=np.float32)
        means = block_means(luma)
        if self._previous is not None and self._means is not None:
            self._compare(self._previous, frame, np.abs(means - self._means))
        if len(self._times_us) % SAMPLED_EVERY == 0:
            self._correlations.append(neighbour_correlation(luma))
        bins = np.clip(means * BINS_PER_LEVEL, 0, BINS - 1).astype(np.int64)
        self._counts += np.bincount(bins.ravel(), minlength=BINS)
        self._lowest = means if self._lowest is None else np.minimum(self._lowest, means)
        self._highest = means if self._highest is None else np.maximum(self._highest, means)
        self._may_clip &= frame.transfer is Transfer.GAMMA
        self._brightness.append(float(means.mean(dtype=np.float64)))
        self._times_us.append(frame.t_us)
        self._previous, self._means = frame, means

    def _compare(self, previous: Frame, frame: Frame, change: NDArray[np.float32]) -> None:
        self._change.append(float(change.mean()))
        is_near = self._change[-1] < STILL_LEVELS
        self._is_exact.append(is_near and bool(np.array_equal(frame.pixels, previous.pixels)))
        if detect_scene_change(previous, frame) is SceneChange.CUT:
            self.cut_times_us.append(frame.t_us)

    def measurements(self) -> dict[str, float]:
        """The numbers behind the checks, by name.

        Returns:
            `frames`: how many. `fps`: frames per second, 0 of a single frame.
            `motion`: 99th percentile over blocks of their range over time, levels. `dark_end` and
            `bright_end`: 5th and 95th percentile of all blocks of all frames, in levels, to 1/16.
            Linear light has no `dark_end`: nothing clips it.
            `correlation`: of neighbouring pixels, median over frames.
            `flicker` and `flash`: upper quartile and maximum of how far a frame's mean stands out
            from both neighbours, on the same side, levels.
            `still_share`: share of pairs whose blocks change by less than 0.02 levels on average.
            `repeat_share`: share of pairs that are repeats (`find_repeats`). `pattern_period` and
            `pattern_repeats`: length of the pattern that they form, and repeats in it; 0 if none.
            `cuts`: pairs that the simulation takes for a cut.
            `jumps` and `longest_jump_s`: steps of time far beyond the usual one, and the longest.
        """
        change = np.array(self._change or [0.0])
        exact = np.array(self._is_exact or [False])
        repeats = find_repeats(change, exact)
        if find_pattern(exact)[0]:
            repeats |= exact  # 5 frames per second stored as 25: most pairs are equal
        period, repeated = find_pattern(repeats)
        jitter = _jitter(np.array(self._brightness))
        return {
            "frames": float(len(self._times_us)),
            "fps": self._fps(),
            "flicker": float(np.percentile(jitter, 75)),
            "flash": float(jitter.max()),
            **self._levels(),
            "still_share": float((change < STILL_LEVELS).mean()),
            "repeat_share": float(repeats.mean()),
            "pattern_period": float(period),
            "pattern_repeats": float(repeated),
            "cuts": float(len(self.cut_times_us)),
            **self._jumps(),
        }

    def _levels(self) -> dict[str, float]:
        if self._lowest is None or self._highest is None:
            return {"motion": 0.0, "dark_end": 0.0, "bright_end": 0.0, "correlation": 1.0}
        dark_end = percentile_of_counts(self._counts, 5) / BINS_PER_LEVEL
        return {
            "motion": float(np.percentile(self._highest - self._lowest, 99)),
            **({"dark_end": dark_end} if self._may_clip else {}),
            "bright_end": percentile_of_counts(self._counts, 95) / BINS_PER_LEVEL,
            "correlation": float(np.median(self._correlations)),
        }

    def _jumps(self) -> dict[str, float]:
        steps = np.diff(np.array(self._times_us, np.int64)).tolist()
        # The median of all steps but the one that is judged would be the same, but of two.
        usual = steps if len(steps) > 2 else sorted(steps)[:-1]
        jumps = [step for step in steps if is_jump(step, usual)]
        return {"jumps": float(len(jumps)), "longest_jump_s": max(jumps, default=0) / MICROSECONDS}

    def _fps(self) -> float:
        """Over the whole clip if its frames are regular, else by the median interval."""
        apart = np.diff(np.array(self._times_us, np.int64)).astype(np.float64)
        if len(apart) == 0:
            return 0.0
        middle = np.median(apart)
        is_regular = (np.abs(apart - middle) <= max(IRREGULAR * middle, ROUNDING_US)).all()
        return MICROSECONDS / float(apart.mean() if is_regular else middle)


def measure_video(frames: Iterable[Frame]) -> dict[str, float]:
    """The numbers behind the checks; see `VideoMeasurer.measurements`."""
    measurer = VideoMeasurer()
    for frame in frames:
        measurer.add(frame)
    return measurer.measurements()


def block_means(luma: NDArray[np.float32]) -> NDArray[np.float32]:
    """Means of square blocks, at most about `GRID` along a side; incomplete blocks are left out."""
    side = max(1, max(luma.shape) // GRID)
    side = min(side, *luma.shape)
    rows, columns = (length // side for length in luma.shape)
    # Rows first: whole rows add up faster than the cells of a row.
    strips = luma[: rows * side, : columns * side].reshape(rows, side, columns * side).sum(axis=1)
    cells: NDArray[np.float32] = strips.reshape(rows, columns, side).sum(axis=2)
    return np.asarray(cells / np.float32(side**2), dtype=np.float32)


def neighbour_correlation(luma: NDArray[np.float32]) -> float:
    """Correlation of pixels with their right and lower neighbours; 1 for a flat image."""
    centred = luma - luma.mean()
    variance = float((centred * centred).mean())
    if variance < FLAT_VARIANCE:
        return 1.0
    right = float((centred[:, 1:] * centred[:, :-1]).mean()) if luma.shape[1] > 1 else variance
    below = float((centred[1:] * centred[:-1]).mean()) if luma.shape[0] > 1 else variance
    return (right + below) / (2 * variance)


def percentile_of_counts(counts: NDArray[Any], percent: float) -> float:
    """Bin that holds a percentile of binned values.

    Args:
        counts: how many values each bin holds, [n]; not all 0.
        percent: 0..100.

    Example:
        >>> percentile_of_counts(np.array([1, 0, 3]), 50)
        2.0
    """
    return float(np.searchsorted(np.cumsum(counts), counts.sum() * percent / 100))


def _jitter(means: Float64Array) -> Float64Array:
    """Distance of each inner frame's mean from both neighbours, on the same side."""
    if len(means) < 3:
        return np.zeros(1)
    before = means[1:-1] - means[:-2]
    after = means[1:-1] - means[2:]
    return np.where(before * after > 0, np.minimum(np.abs(before), np.abs(after)), 0.0)


def find_repeats(change: Float64Array, is_exact: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pairs that repeat a frame while the clip moves.

    Args:
        change: mean absolute change of each pair, levels, [n].
        is_exact: whether its pixels are equal, [n].

    Returns:
        [n]: pairs that are equal, and runs of pairs that change by less than `REPEAT_RATIO` of the
        75th percentile of the pairs up to `AROUND` away while those just before and after the run
        change by at least `BESIDE_RATIO` of it. In a clip that rests around, by `STILL_LEVELS`,
        nothing is a repeat.
    """
    around = np.array(
        [np.percentile(change[max(0, i - AROUND) : i + AROUND + 1], 75) for i in range(len(change))]
    )
    moves = around >= STILL_LEVELS
    low = change < REPEAT_RATIO * around
    is_sudden = np.zeros(len(change), bool)
    bounds = np.flatnonzero(np.diff(np.concatenate([[False], low, [False]])))
    for first, stop in zip(bounds[::2], bounds[1::2], strict=True):
        beside = [i for i in (first - 1, stop) if 0 <= i < len(change)]
        is_sudden[first:stop] = all(change[i] >= BESIDE_RATIO * around[i] for i in beside)
    return np.asarray(moves & (is_exact | is_sudden))


def find_pattern(repeats: NDArray[np.bool_]) -> tuple[int, int]:
    """The shortest pattern in which pairs repeat.

    Args:
        repeats: of each pair, [n].

    Returns:
        Its length in pairs, 2..30, and how many of them are repeats: (5, 1) where every fifth
        frame is a repeat, 24 frames shown as 30. (0, 0) if there is no pattern that at least
        three periods show and 95 % of the pairs follow.
    """
    for period in range(2, LONGEST_PATTERN + 1):
        if len(repeats) < LEAST_PERIODS * period:
            break
        shares = np.array([repeats[phase::period].mean() for phase in range(period)])
        is_repeat = shares > 0.5
        follows = repeats == is_repeat[np.arange(len(repeats)) % period]
        firm = (
            shares[is_repeat].min(initial=1.0) >= 0.75 and shares[~is_repeat].max(initial=0) <= 0.25
        )
        if 0 < is_repeat.sum() < period and firm and follows.mean() >= PATTERN_AGREEMENT:
            return period, int(is_repeat.sum())
    return 0, 0
