import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.metrics.spike_trains.victor_purpura import VictorPurpura, edit_cost

from .. import slow
from ..recordings import one_event, random_events

TIMES = st.lists(st.integers(0, 30_000), max_size=6).map(sorted)


@pytest.mark.parametrize(
    ("delay_us", "expected"), [(1250, 0.125), (5000, 0.5), (10_000, 1.0), (40_000, 1.0)]
)
def test_a_delayed_event_costs_its_shift_up_to_a_deletion(delay_us, expected):
    assert VictorPurpura()(one_event(t=1000 + delay_us), one_event()) == pytest.approx(expected)


@given(a=TIMES, b=TIMES)
def test_edit_cost_is_the_cheapest_of_all_pairings(a, b):
    value = edit_cost(np.array(a, np.int64), np.array(b, np.int64), 2e-4)
    assert value == pytest.approx(slow.cheapest_edit(a, b, 2e-4))


@given(a=TIMES, b=TIMES, c=TIMES)
def test_edit_cost_obeys_the_triangle_inequality(a, b, c):
    def cost(first, second):
        return edit_cost(np.array(first, np.int64), np.array(second, np.int64), 2e-4)

    assert cost(a, c) <= cost(a, b) + cost(b, c) + 1e-9


def test_all_trains_together_are_the_sum_of_the_trains():
    a, b = random_events(1, 300), random_events(2, 300)
    every = VictorPurpura(trains=10_000)(a, b)
    one, two = slow.trains(a), slow.trains(b)
    cost = sum(
        edit_cost(np.array(one.get(key, []), np.int64), np.array(two.get(key, []), np.int64), 2e-4)
        for key in set(one) | set(two)
    )
    assert every == pytest.approx(cost / 600)
    assert VictorPurpura(trains=150)(a, b) == pytest.approx(every, abs=0.1)


def test_two_empty_streams_are_undefined():
    nothing = EventStream.empty(one_event().size)
    assert math.isnan(VictorPurpura()(nothing, nothing))
