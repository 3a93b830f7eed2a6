import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.represent.slices import slices

from .definitions import SMALL, streams


def stream(*times):
    return EventStream([0] * len(times), [0] * len(times), times, [1] * len(times), SMALL)


def times(parts):
    return [part.t.tolist() for part in parts]


def test_slices_of_time_are_half_open_and_may_be_empty():
    assert times(slices(stream(0, 9, 10, 35), duration_us=10)) == [[0, 9], [10], [], [35]]


def test_slices_of_time_overlap_and_start_where_they_are_told():
    parts = slices(stream(10, 14, 18), duration_us=8, overlap=4, start_us=8)
    assert times(parts) == [[10, 14], [14, 18]]
    assert times(slices(stream(5, 15), duration_us=10, start_us=0)) == [[5], [15]]


def test_a_partial_slice_can_be_left_out():
    assert times(slices(stream(0, 9, 12), duration_us=10, keep_partial=False)) == [[0, 9]]
    assert times(slices(stream(0, 9), duration_us=10, keep_partial=False)) == [[0, 9]]
    assert times(slices(stream(1, 2, 3), count=2, keep_partial=False)) == [[1, 2]]
    assert times(slices(stream(1, 2, 3), count=2)) == [[1, 2], [3]]


def test_slices_of_a_number_of_events_overlap():
    assert times(slices(stream(1, 2, 3, 4), count=3, overlap=2)) == [[1, 2, 3], [2, 3, 4]]


@given(streams(least=1), st.integers(1, 6))
def test_slices_without_overlap_put_together_are_the_stream(events, count):
    assert EventStream.concat(slices(events, count=count)).equals(events)
    duration_us = count * 10_000
    assert EventStream.concat(slices(events, duration_us=duration_us)).equals(events)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({}, "give either duration_us or count"),
        ({"count": 1, "duration_us": 1}, "give either duration_us or count"),
        ({"count": 0}, "count is 0; it must be at least 1"),
        ({"duration_us": 0}, "duration_us is 0; it must be at least 1"),
        ({"duration_us": 10, "overlap": 10}, r"overlap is 10; it must be 0\.\.9"),
        ({"count": 2, "overlap": -1}, "overlap is -1"),
        ({"count": 2, "start_us": 0}, "start_us belongs to slices of fixed time"),
    ],
)
def test_wrong_options_are_refused_at_once(options, message):
    with pytest.raises(ConfigError, match=message):
        slices(stream(1, 2), **options)
