"""Time surfaces and timestamp images: by hand, and as they are defined."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.represent.time_surface import time_surface, timestamp_image
from texvent.sensor import SensorSize

from . import definitions
from .definitions import SMALL, random_events, streams


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


@given(events=streams())
@example(events=random_events(400, 400, SensorSize(19, 14)))
def test_a_timestamp_image_equals_its_definition(events):
    found = timestamp_image(events)
    assert found.dtype == np.float32
    np.testing.assert_array_equal(found, definitions.timestamp_image(events))


@pytest.mark.parametrize("decay", ["exponential", "linear"])
@pytest.mark.parametrize("at_us", [-(10**15), 0, 59_999_999, 10**15])
def test_instants_far_from_the_events_see_nothing(decay, at_us):
    events = EventStream([0, 1], [0, 0], [60_000_000, 60_000_005], [1, 0], SensorSize(2, 1))
    assert not time_surface(events, tau_us=1, decay=decay, at_us=at_us).any()
