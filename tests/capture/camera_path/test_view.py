"""Flat images under a moved camera: means over pixels at sub-pixel positions, and the scale."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.capture.camera_path.motion import CameraPose2D
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
