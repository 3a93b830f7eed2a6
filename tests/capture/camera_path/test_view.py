"""Paths of the camera; flat images under them: means over pixels, and the scale."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.capture.camera_path.motion import CameraPose2D, Pan, Saccades, Shake
from texvent.capture.camera_path.photo_frames import SensorView, fitted_view
from texvent.errors import InputError
from texvent.sensor import SensorSize

IMAGE = np.random.default_rng(0).integers(0, 256, (14, 18)).astype(np.float32)


def view_of(width=18, height=14, scale=1.0, image=IMAGE, **options):
    size = SensorSize(image.shape[1], image.shape[0])
    return SensorView(size, SensorSize(width, height), scale, **options)


def mirrored(image, margin=40):
    return np.pad(image, margin, mode="symmetric"), margin


def slow_sample(view, place, fineness=40):
    """Means of many points in each pixel's true area."""
    padded, margin = mirrored(IMAGE)
    width, height = view.sensor
    matrix = view.matrix(place)
    steps = (np.arange(fineness) + 0.5) / fineness
    out = np.empty((height, width))
    for y in range(height):
        for x in range(width):
            px, py = np.meshgrid(x + steps, y + steps)
            u, v, w = matrix @ np.stack([px.ravel(), py.ravel(), np.ones(px.size)])
            columns = np.floor(u / w).astype(int) + margin
            rows = np.floor(v / w).astype(int) + margin
            out[y, x] = padded[rows, columns].mean()
    return out


@given(st.integers(-14, 14), st.integers(-14, 14))
def test_a_shift_by_whole_pixels_gives_the_pixels_exactly(x, y):
    padded, margin = mirrored(IMAGE)
    expected = padded[margin + y : margin + y + 14, margin + x : margin + x + 18]
    np.testing.assert_array_equal(view_of().render(IMAGE, CameraPose2D(x, y)), expected)


def test_a_smaller_sensor_averages_over_the_area_of_its_pixels():
    view = view_of(9, 7, scale=2.0)
    blocks = IMAGE.reshape(7, 2, 9, 2).mean(axis=(1, 3))
    np.testing.assert_array_equal(view.render(IMAGE, CameraPose2D()), blocks)


@pytest.mark.parametrize(
    ("scale", "place"),
    [
        (1.0, CameraPose2D(0.37, -2.81)),
        (1.7, CameraPose2D(1.21, 0.4)),
        (2.6, CameraPose2D(-0.77, 0.9)),
    ],
)
def test_fractional_shifts_and_scales_are_means_over_the_area(scale, place):
    view = view_of(7, 5, scale=scale)
    # 40 points along a pixel know an edge to 1/80 of it, of at most 255 levels, at four borders.
    expected = slow_sample(view, place)
    np.testing.assert_allclose(view.render(IMAGE, place), expected, atol=255 * 4 / 80)


@pytest.mark.parametrize("turn", [1, -1])
def test_the_scale_keeps_the_path_inside_an_image_that_is_large_enough(turn):
    image, sensor = SensorSize(*(400, 300)[::turn]), SensorSize(*(40, 30)[::turn])
    places = [CameraPose2D(*place[::turn]) for place in ((-5.0, 0.0), (5.0, 2.0))]
    view = fitted_view(SensorView(image, sensor), places, is_pixelwise=False)
    assert view.scale == pytest.approx(400 / 50)
    assert view.reach(places) == pytest.approx(1.0)
    still = fitted_view(SensorView(image, sensor), [CameraPose2D()], is_pixelwise=False)
    assert still.scale == 10.0


def test_an_image_is_not_enlarged_for_its_path():
    image, places = SensorSize(44, 34), [CameraPose2D(-5.0), CameraPose2D(5.0)]
    view = fitted_view(SensorView(image, SensorSize(40, 30)), places, is_pixelwise=False)
    assert view.scale == 1.0
    small = fitted_view(SensorView(image, SensorSize(88, 68)), places, is_pixelwise=False)
    assert small.scale == 0.5


def test_a_path_that_leads_far_away_is_refused():
    with pytest.raises(
        InputError, match=r"leads 3\.0 times its size away from the image \(18x14\)"
    ):
        fitted_view(view_of(), [CameraPose2D(45.0)], is_pixelwise=True)


@given(st.floats(-2, 2), st.floats(-2, 2), st.floats(0.5, 3))
def test_vectors_lead_to_the_place_in_the_other_view(x, y, scale):
    view, first, place = view_of(scale=scale), CameraPose2D(), CameraPose2D(x, y)
    there = view.vectors(first, place)
    for row, column in ((1, 5), (0, 0)):
        moved = np.append(np.array([column + 0.5, row + 0.5]) + there[row, column], 1.0)
        u, v, _ = view.matrix(place) @ moved
        expected = view.matrix(first) @ [column + 0.5, row + 0.5, 1.0]
        np.testing.assert_allclose([u, v], expected[:2], atol=1e-5)


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
