"""Velocities of a moving pattern of points, found from its events alone; sharpness along them."""

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.metrics.event_sharpness import (
    estimate_patch_flow,
    estimate_velocities,
    estimate_velocity,
    flow_warp_sharpness,
)
from texvent.sensor import SensorSize

SIZE = SensorSize(120, 60)


def moving_points(velocity, *, stop_us=40_000, left=20, right=100, seed=0, count=3000):
    """Events of 60 points that move as one, each seen whenever it enters a new pixel or time."""
    rng = np.random.default_rng(seed)
    x0, y0 = rng.uniform(left, right, 60), rng.uniform(10, 50, 60)
    t = np.sort(rng.integers(0, stop_us, count))
    which = rng.integers(0, 60, count)
    x = np.round(x0[which] + velocity[0] * t * 1e-6).astype(int)
    y = np.round(y0[which] + velocity[1] * t * 1e-6).astype(int)
    inside = (x >= 0) & (x < SIZE.width) & (y >= 0) & (y < SIZE.height)
    p = np.ones(int(inside.sum()), np.uint8)
    return EventStream(x[inside], y[inside], t[inside], p, SIZE)


@pytest.mark.parametrize("velocity", [(0.0, 0.0), (150.0, -60.0), (-700.0, 25.0)])
def test_the_velocity_of_moving_points_is_found_within_a_pixel_per_window(velocity):
    found = estimate_velocity(moving_points(velocity))
    assert found == pytest.approx(velocity, abs=1.0 / 0.04 + 1e-6)


def test_a_velocity_is_found_wherever_in_the_image_the_points_are():
    rng = np.random.default_rng(14)
    t = np.sort(rng.integers(0, 40_000, 400))
    places = rng.uniform(0, 8, (2, 40))[:, rng.integers(0, 40, 400)]
    moved = np.round(places + np.outer((300.0, 400.0), t) * 1e-6).astype(int)
    ones = np.ones(400, np.uint8)
    found = [estimate_velocity(EventStream(*moved + at, t, ones, SIZE)) for at in (0, 1, 30)]
    assert found[0] == found[1] == found[2] == pytest.approx((300, 400), abs=25)


def test_each_window_has_its_velocity_and_at_most_four_are_used():
    events = moving_points((100.0, 0.0), stop_us=400_000, left=0, right=60, count=9000)
    velocities = estimate_velocities(events)
    assert len(velocities) == 4
    assert np.mean(velocities, axis=0) == pytest.approx((100, 0), abs=25)


def test_patches_that_move_apart_have_their_own_flow():
    left = moving_points((-200.0, 0.0), left=15, right=50)
    right = moving_points((200.0, 0.0), left=65, right=105, seed=1)
    columns = [np.concatenate([getattr(one, name) for one in (left, right)]) for name in "xytp"]
    order = np.argsort(columns[2], kind="stable")
    both = EventStream(*(column[order] for column in columns), SIZE)
    flow = estimate_patch_flow(both, patch_px=60)
    assert flow.shape == (1, 2, 2)
    assert flow[0, :, 0] == pytest.approx([-200, 200], abs=20)


def moving_dots(speed_px_s, seconds=0.12):
    """Ten dots that fire 2000 times a second while they move right."""
    t = np.arange(0, seconds * 1e6, 500).astype(np.int64)
    columns = []
    for dot in range(10):
        x = 2 + 3 * dot + np.rint(speed_px_s * t / 1e6).astype(int)
        columns.append(np.stack([x, np.full(t.size, 3 * dot), t, np.ones(t.size, int)]))
    x, y, t, p = np.concatenate(columns, axis=1)
    order = np.argsort(t, kind="stable")
    return EventStream(x[order], y[order], t[order], p[order], SensorSize(64, 32))


def test_warping_along_the_true_flow_sharpens_and_along_another_blurs():
    events = moving_dots(200.0)
    true = flow_warp_sharpness(events, (200.0, 0.0))
    assert true > 5
    assert flow_warp_sharpness(events, (-200.0, 0.0)) < true / 3
    assert flow_warp_sharpness(events, (0.0, 0.0)) == pytest.approx(1.0)


def test_sharpness_of_dots_moving_whole_pixels_is_as_computed_by_hand():
    # One window: a dot fires once on each of 5 px, so warped it fires 5 times on one pixel.
    t = np.arange(5) * 10_000
    events = EventStream(np.arange(5), [0] * 5, t, [1] * 5, SensorSize(8, 4))
    value = flow_warp_sharpness(events, (100.0, 0.0), least_events=5)
    cells = (8 + 2 * 7) * (4 + 2 * 1)
    mean = 5 / cells
    assert value == pytest.approx((25 / cells - mean**2) / (5 / cells - mean**2))
