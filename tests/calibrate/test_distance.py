import math

import pytest

from texvent.calibrate.search import NOTHING, measure_distance
from texvent.events import EventStream


def test_equal_streams_have_no_distance(recording):
    distance = measure_distance(recording.events, recording.events)
    assert distance.total == 0
    assert str(distance).startswith("0.000 (1-STPP 0.000")


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
