"""Time surfaces and N-ImageNet's images of the last events: by hand, and as they are defined."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.represent.time_surface import (
    dist,
    event_image,
    sorted_time_surface,
    time_surface,
    timestamp_image,
)
from texvent.sensor import SensorSize

from . import definitions
from .definitions import SMALL, random_events, streams

ALL = (timestamp_image, event_image, sorted_time_surface, dist)


def test_exponential_and_linear_decay_by_hand():
    events = EventStream([0, 0, 1], [0, 0, 2], [0, 60, 100], [1, 1, 0], SMALL)
    surface = time_surface(events, tau_us=80)
    assert surface.dtype == np.float32
    assert surface[1, 0, 0] == np.float32(math.exp(-0.5))
    assert surface[0, 2, 1] == 1
    assert np.count_nonzero(surface) == 2
    linear = time_surface(events, tau_us=80, decay="linear", at_us=160)
    assert linear[1, 0, 0] == 0  # 100 µs old
    assert linear[0, 2, 1] == 0.25


@given(
    streams(),
    st.sampled_from([1, 20_000]),
    st.sampled_from(["exponential", "linear"]),
    st.one_of(st.none(), st.integers(-10, 60_000)),
)
def test_a_time_surface_equals_its_definition(events, tau_us, decay, offset_us):
    at_us = None
    if offset_us is not None:
        at_us = offset_us + (int(events.t[0]) if len(events) else 0)
    surface = time_surface(events, tau_us=tau_us, decay=decay, at_us=at_us)
    instant = at_us if at_us is not None else int(events.t[-1]) if len(events) else 0
    expected = definitions.time_surface(events, tau_us, decay, instant)
    np.testing.assert_array_max_ulp(surface, expected, maxulp=1)


@pytest.mark.parametrize("function", ALL)
@given(events=streams())
def test_it_equals_its_definition(function, events):
    expected = getattr(definitions, function.__name__)(events)
    found = function(events)
    assert found.dtype == np.float32
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("function", ALL)
@pytest.mark.parametrize("count", [40, 400])
def test_it_equals_its_definition_with_many_events(function, count):
    events = random_events(count, count, SensorSize(19, 14))
    np.testing.assert_array_equal(function(events), getattr(definitions, function.__name__)(events))


def test_times_are_shares_of_the_slice_and_on_comes_first():
    events = EventStream([0, 1, 0, 2], [0, 0, 0, 0], [100, 105, 110, 120], [1, 0, 1, 0], (3, 1))
    np.testing.assert_allclose(timestamp_image(events)[:, 0], [[0.5, 0, 0], [0, 0.25, 1]])


def test_the_event_image_has_counts_before_times():
    events = EventStream([0, 0, 1, 2], [0] * 4, [0, 10, 20, 40], [1, 1, 1, 0], (3, 1))
    np.testing.assert_allclose(
        event_image(events)[:, 0], [[1, 0.5, 0], [0.25, 0.5, 0], [0, 0, 1], [0, 0, 1]]
    )


def test_a_sorted_time_surface_knows_the_order_alone():
    events = EventStream([0, 1, 2, 3], [0] * 4, [0, 1, 1, 1000], [1, 1, 1, 1], (4, 1))
    assert sorted_time_surface(events)[0, 0].tolist() == [0, 0.5, 0.5, 1]


def test_dist_discounts_pixels_by_the_rate_around_them():
    # Two neighbours at 60 and 100 µs, twice two of them 30 px apart, the second with more events:
    # 100 − 3 · 40 / 2 = 40 and 60 − 60 = 0; with 4 events 100 − 30 = 70 and 60 − 30 = 30.
    x = [59, 0, 30, 30, 30, 1, 31]
    t = [0, 60, 60, 60, 60, 100, 100]
    events = EventStream(x, [0] * 7, t, [1] * 7, SensorSize(60, 1))
    ranks = dist(events)[0, 0]
    # Of 60 pixels two have 1 event more than most, one 3: counts are clipped at 2, so 3 events
    # around, and 100 − 40 = 60 and 60 − 40 = 20. Different values: 0, 20, 40, 60.
    assert ranks[[59, 0, 1, 30, 31]].tolist() == [0, 0, 0.5, 0.25, 0.75]
    assert np.count_nonzero(ranks) == 3


def test_dist_of_events_that_are_alone_and_of_few_on_a_large_sensor():
    alone = EventStream([0, 9], [0, 0], [10, 20], [1, 1], SensorSize(10, 1))
    assert not dist(alone).any()
    # Under 1 % of the pixels: counts are clipped to 0, and nothing is discounted.
    few = EventStream([3, 4], [5, 5], [0, 20], [1, 1], SensorSize(20, 20))
    assert dist(few)[0, 5, 4] == 0.5
