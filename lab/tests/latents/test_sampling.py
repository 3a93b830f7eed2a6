"""Events from changes: numbers by thresholds, times by LDATI."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import texvent
from texvent.events import EventStream
from texvent_lab.latents.change import BrightnessChange, node_grid, sample_packets

THRESHOLD = 0.25


def change_of(voxels) -> BrightnessChange:
    """Bins of 10 ms."""
    values = np.asarray(voxels, np.float32)
    return BrightnessChange(values, Fraction(200), 2 * values.shape[1])


def sample(voxels) -> EventStream:
    packets = sample_packets(change_of(voxels), contrast_threshold=THRESHOLD)
    return EventStream.concat(list(packets))


def count_by_pixel(voxels) -> list[int]:
    """The definition, pixel by pixel: events of each bin, ON positive."""
    distance, counts = 0.0, []
    for change in voxels:
        distance += change / THRESHOLD
        fired = 0
        while abs(distance) >= 1:
            step = 1 if distance > 0 else -1
            distance -= step
            fired += step
        counts.append(fired)
    return counts


def test_a_lone_event_happens_where_the_brightness_crosses_the_threshold() -> None:
    # 0.1 + 0.2 passes 0.25 three quarters into the second bin; the fourth passes 0.
    events = sample(np.reshape([0.1, 0.2, 0.0, -0.4], (1, 4, 1, 1)))
    assert events.polarity.tolist() == [1, -1]
    assert events.t.tolist() == pytest.approx([17_500, 37_500], abs=1)


def test_the_distance_is_kept_from_one_interval_to_the_next() -> None:
    events = sample(np.full((3, 1, 1, 1), 0.15))
    # 0.25 is 2/3 into the second interval.
    assert events.t.tolist() == pytest.approx([16_667], abs=1)


def test_the_grid_of_a_bin_with_two_events_by_hand() -> None:
    # From 0, 0.6 crosses 0.25 and 0.5: τ = 5/12 and 10/12.
    grid, distance = node_grid(np.full((1, 1, 1), 0.6), np.zeros((1, 1)), THRESHOLD)
    np.testing.assert_allclose(grid[0, :, 0, 0], [2 - 15 / 12, 15 / 12])
    assert not grid[1].any()
    assert distance[0, 0] == pytest.approx(0.1)


# Of a 1024th: no sum lies within rounding of a threshold by chance.
steps = st.integers(-900, 900).map(lambda value: value / 1024)


@given(arrays(np.float32, (2, 3, 2, 2), elements=steps))
def test_numbers_of_events_are_those_of_the_definition(voxels) -> None:
    distance = np.zeros((2, 2))
    found = []
    for interval in voxels:
        grid, distance = node_grid(interval, distance, THRESHOLD)
        assert (grid >= -1e-9).all()
        found.append(grid.sum(axis=1))
    for y, x in np.ndindex(2, 2):
        counts = count_by_pixel(voxels[..., y, x].astype(np.float64).ravel())
        expected = np.reshape(counts, (2, 3))
        for number in range(2):
            on, off = expected[number].clip(0).sum(), (-expected[number]).clip(0).sum()
            assert found[number][:, y, x] == pytest.approx([on, off], abs=1e-6)


def test_lone_events_are_those_of_ideal_pixels_on_the_same_changes() -> None:
    chance = np.random.default_rng(0)
    voxels = chance.uniform(-0.2, 0.2, (3, 4, 5, 6)).astype(np.float32)
    change = change_of(voxels)
    frames = list(change.frames())
    ideal = texvent.simulate(
        np.stack([one.pixels for one in frames]),
        t_us=[one.t_us for one in frames],
        interpolate="none",
        simulator="esim",
        log_eps=30 / 255,
        contrast_threshold_on=THRESHOLD,
        contrast_threshold_off=THRESHOLD,
    )
    found = sample(voxels)
    assert len(found) == len(ideal) > 50
    order, other = (np.lexsort((one.t, one.x, one.y)) for one in (found, ideal))
    assert (found.x[order] == ideal.x[other]).all()
    assert (found.p[order] == ideal.p[other]).all()
    assert np.abs(found.t[order] - ideal.t[other]).max() <= 2


def test_no_change_gives_empty_packets() -> None:
    packets = list(sample_packets(change_of(np.zeros((3, 2, 4, 5)))))
    assert [len(one) for one in packets] == [0, 0, 0]
    assert packets[0].size == (5, 4)
