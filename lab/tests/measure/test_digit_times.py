"""Surfaces whose times are moved or replaced, against the ages that they stand for."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from texvent_lab.measure.digit_times import DELAYS_MS, SPREADS_MS, replaced, times_of


def surface(age_ms, is_event):
    return np.where(is_event, np.exp(-age_ms / 100), 0.0)


@given(seed=st.integers(0, 999))
def test_recordings_have_one_property_replaced(seed):
    rng = np.random.default_rng(seed)
    shape = (3, 2, 4, 4)
    age, other, counts = (
        rng.uniform(0, 300, shape),
        rng.uniform(0, 300, shape),
        rng.poisson(1, shape),
    )
    recorded = surface(age, counts > 0)
    rows = dict(replaced(recorded, counts))
    assert np.array_equal(rows.pop("nothing"), recorded)
    for delay in DELAYS_MS:  # later events are younger, and none lies after the end
        found = rows.pop(f"all times {delay:+d} ms")
        assert np.allclose(found, surface(np.maximum(age - delay, 0), counts > 0))
    lone = rows.pop("no pixels of a single event")
    assert np.array_equal(lone, np.where(counts.sum(axis=1)[:, None] == 1, 0, recorded))
    for spread, found in zip(SPREADS_MS, rows.values(), strict=True):
        is_known = (counts > 0) & (found < 1)
        moves = 100 * np.log(found[is_known] / recorded[is_known]) / spread
        assert np.abs(moves).max() < 5
        assert np.array_equal(found > 0, counts > 0)
    is_there = rng.random(shape) < 0.5
    assert np.allclose(times_of(surface(other, is_there), recorded),
                       surface(np.where(is_there, other, age), counts > 0))  # fmt: skip
