import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.examples import examples
from tests.simulation.references import esim
from tests.simulation.references.ramp import Ramp, cross_ramp

from texvent.simulation.crossing.ramp import RefractoryPeriod
from texvent.simulation.esim import crossings
from texvent.simulation.esim.crossings import CrossingState, RampPixels
from texvent.simulation.random.mismatch import Thresholds

SHAPE = (12,)
SENSOR = (3, 8)
NEVER = -(2**62)
changes = arrays(np.float64, SHAPE, elements=st.floats(-2, 2))
thresholds = arrays(np.float64, SHAPE, elements=st.floats(0.05, 0.5))
rests = st.builds(RefractoryPeriod, st.sampled_from([0, 1, 300, 5000]), st.booleans())


def cross(ramp, fired_us=None, *, span=(0, 1000), rest=None, by=crossings):
    """Events, and where the references are after them: they begin at 0."""
    fired = np.full(SENSOR[0] * SENSOR[1], NEVER) if fired_us is None else fired_us
    candidates = RampPixels(*ramp[:3], None, Thresholds(*ramp[3:]))
    levels = CrossingState(np.zeros(fired.size), fired)
    events = by.cross_thresholds(
        candidates, levels, span, rest or RefractoryPeriod(0, True), SENSOR
    )
    return events, levels.reference


def one(start, stop, on=0.2, off=0.2):
    values = (np.array([float(value)]) for value in (start, stop, on, off))
    return Ramp(np.zeros(1, np.int64), *values)


def test_levels_are_crossed_where_the_line_meets_them():
    # From 0.1 to 0.7 in 1000 µs: 0.2, 0.4 and 0.6 at 1/6, 1/2 and 5/6.
    found, reference = cross(one(0.1, 0.7))
    assert found.t.tolist() == [166, 500, 833]
    assert found.p.tolist() == [1, 1, 1]
    assert found.label.tolist() == [0, 0, 0]
    assert reference[0] == 3 * 0.2


def test_a_level_met_exactly_at_the_end_fires_in_the_last_microsecond():
    assert cross(one(0.0, 0.25, on=0.25))[0].t.tolist() == [999]


def test_a_level_passed_before_the_start_fires_at_once():
    found, _ = cross(one(0.5, 0.45))
    assert found.t.tolist() == [0, 0]


def test_off_uses_its_own_threshold():
    found, reference = cross(one(0.0, -0.35, on=0.2, off=0.1))
    assert found.p.tolist() == [0, 0, 0]
    assert reference[0] == -3 * 0.1


@pytest.mark.parametrize(("is_level_lost", "steps"), [(True, 5), (False, 2)])
def test_a_rest_keeps_or_loses_the_levels_it_swallows(is_level_lost, steps):
    fired = np.full(24, NEVER)
    found, reference = cross(one(0.0, 1.05), fired, rest=RefractoryPeriod(500, is_level_lost))
    assert found.t.tolist() == [190, 761]
    assert reference[0] == steps * 0.2
    assert fired.tolist() == [761] + [NEVER] * 23


@examples(60)
@given(changes, changes, thresholds, thresholds, rests, st.sampled_from([1, 2, 1000, 41_667]))
def test_backends_agree_and_crossings_are_sound(start, stop, on, off, rest, duration):
    # Every other pixel of a sensor of twice as many.
    pixel = np.arange(0, 24, 2)
    ramp, span = Ramp(pixel, start, stop, on, off), (70, 70 + duration)
    times = [np.full(24, NEVER) for _ in range(3)]
    reference, moved = cross(ramp, times[0], span=span, rest=rest, by=esim)
    compiled, also_moved = cross(ramp, times[1], span=span, rest=rest)
    for ours, theirs in zip(reference, compiled, strict=True):
        assert np.array_equal(ours, theirs)
    assert np.array_equal(moved, also_moved)
    assert np.array_equal(times[0], times[1])
    found = cross_ramp(ramp, times[2], span, rest)
    assert np.array_equal(times[0], times[2])
    assert (times[0][1::2] == NEVER).all()
    assert ((found.t >= 70) & (found.t < 70 + duration)).all()
    order = np.lexsort((found.t, found.pixel))
    assert (order == np.arange(len(order))).all()
    if rest.period_us == 0:
        left = stop - found.steps * np.where(found.steps > 0, on, off)
        assert (left < on).all()
        assert (-left < off).all()
        assert len(found.t) == np.abs(found.steps).sum()
