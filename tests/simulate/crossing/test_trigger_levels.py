"""Trigger levels: who is inside them cannot fire, whatever the types and thresholds."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.simulate.references.ramp import Ramp, cross_ramp

from texvent.simulate.crossing.ramp import RefractoryPeriod
from texvent.simulate.crossing.trigger_levels import BrightnessCurve, TriggerLevels
from texvent.simulate.esim.simulator import EsimConfig, EsimSimulator, log_intensity
from texvent.simulate.random.mismatch import (
    LONG_AGO_US,
    Thresholds,
    draw_threshold_pair,
    sensor_key,
)
from texvent.simulate.senpi.simulator import SenpiConfig, SenpiSimulator, photons
from texvent.video import Frame

from ..pixel_frames import run


def frames_of(dtypes, seed, shape=(4, 6)) -> list[Frame]:
    """Levels 0..255 in coarse steps, so that thresholds are often met exactly or nearly so."""
    random = np.random.default_rng(seed)
    return [
        Frame(random.choice([0, 1, 2, 20, 100, 101, 110, 200, 255], shape).astype(dtype), i * 1000)
        for i, dtype in enumerate(dtypes)
    ]


DTYPES = st.lists(st.sampled_from([np.uint8, np.float32]), min_size=3, max_size=6)


def esim_of_every_pixel(frames, config) -> list[tuple[int, int, int]]:
    """(t, pixel, p) of the published rule, with all pixels looked at in every frame."""
    on, off = (
        np.full(frames[0].luma.size, one)
        for one in (config.contrast_threshold_on, config.contrast_threshold_off)
    )
    light = [log_intensity(frame.luma.ravel(), config.log_eps) for frame in frames]
    level, fired_us = light[0].copy(), np.full(light[0].size, LONG_AGO_US)
    events = []
    for i in range(1, len(frames)):
        pixel = np.arange(level.size)
        ramp = Ramp(pixel, light[i - 1] - level, light[i] - level, on, off)
        span = frames[i - 1].t_us, frames[i].t_us
        found = cross_ramp(
            ramp, fired_us, span, RefractoryPeriod(config.refractory_period_us, True)
        )
        level += found.steps * np.where(found.steps > 0, on, off)
        events += zip(found.t.tolist(), found.pixel.tolist(), found.p.tolist(), strict=True)
    return sorted(events)


@settings(max_examples=50)
@given(
    DTYPES,
    st.integers(0, 2**32),
    st.builds(
        EsimConfig,
        contrast_threshold_on=st.sampled_from([0.01, 0.1, np.log(2.0), 3.0]),
        contrast_threshold_off=st.sampled_from([0.01, 0.15, np.log(2.0), 10.0]),
        log_eps=st.sampled_from([1e-9, 1e-3, 1.0]),
        refractory_period_us=st.sampled_from([0, 700, 3000]),
    ),
)
def test_esim_with_levels_fires_as_without(dtypes, seed, config):
    frames = frames_of(dtypes, seed)
    events = run(EsimSimulator(config, seed=seed), frames)
    pixel = events.y.astype(int) * 6 + events.x
    ours = zip(events.t.tolist(), pixel.tolist(), events.p.tolist(), strict=True)
    assert list(ours) == esim_of_every_pixel(frames, config)


def senpi_of_every_pixel(frames, config, seed) -> list[tuple[int, int, int]]:
    """(t, pixel, p) of the published rule without noise, with all pixels looked at."""
    shape = frames[0].luma.shape
    on, off = (m.ravel() for m in draw_threshold_pair(shape, sensor_key(seed), config))
    light = [np.log(photons(frame.luma.ravel())) for frame in frames]
    level, fired_us = light[0].copy(), np.full(light[0].size, LONG_AGO_US)
    events = []
    for i in range(1, len(frames)):
        t, change = frames[i].t_us - 1, light[i] - level
        fires = (np.abs(change) >= np.where(change > 0, on, off)) & (
            t - fired_us >= config.refractory_period_us
        )
        level[fires], fired_us[fires] = light[i][fires], t
        events += [(t, int(k), int(change[k] > 0)) for k in np.flatnonzero(fires)]
    return events


@settings(max_examples=60)
@given(
    DTYPES,
    st.integers(0, 2**32),
    st.sampled_from([0.01, 0.3, np.log(2.0), 10.0]),
    st.sampled_from([0.0, 0.1]),
    st.sampled_from([0, 1500]),
)
def test_senpi_with_levels_fires_as_without(dtypes, seed, threshold, sigma, rest_us):
    config = SenpiConfig(
        contrast_threshold_on=threshold,
        contrast_threshold_off=threshold,
        threshold_sigma=sigma,
        refractory_period_us=rest_us,
        noise_rate_hz=0.0,
    )
    frames = frames_of(dtypes, seed)
    events = run(SenpiSimulator(config, seed=seed), frames)
    pixel = events.y.astype(int) * 6 + events.x
    ours = zip(events.t.tolist(), pixel.tolist(), events.p.tolist(), strict=True)
    assert list(ours) == senpi_of_every_pixel(frames, config, seed)


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
