"""Mean and standard error of a metric over several pairs, with the undefined values counted."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from texvent.metrics.protocol import Better


class Summary(NamedTuple):
    """Summary of one metric over several pairs."""

    mean: float
    """Mean of the defined values; NaN if there is none."""
    standard_error: float
    """Standard error of that mean; NaN below two values, or where one is infinite."""
    defined: int
    """Values that entered the mean (n)."""
    undefined: int
    """Values that were NaN and did not enter the mean."""


@np.errstate(invalid="ignore")  # infinite values have no spread
def summarise(values: Iterable[float]) -> Summary:
    """Mean ± standard error over scenes or seeds; an undefined value is counted, not replaced.

    Example:
        >>> summarise([1.0, 3.0, float("nan")])
        Summary(mean=2.0, standard_error=1.0, defined=2, undefined=1)
    """
    every = np.asarray(list(values), dtype=np.float64)
    defined = every[~np.isnan(every)]
    count = int(defined.size)
    mean = float(defined.mean()) if count else math.nan
    spread = float(defined.std(ddof=1)) / math.sqrt(count) if count > 1 else math.nan
    return Summary(mean, spread, count, int(every.size) - count)


def mean_text(values: Iterable[float]) -> str:
    """Mean ± standard error over seeds; "–" without a defined value."""
    found = summarise(values)
    error = f" ± {found.standard_error:.3f}" if found.defined > 1 else ""
    return f"{found.mean:.3f}{error}" if found.defined else "–"


def normalise(value: float, *, floor: float, null: float, better: Better) -> float:
    """`S* = (d_null − d) / (d_null − d_floor)`, clipped to 0..1: 0 is the null, 1 the floor.

    Args:
        value: the metric.
        floor: its value for a second recording of the same scene.
        null: its value for the reference with its times shuffled.
        better: which values of the metric are good.

    Returns:
        NaN if a value is NaN, or if the null is no worse than the floor: then the metric cannot
        tell a recording of this scene from noise, and a ratio of the two would mean nothing.
    """
    value, floor, null = (badness(one, better) for one in (value, floor, null))
    if math.isnan(value) or not null > floor:
        return math.nan
    return min(max((null - value) / (null - floor), 0.0), 1.0)


def badness(value: float, better: Better) -> float:
    """The value turned so that more is worse."""
    if better == "one":
        return abs(math.log(value)) if value > 0 else math.inf
    return value if better == "lower" else -value
