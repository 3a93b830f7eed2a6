import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.represent.time_surface import time_surface

from . import definitions
from .definitions import SMALL, streams


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


def test_events_after_the_instant_do_not_count():
    events = EventStream([0, 0], [0, 0], [10, 20], [1, 1], SMALL)
    assert time_surface(events, tau_us=10, at_us=15)[1, 0, 0] == np.float32(math.exp(-0.5))
    assert not time_surface(events, at_us=9).any()


@given(
    streams(),
    st.sampled_from([1, 20_000]),
    st.sampled_from(["exponential", "linear"]),
    st.one_of(st.none(), st.integers(-10, 60_000)),
)
def test_it_equals_its_definition(events, tau_us, decay, offset_us):
    at_us = None
    if offset_us is not None:
        at_us = offset_us + (int(events.t[0]) if len(events) else 0)
    surface = time_surface(events, tau_us=tau_us, decay=decay, at_us=at_us)
    instant = at_us if at_us is not None else int(events.t[-1]) if len(events) else 0
    expected = definitions.time_surface(events, tau_us, decay, instant)
    np.testing.assert_array_max_ulp(surface, expected, maxulp=1)
