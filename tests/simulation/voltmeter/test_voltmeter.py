import math

import numpy as np
import pytest
from tests.simulation.references.voltmeter import (
    drift_and_diffusion,
    first_passage_time,
    probability_along_drift,
)

from texvent.events import NOISE
from texvent.frames import Frame
from texvent.simulation.voltmeter.config import Constants, VoltmeterConfig
from texvent.simulation.voltmeter.simulator import VoltmeterSimulator

from ..pixel_frames import frames_of, run, static

QUIET = VoltmeterConfig(constants="5.265 20 0 0 0 0", initial_phase="zero")
ABOVE_99_9_PERCENT = 1.95
"""Kolmogorov-Smirnov distance times √n that a true sample exceeds once in a thousand."""


def with_only(*, initial_phase="zero", **constants) -> VoltmeterConfig:
    """Nothing but these constants: no other noise, no other drift."""
    text = str(QUIET.k._replace(**constants))
    return VoltmeterConfig(constants=text, initial_phase=initial_phase)


def normal_cdf(values):
    return np.array([0.5 * math.erfc(-value / math.sqrt(2)) for value in values])


def inverse_gaussian_cdf(times, mean, shape):
    root = np.sqrt(shape / times)
    reflected = math.exp(2 * shape / mean) * normal_cdf(-root * (times / mean + 1))
    return normal_cdf(root * (times / mean - 1)) + reflected


def distance_to(cdf, sample) -> float:
    """Kolmogorov-Smirnov distance times √n."""
    ordered = np.sort(sample)
    steps = np.arange(len(ordered) + 1) / len(ordered)
    theory = cdf(ordered)
    largest = max(np.max(steps[1:] - theory), np.max(theory - steps[:-1]))
    return float(largest * math.sqrt(len(ordered)))


def test_a_random_start_lies_on_the_side_that_the_leak_drives_to():
    config = with_only(k4=-1e-5, initial_phase="random")
    frames = static(90.0, fps=100, seconds=0.1, shape=(20, 20))
    events = run(VoltmeterSimulator(config), frames)
    # Down by 1 in 0.1 s: each of 400 pixels fires once.
    assert len(events) == pytest.approx(400, abs=2)
    assert not events.p.any()


def test_drift_and_diffusion_are_equations_10_and_11():
    constants = Constants(k1=5.0, k2=20.0, k3=1e-4, k4=1e-7, k5=5e-9, k6=1e-5)
    signal, drift, sigma = drift_and_diffusion(90.0, 110.0, 1000, constants)
    assert signal == pytest.approx(5.0 * 20 / 1000 / 120)
    assert drift == pytest.approx(5.0 * 20 / 1000 / 120 + 1e-7 + 5e-7)
    assert sigma == pytest.approx(1e-4 * 10 / 120 + 1e-5)


def test_without_noise_the_residual_is_carried_over():
    # Each frame moves by 5.265 * 5 / (L + 22.5); the sum decides, however it is cut.
    levels = [80 + 5 * i for i in range(17)]
    simulator = VoltmeterSimulator(QUIET)
    events = run(simulator, frames_of(levels, range(0, 17_000, 1000)))
    way = np.cumsum([0.0] + [5.265 * 5 / (level + 22.5) for level in levels[:-1]])
    expected = np.interp([1.0, 2.0, 3.0], way, np.arange(17) * 1000)
    assert events.t == pytest.approx(expected, abs=1)


@pytest.mark.parametrize(("preset", "fps"), [("davis346", 24), ("davis240", 24), ("davis240", 500)])
def test_a_static_scene_has_the_rate_of_its_drift_at_any_frame_rate(preset, fps):
    config = VoltmeterSimulator.presets[preset]
    frames = static(250.0, fps=fps, seconds=1.0, shape=(40, 50))
    events = run(VoltmeterSimulator(config), frames)
    expected = (config.k.k4 + config.k.k5 * 250) * 1e6 * 40 * 50
    assert abs(len(events) - expected) < 4 * math.sqrt(expected)
    assert (events.label == NOISE).all()
    # Never in unison: pixels start anywhere on the way to their first event.
    assert events.t.mean() == pytest.approx(500_000, abs=4e6 / math.sqrt(12 * expected))


@pytest.mark.parametrize("frame_us", [400_000, 500])
def test_intervals_with_drift_are_inverse_gaussian_at_any_frame_rate(frame_us):
    # Mean 1 / μ = 1 ms, shape 1 / σ² = 10 ms; OFF first is a matter of exp(−20).
    config = with_only(k4=1e-3, k6=math.sqrt(1e-4))
    simulator = VoltmeterSimulator(config, seed=1)
    frames = [Frame(np.full((2, 3), 90.0), t) for t in range(0, 400_001, frame_us)]
    events = run(simulator, frames)
    assert events.p.all()
    order = np.lexsort((events.t, events.x, events.y))
    pixel = (events.y.astype(int) * 3 + events.x)[order]
    gaps = np.diff(events.t[order])[np.diff(pixel) == 0]
    assert len(gaps) > 2000
    # Whole microseconds blur the gaps by less than a thousandth of their mean.
    assert distance_to(lambda t: inverse_gaussian_cdf(t, 1000.0, 10_000.0), gaps) < (
        ABOVE_99_9_PERCENT
    )


def draw_times(distance, speed, sigma, *, seed):
    random = np.random.default_rng(seed)
    draws = zip(random.standard_normal(4000) ** 2, random.uniform(size=4000), strict=True)
    return np.array([first_passage_time(distance, speed, sigma, *draw) for draw in draws])


@pytest.mark.parametrize("sigma", [0.1, 1.0, 10.0])
def test_passage_times_are_inverse_gaussian_at_any_ratio_of_drift_to_noise(sigma):
    times = draw_times(1.0, 1.0, sigma, seed=2)
    assert distance_to(lambda t: inverse_gaussian_cdf(t, 1.0, 1 / sigma**2), times) < (
        ABOVE_99_9_PERCENT
    )


def test_passage_times_without_drift_are_levy():
    times = draw_times(2.0, 0.0, 0.5, seed=3)
    assert distance_to(lambda t: 2 * normal_cdf(-2 / 0.5 / np.sqrt(t)), times) < ABOVE_99_9_PERCENT


def test_passage_times_without_noise_are_certain():
    places = (1.0, 2.0), (3.0, 2.0), (1.0, 0.0)
    times = [first_passage_time(*place, 0.0, 1.0, 0.9) for place in places]
    assert times == [0.5, 1.5, math.inf]


def test_the_first_polarity_has_its_closed_form():
    # (1 − e^{−sb}) / (1 − e^{−s(a+b)}), s = 2 μ / σ² = 1, a = 0.5, b = 1.5.
    expected = (1 - math.exp(-1.5)) / (1 - math.exp(-2.0))
    assert probability_along_drift(0.5, 1.0, 0.5, 1.5) == pytest.approx(expected)
    assert probability_along_drift(0.0, 1.0, 0.5, 1.5) == pytest.approx(1.5 / 2.0)
    assert probability_along_drift(1e-300, 1.0, 0.5, 1.5) == pytest.approx(1.5 / 2.0)
    assert probability_along_drift(1.0, 0.0, 1.0, 1.0) == 1.0
    assert probability_along_drift(0.0, 0.0, 1.0, 1.0) == 0.5


def test_eq4_counts_with_the_gain_and_the_dark_offset():
    simulator = VoltmeterSimulator(VoltmeterSimulator.presets["davis240"])
    assert simulator.contrast_threshold == pytest.approx(1 / 4.424)
    assert simulator.balance == 23.0
