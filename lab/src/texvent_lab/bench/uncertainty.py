"""Confidence intervals over windows of time: of a metric's mean, and of paired differences."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

LEVEL = 0.95
"""Share of repeated experiments whose interval holds the true mean."""
RESAMPLES = 9999
LEAST_WINDOWS = 6
"""Fewer windows get no interval: five differences of one sign are chance in 1 of 16 cases."""
DEPENDENT = 1.645
"""Standard errors of a correlation above which neighbouring windows count as dependent."""

Key = TypeVar("Key", bound=Hashable)


class MeanInterval(NamedTuple):
    """Ends of a 95 % interval; NaN where there are too few windows."""

    low: float
    high: float


def average_blocks(values: ArrayLike, size: int) -> NDArray[np.float64]:
    """Means of consecutive windows.

    Args:
        values: [n], in time order; NaN where a window is undefined.
        size: windows per block; where n is no multiple, the first blocks have one more.

    Returns:
        [n // size] float64: mean of the defined windows of each block, NaN if it has none.
    """
    every = np.asarray(values, dtype=np.float64)
    if size == 1 or len(every) < size:
        return every[: len(every) // size]
    return np.array([_mean_of_defined(one) for one in np.array_split(every, len(every) // size)])


def _mean_of_defined(values: NDArray[np.float64]) -> float:
    defined = values[~np.isnan(values)]
    return float(defined.mean()) if len(defined) else math.nan


def independent_block_size(values: ArrayLike) -> int:
    """Windows to average so that neighbouring means are uncorrelated.

    The size is doubled while the correlation of neighbours is above its 5 % limit for independent
    values, 1.645 / √n, or until fewer than `LEAST_WINDOWS` blocks are left: then there are too few.

    Args:
        values: one per window, in time order; NaN is left out.

    Source: batch means, G. Fishman, "Grouping observations in digital simulation", 1978.
    """
    size = 1
    while True:
        blocks = average_blocks(values, size)
        defined = blocks[~np.isnan(blocks)]
        if len(defined) < LEAST_WINDOWS or not _is_correlated(defined):
            return size
        size *= 2


def _is_correlated(values: NDArray[np.float64]) -> bool:
    deviation = values - values.mean()
    total = float(deviation @ deviation)
    # Rounding of equal values is no correlation.
    if total <= len(values) * (1e-12 * float(np.abs(values).max())) ** 2:
        return False
    return float(deviation[:-1] @ deviation[1:]) / total > DEPENDENT / math.sqrt(len(values))


def bootstrap_interval(values: ArrayLike, *, comparisons: int = 1, seed: int = 0) -> MeanInterval:
    """95 % interval of the mean of independent windows.

    Args:
        values: one per window; NaN is left out.
        comparisons: number of intervals that are to hold together (Bonferroni's correction).
        seed: of the resampling: the same values and seed give the same interval.

    Returns:
        The interval; NaN below `LEAST_WINDOWS` defined values.

    Source: the expanded percentile interval, T. Hesterberg, "What teachers should know about the
        bootstrap", The American Statistician 2015, section 4.3. The plain percentile interval of 8
        windows holds the true mean in 89 % of experiments, this one in 94 %.
    """
    every = np.asarray(values, dtype=np.float64)
    defined = every[~np.isnan(every)]
    count = len(defined)
    if count < LEAST_WINDOWS:
        return MeanInterval(math.nan, math.nan)
    drawn = np.random.default_rng(seed).integers(0, count, (RESAMPLES, count))
    quantile = _t_quantile(count - 1, 1 - (1 - LEVEL) / (2 * comparisons))
    tail = NormalDist().cdf(-math.sqrt(count / (count - 1)) * quantile)
    low, high = np.quantile(defined[drawn].mean(axis=1), [tail, 1 - tail])
    return MeanInterval(float(low), float(high))


def _t_quantile(freedom: int, share: float) -> float:
    """Quantile of Student's t; at .975 to 4 digits above 4 degrees of freedom.

    Source: Abramowitz and Stegun, 26.7.5.
    """
    z = NormalDist().inv_cdf(share)
    terms = (
        (z**3 + z) / 4,
        (5 * z**5 + 16 * z**3 + 3 * z) / 96,
        (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384,
        (79 * z**9 + 776 * z**7 + 1482 * z**5 - 1920 * z**3 - 945 * z) / 92160,
    )
    return float(z + sum(term / freedom**power for power, term in enumerate(terms, start=1)))


@dataclass(frozen=True)
class Mean:
    """A mean over windows, of values or of paired differences, with its interval."""

    mean: float
    """NaN without a defined window."""
    interval: MeanInterval
    """95 %; NaN where there are too few windows."""
    windows: int
    """Independent means: windows, or blocks of them."""
    block: int = 1
    """Windows in each."""

    @classmethod
    def of(cls, values: ArrayLike, *, is_in_sequence: bool, comparisons: int = 1) -> Mean:
        """Mean of one value per window.

        Args:
            values: [n]; NaN is left out.
            is_in_sequence: the windows follow each other in time: correlated neighbours are
                averaged (`independent_block_size`). False: seeds, scenes or recordings.
            comparisons: as in `bootstrap_interval`.
        """
        every = np.asarray(values, dtype=np.float64)
        size = independent_block_size(every) if is_in_sequence else 1
        blocks = average_blocks(every, size)
        interval = bootstrap_interval(blocks, comparisons=comparisons)
        return cls(_mean_of_defined(every), interval, int((~np.isnan(blocks)).sum()), size)

    @property
    def is_enough(self) -> bool:
        """Whether there are enough windows for an interval."""
        return self.windows >= LEAST_WINDOWS

    @property
    def is_significant(self) -> bool:
        """Whether the interval excludes 0."""
        return self.interval.low > 0 or self.interval.high < 0

    def reversed(self) -> Mean:
        """The same with the opposite sign."""
        low, high = self.interval
        return Mean(-self.mean, MeanInterval(-high, -low), self.windows, self.block)

    def document(self) -> dict[str, Any]:
        """Plain values, NaN where undefined."""
        low, high = self.interval
        counts = {"windows": self.windows, "windows_per_block": self.block}
        return {"mean": self.mean, "low": low, "high": high, **counts}


def paired_differences(
    columns: Mapping[Key, ArrayLike], *, is_in_sequence: bool
) -> dict[Key, Mean]:
    """Means of paired differences whose intervals hold together.

    Args:
        columns: key → [n] differences, one per window; NaN where one candidate is undefined.
        is_in_sequence: as in `Mean.of`.
    """
    return {
        key: Mean.of(one, is_in_sequence=is_in_sequence, comparisons=len(columns))
        for key, one in columns.items()
    }
