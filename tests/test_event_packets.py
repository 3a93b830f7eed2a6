"""Recordings packet by packet: cut, saved, shown and represented with flat memory."""

import numpy as np
import pytest

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
def packets(whole):
    return EventPackets(CountedPackets(whole), SIZE, whole.metadata)


def test_a_window_of_packets_is_that_of_the_stream_and_stops_reading_early(whole, packets):
    start, stop = int(whole.t[120]), int(whole.t[250])
    assert packets.between(start, stop).collect().equals(whole.between(start, stop))
    assert packets.packets.reads == 3
    assert packets.cut(start, start).collect().equals(EventStream.empty(SIZE))


def test_the_time_range_is_that_of_the_stream(whole, packets):
    assert packets.time_range == whole.time_range
    assert EventPackets([EventStream.empty(SIZE)], SIZE).time_range is None


def test_packets_are_saved_one_by_one_and_say_how_far_they_are(tmp_path, whole, packets):
    calls = []
    path = packets.save(tmp_path / "out.h5", progress=lambda *step: calls.append(step))
    assert load(path).equals(whole)
    assert load(path).metadata["seed"] == 3
    assert calls[0] == (100, None, "events")
    assert calls[-1] == (COUNT, None, "events")


def test_packets_give_an_array_per_slice_of_time(whole, packets):
    arrays = list(packets.represent("time-surface", duration_us=10_000))
    start = int(whole.t[0])
    assert len(arrays) == 3
    for number, array in enumerate(arrays):
        window = (start + number * 10_000, start + (number + 1) * 10_000)
        part = whole.between(*window)
        np.testing.assert_array_equal(array, part.represent("time-surface", at_us=window[1]))


def test_packets_give_an_array_per_number_of_events(whole, packets):
    arrays = list(packets.represent("event-frame", count=250, kind="count"))
    assert [int(array.sum()) for array in arrays] == [250, 250, 100]
    np.testing.assert_array_equal(arrays[0], whole[:250].represent("event-frame", kind="count"))


def test_lazy_packets_are_made_anew_for_each_pass(whole):
    packets = EventPackets(LazyPackets(lambda: iter([whole])), SIZE)
    assert packets.collect().equals(whole)
    assert packets.collect().equals(whole)
    assert repr(packets) == "EventPackets(32x24, read when iterated)"


def test_a_generator_of_packets_is_read_once(whole):
    packets = EventPackets((whole[i : i + 100] for i in range(0, COUNT, 100)), SIZE)
    assert len(packets.collect()) == COUNT
    with pytest.raises(InputError, match="generator of packets can be read once, and was"):
        packets.collect()
