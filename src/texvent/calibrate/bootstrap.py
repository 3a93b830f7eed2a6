"""Bootstrap intervals of any estimate: how far it moves if what it was made of is drawn again."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Float64Array: TypeAlias = NDArray[np.float64]
LEVEL = 0.95
"""Share of repeated recordings whose interval holds the true value."""
RESAMPLES = 200


def bootstrap(
    estimate: Callable[..., Float64Array],
    units: tuple[int, ...],
    *,
    resamples: int = RESAMPLES,
) -> Float64Array:
    """Percentile intervals of some estimates.

    With several kinds of units, such as windows of time and groups of pixels, each kind is drawn on
    its own and the weights multiply: Owen, *The pigeonhole bootstrap*, Annals of Applied Statistics
    2007, whose intervals are rather too wide than too narrow.

    Args:
        estimate: one argument per kind of unit, how often each unit counts, [units] float64; gives
            [k] estimates, NaN where there is none.
        units: how many there are of each kind.
        resamples: how often is drawn; the draws are always the same.

    Returns:
        [2, k] lower and upper end of the 95 % intervals; NaN where most resamples gave none.
    """
    random = np.random.default_rng(0)
    drawn = [
        estimate(*(random.multinomial(n, np.full(n, 1 / n)).astype(np.float64) for n in units))
        for _ in range(resamples)
    ]
    return percentile_interval(np.array(drawn))


def percentile_interval(drawn: Float64Array) -> Float64Array:
    """The middle 95 % of every column, [2, k]; NaN where fewer than half of the values are numbers.

    Args:
        drawn: [n, k] estimates of n resamples.
    """
    tail = (1 - LEVEL) / 2
    ends = np.full((2, drawn.shape[1]), np.nan)
    for column in range(drawn.shape[1]):
        values = drawn[np.isfinite(drawn[:, column]), column]
        if values.size * 2 >= len(drawn):
            ends[:, column] = np.quantile(values, [tail, 1 - tail])
    return ends
