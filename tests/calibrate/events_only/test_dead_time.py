import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from texvent.calibrate.estimates import Estimate
from texvent.calibrate.events_only.pixel_trains import find_dead_time


def test_rare_intervals_only_bound_it():
    assert find_dead_time(np.array([400.0] * 49)) == "49 intervals; 50 are needed"
    sparse = find_dead_time(np.linspace(1_000, 100_000, 50))
    assert sparse == "intervals near it are too rare; it is at most 1000 µs"


@given(dead=st.integers(100, 5_000), seed=st.integers(0, 1000))
def test_the_dead_time_is_within_its_interval(dead, seed):
    waits = dead + np.random.default_rng(seed).exponential(dead * 50, 20_000)
    found = find_dead_time(waits)
    assert isinstance(found, Estimate)
    # The shortest of them lies above; 1/ρ is the mean gap, of which the interval holds three.
    assert found.low - 0.05 * dead <= dead <= found.high
