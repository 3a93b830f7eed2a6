"""Batching and cadence."""

import math
from fractions import Fraction

import numpy as np

from texvent.events import EventStream
from texvent.metrics.timing.batching import BatchingDifference, same_timestamp_share
from texvent.metrics.timing.cadence import CadenceDifference, cadence_energy

from ..recordings import SMALL, one_event


def test_only_groups_of_twenty_count_as_batches():
    times = [5] * 20 + [9] * 19 + [12]
    a = EventStream([0] * 40, [0] * 40, times, [1] * 40, SMALL)
    assert same_timestamp_share(a) == 0.5
    assert math.isnan(same_timestamp_share(a[:0]))
    assert BatchingDifference()(a, a[20:]) == 0.5


def beating(rate_hz, seconds=0.5, count=4000, depth=1.0):
    """Events whose rate beats as 1 + depth · cos, by inverse sampling on a fine grid."""
    grid = np.linspace(0, seconds, 200_001)
    rate = 1 + depth * np.cos(2 * np.pi * rate_hz * grid)
    share = np.cumsum(rate) / rate.sum()
    t = np.interp((np.arange(count) + 0.5) / count, share, grid) * 1e6
    zero = np.zeros(count, int)
    return EventStream(zero, zero, t.astype(np.int64), zero, SMALL)


def test_cadence_energy_finds_a_beat_at_the_frame_rate_and_its_multiples_only():
    span = (0, 500_000)
    assert cadence_energy(beating(24), span_us=span) > 0.9
    assert cadence_energy(beating(72), span_us=span) > 0.9
    assert cadence_energy(beating(36), span_us=span) < 0.1
    assert cadence_energy(beating(36), Fraction(36), span_us=span) > 0.9
    assert CadenceDifference()(beating(24), beating(36)) > 0.8


def test_cadence_energy_of_short_or_endless_spans_is_undefined():
    assert math.isnan(cadence_energy(one_event()))
    assert math.isnan(cadence_energy(one_event()[:0]))
    assert math.isnan(cadence_energy(one_event(), span_us=(0, 10**12)))
