import dataclasses
import math

import numpy as np
import pytest

from texvent.events import NOISE, SIGNAL
from texvent.simulate.senpi.simulator import (
    SenpiConfig,
    SenpiSimulator,
    photons,
)
from texvent.video import Frame

from ..pixel_frames import curve, frames_of, run, static

CLEAN = SenpiSimulator.presets["peer-common"]


def with_only(**options) -> SenpiConfig:
    """Nothing but these options: everything else of the model is off."""
    return dataclasses.replace(CLEAN, **options)


def test_photons_have_a_floor_and_a_full_well():
    levels = np.array([[0, 1, 51, 255]], np.uint8)
    assert photons(levels) == pytest.approx(np.array([[58.8235, 58.8235, 3000, 15_000]]))


def test_a_change_fires_once_at_the_end_of_the_interval():
    frames = frames_of([40, 90, 90, 40], [0, 1000, 2000, 3000])
    events = run(SenpiSimulator(CLEAN), frames)
    # The frame time itself belongs to the next packet, so the event comes 1 µs before it.
    assert events.t.tolist() == [999, 2999]
    assert events.polarity.tolist() == [1, -1]


def test_firing_memorises_the_present_voltage():
    # Every fifth frame has risen by 0.25 since the last event; the rest of 0.05 is forgotten.
    frames = frames_of([40 * math.exp(0.05 * i) for i in range(21)], range(0, 21_000, 1000))
    config = with_only(contrast_threshold_on=0.22)
    events = run(SenpiSimulator(config), frames)
    assert events.t.tolist() == [4999, 9999, 14_999, 19_999]


def test_a_sinusoid_fires_at_every_turn_of_the_threshold():
    # ln I swings by ±0.25 at 4 samples a period: 0, +, 0, -, so each frame changes by 0.25.
    frames = curve(lambda s: 80 * math.exp(0.25 * math.sin(math.tau * s)), fps=4, seconds=2.0)
    events = run(SenpiSimulator(CLEAN), frames)
    assert events.p.tolist() == [1, 0, 0, 1, 1, 0, 0, 1]
    assert events.t.tolist() == [k * 250_000 - 1 for k in range(1, 9)]


def test_a_pixel_at_rest_is_not_fired_by_a_change():
    config = with_only(refractory_period_us=1500)
    frames = frames_of([40, 80, 160, 160], [0, 1000, 2000, 3000])
    events = run(SenpiSimulator(config), frames)
    # The change at 2000 µs comes 1 ms after the first event; it is seen in the next frame.
    assert events.t.tolist() == [999, 2999]


def test_no_change_fires_within_the_refractory_period_of_noise():
    config = with_only(noise_rate_hz=500.0, refractory_period_us=500)
    frames = [Frame(np.full((20, 30), level, np.uint8), t) for level, t in ((40, 0), (80, 1000))]
    events = run(SenpiSimulator(config), frames)
    rested, fired = np.ones((20, 30), bool), np.zeros((20, 30), bool)
    noise, signal = events[events.label == NOISE], events[events.label == SIGNAL]
    late = noise.t > 999 - 500
    rested[noise.y[late], noise.x[late]] = False
    fired[signal.y, signal.x] = True
    assert np.array_equal(fired, rested)
    assert 0.7 < rested.mean() < 0.9  # exp(-500 Hz · 0.5 ms) = 0.78


def test_noise_memorises_the_present_voltage():
    simulator = SenpiSimulator(with_only(noise_rate_hz=1000.0))
    # 0.15 up, noise (certain in 1 s), 0.15 up: without the reset, 0.3 would fire.
    values = [40 * math.exp(0.15 * k) for k in range(3)]
    events = run(simulator, frames_of(values, [0, 1_000_000, 2_000_000]))
    assert (events.label == NOISE).all()


def test_mismatch_shifts_the_change_that_fires():
    config = with_only(threshold_sigma=0.03)
    shape = (40, 50)
    simulator = SenpiSimulator(config)
    simulator.step(static(40.0, fps=1, seconds=0, shape=shape)[0])
    frame = static(40.0 * math.exp(0.23), fps=1, seconds=1, shape=shape)[1]
    events = simulator.step(frame)
    # One sd above the mean: 84 % of the pixels have a lower threshold.
    assert len(events) / 2000 == pytest.approx(0.8413, abs=4 * math.sqrt(0.84 * 0.16 / 2000))
    assert (events.label == SIGNAL).all()


def test_the_default_threshold_is_a_tenth_of_full_scale():
    assert SenpiConfig().contrast_threshold_on == pytest.approx(0.1 * math.log(15_000), abs=1e-4)
    assert SenpiSimulator().contrast_threshold == SenpiConfig().contrast_threshold_on
    assert SenpiSimulator().balance == 1.0
