"""The bandwidth of the physical model against closed forms."""

import math

import numpy as np
import pytest

from ..pixel_frames import curve, frames_of, run
from .physical_pixels import clean, intensity


def follow_line(t: float, slope: float, tau: float) -> float:
    """Answer of a first-order low-pass to a line from rest."""
    return slope * (t - tau * (1 - math.exp(-t / tau)))


@pytest.mark.parametrize("count", [1, 7, 100])
def test_the_low_pass_follows_a_line_by_its_closed_form(count):
    # So small a contrast that the corner frequency, (10 + 100) / 265 of the cutoff, stays.
    cutoff, threshold, balance = 5.0, 0.011, 10.0
    tau = 1 / (math.tau * cutoff * 110 / 265)
    start = math.log(110)
    values = [intensity(start + 0.05 * i / count, balance) for i in range(count + 1)]
    times = [round(i * 500_000 / count) for i in range(count + 1)]
    simulator = clean(cutoff_hz=cutoff, contrast_threshold=threshold)
    events = run(simulator, frames_of(values, times))
    assert len(events) == 3
    reached = [follow_line(t * 1e-6, 0.1, tau) for t in events.t]
    # The corner rises by 5 % on the way, in as many steps as there are frames.
    assert reached == pytest.approx([threshold, 2 * threshold, 3 * threshold], rel=0.02)


def test_frames_an_hour_apart_are_simulated_at_once():
    hour_us = 3_600_000_000
    start = math.log(110)
    values = [intensity(start, 10.0), intensity(start + 0.65, 10.0)]
    events = run(clean(cutoff_hz=250.0), frames_of(values, [0, hour_us]))
    expected = np.array([0.2, 0.4, 0.6]) / 0.65 * hour_us
    assert events.t == pytest.approx(expected, abs=hour_us / 1024)


@pytest.mark.parametrize("fps", [240, 1000])
def test_bandwidth_does_not_depend_on_the_frame_rate(fps):
    knots = np.array([4.0, 4.4, 5.2, 4.9, 4.1, 4.1, 4.8, 3.9, 4.0])

    def sampled(rate):
        wave = lambda s: intensity(float(np.interp(s * 24, np.arange(len(knots)), knots)))  # noqa: E731
        return run(clean(cutoff_hz=60.0), curve(wave, fps=rate, seconds=8 / 24))

    slow, fast = sampled(24), sampled(fps)
    assert len(slow) > 10
    assert fast.p.tolist() == slow.p.tolist()
    # What is left: corners are averaged over pieces of an interval; time constants are 12 ms here.
    assert fast.t == pytest.approx(slow.t, abs=200)


@pytest.mark.parametrize("limit_hz", [0.0, 20.0])
def test_dark_pixels_are_slower_than_bright_ones(limit_hz):
    def delay(level):
        start = math.log(10 + level)
        values = [level, intensity(start + 0.4), intensity(start + 0.4)]
        events = run(
            clean(cutoff_hz=100.0, cutoff_limit_hz=limit_hz),
            frames_of(values, [0, 100, 500_000]),
        )
        return int(events.t[0])

    # Half of a step of 0.4, which takes 100 µs, is reached after ln 2 · τ.
    for level in (2.0, 20.0, 150.0):
        end = intensity(math.log(10 + level) + 0.4)
        cutoff_hz = 100 * (10 + end) / 265
        tau = 1e6 / (math.tau * min(cutoff_hz, limit_hz or cutoff_hz))
        assert delay(level) == pytest.approx(50 + tau * math.log(2), rel=0.01)
