"""Paths of the camera: saccades, shake and pan."""

import numpy as np
import pytest

from texvent.capture.camera_path.motion import Pan, Saccades, Shake

MEASURED = """
0 .44 .47, 20 .37 .90, 30 .30 1.62, 40 .29 2.67, 50 .42 3.89, 60 .83 5.02, 70 1.37 5.66,
80 1.75 5.86, 90 1.79 5.86, 100 1.86 5.80, 110 2.12 5.68, 120 2.45 5.69, 130 3.02 5.46,
140 3.72 4.64, 150 4.28 3.43, 160 4.51 2.17, 170 4.70 1.19, 180 4.92 .76, 200 5.27 .75,
220 5.31 .81, 240 4.95 .60, 250 3.90 .73, 260 2.89 .80, 270 1.93 .70, 280 1.21 .52,
290 .71 .39, 300 .44 .39, 310 .39 .42"""
"""ms, x and y px of a digit's corner on N-MNIST's sensor, measured on 100 pairs."""


def xy(path, t_ms):
    place = path(1000 * t_ms)
    return np.array([place.x, place.y])


def test_the_saccades_move_the_image_as_measured():
    rows = np.array([[float(one) for one in row.split()] for row in MEASURED.split(",")])
    moved = np.array([-xy(Saccades(), t) for t in rows[:, 0]])
    errors = moved - moved[0] - (rows[:, 1:] - rows[0, 1:])
    assert np.sqrt((errors**2).mean()) < 0.07
    assert np.abs(errors).max() < 0.2


def test_the_saccades_are_about_the_middle_and_scale():
    path = np.array([xy(Saccades(), t) for t in range(316)])
    np.testing.assert_allclose(path.max(axis=0) + path.min(axis=0), 0, atol=0.1)
    larger = np.array([xy(Saccades(10.8), t) for t in range(316)])
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
