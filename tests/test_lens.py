"""Lenses beside OpenCV's models, and those that no image can have."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.errors import ConfigError
from texvent.lens import (
    DISTORTIONS,
    Distortion,
    Lens,
    distort,
    lens_reach,
    normalised,
    straight_pixels,
)
from texvent.sensor import SensorSize

SIZE = SensorSize(160, 120)
LENSES = [
    Lens(110.0, 112.0, 78.0, 61.5, "radtan", (-0.28, 0.07, 2e-3, -1e-3)),
    Lens(110.0, 112.0, 78.0, 61.5, "radtan", (-0.28, 0.07, 2e-3, -1e-3, 0.02)),
    Lens(60.0, 62.0, 78.0, 61.5, "radtan", (0.67, -0.01, 0.0, 0.0, -0.03)),
    Lens(70.0, 71.0, 81.0, 59.0, "equidistant", (0.02, -0.01, 3e-3, -5e-4)),
]
BOUNDS: dict[Distortion, tuple[float, ...]] = {
    "none": (),
    "radtan": (0.1, 0.03, 0.01, 0.01, 0.04),
    "equidistant": (0.05, 0.02, 0.03, 0.01),
}
"""Largest coefficients; tangential ones far larger than those of sold lenses."""


@pytest.mark.parametrize("lens", LENSES)
@given(x=st.floats(0.0, 160.0), y=st.floats(0.0, 120.0))
def test_the_ray_through_a_point_leads_back_to_it(lens, x, y):
    point = np.array([[x, y]])
    plane = normalised(lens, point)
    back = distort(lens, plane) * [lens.fx, lens.fy] + [lens.cx, lens.cy]
    np.testing.assert_allclose(back, point, atol=1e-8)


@pytest.mark.parametrize("model", DISTORTIONS)
@given(data=st.data())
@examples(25)
def test_pixels_without_distortion_lie_where_opencv_puts_them(model, data):
    coefficients = tuple(data.draw(st.sampled_from([-one, 0.0, one])) for one in BOUNDS[model])
    lens = Lens(160.0, 170.0, 118.5, 92.5, model, coefficients)
    fx, fy, cx, cy = lens.intrinsics
    camera = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1.0]])
    y, x = np.mgrid[:180:5, :240:5].astype(np.float64)
    seen = np.stack([x, y], axis=-1).reshape(-1, 1, 2)
    search = cv2.fisheye.undistortPoints if model == "equidistant" else cv2.undistortPoints
    settled = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 100, 1e-9)
    known = search(seen, camera, np.array(coefficients), P=camera, criteria=settled)
    known = known.reshape(36, 48, 2)
    places = straight_pixels(lens, SensorSize(240, 180))[::5, ::5]
    inside = ((known > 0) & (known < (239, 179))).all(axis=-1)
    assert inside.mean() > 0.5
    np.testing.assert_allclose(places[inside], known[inside], atol=1e-2)


@pytest.mark.parametrize(
    ("lens", "words"),
    [
        (Lens(110.0, 110.0, 80.0, 60.0, "radtan", (-2.0, 0.0, 0.0, 0.0)), "folds"),
        (Lens(8.0, 8.0, 80.0, 60.0), "85°"),
        (Lens(40.0, 40.0, 400.0, 60.0, "equidistant"), "no ray reaches"),
    ],
)
def test_a_lens_that_cannot_fill_the_image_is_refused(lens, words):
    with pytest.raises(ConfigError, match=words):
        lens_reach(lens, SIZE)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ((0.0, 110.0, 80.0, 60.0), "focal lengths are 0 and 110"),
        ((np.inf, 110.0, 80.0, 60.0), "focal lengths are inf"),
        ((110.0, 110.0, np.nan, 60.0), "must be finite"),
        ((110.0, 110.0, 80.0, 60.0, "radtan", (np.nan, 0.0)), "must be finite"),
    ],
)
def test_numbers_that_no_lens_has_are_refused(values, words):
    with pytest.raises(ConfigError, match=words):
        Lens(*values)
