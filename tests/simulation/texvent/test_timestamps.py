"""Eq. 7 and the other rules by hand, as times of a sub-interval of 10 ms."""

import numpy as np
import pytest

from texvent.simulation.packets import FrameInterval
from texvent.simulation.random.draws import frame_key
from texvent.simulation.texvent.config import TexventConfig
from texvent.simulation.texvent.noise import QUIET
from texvent.simulation.texvent.pixel_memory import FiredPixels
from texvent.simulation.texvent.timestamps import timestamp_events

THRESHOLD = 0.2
RULES = ("eq7", "random", "linear", "end")


def times(rule, changes, *, before=0.0, multi_event=False, stop_us=10_000) -> list[int]:
    """Times of the events of pixels whose reference is 0, pixel by pixel."""
    change = np.array(changes, np.float64)
    starts, references = np.full(change.size, before), np.zeros(change.size)
    fired = FiredPixels(np.arange(change.size), change, starts, change, references)
    config = TexventConfig(
        timestamp_rule=rule, contrast_threshold=THRESHOLD, multi_event=multi_event
    )
    span = FrameInterval(0, stop_us, frame_key(0, 0))
    x, _, t, _, _ = timestamp_events(fired, QUIET, config, span, (1, change.size))
    return t[np.lexsort((t, x))].tolist()


def test_eq7_three_pixels():
    """u = 1 - (Δ - 0.25) / 0.20: 1, 0.75, 0; the end of the interval is left out."""
    assert times("eq7", [0.25, 0.30, 0.45]) == pytest.approx([9999, 7500, 0], abs=1)


def test_eq7_looks_at_the_size_of_the_change_not_its_sign():
    assert times("eq7", [0.25, -0.30, -0.45]) == times("eq7", [0.25, 0.30, 0.45])


def test_eq7_equal_changes_are_in_the_middle():
    assert times("eq7", [0.3, -0.3]) == [5000, 5000]
    assert times("eq7", [0.3]) == [5000]


@pytest.mark.parametrize(
    ("change", "before", "expected"),
    [
        # From 0.1 to 0.5 above the reference, δ = 0.2 lies a quarter of the way up.
        *((0.5, 0.1, 2500), (-0.5, -0.1, 2500)),
        # What is left over from before is due at the start, what rounding puts off at the end.
        *((0.5, 0.3, 0), (0.5, 0.5, 0), (-0.5, -0.9, 0), (0.2, 0.2, 0)),
        (np.nextafter(0.2, 0), 0.0, 9999),
    ],
)
def test_linear_crossing_starts_at_the_previous_brightness(change, before, expected):
    slack = 1 if expected == 2500 else 0
    assert times("linear", [change], before=before) == pytest.approx([expected], abs=slack)


def test_random_times_are_uniform_and_differ_between_events_of_a_pixel():
    sample = np.array(times("random", [0.5] * 4000, multi_event=True))
    counts = np.histogram(sample, bins=20, range=(0, 10_000))[0]
    assert float(((counts - 400) ** 2 / 400).sum()) < 19 + 5 * np.sqrt(2 * 19)
    earlier, later = sample.reshape(-1, 2).T
    # Sorted pairs of uniform numbers: means of a third and two thirds, correlation one half.
    assert earlier.mean() == pytest.approx(10_000 / 3, rel=0.05)
    assert np.corrcoef(earlier, later)[0, 1] == pytest.approx(0.5, abs=5 / np.sqrt(4000))


@pytest.mark.parametrize("rule", RULES)
def test_times_never_reach_the_end_of_the_shortest_interval(rule):
    assert times(rule, [0.3], stop_us=1) == [0]
