"""Pixels that follow a lamp of known frequency are found, others are not."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.interpolate.flicker import fit_cpu, fit_reference
from texvent.interpolate.flicker.fit_reference import design_fit, explained_by_chance, together
from texvent.interpolate.flicker.image_gain import STEADY, fit_gain
from texvent.interpolate.flicker.windows import alias_hz
from texvent.video import frame_time_us


def times_at(fps, number=12, start=0):
    times = [frame_time_us(index, Fraction(fps), start) for index in range(number)]
    return np.array(times, np.int64)


@pytest.mark.parametrize(
    ("hz", "fps", "seen"),
    [(37, 24, 11), (100, 24, 4), (120, 24, 0), (100, 25, 0), (120, 25, 5), (100, 30, 10)],
)
def test_a_lamp_shows_in_frames_at_its_alias(hz, fps, seen):
    assert alias_hz(hz, Fraction(fps)) == pytest.approx(seen, abs=1e-9)
    assert design_fit(times_at(fps), 0, hz).is_enough == (seen > 0)


def test_a_lamp_of_half_the_frame_rate_shows_one_phase_only():
    assert not design_fit(times_at(24), 0, 12.0).is_enough  # the sine is 0 in every frame


def test_few_frames_tell_nothing():
    assert not design_fit(times_at(24, number=5), 0, 37.0).is_enough


def test_the_share_that_chance_explains():
    # Two columns explain Beta(1, k/2): it exceeds s with probability (1 - s)^(k/2).
    assert explained_by_chance(0.0625, 8) == 0.5  # 0.5^4
    generator = np.random.default_rng(1)
    noise = generator.normal(size=(20_000, 12))
    design = design_fit(times_at(24), 0, 37.0)
    shares = noise @ design.orthonormal
    moving = (noise**2).sum(axis=1) - (shares[:, :2] ** 2).sum(axis=1)
    explained = (shares[:, 2:] ** 2).sum(axis=1) / moving
    assert (explained > explained_by_chance(0.01, 8)).mean() == pytest.approx(0.01, abs=0.003)


def test_amplitudes_by_hand():
    times_us = times_at(24)
    angle = 2 * np.pi * 37 * times_us / 1e6
    level = 100 + 3 * np.arange(12) + 20 * np.cos(angle) - 10 * np.sin(angle)
    light = np.stack([level, np.full(12, 100.0)], axis=1)[:, None].astype(np.float32)
    found, amplitude = fit_reference.fit_pixels(light, np.ones(12), design_fit(times_us, 0, 37.0))
    assert found.tolist() == [[True, False]]
    assert amplitude[0] == pytest.approx(np.array([[20.0, -10.0], [0.0, 0.0]]), abs=1e-3)


@given(seed=st.integers(0, 999), hz=st.floats(5.0, 500.0), swing=st.floats(0.0, 40.0))
def test_the_compiled_fit_is_the_reference(seed, hz, swing):
    generator = np.random.default_rng(seed)
    times_us = np.cumsum(generator.integers(20_000, 60_000, size=12))
    wave = np.cos(2 * np.pi * hz * times_us / 1e6 + seed)
    light = 100 + generator.normal(0, 4, size=(12, 3, 5)) + swing * wave[:, None, None]
    light, gain = light.astype(np.float32), generator.uniform(0.8, 1.2, size=12)
    design = design_fit(times_us, 0, hz)
    found, amplitude = fit_cpu.fit_pixels(light, gain, design)
    wanted, right = fit_reference.fit_pixels(light, gain, design)
    assert np.array_equal(found, wanted)
    assert amplitude == pytest.approx(right, rel=1e-5, abs=1e-4)


def test_pixels_alone_are_chance():
    found = np.zeros((5, 6), np.bool_)
    found[0, 0] = found[2:4, 2:4] = True
    wanted = found.copy()
    wanted[0, 0] = False
    assert np.array_equal(together(found), wanted)


@given(cosine=st.floats(-0.3, 0.3), sine=st.floats(-0.3, 0.3), fade=st.floats(-0.5, 0.5))
def test_the_modulation_of_an_image_is_found(cosine, sine, fade):
    times_us = times_at(24)
    angle = 2 * np.pi * 100 * times_us / 1e6
    light = np.exp(fade * times_us / 1e6) * (1 + cosine * np.cos(angle) + sine * np.sin(angle))
    found = fit_gain(np.diff(np.log(light)), times_us, 0, 100.0)
    if np.hypot(cosine, sine) > 0.021:
        assert found == pytest.approx((cosine, sine), abs=2e-3)
    elif np.hypot(cosine, sine) < 0.019:
        assert found == STEADY


def test_random_gains_are_no_lamp():
    generator = np.random.default_rng(2)
    times_us = times_at(24)
    found = [fit_gain(generator.normal(0, 0.1, 11), times_us, 0, 100.0) for _ in range(200)]
    assert sum(one != STEADY for one in found) <= 2
