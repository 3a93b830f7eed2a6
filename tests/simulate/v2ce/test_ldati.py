"""LDATI: known events, their voxel grid, and the events inferred from it."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from texvent.errors import InputError
from texvent.sensor import SensorSize
from texvent.simulate.packets import FrameInterval, make_packet
from texvent.simulate.random.draws import frame_key
from texvent.simulate.v2ce.ldati import (
    density_slope,
    infer_counts,
    sample_density,
    sample_events,
)

CHECKED = settings(max_examples=60)
NINTH_US = 1_000_000
"""Sub-interval of ten nodes over nine seconds."""
WHOLE_US = 9 * NINTH_US


def voxelise(t, x, y, p, shape, *, nodes=10, duration_us=WHOLE_US):
    """Linear voxel grid [2, nodes, H, W] of events, ON first: each adds 1 to two nodes."""
    voxel = np.zeros((2, nodes, *shape))
    place = np.asarray(t, np.float64) * (nodes - 1) / duration_us
    lower = np.floor(place).astype(int)
    channel = 1 - np.asarray(p, int)
    np.add.at(voxel, (channel, lower, y, x), 1 - (place - lower))
    np.add.at(voxel, (channel, lower + 1, y, x), place - lower)
    return voxel


def column(*nodes):
    """Voxel grid of one pixel: these ON nodes, no OFF."""
    voxel = np.zeros((2, len(nodes), 1, 1))
    voxel[0, :, 0, 0] = nodes
    return voxel


def on_counts(voxel):
    return infer_counts(voxel).counts[0, :, 0, 0].tolist()


def events_of(voxel, start_us, stop_us, *, seed=0):
    """Events of one voxel grid as a packet."""
    interval = FrameInterval(start_us, stop_us, frame_key(seed, stop_us - start_us))
    size = SensorSize(voxel.shape[3], voxel.shape[2])
    return make_packet(sample_events(voxel, interval), interval, size)


def test_one_event_gets_back_its_time_and_polarity():
    for p in (0, 1):
        voxel = voxelise([3_250_000], [1], [0], [p], (1, 2))
        events = events_of(voxel, 500, 500 + WHOLE_US)
        assert (events.t.tolist(), events.x.tolist(), events.y.tolist()) == ([3_250_500], [1], [0])
        assert events.p.tolist() == [p]


def test_the_first_node_is_the_first_instant_and_an_event_there_owes_nothing():
    events = events_of(column(1, 1, 0, 0), 0, 3000)
    assert events.t.tolist() == [0, 1000]


def test_a_debt_is_paid_before_the_next_event_is_counted():
    # Events at 0.75 and 1.5: 0.25 | 0.75 + 0.5 | 0.5. Node 1 alone would say two events.
    assert on_counts(column(0.25, 1.25, 0.5, 0)) == [1, 1, 0]
    assert events_of(column(0.25, 1.25, 0.5, 0), 0, 3000).t.tolist() == [750, 1500]


@given(st.data())
@CHECKED
def test_lone_events_come_back_exactly(data):
    nodes = data.draw(st.integers(2, 12))
    is_fired = data.draw(arrays(bool, (2, nodes - 1, 2, 2)))
    channel, i, y, x = np.nonzero(is_fired)
    # An event in the last millionth of its sub-interval counts as the next one's.
    within = data.draw(arrays(np.int64, len(i), elements=st.integers(0, NINTH_US - 2)))
    t, stop_us = i * NINTH_US + within, (nodes - 1) * NINTH_US
    voxel = voxelise(t, x, y, 1 - channel, (2, 2), nodes=nodes, duration_us=stop_us)
    events = events_of(voxel, 0, stop_us)
    expected = sorted(zip(y, x, 1 - channel, t, strict=True))
    found = sorted(zip(events.y, events.x, events.p, events.t, strict=True))
    assert [row[:3] for row in found] == [row[:3] for row in expected]
    # Floating point may put a time just below its whole microsecond, or just past a tolerance.
    for mine, theirs in zip(found, expected, strict=True):
        assert abs(int(mine[3]) - int(theirs[3])) <= 2
    again = voxelise(
        events.t, events.x, events.y, events.p, (2, 2), nodes=nodes, duration_us=stop_us
    )
    assert np.abs(again - voxel).max() < 1e-5


voxels = arrays(
    np.float64,
    st.tuples(st.just(2), st.integers(2, 11), st.integers(1, 3), st.integers(1, 3)),
    elements=st.one_of(st.just(0.0), st.floats(0, 6), st.integers(0, 5).map(float)),
)


@given(voxels)
@CHECKED
def test_a_pixel_fires_its_sum_rounded_to_either_side(voxel):
    counts = infer_counts(voxel).counts
    assert (counts >= 0).all()
    total, wanted = counts.sum(1), voxel.sum(1)
    assert (total > wanted - 1 - 1e-4).all()
    assert (total < wanted + 1 + 1e-4).all()


@pytest.mark.parametrize(
    ("nodes", "published"),
    [
        # A part of an event in the first sub-interval is one, and its debt is never paid.
        pytest.param((0.1, 0, 0, 0), [1, 0, 0], id="a little at the start"),
        # The last node's rest is rounded down.
        pytest.param((0, 0, 0, 0.9), [0, 0, 0], id="a little at the end"),
        pytest.param((0, 0, 0, 2.9), [0, 0, 2], id="a lot at the end"),
        pytest.param((2, 0, 0, 0), [2, 0, 0], id="several at the start"),
    ],
)
def test_what_is_not_whole_is_settled_at_the_end(nodes, published):
    assert on_counts(column(*nodes)) == published


def test_the_slope_follows_the_neighbours():
    counts = np.array([4, 2, 8, 0, 3]).reshape(1, 5, 1, 1)
    # Ends have none; (8 - 4) / (2 · 2), (0 - 2) / (2 · 8), and nothing where nothing fires.
    assert density_slope(counts)[0, :, 0, 0].tolist() == [0.0, 1.0, -0.125, 0.0, 0.0]


@pytest.mark.parametrize("slope", [-5.0, -2.0, -0.3, 0.0, 1e-9, 0.7, 2.0, 6.0])
def test_times_have_the_distribution_of_the_slope(slope):
    chance = (np.arange(20_000) + 0.5) / 20_000
    tau = sample_density(np.full(20_000, slope), chance)
    assert 0 <= tau.min() <= tau.max() < 1
    assert (np.diff(tau) > 0).all()
    # Evenly spaced chances give the distribution itself; the closed form on its support:
    area = (1 - slope / 2) * tau + slope * tau**2 / 2
    assert area == pytest.approx(chance, abs=1e-9)
    if abs(slope) <= 2:
        assert tau.mean() == pytest.approx(0.5 + slope / 12, abs=1e-6)
    else:
        assert tau.max() - tau.min() == pytest.approx(2 / abs(slope), abs=1e-3)


def test_several_events_of_a_pixel_spread_as_its_neighbours_say():
    # Nodes of 0, 400, 800 events at τ = 0 each: the middle sub-interval has slope +1.
    events = events_of(column(0, 400, 800, 0), 0, 3_000_000)
    middle = events.t[(events.t >= 1_000_000) & (events.t < 2_000_000)] / 1e6 - 1
    assert len(middle) == 400
    # Mean 1/2 + 1/12; standard deviation of one time below 0.29.
    assert middle.mean() == pytest.approx(0.5 + 1 / 12, abs=4 * 0.29 / math.sqrt(400))
    last = events.t[events.t >= 2_000_000] / 1e6 - 2
    assert last.mean() == pytest.approx(0.5, abs=4 * 0.29 / math.sqrt(800))


def test_more_events_than_a_draw_can_number_fail_clearly():
    with pytest.raises(InputError, match="20000 events"):
        events_of(column(20_000, 0), 0, 1000)
