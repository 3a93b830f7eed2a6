"""Paths of the camera: saccades, shake and pan."""

import numpy as np
import pytest

from texvent.capture.camera_path.motion import Pan, Saccades, Shake

MEASURED = """
5 .2 .4, 25 .3 1.2, 35 .3 2.1, 45 .4 3.3, 55 .9 4.2, 65 1.2 5.4, 75 1.4 6.1, 105 2.0 5.8,
125 2.8 5.6, 135 3.3 5.0, 145 4.0 4.1, 155 4.3 2.9, 165 4.7 1.8, 175 4.9 1.1, 195 5.2 1.0,
235 5.0 .8, 245 4.4 .9, 255 3.4 1.0, 265 2.4 1.0, 275 1.9 .3, 285 1.1 .4, 295 .8 .3"""
"""ms, x and y px of a digit's corner on N-MNIST's sensor, measured on 100 pairs."""


def xy(path, t_ms):
    place = path(1000 * t_ms)
    return np.array([place.x, place.y])


def test_the_saccades_move_the_image_as_measured():
    rows = np.array([[float(one) for one in row.split()] for row in MEASURED.split(",")])
    moved = np.array(
        [np.mean([-xy(Saccades(), t + dt) for dt in (-4, -2, 0, 2, 4)], axis=0) for t in rows[:, 0]]
    )
    errors = moved - moved[0] - (rows[:, 1:] - rows[0, 1:])
    assert np.sqrt((errors**2).mean()) < 0.2
    assert np.abs(errors).max() < 0.6


def test_the_saccades_are_about_the_middle_and_scale():
    path = np.array([xy(Saccades(), t) for t in range(316)])
    np.testing.assert_allclose(path.max(axis=0) + path.min(axis=0), 0, atol=0.1)
    larger = np.array([xy(Saccades(11.0), t) for t in range(316)])
    np.testing.assert_allclose(larger, 2 * path)
    assert Saccades().seconds == 0.315


def test_a_shake_has_the_stated_size_and_frequencies():
    times = np.arange(0, 40_000_000, 10_000)
    path = np.array([xy(Shake(3.0, seed=5), t / 1000) for t in times])
    np.testing.assert_allclose(np.sqrt((path**2).mean(axis=0)), 3.0, rtol=0.05)
    power = np.abs(np.fft.rfft(path * np.hanning(len(path))[:, None], axis=0)) ** 2
    hertz = np.fft.rfftfreq(len(path), 0.01)
    inside = (hertz > 0.9) & (hertz < 12.1)
    assert power[inside].sum() > 0.999 * power.sum()
    low, high = power[(hertz < 3) & inside].sum(), power[(hertz > 8) & inside].sum()
    assert low > 5 * high > 0


def test_a_shake_depends_on_its_seed_alone():
    assert Shake(seed=3)(12345) == Shake(seed=3)(12345)
    assert Shake(seed=3)(12345) != Shake(seed=4)(12345)
    assert Shake(2.0, 0)(1e6).x == pytest.approx(2 * Shake(1.0, 0)(1e6).x)


def test_a_pan_has_constant_speed_and_is_half_way_at_the_centre():
    pan = Pan(80.0, seconds=2.0)
    assert [pan(t).x for t in (0, 500_000, 1_000_000, 2_000_000)] == [-80, -40, 0, 80]
    assert pan(777).y == 0
