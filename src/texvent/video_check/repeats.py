"""Frames that repeat the one before: a frozen clip, and rates that a file only pretends to have."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array
from texvent.video_check.blocks import SeenFrame

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


class Repeats:
    """Takes how much each frame differs from the one before: two numbers per pair."""

    def __init__(self) -> None:
        self._previous: SeenFrame | None = None
        self._change: list[float] = []
        self._exact: list[bool] = []

    def add(self, seen: SeenFrame) -> None:
        """Take one frame."""
        if self._previous is not None:
            self._change.append(float(np.abs(seen.means - self._previous.means).mean()))
            is_near = self._change[-1] < STILL_LEVELS
            pixels = seen.frame.pixels
            self._exact.append(
                is_near and bool(np.array_equal(pixels, self._previous.frame.pixels))
            )
        self._previous = seen

    def measures(self) -> dict[str, float]:
        """By name.

        Returns:
            `still_share`: share of pairs whose blocks change by less than 0.02 levels on average.
            `exact_share`: share of pairs whose pixels are equal. `repeat_share`: share of pairs
            that are repeats, exact or not (`find_repeats`). `pattern_period` and
            `pattern_repeats`: length of the pattern that they form, and repeats in it; 0 if none.
        """
        change = np.array(self._change or [0.0])
        exact = np.array(self._exact or [False])
        repeats = find_repeats(change, exact)
        if find_pattern(exact)[0]:
            repeats |= exact  # 5 frames per second stored as 25: most pairs are equal
        period, repeated = find_pattern(repeats)
        return {
            "still_share": float((change < STILL_LEVELS).mean()),
            "exact_share": float(np.mean(self._exact)) if self._exact else 0.0,
            "repeat_share": float(repeats.mean()),
            "pattern_period": float(period),
            "pattern_repeats": float(repeated),
        }


def find_repeats(change: Float64Array, is_exact: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pairs that repeat a frame while the clip moves.

    Args:
        change: mean absolute change of each pair, levels, [n].
        is_exact: whether its pixels are equal, [n].

    Returns:
        [n]: pairs that are equal, and runs of pairs that change by less than `REPEAT_RATIO` of the
        75th percentile of the pairs up to `AROUND` away while those just before and after the run
        change by at least `BESIDE_RATIO` of it. In a clip that stands still around, by
        `STILL_LEVELS`, nothing is a repeat.
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
