import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from texvent.metrics.uncertainty.bootstrap import (
    LEAST_WINDOWS,
    average_blocks,
    bootstrap_interval,
    independent_block_size,
)

VALUES = arrays.arrays(np.float64, st.integers(6, 20), elements=st.floats(-5, 5, width=32))


def test_the_interval_of_equal_values_has_no_width():
    assert bootstrap_interval([0.25] * 8) == (0.25, 0.25)


def test_the_interval_of_many_values_is_that_of_the_normal_distribution():
    values = np.random.default_rng(3).normal(2.0, 1.0, 400)
    low, high = bootstrap_interval(values)
    error = values.std(ddof=1) / 20
    assert low == pytest.approx(values.mean() - 1.966 * error, abs=0.1 * error)
    assert high == pytest.approx(values.mean() + 1.966 * error, abs=0.1 * error)
    assert bootstrap_interval(values, seed=1) != (low, high)


@pytest.mark.parametrize("count", [6, 8, 16])
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


def test_too_few_windows_have_no_interval():
    few = [1.0, 2.0, 3.0, 4.0, 5.0]
    assert len(few) == LEAST_WINDOWS - 1
    assert all(map(math.isnan, bootstrap_interval([*few, math.nan])))
    assert not math.isnan(bootstrap_interval([*few, 6.0]).low)


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


def test_intervals_of_dependent_windows_hold_the_mean_only_by_blocks():
    """An autoregressive series: neighbours correlate by 0.7."""
    rng = np.random.default_rng(2)
    held = {"windows": 0, "blocks": 0}
    for seed in range(60):
        series = [0.0]
        for noise in rng.normal(size=200):
            series.append(0.7 * series[-1] + noise)
        values = np.array(series[73:])
        blocks = average_blocks(values, independent_block_size(values))
        for name, one in (("windows", values), ("blocks", blocks)):
            low, high = bootstrap_interval(one, seed=seed)
            held[name] += low <= 0 <= high
    assert held["windows"] <= 45
    assert held["blocks"] >= 51
