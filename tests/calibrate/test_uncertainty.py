"""Intervals around fitted options, and distances between recordings."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.calibrate.estimates import bootstrap, percentile_interval
from texvent.calibrate.recording import TimeSpan
from texvent.calibrate.search import NOTHING, interval_distance, measure_distance
from texvent.calibrate.uncertainty import FARTHEST, cut_blocks, vertex, widen
from texvent.events import EventStream
from texvent.sensor import SensorSize


@given(place=st.floats(-1.0, 1.0), height=st.floats(0, 10), bend=st.floats(0.01, 100))
def test_the_vertex_of_any_parabola_is_found(place, height, bend):
    x = np.log([0.5, 1.0, 2.0])
    assert vertex(height + bend * (x - place) ** 2) == pytest.approx(place, abs=1e-6)


def test_without_a_minimum_the_vertex_is_far_away():
    assert vertex(np.array([3.0, 2.0, 1.0])) == FARTHEST
    assert vertex(np.array([1.0, 2.0, 1.5])) == -FARTHEST


def test_ends_are_widened_by_what_other_options_may_shift():
    own, others = np.array([[-0.3, -0.5], [0.6, 0.5]]), np.array([[0.16, 0.0], [0.64, 0.0]])
    np.testing.assert_allclose(widen(own, others), [[-0.5, -0.5], [1.0, 0.5]])


@given(start=st.integers(0, 10**15), length=st.integers(1, 10**7))
def test_blocks_cover_their_span(start, length):
    blocks = cut_blocks(TimeSpan(start, start + length))
    assert 1 <= len(blocks) <= 20
    assert blocks[0].start_us == start
    assert blocks[-1].stop_us == start + length
    assert all(a.stop_us == b.start_us for a, b in itertools.pairwise(blocks))
    assert len(blocks) == 1 or min(b.stop_us - b.start_us for b in blocks) >= 10_000


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


SMALL = SensorSize(13, 12)
ONE_EVENT = EventStream([0], [0], [1000], [1], SMALL)


def test_counts_are_compared_by_polarity(recording):
    events = recording.events
    thinned = events[(events.p == 1) | (events.t % 2 == 0)]
    distance = measure_distance(thinned, events)
    assert distance.log_on == 0
    assert distance.log_off == pytest.approx(math.log(0.5), abs=0.05)
    assert distance.total > abs(distance.log_off)


def test_no_event_is_worse_than_anything_and_finite(recording):
    distance = measure_distance(EventStream.empty(recording.events.size), recording.events)
    assert distance.intervals == NOTHING
    assert distance.overlap == 1
    assert NOTHING < distance.total < math.inf


def test_interval_distance_of_intervals_ten_times_longer_is_one_decade():
    slow_pixel = EventStream([0] * 3, [0] * 3, [0, 1000, 2000], [1] * 3, SMALL)
    fast_pixel = EventStream([0] * 3, [0] * 3, [0, 100, 200], [1] * 3, SMALL)
    assert interval_distance(slow_pixel, fast_pixel) == pytest.approx(1.0)


def test_interval_distance_without_any_interval_is_undefined():
    assert math.isnan(interval_distance(ONE_EVENT, ONE_EVENT))
    # Intervals of 0 µs count as 1 µs.
    same = EventStream([0] * 2, [0] * 2, [0, 0], [1] * 2, SMALL)
    ten_us = EventStream([0] * 2, [0] * 2, [0, 10], [1] * 2, SMALL)
    assert interval_distance(same, ten_us) == pytest.approx(1.0)
