"""Tests of paired differences by flipped signs, and p-values of many tests at once."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

MOST_EXACT = 12
"""Up to so many pairs all sign flips are tried; above, some are drawn."""
DRAWN_FLIPS = 9999
ROUNDING = 1e-9
"""Statistics that differ by less, relative to 1, are equal."""


def sign_flip_p_values(differences: ArrayLike, *, seed: int = 0) -> NDArray[np.float64]:
    """Two-sided p-values of paired differences, adjusted for all comparisons of a table.

    If two candidates are equally good, each of their differences is as likely with the opposite
    sign. p is how often flipped signs give a mean as far from 0. All comparisons are flipped
    together and the largest statistic counts, so that p holds for the table as a whole; unlike
    Holm's, this correction can tell many candidates apart with few pairs.

    Args:
        differences: [n, m] n pairs (windows, seeds or scenes that are independent of each other),
            the same for all m comparisons. NaN, where one candidate is undefined, says nothing.
        seed: of the drawn flips, above `MOST_EXACT` pairs.

    Returns:
        [m] float64. For one comparison (m = 1) p is that of the plain sign-flip test.

    Source: step-down maximum of P. Westfall and S. Young, "Resampling-based multiple testing",
        1993, algorithm 4.1; the statistic is |Σ d| / √Σ d², which orders flips as Student's t does.

    Example:
        >>> sign_flip_p_values([[1.0], [2.0], [3.0], [4.0]])
        array([0.125])
    """
    pairs = np.nan_to_num(np.asarray(differences, dtype=np.float64), nan=0.0)
    length = np.sqrt((pairs**2).sum(axis=0))
    unit = np.divide(pairs, length, out=np.zeros_like(pairs), where=length > 0)
    flipped = np.abs(_sign_flips(len(pairs), seed) @ unit)
    found = flipped[0]  # no sign flipped
    order = np.argsort(-found, kind="stable")
    largest = np.maximum.accumulate(flipped[:, order[::-1]], axis=1)[:, ::-1]
    share = (largest >= found[order] - ROUNDING).mean(axis=0)
    p_values = np.empty(len(order))
    p_values[order] = np.maximum.accumulate(share)
    return p_values


def _sign_flips(count: int, seed: int) -> NDArray[np.float64]:
    """Rows of signs for `count` pairs, the first without a flip: all, or many drawn ones."""
    if count <= MOST_EXACT:
        signs = list(itertools.product([1.0, -1.0], repeat=count))
        return np.array(signs).reshape(2**count, count)
    drawn = np.random.default_rng(seed).choice([1.0, -1.0], (DRAWN_FLIPS, count))
    return np.vstack([np.ones(count), drawn])


def holm(p_values: Sequence[float]) -> list[float]:
    """p-values of many tests, adjusted so that all together err in at most their share of cases.

    Args:
        p_values: of tests that need not be independent.

    Source: S. Holm, "A simple sequentially rejective multiple test procedure", 1979.

    Example:
        >>> holm([0.01, 0.04, 0.03])
        [0.03, 0.06, 0.06]
    """
    order = sorted(range(len(p_values)), key=p_values.__getitem__)
    adjusted = [0.0] * len(p_values)
    largest = 0.0
    for rank, index in enumerate(order):
        largest = max(largest, min(1.0, p_values[index] * (len(p_values) - rank)))
        adjusted[index] = largest
    return adjusted
