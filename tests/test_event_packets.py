"""Recordings packet by packet: cut, saved, shown and represented with flat memory."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.transform.recordings import CUTS, packets, streams

from texvent.errors import InputError
from texvent.event_packets import EventPackets, LazyPackets
from texvent.events import EventStream
from texvent.io.files import load
from texvent.sensor import SensorSize

SIZE = SensorSize(32, 24)
COUNT = 600


@pytest.fixture(scope="module")
def whole():
    random = np.random.default_rng(2)
    columns = (random.integers(0, side, COUNT) for side in (SIZE.width, SIZE.height))
    times = np.sort(random.integers(1_000, 31_000, COUNT))
    events = EventStream.from_columns(*columns, times, random.integers(0, 2, COUNT), size=SIZE)
    return events.with_metadata({"seed": 3})


class CountedPackets:
    """Packets of a hundred events, and how many of them were read."""

    def __init__(self, whole):
        self.whole = whole
        self.reads = 0

    def __iter__(self):
        for start in range(0, len(self.whole), 100):
            self.reads += 1
            yield self.whole[start : start + 100]


@pytest.fixture
def hundreds(whole):
    return EventPackets(CountedPackets(whole), SIZE, whole.metadata)


@examples(25)
@given(streams(), CUTS, st.lists(st.integers(-2, 23), min_size=3, max_size=3).map(sorted))
def test_parts_of_time_put_together_are_the_whole_however_packets_are_cut(events, cuts, times):
    first, middle, last = times
    for ways in (cuts, range(len(events))):
        parts = packets(events, ways)
        assert parts.collect() == events
        assert parts.time_range == events.time_range
        pieces = [parts.cut(*one).collect() for one in ((first, middle), (middle, last))]
        assert pieces[0] == events.cut(first, middle)
        assert EventStream.concat(pieces) == parts.cut(first, last).collect()
        seen = []
        parts.cut(first, last, seen.append).collect()
        if len(events):
            start_us, stop_us = events.time_range
            assert seen[0].first_us == start_us
            assert seen[0].is_whole == (seen[0].end_us == stop_us <= last)


def test_what_comes_after_a_part_is_not_read(whole, hundreds):
    start, stop = int(whole.t[120]), int(whole.t[250])
    assert hundreds.between(start, stop).collect() == whole.between(start, stop)
    assert hundreds.packets.reads == 3


def test_packets_are_saved_one_by_one_and_say_how_far_they_are(tmp_path, whole, hundreds):
    calls = []
    path = hundreds.save(tmp_path / "out.h5", progress=lambda *step: calls.append(step))
    assert load(path).equals(whole)
    assert load(path).metadata["seed"] == 3
    assert calls[0] == (100, None, "events")
    assert calls[-1] == (COUNT, None, "events")


def test_lazy_packets_are_made_anew_for_each_pass(whole):
    lazy = EventPackets(LazyPackets(lambda: iter([whole])), SIZE)
    assert lazy.collect().equals(whole)
    assert lazy.collect().equals(whole)
    assert repr(lazy) == "EventPackets(32x24, read when iterated)"


def test_a_generator_of_packets_is_read_once(whole):
    lazy = EventPackets((whole[i : i + 100] for i in range(0, COUNT, 100)), SIZE)
    assert len(lazy.collect()) == COUNT
    with pytest.raises(InputError, match="generator of packets can be read once, and was"):
        lazy.collect()
