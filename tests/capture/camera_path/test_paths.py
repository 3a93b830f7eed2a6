"""Paths of the camera: presets, and trajectory files good and bad."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.capture.camera_path.motion import Pan, Saccades, Shake
from texvent.capture.camera_path.trajectory_file import read_trajectory
from texvent.errors import FileFormatError, InputError

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


def written(tmp_path, text):
    file = tmp_path / "path.csv"
    file.write_text(text)
    return file


def test_positions_are_read_with_roll_and_zoom(tmp_path):
    text = "# a path\nt,x,y,roll,zoom\n0.5,0,0,0,1\n1,2,-4,90,1.5\n"
    path = read_trajectory(written(tmp_path, text))
    assert (path.start_us, path.seconds) == (500_000, 0.5)
    last = path(1_000_000)
    assert (last.x, last.y, last.zoom) == pytest.approx((2, -4, 1.5))
    assert last.roll == pytest.approx(np.pi / 2)
    assert path(0) == path(500_000)  # held before the first row
    assert path(9e9) == last


def test_between_rows_a_path_is_smooth(tmp_path):
    times = [0, 0.1, 0.25, 0.5, 0.6, 1.0]
    rows = "\n".join(f"{t} {3 * t + 1} {5 * t * t}" for t in times)
    path = read_trajectory(written(tmp_path, rows))
    for t in (0.05, 0.1, 0.2, 0.3, 0.55, 0.8):
        assert path(1e6 * t).x == pytest.approx(3 * t + 1)
    for t in (0.15, 0.3, 0.55):  # slopes inside are exact for parabolas
        assert path(1e6 * t).y == pytest.approx(5 * t * t)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", r"has 0 row\(s\); a camera path needs at least two"),
        ("0 1\n1 2\n", r"rows of 2 columns; allowed: t \[s\], x, y"),
        ("0 1 2\n0 2 3\n", "row 2, has a time that is not at least 1 µs after"),
        ("0 1 nan\n1 2 3\n", r"row 1, has a number that is not within ±1e\+06"),
        ("1e30 1 2\n2e30 2 3\n", "below 285 years"),
        ("0 1 2\n1 2 wall\n", "could not convert string 'wall'"),
        ("0 1 2 0 0\n1 2 3 0 1\n", "row 1, has a zoom that is not above 0"),
    ],
)
def test_a_bad_file_gets_one_clear_line(tmp_path, text, said):
    with pytest.raises((InputError, FileFormatError), match=said) as caught:
        read_trajectory(written(tmp_path, text))
    assert "\n" not in str(caught.value)


NUMBERS = st.floats(-1e6, 1e6, allow_nan=False)


@given(st.lists(st.tuples(NUMBERS, NUMBERS), min_size=2, max_size=6), st.floats(-1e6, 9e6))
def test_any_path_goes_through_its_rows_and_is_finite_between(tmp_path_factory, rows, t_us):
    file = tmp_path_factory.mktemp("paths") / "path.txt"
    file.write_text("\n".join(f"{index} {x!r} {y!r}" for index, (x, y) in enumerate(rows)))
    path = read_trajectory(file)
    for index, (x, y) in enumerate(rows):
        assert (path(1e6 * index).x, path(1e6 * index).y) == pytest.approx((x, y), abs=1e-6)
    assert np.isfinite([path(t_us).x, path(t_us).y]).all()
