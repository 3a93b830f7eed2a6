"""Histograms, and refusals of voxel grids."""

import math

import numpy as np
import pytest

from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.represent.histogram import histogram_2d, histogram_3d, stacked_histogram
from texvent.represent.voxel_grid import voxel_dsec, voxel_zhu
from texvent.sensor import SensorSize

from .definitions import SMALL

EVENTS = EventStream([0, 1, 3], [0, 1, 2], [10, 14, 19], [1, 0, 1], SMALL)


def test_wrong_shapes_and_windows_are_refused():
    with pytest.raises(ConfigError, match=r"rows is 4; it must be 1\.\.3"):
        histogram_2d(EVENTS, shape=(4, 4))
    with pytest.raises(ConfigError, match="columns is 0"):
        histogram_2d(EVENTS, shape=(3, 0))
    with pytest.raises(InputError, match="the window ends at 5 µs; it must end after it starts"):
        histogram_3d(EVENTS, start_us=5, stop_us=5)


@pytest.mark.parametrize("start", [None, 12, 20, 10**12])
@pytest.mark.parametrize("stop", [None, 15, 10**13])
def test_a_window_holds_the_events_between_its_ends(start, stop):
    lowest = -math.inf if start is None else start
    highest = math.inf if stop is None else stop
    if lowest < highest:
        found = histogram_3d(EVENTS, start_us=start, stop_us=stop).sum()
        assert found == np.count_nonzero((EVENTS.t >= lowest) & (EVENTS.t < highest))


def test_counts_stop_at_the_cutoff_instead_of_wrapping():
    events = EventStream([0] * 300, [0] * 300, [7] * 300, [1] * 300, SensorSize(3, 2))
    assert stacked_histogram(events, cutoff=255)[10, 0, 0] == 255
    assert stacked_histogram(events).sum() == 10


def test_a_rectify_map_of_another_size_or_with_nan_is_refused():
    with pytest.raises(InputError, match=r"shape \[4, 3, 2\]; a 4x3 sensor needs \[3, 4, 2\]"):
        voxel_dsec(EventStream.empty(SMALL), rectify_map=np.zeros((4, 3, 2)))
    with pytest.raises(InputError, match="every pixel needs a finite place"):
        voxel_dsec(EventStream.empty(SMALL), rectify_map=np.full((3, 4, 2), np.nan))


def test_a_sum_that_could_overflow_is_refused():
    events = EventStream([0, 0], [0, 0], [0, 2**62], [1, 1], SMALL)
    with pytest.raises(InputError, match="too much for one voxel grid"):
        voxel_zhu(events)
