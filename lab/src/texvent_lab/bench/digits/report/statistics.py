"""How sure a difference between two classifiers is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import NormalDist
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent_lab.bench.digits.data.idx import CLASSES

SIGNIFICANCE = 0.05
"""Classifiers differ where p is not above it."""


class McNemar(NamedTuple):
    """Two classifiers on the same recordings."""

    only_first: int
    """Recordings that the first alone recognises."""
    only_second: int
    """Recordings that the second alone recognises."""
    p: float
    """Two-sided: how often as unequal a pair would come up if both were equally good."""


def compare_classifiers(first: NDArray[np.bool_], second: NDArray[np.bool_]) -> McNemar:
    """McNemar's exact test.

    Args:
        first: [n] whether each recording is recognised.
        second: [n], as `first`.

    Source: Q. McNemar, Psychometrika 1947; exact, from the binomial distribution.

    Example:
        >>> compare_classifiers(np.array([True] * 6), np.array([True] + [False] * 5))
        McNemar(only_first=5, only_second=0, p=0.0625)
    """
    only_first, only_second = int((first & ~second).sum()), int((second & ~first).sum())
    count, fewer = only_first + only_second, min(only_first, only_second)
    tail = sum(math.comb(count, number) for number in range(fewer + 1))
    return McNemar(only_first, only_second, min(1.0, 2 * tail / 2**count))


def difference_interval(only_first: int, only_second: int, count: int) -> tuple[float, float]:
    """95 % interval of the difference of two accuracies on the same recordings.

    Args:
        only_first: recordings that the first classifier alone recognises.
        only_second: recordings that the second alone recognises.
        count: all recordings.

    Returns:
        Lower and upper end, first minus second.

    Source: A. Agresti and Y. Min, "Simple improved confidence intervals for comparing matched
        proportions", 2005: Wald's interval with half a recording added to each of the four cells.
    """
    first, second, total = only_first + 0.5, only_second + 0.5, count + 2
    difference = (first - second) / total
    error = math.sqrt(first + second - (first - second) ** 2 / total) / total
    reach = NormalDist().inv_cdf(0.975) * error
    return difference - reach, difference + reach


def holm(p_values: Sequence[float]) -> list[float]:
    """p-values of several tests, adjusted so that all together err in at most their share of cases.

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


def vote(predictions: Sequence[NDArray[np.int64]]) -> NDArray[np.int64]:
    """The class that most networks name, of equals the smallest; [n]."""
    names = np.stack(predictions)
    votes = (names[:, :, None] == np.arange(CLASSES)).sum(axis=0)
    return np.asarray(votes.argmax(axis=1), np.int64)
