"""Flow-warp sharpness and event structural ratio."""

import math

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.metrics.event_sharpness import (
    FlowWarpRatio,
    StructuralRatioQuotient,
    flow_warp_sharpness,
    structural_ratio,
)
from texvent.sensor import SensorSize

from ..recordings import SMALL, random_events


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


def test_structural_ratio_is_as_computed_by_hand():
    # N = 4, M = 2: counts 3 and 1 on 156 pixels.
    events = EventStream([0, 0, 0, 1], [0] * 4, [1, 2, 3, 4], [1] * 4, SMALL)
    value = structural_ratio(events, packet_events=4, reference_events=2)
    pairs = 3 * 2 / (4 * 3)
    active = 156 - (154 + 0.5**3 + 0.5)
    assert value == pytest.approx(math.sqrt(pairs * active))


def test_structural_ratio_needs_a_complete_packet():
    assert math.isnan(structural_ratio(random_events(1, 29_999)))
    repeated = structural_ratio(random_events(1, 400), packet_events=100, reference_events=60)
    assert repeated > 0


def test_blurred_events_are_less_sharp_than_the_reference_along_its_own_motion():
    events = moving_dots(200.0)
    rng = np.random.default_rng(0)
    spread = np.clip(events.x + rng.integers(-3, 4, len(events)), 0, events.size.width - 1)
    blurred = EventStream(spread, events.y, events.t, events.p, events.size)
    assert FlowWarpRatio()(events, events) == 1.0
    assert FlowWarpRatio()(blurred, events) < 0.5
    # Motion is sought in the reference: events that do not move along it lose.
    other_way = EventStream(63 - events.x, events.y, events.t, events.p, events.size)
    assert FlowWarpRatio()(other_way, events) < 0.5


def test_structural_ratios_are_compared_at_one_length():
    # N = 3, M = 2. Judged: all on one pixel, 1 of 1 pairs and 1 - (1/3)^3 pixels; true: 2 and 1.
    judged = EventStream([0, 0, 0], [0] * 3, [1, 2, 3], [1] * 3, SMALL)
    true = EventStream([0, 0, 1, 5], [0] * 4, [1, 2, 3, 4], [1] * 4, SMALL)
    above = 1 - (1 / 3) ** 3
    below = 2 / 6 * (2 - (1 / 3) ** 2 - 1 / 3)
    assert StructuralRatioQuotient()(judged, true) == pytest.approx(math.sqrt(above / below))
    alone = EventStream([0, 1, 2], [0] * 3, [1, 2, 3], [1] * 3, SMALL)
    assert math.isnan(StructuralRatioQuotient()(judged, alone))
    assert math.isnan(StructuralRatioQuotient()(judged, judged[:1]))
