import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.represent.histogram import histogram_2d, histogram_3d, stacked_histogram
from texvent.sensor import SensorSize

from . import definitions
from .definitions import SMALL, streams

EVENTS = EventStream([0, 1, 3], [0, 1, 2], [10, 14, 19], [1, 0, 1], SMALL)


def test_the_window_is_half_open_and_defaults_to_all_events():
    assert histogram_3d(EVENTS, start_us=10, stop_us=19).sum() == 2
    assert histogram_3d(EVENTS, start_us=11).sum() == 2
    assert histogram_3d(EVENTS).sum() == 3
    assert histogram_3d(EVENTS, start_us=100).sum() == 0


@given(
    streams(),
    st.integers(1, 5),
    st.integers(-5, 5),
    st.integers(1, 60_000),
    st.tuples(st.integers(1, 3), st.integers(1, 4)),
)
def test_histograms_equal_their_definition(events, bins, offset_us, duration_us, shape):
    start_us = offset_us + (int(events.t[0]) if len(events) else 0)
    stop_us = start_us + duration_us
    found = histogram_3d(events, bins=bins, start_us=start_us, stop_us=stop_us, shape=shape)
    expected = definitions.histogram(events, bins, start_us, stop_us, shape)
    assert found.dtype == np.float32
    np.testing.assert_array_equal(found, expected)
    inside = events.cut(start_us, stop_us)
    np.testing.assert_array_equal(histogram_2d(inside, shape=shape), expected.sum(axis=1))


def test_wrong_shapes_bins_and_windows_are_refused():
    with pytest.raises(ConfigError, match=r"rows is 4; it must be 1\.\.3"):
        histogram_2d(EVENTS, shape=(4, 4))
    with pytest.raises(ConfigError, match="columns is 0"):
        histogram_2d(EVENTS, shape=(3, 0))
    with pytest.raises(ConfigError, match="bins is 0"):
        histogram_3d(EVENTS, bins=0)
    with pytest.raises(InputError, match="the window ends at 5 µs; it must end after it starts"):
        histogram_3d(EVENTS, start_us=5, stop_us=5)


def test_bins_span_the_first_event_to_the_last_not_the_slice():
    events = EventStream([0, 1, 2], [0, 0, 1], [1000, 1500, 2000], [1, 0, 1], SensorSize(3, 2))
    histogram = stacked_histogram(events)
    assert histogram.shape == (20, 2, 3)
    assert histogram.dtype == np.uint8
    # Channel p · 10 + bin; the last event falls on the last edge and stays in the last bin.
    assert np.argwhere(histogram).tolist() == [[5, 0, 1], [10, 0, 0], [19, 1, 2]]


def test_counts_stop_at_the_cutoff_instead_of_wrapping():
    events = EventStream([0] * 300, [0] * 300, [7] * 300, [1] * 300, SensorSize(3, 2))
    histogram = stacked_histogram(events, cutoff=10)
    assert histogram[10, 0, 0] == 10
    assert histogram.sum() == 10
    assert stacked_histogram(events, cutoff=255)[10, 0, 0] == 255


@given(streams(), st.integers(1, 12), st.integers(1, 3))
def test_a_stacked_histogram_equals_its_definition(events, bins, cutoff):
    expected = definitions.stacked_histogram(events, bins, cutoff)
    np.testing.assert_array_equal(stacked_histogram(events, bins=bins, cutoff=cutoff), expected)
