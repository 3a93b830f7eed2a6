"""Ramps and trigger levels: which thresholds a change crosses, and which pixels cannot fire."""

import dataclasses
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.examples import examples
from tests.simulation.references import esim
from tests.simulation.references.ramp import Ramp, cross_ramp

from texvent.frames import Frame
from texvent.simulation.crossing.ramp import RefractoryPeriod
from texvent.simulation.crossing.trigger_levels import BrightnessCurve, OutsidePixels, TriggerLevels
from texvent.simulation.esim import crossings
from texvent.simulation.esim.config import EsimConfig
from texvent.simulation.esim.crossings import CrossingState, RampPixels
from texvent.simulation.esim.simulator import EsimSimulator
from texvent.simulation.random.mismatch import Thresholds

from ..pixel_frames import run

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


def frames_of(dtypes, seed, shape=(4, 6)) -> list[Frame]:
    """Levels 0..255 in coarse steps, so that thresholds are often met exactly or nearly so."""
    random = np.random.default_rng(seed)
    return [
        Frame(random.choice([0, 1, 2, 20, 100, 101, 110, 200, 255], shape).astype(dtype), i * 1000)
        for i, dtype in enumerate(dtypes)
    ]


find_outside_levels = TriggerLevels.find_outside_levels


def list_every_pixel(levels, luma):
    before = levels._seen.copy()
    find_outside_levels(levels, luma)
    return OutsidePixels(np.arange(luma.size), before, levels._seen.copy())


LOW, HIGH = st.sampled_from([0.01, 0.1, np.log(2.0), 3.0]), st.sampled_from([0.15, np.log(2.0), 10])
MODELS = st.builds(
    EsimConfig,
    contrast_threshold_on=LOW,
    contrast_threshold_off=HIGH,
    log_eps=st.sampled_from([1e-9, 1e-3, 1.0]),
    refractory_period_us=st.sampled_from([0, 700, 3000]),
).map(lambda config: partial(EsimSimulator, config))


@examples(100)
@given(
    st.lists(st.sampled_from([np.uint8, np.float32]), min_size=3, max_size=6),
    st.integers(0, 2**32),
    MODELS,
)
def test_pixels_inside_their_levels_would_not_have_fired(dtypes, seed, model):
    frames = frames_of(dtypes, seed)
    events = run(model(seed=seed), frames)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(TriggerLevels, "find_outside_levels", list_every_pixel)
        assert run(model(seed=seed), frames).equals(events)


@pytest.mark.parametrize("dtype", [np.uint8, np.float32])
def test_only_pixels_outside_their_levels_are_looked_at(dtype):
    first = np.full((2, 300), 100, dtype)
    levels = TriggerLevels(first, BrightnessCurve(1.0, -10.0))
    assert len(levels.find_outside_levels(first)[0]) == 600
    # Silent from ln(10 + 90.5) to ln(10 + 120).
    reference, pixel = np.full(600, np.log(110.0)), np.arange(600)
    on, off = np.full(600, np.log(130.0 / 110.0)), np.full(600, np.log(110.0 / 100.5))
    levels.set(pixel, reference, Thresholds(on, off))
    second = first.copy()
    second[0, :5] = [90, 91, 119, 120, 130]
    pixel, before, now = levels.find_outside_levels(second)
    assert pixel.tolist() == [0, 3, 4]
    assert before.tolist() == [100] * 3
    assert now.tolist() == [90, 120, 130]


def test_a_pixel_that_always_fires_is_always_looked_at():
    first = np.full((1, 3), 9, np.uint8)
    levels = TriggerLevels(first, BrightnessCurve(1.0, 0.0))
    # ON from below 0 on, OFF from above 255 on, and nowhere silent.
    reference, on = np.array([-21.0, 9.5, 2.5]), np.array([1.0, 0.5, -0.5])
    off = np.array([np.inf, 0.5, -0.5])
    levels.set(np.arange(3), reference, Thresholds(on, off))
    assert levels.find_outside_levels(np.full((1, 3), 0, np.uint8))[0].tolist() == [0, 1, 2]


def test_redrawn_thresholds_may_fire_any_pixel():
    config = EsimConfig(threshold_sigma=0.1)
    dim, bright = np.full((30, 30), 100.0), np.full((30, 30), 102.0)
    frames = [Frame(dim, 0), Frame(bright, 1000)]
    events = run(EsimSimulator(config, seed=1), frames)
    # ln(102.255 / 100.255) = 0.0198: a threshold of mean 0.2 and sd 0.1 is below it in 3.6 %.
    assert 10 < len(np.unique(events.y.astype(int) * 30 + events.x)) < 60
    steady = dataclasses.replace(config, threshold_sigma=0.0)
    assert len(run(EsimSimulator(steady), frames)) == 0
