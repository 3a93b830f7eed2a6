"""Bootstrap interval of the mean of windows, for few windows too."""

from __future__ import annotations

import math
from statistics import NormalDist
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

LEVEL = 0.95
"""Share of repeated experiments whose interval holds the true mean."""
RESAMPLES = 9999
LEAST_WINDOWS = 6
"""With fewer no difference can be told: the smallest p of a sign-flip test of 5 pairs is 1/16."""

DEPENDENT = 1.645
"""Standard errors of a correlation above which neighbours follow each other."""


class Interval(NamedTuple):
    """Ends of a 95 % interval; NaN where there are too few windows."""

    low: float
    high: float


NO_INTERVAL = Interval(math.nan, math.nan)


def average_blocks(values: ArrayLike, size: int) -> NDArray[np.float64]:
    """Means of consecutive windows, so that what follows may take them as independent.

    Windows next to each other are alike, and resampled one by one they would promise too much.

    Args:
        values: [n], in time order; NaN where a window is undefined.
        size: windows per block; where n is no multiple, the first blocks have one more.

    Returns:
        [n // size] float64: mean of the defined windows of each block, NaN if it has none.
    """
    every = np.asarray(values, dtype=np.float64)
    if size == 1 or len(every) < size:
        return every[: len(every) // size]
    blocks = np.array_split(every, len(every) // size)
    return np.array([_mean_of_defined(block) for block in blocks])


def _mean_of_defined(values: NDArray[np.float64]) -> float:
    defined = values[~np.isnan(values)]
    return float(defined.mean()) if len(defined) else math.nan


def independent_block_size(values: ArrayLike) -> int:
    """Windows to average so that neighbouring means no longer follow each other.

    The size is doubled while the correlation of neighbours is above its 5 % limit for independent
    values, 1.645 / √n, or until fewer than `LEAST_WINDOWS` blocks are left: then there are too few.

    Args:
        values: one per window, in time order; NaN is left out.

    Source: batch means, G. Fishman, "Grouping observations in digital simulation", 1978.
    """
    every = np.asarray(values, dtype=np.float64)
    size = 1
    while True:
        blocks = average_blocks(every, size)
        defined = blocks[~np.isnan(blocks)]
        if len(defined) < LEAST_WINDOWS or not _follow_each_other(defined):
            return size
        size *= 2


def _follow_each_other(values: NDArray[np.float64]) -> bool:
    deviation = values - values.mean()
    total = float(deviation @ deviation)
    # Rounding of equal values is no correlation.
    if total <= len(values) * (1e-12 * float(np.abs(values).max())) ** 2:
        return False
    return float(deviation[:-1] @ deviation[1:]) / total > DEPENDENT / math.sqrt(len(values))


def bootstrap_interval(values: ArrayLike, *, seed: int = 0) -> Interval:
    """95 % interval of the mean of windows that are independent of each other.

    Args:
        values: one per window; NaN is left out.
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
        return NO_INTERVAL
    drawn = np.random.default_rng(seed).integers(0, count, (RESAMPLES, count))
    tail = NormalDist().cdf(-math.sqrt(count / (count - 1)) * _t_quantile(count - 1))
    low, high = np.quantile(defined[drawn].mean(axis=1), [tail, 1 - tail])
    return Interval(float(low), float(high))


def _t_quantile(freedom: int) -> float:
    """The quantile of Student's t at the upper end of a 95 % interval, to 4 digits above 4 degrees.

    Source: Abramowitz and Stegun, 26.7.5.
    """
    z = NormalDist().inv_cdf((1 + LEVEL) / 2)
    terms = (
        (z**3 + z) / 4,
        (5 * z**5 + 16 * z**3 + 3 * z) / 96,
        (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384,
        (79 * z**9 + 776 * z**7 + 1482 * z**5 - 1920 * z**3 - 945 * z) / 92160,
    )
    return float(z + sum(term / freedom**power for power, term in enumerate(terms, start=1)))
