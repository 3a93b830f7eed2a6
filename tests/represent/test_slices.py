"""Slices of streams and of packets: by hand, without a lost event, however packets are cut."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tests.transform.recordings import CUTS, packets

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.represent.slices import slice_between, slice_by_count, slice_regularly, slices

from .definitions import SMALL, streams


def stream(*times):
    zeros = [0] * len(times)
    return EventStream.from_columns(zeros, zeros, times, zeros, size=SMALL)


@given(
    streams(), st.sampled_from(["count", "duration_us"]), st.integers(1, 6), st.integers(0, 5),
    st.integers(-3, 3), st.booleans(),
)  # fmt: skip
@example(stream(0), "duration_us", 2, 1, -1, True)  # the whole slice reaches the last event
@example(stream(0, 4), "duration_us", 2, 0, 0, False)  # a slice would begin at the last event
@example(stream(0, 4), "duration_us", 2, 0, 0, True)
def test_slices_begin_a_stride_apart_and_the_last_one_may_be_partial(
    events, kind, length, overlap, start, keep_partial
):
    is_long = kind == "duration_us" and len(events) and np.ptp(events.t) > 10
    unit, overlap = 10_000 if is_long else 1, min(overlap, length - 1)
    places, ends, first = range(len(events)), len(events), 0
    options = {kind: length * unit, "overlap": overlap * unit, "keep_partial": keep_partial}
    if kind == "duration_us" and len(events):
        places, ends = events.t.tolist(), int(events.t[-1]) + 1
        first = int(events.t[0]) + start * unit
        options["start_us"] = first
    expected = []
    while first < ends:
        stop = first + length * unit
        if stop <= ends or keep_partial:
            expected.append([place for place in places if first <= place < stop])
        if stop >= ends:
            break
        first += (length - overlap) * unit
    found = list(slices(events, **options))
    by_place = [part.t.tolist() for part in found]
    if kind == "count":
        expected = [[int(events.t[place]) for place in part] for part in expected]
    assert by_place == expected


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


TIMES = st.lists(st.integers(0, 200), max_size=40).map(sorted)


@given(TIMES, CUTS, st.lists(st.integers(0, 250), min_size=2, max_size=8, unique=True).map(sorted))
def test_slices_hold_the_events_between_neighbouring_instants(times, cuts, instants):
    slices = list(slice_between(packets(stream(*times), cuts), instants, size=SMALL))
    assert [t_us for t_us, _ in slices] == instants[1:]
    for before, (t_us, events) in zip(instants, slices, strict=False):
        assert events.t.tolist() == [t for t in times if before <= t < t_us]


@given(TIMES, CUTS, st.fractions(1, 60, max_denominator=7))
def test_regular_slices_lose_no_event_and_do_not_drift(times, cuts, step_us):
    slices = list(slice_regularly(packets(stream(*times), cuts), step_us=step_us))
    assert [t for _, events in slices for t in events.t.tolist()] == times
    if times:
        ends = [times[0] + round(number * step_us) for number in range(1, len(slices) + 1)]
        assert [t_us for t_us, _ in slices] == ends
        assert ends[-1] > times[-1] >= (ends[-2] if len(ends) > 1 else times[0])


@given(TIMES, CUTS, st.integers(1, 12))
def test_counted_slices_are_full_and_end_ever_later(times, cuts, count):
    slices = list(slice_by_count(packets(stream(*times), cuts), count=count, size=SMALL))
    assert [t for _, events in slices for t in events.t.tolist()] == times
    assert all(len(events) == count for _, events in slices[:-1])
    end_us = None
    for t_us, events in slices:
        last_us = int(events.t[-1])
        assert t_us == (last_us if end_us is None else max(last_us, end_us + 1))
        end_us = t_us


def test_events_are_read_no_further_than_needed():
    read = []

    def endless():
        for start in range(0, 100, 10):
            read.append(start)
            yield stream(start, start + 5)

    slices = slice_between(endless(), [0, 20, 40], size=SMALL)
    assert next(slices)[1].t.tolist() == [0, 5, 10, 15]
    assert read == [0, 10, 20]


def test_empty_slices_are_refused():
    with pytest.raises(ConfigError, match="at least 1"):
        list(slice_regularly([], step_us=Fraction(1, 2)))
    with pytest.raises(ConfigError, match="at least 1"):
        list(slice_by_count([], count=0, size=SMALL))
