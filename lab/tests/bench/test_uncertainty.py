import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from texvent_lab.bench.uncertainty import (
    LEAST_WINDOWS,
    Mean,
    average_blocks,
    bootstrap_interval,
    independent_block_size,
    paired_differences,
)

VALUES = arrays.arrays(np.float64, st.integers(6, 20), elements=st.floats(-5, 5, width=32))


@pytest.mark.parametrize("count", [6, 16])
def test_95_of_100_intervals_hold_the_true_mean_of_few_normal_values(count):
    rng = np.random.default_rng(5)
    intervals = [bootstrap_interval(rng.normal(1.0, 2.0, count), seed=seed) for seed in range(300)]
    held = np.mean([low <= 1.0 <= high for low, high in intervals])
    # Three standard errors of 300 experiments are 0.038.
    assert 0.91 <= held <= 0.985


@given(VALUES, st.floats(-3, 3))
def test_the_interval_moves_with_the_values_and_holds_their_mean(values, shift):
    low, high = bootstrap_interval(values)
    assert low - 1e-9 <= values.mean() <= high + 1e-9
    assert bootstrap_interval(values) == (low, high)
    assert bootstrap_interval(values + shift) == pytest.approx((low + shift, high + shift))
    assert bootstrap_interval(-values) == pytest.approx((-high, -low))


def test_blocks_are_means_of_the_windows_that_are_defined():
    blocks = average_blocks([1.0, 3.0, math.nan, 5.0, 7.0, math.nan, math.nan], 2)
    # Seven windows make three blocks, the first of three.
    assert blocks[:2].tolist() == [2.0, 6.0]
    assert math.isnan(blocks[2])
    assert len(blocks) == 3
    assert average_blocks([1.0, math.nan], 1)[0] == 1.0
    assert len(average_blocks([1.0, 2.0, 3.0], 4)) == 0


def test_windows_that_follow_each_other_are_averaged_and_others_are_not():
    rng = np.random.default_rng(1)
    assert independent_block_size(rng.normal(size=64)) == 1
    assert independent_block_size([0.1] * 64) == 1
    # Each value four times: neighbours are equal until four make one block.
    assert independent_block_size(np.repeat(rng.normal(size=32), 4)) == 4
    # A drift never ends: the blocks run out.
    assert 16 // independent_block_size(np.arange(16.0)) < LEAST_WINDOWS


@given(VALUES, st.lists(st.booleans(), min_size=20, max_size=20), st.booleans())
def test_a_mean_is_that_of_all_defined_values_whatever_the_blocks(values, gaps, is_in_sequence):
    values = np.where(gaps[: len(values)], math.nan, np.cumsum(values))
    if np.isnan(values).all():
        return
    mean = Mean.of(values, is_in_sequence=is_in_sequence)
    assert mean.mean == pytest.approx(np.nanmean(values), abs=1e-9)
    back = mean.reversed()
    assert (back.windows, back.block, back.mean) == (mean.windows, mean.block, -mean.mean)
    if mean.is_enough:
        assert back.interval == (-mean.interval.high, -mean.interval.low)
        assert not math.isnan(mean.interval.low)


PAIRS = arrays.arrays(
    np.float64, st.tuples(st.just(2), st.integers(6, 10)), elements=st.floats(0, 1, width=16)
)


def difference(first, second, **options):
    column = np.subtract(first, second)
    return paired_differences({"it": column}, **{"is_in_sequence": False, **options})["it"]


def test_identical_candidates_do_not_differ():
    found = difference([0.5, 0.6, 0.7, 0.5, 0.4, 0.6], [0.5, 0.6, 0.7, 0.5, 0.4, 0.6])
    assert (found.mean, found.interval) == (0.0, (0.0, 0.0))
    assert not found.is_significant


def test_a_constant_advantage_over_eight_windows_is_significant():
    found = difference([0.75] * 8, [0.5] * 8)
    assert (found.mean, found.interval) == (0.25, (0.25, 0.25))
    assert found.is_significant


@given(PAIRS)
def test_the_order_of_candidates_only_flips_signs(pair):
    found, other = difference(*pair), difference(*pair[::-1])
    assert other.mean == pytest.approx(-found.mean)
    assert other.interval == pytest.approx(found.reversed().interval)
    assert found.is_significant == other.is_significant


def test_more_comparisons_widen_the_interval_and_equals_rarely_differ():
    rng = np.random.default_rng(4)
    tables = rng.normal(size=(60, 12, 16))
    alone = wrong = 0
    for table in tables:
        columns = dict(enumerate(table))
        found = paired_differences(columns, is_in_sequence=False)
        wrong += any(one.is_significant for one in found.values())
        single = bootstrap_interval(table[0])
        alone += single.low > 0 or single.high < 0
        assert found[0].interval.low <= single.low <= single.high <= found[0].interval.high
    assert alone <= 8
    assert wrong <= 8


def test_windows_that_drift_count_by_blocks_of_which_too_few_are_left():
    drift = np.arange(16.0)
    assert difference(drift, 0 * drift).is_significant
    found = difference(drift, 0 * drift, is_in_sequence=True)
    assert (found.windows, found.block, found.is_significant) == (4, 4, False)
    assert not found.is_enough


def test_undefined_windows_are_left_out():
    found = difference([1.0, math.nan, 3, 4, 5, 6, 7], [0.0] * 7)
    assert (found.mean, found.windows) == (26 / 6, 6)
    nothing = difference([math.nan] * 7, [0.0] * 7)
    assert math.isnan(nothing.mean)
    assert not nothing.is_enough
