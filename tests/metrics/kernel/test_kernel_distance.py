"""The kernel distance against pairs of events weighted one by one."""

import math
import tracemalloc

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.metrics.kernel.distance import KernelDistance
from texvent.sensor import SensorSize

from .. import slow
from ..recordings import one_event, random_events


@pytest.mark.parametrize(("delay_ms", "expected"), [(2, 0.1175), (4, 0.3935), (8, 0.8647)])
def test_a_delayed_event_scores_one_minus_the_gaussian_of_the_delay(delay_ms, expected):
    value = KernelDistance()(one_event(t=1000 + 1000 * delay_ms), one_event())
    assert value == pytest.approx(1 - math.exp(-(delay_ms**2) / 32), abs=1e-5)
    assert value == pytest.approx(expected, abs=5e-5)


def test_an_event_one_pixel_away_scores_one_minus_the_gaussian_of_the_distance():
    value = KernelDistance()(one_event(x=1, y=1), one_event())
    assert value == pytest.approx(1 - math.exp(-2 / (2 * 1.5**2)), abs=1e-5)


def test_equal_streams_are_at_zero_and_opposite_polarities_at_one():
    a = random_events(1)
    opposite = EventStream(a.x, a.y, a.t, 1 - a.p, a.size)
    assert KernelDistance()(a, a) == pytest.approx(0.0, abs=1e-6)
    assert KernelDistance()(one_event(p=0), one_event()) == 1.0
    assert 0 < KernelDistance()(opposite, a) <= 1


@pytest.mark.parametrize("size", [SensorSize(5, 70), SensorSize(70, 5)])
def test_cells_and_bins_add_up_to_all_pairs(size):
    a, b = (random_events(seed, 250, size, 500_000) for seed in (1, 2))
    # Each stream repeats the other half the time, so that there is much in common.
    mixed = EventStream.concat([a.between(0, 250_000), b.between(250_000, 500_000)])
    for other in (b, mixed):
        assert KernelDistance()(a, other) == pytest.approx(slow.kernel(a, other), abs=2e-5)


def test_two_empty_streams_are_undefined():
    nothing = EventStream.empty(one_event().size)
    assert math.isnan(KernelDistance()(nothing, nothing))
    assert KernelDistance()(nothing, one_event()) == 1.0


def test_negative_times_fall_into_bins_like_others():
    a = random_events(3)
    b = random_events(4)
    earlier = [EventStream(one.x, one.y, one.t - 1_024_000, one.p, one.size) for one in (a, b)]
    assert KernelDistance()(*earlier) == pytest.approx(KernelDistance()(a, b))
    assert np.isfinite(KernelDistance()(*earlier))


def test_memory_follows_the_events_not_the_length_or_the_sensor():
    """Dense blocks of the sensor took 2.9 GB for 1280x720."""
    size = SensorSize(1280, 720)
    a, b = (random_events(seed, 2000, size, 3_000_000) for seed in (1, 2))
    KernelDistance()(a, b)
    tracemalloc.start()
    KernelDistance()(a, b)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 32e6
