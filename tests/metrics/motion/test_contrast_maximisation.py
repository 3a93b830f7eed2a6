"""Velocities that a moving pattern of points has, found from its events alone."""

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.metrics.event_sharpness import (
    estimate_patch_flow,
    estimate_velocities,
    estimate_velocity,
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
