import numpy as np
import pytest

from texvent.calibrate.bootstrap import bootstrap, percentile_interval


def mean_of(values):
    return lambda weights: np.array([weights @ values / weights.sum()])


def test_the_interval_of_a_mean_is_two_standard_errors_wide():
    values = np.random.default_rng(0).normal(5, 2, 400)
    low, high = bootstrap(mean_of(values), (400,), resamples=2000)[:, 0]
    assert low < values.mean() < high
    assert high - low == pytest.approx(2 * 1.96 * 2 / np.sqrt(400), rel=0.15)


def test_two_kinds_of_units_are_drawn_apart():
    # Only windows differ, so drawing pixels changes nothing and drawing windows everything.
    table = np.repeat(np.array([0.0, 10.0] * 5)[:, None], 7, axis=1)

    def estimate(windows, groups):
        return np.array([windows @ table @ groups / 70, windows.sum(), groups.sum()])

    low, high = bootstrap(estimate, (10, 7))
    assert low[0] < 4 < 6 < high[0]
    assert (low[1:], high[1:]) == (pytest.approx([10, 7]), pytest.approx([10, 7]))


def test_percentiles_by_hand_and_what_is_no_number():
    drawn = np.stack([np.arange(201.0), np.full(201, np.nan)], axis=1)
    drawn[:40, 1] = 1.0
    ends = percentile_interval(drawn)
    assert ends[:, 0] == pytest.approx([5.0, 195.0])
    assert np.isnan(ends[:, 1]).all()
