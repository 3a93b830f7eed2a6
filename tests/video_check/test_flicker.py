"""A beat is found at its frequency with its amplitude, and motion has none."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.video_check.made_clips import frames, pan

from texvent.video_check.flicker import amplitudes, find_lines, mains_alias
from texvent.video_check.measurer import VideoMeasurer, measure_video
from texvent.video_check.report import check_video


def slow_amplitudes(series):
    """The definition, one signal, one sum at a time."""
    count = len(series)
    slope, offset = np.polyfit(range(count), series, 1)
    straight = [value - slope * i - offset for i, value in enumerate(series)]
    window = [0.5 - 0.5 * math.cos(2 * math.pi * i / count) for i in range(count)]
    result = [0.0]
    for k in range(1, count // 2 + 1):
        total = sum(
            w * value * cmath.exp(-2j * math.pi * k * i / count)
            for i, (w, value) in enumerate(zip(window, straight, strict=True))
        )
        factor = 1 if 2 * k == count else 2
        result.append(factor * abs(total) / sum(window))
    return result


@pytest.mark.parametrize("count", [16, 17, 64])
def test_amplitudes_are_those_of_the_definition(count):
    series = np.random.default_rng(count).normal(size=(count, 3))
    fast = amplitudes(series)
    for signal in range(3):
        assert np.allclose(fast[:, signal], slow_amplitudes(series[:, signal]), atol=1e-12)


@given(bin_=st.integers(8, 30), amplitude=st.floats(0.02, 1), phase=st.floats(0, 6))
def test_a_sine_comes_out_with_its_amplitude_on_a_line(bin_, amplitude, phase):
    time = np.arange(64)
    series = amplitude * np.sin(2 * np.pi * bin_ * time / 64 + phase)[:, None]
    found = amplitudes(series)
    assert found[bin_, 0] == pytest.approx(amplitude, rel=0.1)
    assert np.flatnonzero(find_lines(found)[:, 0]).tolist() == [bin_]


def test_a_slow_rise_has_no_line():
    series = np.linspace(0, 2, 64)[:, None] ** [[1, 2, 3]]
    assert not find_lines(amplitudes(series)).any()


def beating(images, hz, log, fps=24, part=1.0):
    """The images with a lamp over the left part of them."""
    lit = np.zeros(images.shape[2])
    lit[: round(part * len(lit))] = 1
    gain = np.exp(log * np.sin(2 * np.pi * hz * np.arange(len(images)) / fps))
    return np.where(lit > 0, (images + 30) * gain[:, None, None] - 30, images)


@pytest.mark.parametrize("part", [1.0, 0.3])
def test_a_beating_lamp_over_a_pan_is_found_at_its_frequency(part):
    images = 0.8 * pan(96, step=1) + 20
    report = check_video(frames(beating(images, 9.0, 0.05, part=part)))
    assert "beat" in report.remarks
    assert report.measures["beat_hz"] == pytest.approx(9.0, abs=0.3)
    assert report.measures["beat_log"] == pytest.approx(0.05, rel=0.3)
    assert report.measures["beat_share"] == pytest.approx(part, abs=0.15)


def test_a_pan_does_not_beat():
    assert measure_video(frames(pan(96)))["beat_share"] < 0.05


def test_the_spectrum_shows_the_power_where_it_is():
    measurer = VideoMeasurer()
    for frame in frames(beating(0.8 * pan(64, step=1) + 20, 6.0, 0.05)):
        measurer.add(frame)
    spectrum = measurer.flicker_spectrum()
    six = int(spectrum.whole_log.argmax())
    assert spectrum.frequency[six] * 24 == 6.0
    assert spectrum.line_share.argmax() == six
    assert spectrum.blocks_log[six] > spectrum.blocks_log[six + 3], "on the slope of the motion"


def test_a_short_clip_has_no_spectrum():
    measurer = VideoMeasurer()
    for frame in frames(pan(15)):
        measurer.add(frame)
    assert measurer.flicker_spectrum() is None
    assert measurer.measures()["beat_share"] == 0


def test_mains_light_by_hand():
    # 100 Hz at 30 fps: 100 - 3 * 30 = 10 Hz; 120 Hz at 25 fps: 120 - 5 * 25 = -5 Hz.
    assert mains_alias(10.0, 30, 64) == 100
    assert mains_alias(5.0, 25, 64) == 120
    # 100 Hz at 25 fps stands still, and so does 120 Hz at 30 fps.
    assert mains_alias(12.5, 25, 64) is None
    assert mains_alias(3.0, 30, 64) is None
