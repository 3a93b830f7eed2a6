"""Trigger levels: who is inside them cannot fire, whatever the types and thresholds."""

import dataclasses
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.frames import Frame
from texvent.simulation.crossing.trigger_levels import BrightnessCurve, OutsidePixels, TriggerLevels
from texvent.simulation.esim.config import EsimConfig
from texvent.simulation.esim.simulator import EsimSimulator
from texvent.simulation.random.mismatch import Thresholds

from ..pixel_frames import run


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
