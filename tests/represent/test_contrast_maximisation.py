"""Velocities that moving patterns have, found from their events alone."""

import itertools
import math
from collections import defaultdict

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.represent.contrast_maximisation import (
    _contrast,
    find_flow,
    find_velocity,
    flow_warp_loss,
    warp_events,
)
from texvent.sensor import SensorSize

SIZE = SensorSize(120, 60)
SLICE_US = 40_000
PIXEL = 1e6 / SLICE_US
"""Speed of one pixel in the slice, px/s: places are whole pixels, so no velocity is surer."""


def moving_points(velocity, *, left=40, top=20, width=24, height=20, seed=0, count=1500):
    """Events of 40 points that move as one, each seen at random times in the pixel where it is."""
    rng = np.random.default_rng(seed)
    x0, y0 = rng.uniform(0, width, 40), rng.uniform(0, height, 40)
    t = np.sort(rng.integers(0, SLICE_US, count))
    t[[0, -1]] = 0, SLICE_US
    which = rng.integers(0, 40, count)
    x = left + np.floor(x0[which] + velocity[0] * t * 1e-6).astype(int)
    y = top + np.floor(y0[which] + velocity[1] * t * 1e-6).astype(int)
    inside = (x >= 0) & (x < SIZE.width) & (y >= 0) & (y < SIZE.height)
    return EventStream(x[inside], y[inside], t[inside], rng.integers(0, 2, count)[inside], SIZE)


def together(*streams):
    x, y, t, p = (np.concatenate([getattr(one, name) for one in streams]) for name in "xytp")
    order = np.argsort(t, kind="stable")
    return EventStream(x[order], y[order], t[order], p[order], streams[0].size)


@pytest.mark.parametrize("velocity", [(0, 0), (150, -60), (-700, 25), (333, -300), (20, 400)])
def test_the_velocity_of_moving_points_is_found_within_a_pixel_per_slice(velocity):
    found = find_velocity(moving_points(velocity))
    assert found == pytest.approx(velocity, abs=PIXEL)


@pytest.mark.parametrize("side", [8, 20])
@pytest.mark.parametrize("velocity", [(150, -60), (-220, 90)])
def test_the_velocity_is_the_same_wherever_the_pattern_is_and_whenever(velocity, side):
    # Cells that are wider where numbers change their sign draw a small pattern into them.
    middle = moving_points(velocity, width=side, height=side)
    found = find_velocity(middle)
    assert found == pytest.approx(velocity, abs=PIXEL)
    for right, down, later in ((-30, -15, 0), (30, 5, 3), (1, 0, 10**15), (0, 1, 0)):
        x, y = middle.x.astype(int) + right, middle.y.astype(int) + down
        moved = EventStream(x, y, middle.t + later, middle.p, SIZE)
        np.testing.assert_array_equal(find_velocity(moved), found)


def test_of_equally_sharp_motions_the_slowest_is_found():
    one_pixel = EventStream([5] * 200, [5] * 200, [7] * 200, [1] * 200, SIZE)
    assert find_velocity(one_pixel).tolist() == [0, 0]
    far = np.arange(100) % 7 * 10, np.arange(100) // 7 * 4  # none gets onto another
    apart = EventStream([*far[0], 119], [*far[1], 59], [0] * 100 + [SLICE_US], [1] * 101, SIZE)
    assert find_velocity(apart).tolist() == [0, 0]
    still = EventStream([5] * 200, [5] * 200, np.arange(200) * 200, [1] * 200, SIZE)
    assert find_velocity(still).tolist() == [0, 0]


def test_the_flow_warp_loss_is_1_at_rest_and_above_along_the_motion():
    events, velocity = moving_points((200, -100)), np.array([200.0, -100.0])
    assert flow_warp_loss(events, np.zeros(2)) == 1
    true = flow_warp_loss(events, velocity)
    assert true > 2
    assert flow_warp_loss(events, -velocity) < 1
    assert flow_warp_loss(events, find_velocity(events)) > 0.95 * true
    assert flow_warp_loss(events, np.full((60, 120, 2), velocity)) == pytest.approx(true)
    # Mirrored or elsewhere, as many pixels see the same.
    assert flow_warp_loss(events.flip("x"), velocity * [-1, 1]) == pytest.approx(true)


def test_the_flow_warp_loss_of_whole_pixels_is_as_computed_by_hand():
    # A dot fires once on each of 5 px, so warped it fires 5 times on one of them.
    t = np.arange(5) * 10_000
    events = EventStream(np.arange(5), [0] * 5, t, [1] * 5, SensorSize(8, 4))
    cells = 9 * 5  # a bilinear share falls on the next pixel too
    mean = 5 / cells
    expected = (25 / cells - mean**2) / (5 / cells - mean**2)
    assert flow_warp_loss(events, np.array([100, 0])) == pytest.approx(expected)
    assert warp_events(events, [100, 0]).x.tolist() == [0] * 5
    assert math.isnan(flow_warp_loss(events[:0], [100, 0]))


