import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.represent.histogram import stacked_histogram
from texvent.sensor import SensorSize

from . import definitions
from .definitions import streams

SIZE = SensorSize(3, 2)


def test_bins_span_the_first_event_to_the_last_not_the_slice():
    events = EventStream([0, 1, 2], [0, 0, 1], [1000, 1500, 2000], [1, 0, 1], SIZE)
    histogram = stacked_histogram(events)
    assert histogram.shape == (20, 2, 3)
    assert histogram.dtype == np.uint8
    # Channel p · 10 + bin; the last event falls on the last edge and stays in the last bin.
    assert np.argwhere(histogram).tolist() == [[5, 0, 1], [10, 0, 0], [19, 1, 2]]


def test_counts_stop_at_the_cutoff_instead_of_wrapping():
    events = EventStream([0] * 300, [0] * 300, [7] * 300, [1] * 300, SIZE)
    histogram = stacked_histogram(events, cutoff=10)
    assert histogram[10, 0, 0] == 10
    assert histogram.sum() == 10
    assert stacked_histogram(events, cutoff=255)[10, 0, 0] == 255


@given(streams(), st.integers(1, 12), st.integers(1, 3))
def test_it_equals_its_definition(events, bins, cutoff):
    expected = definitions.stacked_histogram(events, bins, cutoff)
    np.testing.assert_array_equal(stacked_histogram(events, bins=bins, cutoff=cutoff), expected)
