import math

import pytest

from texvent.calibrate.search import NOTHING, interval_distance, measure_distance
from texvent.events import EventStream
from texvent.sensor import SensorSize

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
