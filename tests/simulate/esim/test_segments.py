"""Threshold crossings on straight segments: hand-computed, and the compiled kernel against them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.simulate.references import segments

from texvent.simulate.esim.crossings import CrossingRules, CrossingState, Segments, cross_segments

KERNELS = [segments.cross_segments, cross_segments]
kernels = pytest.mark.parametrize("cross", KERNELS, ids=["reference", "cpu"])


def chain(*corners, pixel=0):
    """Segments of one pixel through (time, brightness) corners."""
    t, level = (np.array(column) for column in zip(*corners, strict=True))
    number = len(t) - 1
    return Segments(np.full(number, pixel), t[:-1], t[1:], level[:-1] + 0.0, level[1:] + 0.0)


def at_rest(pixels=1):
    return CrossingState(np.zeros(pixels), np.full(pixels, -(10**9)))


@kernels
def test_a_ramp_crosses_its_thresholds_at_the_exact_microseconds(cross):
    # Facts, ramp A: 1.05 log units in 1 s, θ = .2: true crossings 0.190476, .380952, ... s.
    state = at_rest()
    found = cross(chain((0, 0.0), (1_000_000, 1.05)), CrossingRules(0.2, 0.2, 0), state)
    assert found.t.tolist() == [190476, 380952, 571428, 761904, 952380]
    assert found.p.tolist() == [1] * 5
    assert state.reference[0] == pytest.approx(1.0)


@kernels
def test_cutting_the_ramp_anywhere_changes_no_crossing(cross):
    corners = [(0, 0.0), (250_000, 0.2625), (700_000, 0.735), (1_000_000, 1.05)]
    found = cross(chain(*corners), CrossingRules(0.2, 0.2, 0), at_rest())
    assert found.t.tolist() == [190476, 380952, 571428, 761904, 952380]
    assert found.row.tolist() == [0, 1, 1, 2, 2]


@kernels
def test_there_and_back_fires_on_and_off_with_thresholds_of_their_own(cross):
    # Up by .51 in 100 µs with θ_on = .2: .2 at 39.2 µs, .4 at 78.4 µs. Then down to .02 in another
    # 100 µs with θ_off = .15: .25 at 53.1 µs, .1 at 83.7 µs of it, where the reference ends.
    state = at_rest()
    found = cross(chain((0, 0.0), (100, 0.51), (200, 0.02)), CrossingRules(0.2, 0.15, 0), state)
    assert found.t.tolist() == [39, 78, 153, 183]
    assert found.p.tolist() == [1, 1, 0, 0]
    assert state.reference[0] == pytest.approx(0.1)


@kernels
def test_crossings_in_the_refractory_period_are_lost_and_still_move_the_reference(cross):
    state = at_rest()
    found = cross(chain((0, 0.0), (100, 0.5)), CrossingRules(0.1, 0.1, 45), state)
    # Crossings at 20, 40, 60, 80 (and 100 → 99): 20, then 80 is the first 45 µs later.
    assert found.t.tolist() == [20, 80]
    assert state.reference[0] == pytest.approx(0.5)
    assert state.fired_us.tolist() == [80]


@kernels
def test_a_level_that_was_reached_before_fires_at_once(cross):
    found = cross(chain((10, 0.25), (20, 0.25)), CrossingRules(0.2, 0.2, 0), at_rest())
    assert found.t.tolist() == [10]


@given(st.integers(0, 2**32), st.sampled_from([0, 3, 50]))
def test_compiled_kernel_equals_the_definition(seed, refractory_us):
    rng = np.random.default_rng(seed)
    chains = [
        chain(*zip(range(0, 120, 30), rng.normal(0, 0.6, 4).tolist(), strict=True), pixel=pixel)
        for pixel in range(5)
    ]
    given_segments = Segments(*(np.concatenate(column) for column in zip(*chains, strict=True)))
    rules = CrossingRules(*rng.uniform(0.01, 0.4, 2).tolist(), refractory_us)
    states = [at_rest(5), at_rest(5)]
    one, other = (
        cross(given_segments, rules, state) for cross, state in zip(KERNELS, states, strict=True)
    )
    for mine, theirs in zip((*one, *states[0]), (*other, *states[1]), strict=True):
        np.testing.assert_array_equal(mine, theirs)
