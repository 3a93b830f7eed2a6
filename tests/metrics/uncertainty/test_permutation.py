import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from texvent.metrics.uncertainty.permutation import MOST_EXACT, holm, sign_flip_p_values

COLUMNS = arrays.arrays(
    np.float64,
    st.tuples(st.integers(1, 7), st.integers(1, 4)),
    elements=st.integers(-4, 4).map(float),
)


def p_value_by_definition(differences):
    """The share of all sign flips whose mean is as far from 0."""
    found = abs(sum(differences))
    flipped = itertools.product(*([one, -one] for one in differences))
    sums = [abs(sum(one)) for one in flipped]
    return sum(one >= found - 1e-9 for one in sums) / len(sums)


@pytest.mark.parametrize(
    ("differences", "expected"),
    [
        # Of 16 flips, only none and all reach the sum of 10.
        ([1, 2, 3, 4], 2 / 16),
        # Sum 8: none, all, and the two that undo the flip of the 1.
        ([-1, 2, 3, 4], 4 / 16),
        # Sum 0: every flip reaches it.
        ([1, -1, 2, -2], 1.0),
        ([1] * 8, 2 / 256),
    ],
)
def test_exact_p_values_are_those_counted_by_hand(differences, expected):
    p_values = sign_flip_p_values(np.array(differences, float)[:, None])
    assert p_values.tolist() == [expected]


@given(COLUMNS)
def test_one_comparison_alone_has_the_plain_p_value(columns):
    for column in columns.T:
        alone = sign_flip_p_values(column[:, None])[0]
        assert alone == p_value_by_definition(column.tolist())


@given(COLUMNS)
def test_p_values_of_a_table_are_no_smaller_and_signs_and_scales_do_not_matter(columns):
    p_values = sign_flip_p_values(columns)
    alone = [p_value_by_definition(column.tolist()) for column in columns.T]
    assert (p_values >= np.array(alone) - 1e-12).all()
    assert np.array_equal(sign_flip_p_values(-3 * columns), p_values)
    assert np.array_equal(sign_flip_p_values(columns[:, ::-1])[::-1], p_values)


def test_the_largest_of_a_table_of_equals_is_rarely_told_apart():
    rng = np.random.default_rng(4)
    tables = [rng.normal(size=(8, 20)) for _ in range(200)]
    wrong = sum(sign_flip_p_values(table).min() <= 0.05 for table in tables)
    assert wrong <= 20
    alone = sum(
        min(sign_flip_p_values(one[:, None])[0] for one in table.T) <= 0.05 for table in tables[:20]
    )
    assert alone >= 8


def test_many_candidates_are_told_apart_with_eight_pairs():
    rng = np.random.default_rng(4)
    assert sign_flip_p_values(5 + rng.normal(size=(8, 30))).max() <= 0.05


def test_undefined_pairs_say_nothing():
    some = [[1.0], [2.0], [math.nan], [3.0], [4.0]]
    assert sign_flip_p_values(some).tolist() == [2 / 16]
    assert sign_flip_p_values(np.full((6, 2), math.nan)).tolist() == [1.0, 1.0]


def test_many_pairs_are_flipped_at_random_but_reproducibly():
    values = np.random.default_rng(0).normal(0.4, 1.0, (MOST_EXACT + 1, 1))
    drawn = sign_flip_p_values(values)[0]
    assert drawn == sign_flip_p_values(values)[0]
    assert drawn != sign_flip_p_values(values, seed=1)[0]
    assert drawn == pytest.approx(p_value_by_definition(values[:, 0].tolist()), abs=0.02)


def test_holm_multiplies_the_smallest_by_all_and_keeps_the_order():
    assert holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])
    assert holm([0.5, 0.9]) == [1.0, 1.0]
    assert holm([]) == []
