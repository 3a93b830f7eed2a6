import dataclasses
import math

import numpy as np
import pytest
from tests.simulation.references.v2e import lin_log

from texvent.events import NOISE, SIGNAL
from texvent.simulation.v2e.config import V2eConfig
from texvent.simulation.v2e.pixels import relative_intensity
from texvent.simulation.v2e.simulator import V2eSimulator

from ..pixel_frames import frames_of, run, static

CLEAN = V2eSimulator.presets["peer-common"]


def with_only(**options) -> V2eConfig:
    """Nothing but these options: everything else of the model is off."""
    return dataclasses.replace(CLEAN, **options)


def test_brightness_is_linear_below_20_and_logarithmic_above():
    levels = np.array([0.0, 10.0, 20.0, 21.0, 255.0])
    expected = [0, math.log(20) / 2, math.log(20), math.log(21), math.log(255)]
    assert lin_log(levels) == pytest.approx(expected, rel=1e-15)


def test_the_photoreceptor_follows_a_step_by_its_bandwidth():
    # Weight per frame: (80 + 20) / 275 * 2 pi * f * 1 ms = 0.1, so 1 - 0.9^n of the step is seen.
    cutoff_hz = 0.1 / (100 / 275 * math.tau * 1e-3)
    config = with_only(cutoff_hz=cutoff_hz, contrast_threshold_on=0.05)
    simulator = V2eSimulator(config)
    frames = frames_of([40] + [80] * 30, range(0, 31_000, 1000))
    total = 0
    for n, frame in enumerate(frames):
        total += len(simulator.step(frame))
        assert total == math.floor(math.log(2) * (1 - 0.9**n) / 0.05)


def test_a_bandwidth_above_the_frame_rate_follows_at_once():
    frames = frames_of([40, 80, 80], [0, 41_667, 83_333])
    fast = run(V2eSimulator(with_only(cutoff_hz=300.0)), frames)
    assert fast.equals(run(V2eSimulator(CLEAN), frames))


@pytest.mark.parametrize("intensity", [0.0, 100.0, 255.0])
def test_shot_noise_falls_with_the_light(intensity):
    config = with_only(shot_noise_rate_hz=5.0)
    frames = static(intensity, fps=24, seconds=0.5, shape=(60, 80))
    expected = 5.0 * (1 - 0.75 * (intensity + 20) / 275) * 0.5 * 60 * 80
    events = run(V2eSimulator(config, seed=1), frames)
    assert len(events) == pytest.approx(expected, abs=4 * math.sqrt(expected))


def test_pixels_with_a_low_threshold_have_more_shot_noise_of_that_polarity():
    config = with_only(shot_noise_rate_hz=50.0, threshold_sigma=0.03)
    simulator = V2eSimulator(config, seed=2)
    events = run(simulator, static(60.0, fps=24, seconds=1.0, shape=(60, 80)))
    counts = np.zeros((2, 60, 80))
    np.add.at(counts, (events.p, events.y, events.x), 1)
    mismatch = simulator._pixels._mismatch
    low = np.stack([1 / mismatch.threshold_off, 1 / mismatch.threshold_on])
    together = np.corrcoef(counts.reshape(2, -1), low)[:2, 2:]
    assert (together.diagonal() > 0.2).all()
    assert np.abs(together[[0, 1], [1, 0]]).max() < 5 / math.sqrt(4800)


def test_shot_noise_resets_its_pixel_to_the_present_brightness():
    config = with_only(shot_noise_rate_hz=1000.0)
    simulator = V2eSimulator(config)
    # 0.15 up, then noise (certain in 1 s), then 0.15 up: without the reset, 0.3 would fire.
    values = [40, 40 * math.exp(0.15), 40 * math.exp(0.30)]
    events = run(simulator, frames_of(values, [0, 1_000_000, 2_000_000]))
    assert (events.label == NOISE).all()


def test_noise_brings_the_next_leak_event_nearer():
    leak = {"leak_rate_hz": 1.0, "leak_rate_decades": 0.0}
    config = with_only(shot_noise_rate_hz=0.5, contrast_threshold_off=2.0, **leak)
    # 0.9 down, so that the leak fires after 5.5 s; noise within 1.1..1.2 s forgets that.
    frames = frames_of([40] + [40 * math.exp(-0.9)] * 30, range(0, 3_100_000, 100_000))
    events = run(V2eSimulator(config, seed=7), frames)
    assert 1_100_000 <= events.t[0] < 1_200_000
    assert events.t[1:] == pytest.approx([2_200_000], abs=1)


def test_leak_before_a_noise_event_makes_no_light_noise():
    leak = {"leak_rate_hz": 0.3, "leak_rate_decades": 0.0}
    simulator = V2eSimulator(with_only(shot_noise_rate_hz=0.5, **leak), seed=7)
    # Noise within 1.1..1.2 s; from then on 0.06 of leak and 0.2 of light per second.
    values = [40 * math.exp(max(0.0, 0.02 * (k - 12))) for k in range(21)]
    events = run(simulator, frames_of(values, range(0, 2_100_000, 100_000)))
    assert events.label.tolist() == [NOISE, SIGNAL]
    assert events.t[1] == pytest.approx(1_200_000 + 0.2 / 0.26 * 1e6, abs=1)


@pytest.mark.parametrize(
    ("change", "polarities", "label"),
    [(0.1, [1], NOISE), (0.3, [1, 1], SIGNAL), (-0.4, [0], SIGNAL)],
)
def test_events_are_noise_where_leak_of_their_sign_is_half_of_them(change, polarities, label):
    config = with_only(leak_rate_hz=1.0, leak_rate_decades=0.0)
    # 0.16 of leak in 0.8 s: of an event of 0.2, of two, and against one of -0.2.
    events = run(V2eSimulator(config), frames_of([40, 40 * math.exp(change)], [0, 800_000]))
    assert (events.p.tolist(), set(events.label.tolist())) == (polarities, {label})


def test_a_change_kept_back_by_the_refractory_period_fires_later():
    config = with_only(refractory_period_us=25_000)
    values = [40, 40 * math.exp(2.01), 40 * math.exp(2.01), 40 * math.exp(2.01)]
    frames = frames_of(values, [0, 100_500, 140_500, 180_500])
    events = run(V2eSimulator(config), frames)
    # Crossings every 10 ms; what the period kept back is due when an interval starts after it.
    assert events.t == pytest.approx([10_000, 40_000, 70_000, 100_000, 140_500], abs=1)


def test_eq4_counts_as_steeply_as_the_model_at_black():
    simulator = V2eSimulator(with_only(contrast_threshold_on=0.3, contrast_threshold_off=0.25))
    assert simulator.contrast_threshold == 0.25
    slope = (lin_log(np.array([[1.0]])) - lin_log(np.array([[0.0]])))[0, 0]
    assert 1 / simulator.balance == pytest.approx(slope)


def test_bandwidth_and_shot_noise_scale_with_the_published_intensity():
    levels = np.array([[0, 255]], np.uint8)
    assert relative_intensity(levels).tolist() == [[20 / 275, 1.0]]
