import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from texvent.errors import ConfigError
from texvent.simulate.kernels.ramp import Ramp, Rest, load_cross_ramp

SHAPE = (12,)
NEVER = -(2**62)
changes = arrays(np.float64, SHAPE, elements=st.floats(-2, 2))
thresholds = arrays(np.float64, SHAPE, elements=st.floats(0.05, 0.5))
rests = st.builds(Rest, st.sampled_from([0, 1, 300, 5000]), st.booleans())


def cross(backend, ramp, fired_us=None, *, span=(0, 1000), rest=None):
    fired = np.full(ramp.start.shape, NEVER) if fired_us is None else fired_us
    return load_cross_ramp(backend)(ramp, fired, span, rest or Rest(0, True))


def one(start, stop, on=0.2, off=0.2):
    values = (np.array([float(value)]) for value in (start, stop, on, off))
    return Ramp(np.zeros(1, np.int64), *values)


def test_levels_are_crossed_where_the_line_meets_them(backend):
    # From 0.1 to 0.7 in 1000 µs: 0.2, 0.4 and 0.6 at 1/6, 1/2 and 5/6.
    found = cross(backend, one(0.1, 0.7))
    assert found.t.tolist() == [166, 500, 833]
    assert found.p.tolist() == [1, 1, 1]
    assert found.steps.tolist() == [3]


def test_a_level_met_exactly_at_the_end_fires_in_the_last_microsecond(backend):
    assert cross(backend, one(0.0, 0.25, on=0.25)).t.tolist() == [999]


def test_a_level_passed_before_the_start_fires_at_once(backend):
    found = cross(backend, one(0.5, 0.45))
    assert found.t.tolist() == [0, 0]


def test_off_uses_its_own_threshold(backend):
    found = cross(backend, one(0.0, -0.35, on=0.2, off=0.1))
    assert found.p.tolist() == [0, 0, 0]
    assert found.steps.tolist() == [-3]


@pytest.mark.parametrize(("is_level_lost", "steps"), [(True, 5), (False, 2)])
def test_a_rest_keeps_or_loses_the_levels_it_swallows(backend, is_level_lost, steps):
    fired = np.full(1, NEVER)
    found = cross(backend, one(0.0, 1.05), fired, rest=Rest(500, is_level_lost))
    assert found.t.tolist() == [190, 761]
    assert found.steps.tolist() == [steps]
    assert fired.tolist() == [761]


@settings(max_examples=60, deadline=None)
@given(changes, changes, thresholds, thresholds, rests, st.sampled_from([1, 2, 1000, 41_667]))
def test_backends_agree_and_crossings_are_sound(start, stop, on, off, rest, duration):
    # Every other pixel of a sensor of twice as many.
    pixel = np.arange(0, 24, 2)
    ramp, span = Ramp(pixel, start, stop, on, off), (70, 70 + duration)
    times = [np.full(24, NEVER) for _ in range(2)]
    reference = cross("reference", ramp, times[0], span=span, rest=rest)
    compiled = cross("cpu", ramp, times[1], span=span, rest=rest)
    for ours, theirs in zip(reference, compiled, strict=True):
        assert np.array_equal(ours, theirs)
    assert np.array_equal(*times)
    assert (times[0][1::2] == NEVER).all()
    assert ((reference.t >= 70) & (reference.t < 70 + duration)).all()
    order = np.lexsort((reference.t, reference.pixel))
    assert (order == np.arange(len(order))).all()
    if rest.period_us == 0:
        left = stop - reference.steps * np.where(reference.steps > 0, on, off)
        assert (left < on).all()
        assert (-left < off).all()
        assert len(reference.t) == np.abs(reference.steps).sum()


def test_a_crossing_far_in_time_is_exact(backend):
    late = 10**15
    found = cross(backend, one(0.0, 0.3), span=(late, late + 900))
    assert found.t.tolist() == [late + math.floor(0.2 / 0.3 * 900)]


def test_an_unknown_backend_fails_by_name():
    with pytest.raises(ConfigError, match="abacus"):
        load_cross_ramp("abacus")
