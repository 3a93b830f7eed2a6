"""Slices of recordings do not depend on how these are cut into packets, and lose no event."""

import itertools
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.represent.slices import slice_between, slice_by_count, slice_regularly
from texvent.sensor import SensorSize

SIZE = SensorSize(4, 3)


def stream(times):
    count = len(times)
    zeros = [0] * count
    return EventStream.from_columns(zeros, zeros, times, zeros, size=SIZE)


def packets_of(events, cuts):
    edges = [0, *sorted(min(cut, len(events)) for cut in cuts), len(events)]
    return [events[a:b] for a, b in itertools.pairwise(edges)]


times = st.lists(st.integers(0, 200), max_size=40).map(sorted)
cuts = st.lists(st.integers(0, 40), max_size=6)


@given(times, cuts, st.lists(st.integers(0, 250), min_size=2, max_size=8, unique=True).map(sorted))
def test_slices_hold_the_events_between_neighbouring_instants(times, cuts, instants):
    slices = list(slice_between(packets_of(stream(times), cuts), instants, size=SIZE))
    assert [t_us for t_us, _ in slices] == instants[1:]
    for before, (t_us, events) in zip(instants, slices, strict=False):
        assert events.t.tolist() == [t for t in times if before <= t < t_us]


@given(times, cuts, st.fractions(1, 60, max_denominator=7))
def test_regular_slices_lose_no_event_and_do_not_drift(times, cuts, step_us):
    slices = list(slice_regularly(packets_of(stream(times), cuts), step_us=step_us))
    assert [t for _, events in slices for t in events.t.tolist()] == times
    if times:
        ends = [times[0] + round(number * step_us) for number in range(1, len(slices) + 1)]
        assert [t_us for t_us, _ in slices] == ends
        assert ends[-1] > times[-1] >= (ends[-2] if len(ends) > 1 else times[0])


@given(times, cuts, st.integers(1, 12))
def test_counted_slices_are_full_and_end_ever_later(times, cuts, count):
    slices = list(slice_by_count(packets_of(stream(times), cuts), count=count, size=SIZE))
    assert [t for _, events in slices for t in events.t.tolist()] == times
    assert all(len(events) == count for _, events in slices[:-1])
    ends = [t_us for t_us, _ in slices]
    assert all(a < b for a, b in itertools.pairwise(ends))
    assert all(t_us >= int(events.t[-1]) for t_us, events in slices)


def test_events_are_read_no_further_than_needed():
    read = []

    def packets():
        for start in range(0, 100, 10):
            read.append(start)
            yield stream([start, start + 5])

    slices = slice_between(packets(), [0, 20, 40], size=SIZE)
    assert next(slices)[1].t.tolist() == [0, 5, 10, 15]
    assert read == [0, 10, 20]


def test_empty_slices_are_refused():
    with pytest.raises(ConfigError, match="at least 1"):
        list(slice_regularly([], step_us=Fraction(1, 2)))
    with pytest.raises(ConfigError, match="at least 1"):
        list(slice_by_count([], count=0, size=SIZE))