def test_warped_events_are_in_the_nearest_pixel_and_those_that_leave_are_left_out():
    events = EventStream([0, 1, 1, 9], [2] * 4, [0, 10_000, 20_000, 20_000], [1] * 4, (10, 4))
    # By 0, 0.7, 1.4 and 1.4 px to the left, up and down: 0.3 is in pixel 0, -0.4 too.
    assert warp_events(events, [70, 0]).x.tolist() == [0, 0, 0, 8]
    assert warp_events(events, [80, 0]).x.tolist() == [0, 0, 7]  # -0.6 is not
    assert warp_events(events, [-30, 0]).x.tolist() == [0, 1, 2]
    assert warp_events(events, [0, 30]).y.tolist() == [2, 2, 1, 1]
    flow = np.full((4, 10, 2), np.nan)  # not known, taken as rest
    flow[:, 9] = 70, 0
    assert warp_events(events, flow).x.tolist() == [0, 1, 1, 8]


def test_halves_that_move_apart_have_their_own_flow():
    left = moving_points((-200, 0), left=18)
    right = moving_points((150, 100), left=78, seed=1)
    both = together(left, right)
    flow = find_flow(both, patch_px=60)
    assert flow.shape == (60, 120, 2)
    assert flow[30, 15] == pytest.approx([-200, 0], abs=PIXEL)
    assert flow[30, 105] == pytest.approx([150, 100], abs=PIXEL)
    # Mixed linearly between the centres of both patches, constant beyond.
    middle = flow[:, 59:61].mean(axis=(0, 1))
    assert middle == pytest.approx((flow[0, 0] + flow[-1, -1]) / 2)
    assert (flow[:, :30] == flow[0, 0]).all()
    assert flow_warp_loss(both, flow) > flow_warp_loss(both, find_velocity(both)) > 1


def test_every_patch_has_the_flow_of_its_own_events_in_rows_and_columns():
    ways = {(5, 4): (-100, 0), (65, 4): (150, 0), (5, 34): (0, 200), (65, 34): (100, -100)}
    events = together(*(moving_points(way, left=left, top=top, width=20, seed=left + top)
                        for (left, top), way in ways.items()))  # fmt: skip
    flow = find_flow(events, patch_px=30)
    for (left, top), way in ways.items():
        assert flow[top + 11, left + 10] == pytest.approx(way, abs=2 * PIXEL)


def test_patches_with_few_events_have_no_flow_and_those_left_over_belong_to_the_last():
    events = together(moving_points((100, 0), left=2), moving_points((0, 0), left=115, count=60))
    flow = find_flow(events, patch_px=50)  # two patches: x from 0 and from 50 to the end
    assert np.isnan(flow[:, 50:]).all()
    np.testing.assert_allclose(flow[:, :50], np.broadcast_to(flow[0, 0], (60, 50, 2)))
    assert np.isnan(find_flow(events[:99], patch_px=500)).all()
    assert find_velocity(events[:99]) is None
    whole = find_flow(events, patch_px=500)
    np.testing.assert_array_equal(whole, np.broadcast_to(find_velocity(events), (60, 120, 2)))


def test_impossible_searches_and_flows_are_refused():
    events = moving_points((100, 0))
    slower = EventStream(events.x, events.y, events.t * 100, events.p, SIZE)
    with pytest.raises(InputError, match=r"4000 ms, in which things move 4,000 px.*shorter window"):
        find_velocity(slower)
    assert find_velocity(slower, fastest_px_s=20) == pytest.approx([1, 0], abs=0.3)
    with pytest.raises(ConfigError, match="fastest_px_s is 0"):
        find_velocity(events, fastest_px_s=0)
    with pytest.raises(ConfigError, match="patch_px is 3"):
        find_flow(events, patch_px=3)
    with pytest.raises(InputError, match=r"flow has shape \[3\]; give \[2\] or \[60, 120, 2\]"):
        warp_events(events, [1, 2, 3])


@given(st.integers(0, 2**32 - 1), st.floats(-3, 3), st.floats(-3, 3))
def test_the_contrast_is_that_of_an_image_made_event_by_event(seed, across, down):
    rng = np.random.default_rng(seed)
    place, share = rng.integers(0, 6, (2, 9)).astype(float), rng.random(9)
    image = defaultdict(float)
    for column, row, part in zip(*place, share, strict=True):
        where = column - across * part, row - down * part
        for cell in itertools.product(
            *([math.floor(one) + n for n in range(-1, 3)] for one in where)
        ):
            # A pixel's share is a tent, spread by (1 2 1): of each side, of both.
            image[cell] += math.prod(
                sum((2 - abs(n)) * max(1 - abs(at + n - one), 0.0) for n in (-1, 0, 1))
                for at, one in zip(cell, where, strict=True)
            )
    found = _contrast(place, share, np.array([across, down]))
    assert found == pytest.approx(sum(one * one for one in image.values()))
