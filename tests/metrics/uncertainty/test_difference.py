import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from texvent.metrics.uncertainty.bootstrap import Interval
from texvent.metrics.uncertainty.difference import (
    Difference,
    Mean,
    PairedDifferences,
    differences_from,
    tell,
)

PAIRS = arrays.arrays(
    np.float64, st.tuples(st.just(2), st.integers(6, 10)), elements=st.floats(0, 1, width=16)
)


def difference(first, second, **changes):
    one = np.subtract(first, second)
    return PairedDifferences({"it": one}, **{"is_in_sequence": False, **changes})["it"]


def test_identical_candidates_cannot_be_told_apart():
    found = difference([0.5, 0.6, 0.7, 0.5, 0.4, 0.6], [0.5, 0.6, 0.7, 0.5, 0.4, 0.6])
    assert (found.mean, found.interval, found.p) == (0.0, (0.0, 0.0), 1.0)
    assert tell("A", "B", found) == (
        "A and B cannot be told apart (difference 0.000, 95 % interval 0.000 to 0.000, p = 1, "
        "6 windows)"
    )


def test_a_constant_advantage_over_eight_windows_is_told():
    found = difference([0.75] * 8, [0.5] * 8)
    assert (found.mean, found.interval, found.p) == (0.25, (0.25, 0.25), 2 / 256)
    text = "is closer than {} by 0.250 ms (95 % interval 0.250 to 0.250, 8 windows)"
    assert tell("A", "B", found, better="higher", unit="ms") == f"A {text.format('B')}"
    assert tell("A", "B", found, better="lower", unit="ms") == f"B {text.format('A')}"


@given(PAIRS, st.floats(-2, 2, width=16))
def test_the_order_of_candidates_only_flips_signs_and_a_constant_shifts(pair, shift):
    first, second = pair
    found, other = difference(first, second), difference(second, first)
    assert (other.mean, other.p) == pytest.approx((-found.mean, found.p))
    assert other.interval == pytest.approx(found.reversed().interval)
    assert found.is_told == other.is_told
    moved = difference(first + shift, second)
    assert moved.mean == pytest.approx(found.mean + shift)
    assert moved.interval == pytest.approx([end + shift for end in found.interval])
    if found.is_told:
        assert tell("A", "B", found) == tell("B", "A", other)


def test_too_few_windows_tell_nothing():
    found = difference([0.9, 0.8], [0.1, 0.1])
    assert not found.is_told
    assert math.isnan(found.p)
    assert tell("A", "B", found) == "A and B: too few windows to tell (n = 2; 6 are needed)"


def test_windows_that_drift_count_by_blocks_of_which_too_few_are_left():
    drift = np.arange(16.0)
    assert difference(drift, 0 * drift).is_told
    found = difference(drift, 0 * drift, is_in_sequence=True)
    assert (found.windows, found.block, found.is_told) == (4, 4, False)
    assert "too few independent windows to tell (n = 4;" in tell("A", "B", found)


def test_windows_that_are_alike_in_pairs_count_by_pairs():
    values = np.repeat([0.2, 0.5, 0.6, 0.3, 0.2, 0.3, 0.6, 0.5], 2)
    found = difference(values, 0 * values, is_in_sequence=True)
    assert (found.windows, found.block) == (8, 2)
    assert found.p == 2 / 256  # of the eight blocks; the sixteen windows alone give 2e-4
    assert tell("A", "B", found).endswith(", 8 blocks of 2 windows)")


def test_undefined_windows_count_for_no_one():
    found = difference([1.0, math.nan, 3, 4, 5, 6, 7], [0.0] * 7)
    assert (found.mean, found.windows) == (26 / 6, 6)
    nothing = difference([math.nan] * 7, [0.0] * 7)
    assert math.isnan(nothing.mean)
    assert not nothing.is_enough


def test_all_candidates_are_compared_with_one_and_adjusted_together():
    rng = np.random.default_rng(0)
    values = {f"{number}": rng.normal(0, 1, 8) for number in range(20)}
    found = differences_from("0", values, is_in_sequence=False)
    assert found["1"].mean == pytest.approx(np.mean(values["1"] - values["0"]))
    alone = differences_from("0", {name: values[name] for name in "01"}, is_in_sequence=False)
    assert found["1"].p >= alone["1"].p


def test_numbers_have_the_digits_that_count():
    small = Difference(0.00042, Interval(0.00031, 0.00052), 8, p=0.01)
    assert "by 0.00042 (95 % interval 0.00031 to 0.00052" in tell("A", "B", small, better="higher")
    large = Difference(-12.5, Interval(-20.25, -4.75), 8, p=0.01)
    assert "by 12.500 (95 % interval 4.750 to 20.250" in tell("A", "B", large)


def test_a_mean_has_an_interval_of_its_own():
    mean = Mean.of([1.0, 2.0] * 8, is_in_sequence=True)
    assert mean.mean == 1.5
    assert mean.interval.low < 1.5 < mean.interval.high
    assert set(mean.document()) == {"mean", "low", "high", "windows", "windows_per_block"}
