"""The judge of event filters, on curves and recordings of which the answer is known."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.events import EventStream
from texvent_lab.measure.event_filters import Curve, judge


def test_the_area_is_one_for_a_perfect_filter_and_half_for_a_guess() -> None:
    assert Curve(np.array([1.0]), np.array([0.0])).area == 1.0
    assert Curve(np.array([0.3, 0.6]), np.array([0.3, 0.6])).area == pytest.approx(0.5)
    one = Curve(np.array([0.8]), np.array([0.2]))
    assert one.area == pytest.approx(0.5 * 0.2 * 0.8 + 0.8 * 0.9)
    assert one.signal_at(0.1) == pytest.approx(0.4)


def test_signal_that_comes_in_pairs_is_told_from_lone_noise() -> None:
    rows = [(4, 4, 1000, 0), (5, 4, 1100, 0), (9, 1, 2_000_000, 1), (2, 8, 9_000_000, 1)]
    x, y, t, label = np.array(rows).T
    events = EventStream(x, y, t, np.ones_like(x), (16, 12), label=label)
    curve = judge(events, {})
    assert set(curve.noise) == {0.0}
    assert set(curve.signal) == {0.5}
