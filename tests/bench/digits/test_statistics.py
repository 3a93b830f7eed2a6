"""McNemar's test against values by hand, votes."""

import numpy as np
import pytest

from texvent.bench.digits.report.statistics import compare_classifiers, vote


def pair(both, first, second, neither):
    a = [True] * both + [True] * first + [False] * second + [False] * neither
    b = [True] * both + [False] * first + [True] * second + [False] * neither
    return np.array(a), np.array(b)


@pytest.mark.parametrize(
    ("first", "second", "p"),
    [
        (0, 0, 1.0),
        (1, 1, 1.0),
        (5, 0, 2 / 32),
        (0, 5, 2 / 32),
        (8, 1, 2 * (1 + 9) / 512),
        (10, 4, 2 * (1 + 14 + 91 + 364 + 1001) / 2**14),
    ],
)
def test_mcnemar_agrees_with_binomial_sums_by_hand(first, second, p):
    found = compare_classifiers(*pair(100, first, second, 7))
    assert (found.only_first, found.only_second) == (first, second)
    assert found.p == pytest.approx(p)


def test_the_vote_takes_the_class_named_most_and_of_equals_the_smallest():
    names = [np.array([1, 5, 9]), np.array([2, 5, 3]), np.array([2, 0, 9])]
    assert vote(names).tolist() == [2, 5, 9]
    assert vote([np.array([7]), np.array([4])]).tolist() == [4]
