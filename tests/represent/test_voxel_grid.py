import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.represent.voxel_grid import voxel_dsec, voxel_e2vid, voxel_zhu
from texvent.sensor import SensorSize

from . import definitions
from .definitions import SMALL, streams

ONE_PIXEL = SensorSize(1, 1)
# t* in 3 bins: 0, 0.5, 1.5, 2.
FOUR = EventStream([0] * 4, [0] * 4, [100, 110, 130, 140], [1, 0, 1, 1], ONE_PIXEL)


def values(grid):
    assert grid.dtype == np.float32
    return grid.ravel().tolist()


def test_zhu_and_e2vid_by_hand():
    # Bin 0: +1 − 0.5; bin 1: −0.5 + 0.5; bin 2: 0.5 + 1.
    assert values(voxel_zhu(FOUR, bins=3)) == [0.5, 0.0, 1.5]
    assert values(voxel_e2vid(FOUR, bins=3)) == [0.5, 0.0, 1.5]


def test_zhu_split_by_hand_gives_on_bins_then_off_bins():
    assert values(voxel_zhu(FOUR, bins=3, split_polarity=True)) == [1, 0.5, 1.5, 0.5, 0.5, 0]


def test_dsec_by_hand_normalises_the_voxels_that_are_not_zero():
    assert values(voxel_dsec(FOUR, bins=3, normalise=False)) == [0.5, 0.0, 1.5]
    # 0.5 and 1.5: mean 1, deviation √(2 · 0.25 / 1).
    expected = [-(0.5**0.5), 0.0, 0.5**0.5]
    np.testing.assert_allclose(values(voxel_dsec(FOUR, bins=3)), expected, rtol=1e-6)
    np.testing.assert_allclose(
        values(voxel_e2vid(FOUR, bins=3, normalise=True)), expected, rtol=1e-6
    )


def test_equal_voxels_normalise_to_zero_without_a_division_by_zero():
    events = EventStream([0, 1, 2], [0, 0, 0], [7, 7, 7], [1, 1, 1], SMALL)
    assert voxel_dsec(events).any() == 0
    assert voxel_dsec(events[:1]).any() == 0


def test_rectified_events_spread_over_four_pixels():
    events = EventStream([1], [1], [5], [0], SMALL)
    table = np.zeros((3, 4, 2), np.float32)
    table[1, 1] = (2.25, 0.5)
    grid = voxel_dsec(events, bins=1, normalise=False, rectify_map=table)[0]
    expected = np.zeros((3, 4))
    expected[0, 2:4] = expected[1, 2:4] = (-0.375, -0.125)
    np.testing.assert_allclose(grid, expected, rtol=1e-6)


def test_rectified_events_outside_the_sensor_are_lost_in_part_or_whole():
    events = EventStream([0, 1], [0, 0], [5, 5], [1, 1], SMALL)
    table = np.zeros((3, 4, 2), np.float32)
    table[0, 0] = (-0.25, 0)
    table[0, 1] = (40, -1e6)
    grid = voxel_dsec(events, bins=1, normalise=False, rectify_map=table)
    assert grid[0, 0, 0] == 0.75
    assert grid.sum() == 0.75


def test_a_rectify_map_of_another_size_or_with_nan_is_refused():
    with pytest.raises(InputError, match=r"shape \[4, 3, 2\]; a 4x3 sensor needs \[3, 4, 2\]"):
        voxel_dsec(EventStream.empty(SMALL), rectify_map=np.zeros((4, 3, 2)))
    with pytest.raises(InputError, match="every pixel needs a finite place"):
        voxel_dsec(EventStream.empty(SMALL), rectify_map=np.full((3, 4, 2), np.nan))


@given(streams(), st.integers(1, 4))
def test_grids_equal_their_definition_exactly(events, bins):
    def slow(**options):
        return definitions.event_volume(events, bins, **options)

    np.testing.assert_array_equal(voxel_zhu(events, bins=bins), slow())
    np.testing.assert_array_equal(voxel_e2vid(events, bins=bins), slow())
    np.testing.assert_array_equal(voxel_zhu(events, bins=bins, split_polarity=True), slow(lanes=2))


@given(streams(), st.data())
@settings(max_examples=30)
def test_rectified_grids_equal_their_definition(events, data):
    place = st.floats(-2, 6, width=16)
    table = np.array(data.draw(st.lists(place, min_size=24, max_size=24))).reshape(3, 4, 2)
    grid = voxel_dsec(events, bins=3, normalise=False, rectify_map=table)
    expected = definitions.event_volume(events, 3, place=table.tolist())
    np.testing.assert_allclose(grid, expected, rtol=1e-6, atol=1e-12)


def test_a_sum_that_could_overflow_is_refused():
    events = EventStream([0, 0], [0, 0], [0, 2**62], [1, 1], SMALL)
    with pytest.raises(InputError, match="too much for one voxel grid"):
        voxel_zhu(events)


@pytest.mark.parametrize("bins", [0, 4097])
def test_bins_out_of_range_are_refused(bins):
    with pytest.raises(ConfigError, match=r"bins is .*1\.\.4096"):
        voxel_e2vid(FOUR, bins=bins)
    with pytest.raises(ConfigError, match="bins is"):
        voxel_dsec(FOUR, bins=bins, rectify_map=np.zeros((1, 1, 2)))
