"""Eq. 7 and its alternatives, as fractions of a sub-interval, by hand."""

import numpy as np
import pytest

from texvent.simulate.packets import FrameInterval
from texvent.simulate.random.draws import frame_key
from texvent.simulate.texvent.event_frame import EventFrame, list_threshold_crossings
from texvent.simulate.texvent.timestamps import (
    SubInterval,
    larger_change_earlier,
    reconstruct_timestamps,
)

THRESHOLD = 0.2


def interval(previous, brightness, reference, stop_us=10_000) -> SubInterval:
    columns = tuple(np.array(one, np.float64) for one in (previous, brightness, reference))
    pixel = np.arange(columns[0].size)
    return SubInterval(FrameInterval(0, stop_us, frame_key(0, 0)), pixel.size, pixel, columns)


def crossings(changes, numbers=None):
    changes = np.array(changes, np.float64)
    numbers = np.ones(changes.size, np.int64) if numbers is None else np.array(numbers)
    return list_threshold_crossings(EventFrame(np.arange(changes.size), changes, numbers))


def times(stamp, changes, *, numbers=None, previous=None, reference=None, scale=1.0):
    reference = np.zeros(len(changes)) if reference is None else np.array(reference)
    previous = reference if previous is None else previous
    where = interval(previous, reference + np.array(changes), reference)
    return reconstruct_timestamps(
        crossings(changes, numbers), where, timestamp_rule=stamp, threshold=THRESHOLD, scale=scale
    ).tolist()


def test_eq7_three_pixels():
    assert times("eq7", [0.25, 0.30, 0.45]) == pytest.approx([9999, 7500, 0], abs=1)
    assert larger_change_earlier(np.array([0.25, 0.30, 0.45])) == pytest.approx([1, 0.75, 0])


def test_eq7_looks_at_the_size_of_the_change_not_its_sign():
    assert times("eq7", [0.25, -0.30, -0.45]) == times("eq7", [0.25, 0.30, 0.45])


def test_eq7_equal_changes_are_in_the_middle():
    assert times("eq7", [0.3, -0.3]) == [5000, 5000]
    assert times("eq7", [0.3]) == [5000]


def test_eq7_scale_multiplies_the_offset():
    assert times("eq7", [0.25, 0.45], scale=0.1) == [1000, 0]


def test_linear_crossing_starts_at_the_previous_brightness():
    """From 0.1 to 0.5 above the reference, δ = 0.2 lies a quarter of the way up."""
    assert times("linear", [0.5], previous=[0.1]) == pytest.approx([2500], abs=1)
    assert times("linear", [-0.5], previous=[-0.1]) == pytest.approx([2500], abs=1)


def test_linear_crossing_lists_all_thresholds():
    assert times("linear", [0.7], numbers=[3]) == pytest.approx([2857, 5714, 8571], abs=1)


def test_linear_crossing_left_over_from_before_is_at_the_start():
    assert times("linear", [0.5], previous=[0.3]) == [0]
    assert times("linear", [0.5], previous=[0.5]) == [0]
    assert times("linear", [-0.5], previous=[-0.9]) == [0]
    assert times("linear", [0.2], previous=[0.2]) == [0]


def test_linear_crossing_that_rounding_puts_after_the_end_is_at_the_end():
    assert times("linear", [np.nextafter(0.2, 0)]) == [9999]


def test_hyperbolic_crossing_is_threshold_over_change():
    assert times("hyperbolic", [0.4, -0.8]) == [5000, 2500]
    assert times("hyperbolic", [0.8], numbers=[2]) == [2500, 5000]


def test_even_and_end():
    assert times("even", [0.8, 0.25], numbers=[4, 1]) == [2500, 5000, 7500, 9999, 9999]
    assert times("end", [0.8, 0.25]) == [9999, 9999]


def test_random_times_are_uniform_and_differ_between_events_of_a_pixel():
    sample = np.array(times("random", [0.5] * 4000, numbers=[2] * 4000))
    counts = np.histogram(sample, bins=20, range=(0, 10_000))[0]
    assert float(((counts - 400) ** 2 / 400).sum()) < 19 + 5 * np.sqrt(2 * 19)
    assert np.corrcoef(sample[::2], sample[1::2])[0, 1] == pytest.approx(0, abs=5 / np.sqrt(4000))


def test_times_never_reach_the_end_of_the_shortest_interval():
    shortest = interval([0.0], [0.3], [0.0], stop_us=1)
    for stamp in ("eq7", "random", "linear", "hyperbolic", "even", "end"):
        t = reconstruct_timestamps(
            crossings([0.3]), shortest, timestamp_rule=stamp, threshold=THRESHOLD
        )
        assert t.tolist() == [0]
