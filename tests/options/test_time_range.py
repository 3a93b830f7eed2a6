"""Ranges that hold nothing of a recording are said, with its times and the likely unit."""

import re
import warnings

import numpy as np
import pytest

from texvent.cli.event_files.event_file_options import END_OF_TIME_US, parse_time_range
from texvent.errors import TexventWarning
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.files import open_events
from texvent.sensor import SensorSize

SIZE = SensorSize(8, 6)


def test_times_are_rounded_to_the_nearest_us_at_both_ends():
    assert parse_time_range("0.0000009,0.0000016") == (1, 2)
    assert parse_time_range("-0.0000016,") == (-2, END_OF_TIME_US)


def recording(start_us=0, end_us=400_001, step_us=100):
    t = np.arange(start_us, end_us, step_us)
    return EventStream(t % 8, t % 6, t, t % 2, SIZE)


@pytest.fixture(params=["stream", "packets", "h5", "csv"])
def opened(request, tmp_path):
    events = recording()
    if request.param == "stream":
        return events
    if request.param == "packets":
        return EventPackets([events[:500], events[500:]], SIZE)
    return open_events(events.save(tmp_path / f"a.{request.param}"), size=SIZE)


def count(events):
    return len(events) if isinstance(events, EventStream) else len(events.collect())


@pytest.mark.parametrize(
    ("start", "stop", "said"),
    [
        (0.1, 0.3, "times are µs: did you mean 100_000 to 300_000?"),
        (5_000_000, 6_000_000, "no event from 5_000_000 to 6_000_000 µs: the recording runs from"),
        (5_000, 5_000, "the range from 5_000 to 5_000 µs is empty"),
    ],
)
def test_a_range_that_is_hardly_meant_warns(opened, start, stop, said):
    with pytest.warns(TexventWarning, match=re.escape(said)) as caught:
        assert count(opened.between(start, stop)) == 0
    assert len(caught) == 1
    assert caught[0].filename == __file__


def test_seconds_that_catch_an_event_by_chance_warn_too(opened):
    with pytest.warns(TexventWarning, match="did you mean 0 to 300_000"):
        assert count(opened.between(0.0, 0.3)) == 1


def test_a_range_before_the_recording_names_its_begin():
    packets = EventPackets([recording(500_000, 900_000)], SIZE)
    with pytest.warns(TexventWarning, match="begins at 500_000 µs; .*mean 600_000 to 700_000"):
        assert count(packets.between(0.6, 0.7)) == 0
    with pytest.warns(TexventWarning, match="begins at 500_000 µs$"):
        assert count(packets.between(0, 100)) == 0


def test_what_lies_inside_is_taken_without_a_word(opened):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert count(opened.between(100_000, 300_000)) == 2000
        assert count(opened.between(1_000.5, 2_000.5)) == 10
        assert count(opened.between(10_001, 10_002)) == 0
        assert count(opened.between(0, 2**62)) == 4001
        assert len(EventStream.empty(SIZE).between(0, 10**12)) == 0
