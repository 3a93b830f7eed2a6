import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.capture.fit_to_sensor import fit_motion, fit_pixels, fit_place
from texvent.frames import MotionVectors
from texvent.sensor import SensorSize

sides = st.integers(1, 40)


def box_average(pixels, factor):
    """Reference: the mean of factor × factor pixels, float64."""
    height, width = pixels.shape[0] // factor, pixels.shape[1] // factor
    blocks = pixels[: height * factor, : width * factor].astype(np.float64)
    return blocks.reshape(height, factor, width, factor).mean(axis=(1, 3))


def test_shrinking_averages_over_each_new_pixel_without_rounding():
    pixels = np.random.default_rng(0).integers(0, 256, (30, 45), dtype=np.uint8)
    small = fit_pixels(pixels, SensorSize(15, 10), "cover")
    assert small.dtype == np.float32
    assert np.allclose(small, box_average(pixels, 3), atol=1e-4)
    assert np.any(small != np.round(small))


def test_sixteen_bits_come_out_on_the_0_to_255_scale():
    pixels = np.full((8, 8), 65_535, np.uint16)
    pixels[:4] = 257
    small = fit_pixels(pixels, SensorSize(4, 4), "stretch")
    assert small[0, 0] == pytest.approx(1.0)
    assert small[3, 0] == pytest.approx(255.0)


@pytest.mark.parametrize(
    ("fit", "column", "size", "expected"),
    [
        ("cover", range(8), (4, 4), [2, 3, 4, 5]),
        ("contain", [90, 90], (4, 4), [0, 90, 90, 0]),
        ("stretch", [10.0, 20.0], (2, 4), [10.0, 12.5, 17.5, 20.0]),
    ],
)
def test_each_fit_cuts_fills_or_stretches_evenly(fit, column, size, expected):
    """Columns that are cut, filled with black bars, or enlarged while their rows shrink."""
    kind = np.float32 if fit == "stretch" else np.uint8
    grey = np.repeat(np.array(column, kind)[:, None], 8 if fit == "stretch" else 4, axis=1)
    for pixels in (grey, np.stack([grey] * 3, axis=-1)):
        fitted = fit_pixels(pixels, SensorSize(*size), fit)
        assert fitted.reshape(size[1], size[0], -1)[:, 0, -1].tolist() == expected


@given(sides, sides, sides, sides, st.sampled_from(["cover", "contain", "stretch"]))
def test_any_size_fits_any_size_and_stays_within_the_range(height, width, tall, wide, fit):
    pixels = np.random.default_rng(1).uniform(20, 200, (height, width)).astype(np.float32)
    fitted = fit_pixels(pixels, SensorSize(wide, tall), fit)
    assert fitted.shape == (tall, wide)
    low = 0 if fit == "contain" else 20
    assert fitted.min() >= low - 1e-3
    assert fitted.max() <= 200 + 1e-3


def motion_of(height, width):
    """Every pixel's vector, depth and id say where the pixel is."""
    row, column = np.mgrid[:height, :width]
    vectors = np.stack([column, row], axis=-1).astype(np.float32)
    return MotionVectors(vectors, -vectors, (row + 1).astype(np.float32), column.astype(np.int32))


def test_motion_is_cut_and_scaled_as_the_pixels_are():
    # 8x4 fitted to 2x2 is the middle 4x4, at half its resolution: columns 2..5 become 0 and 1.
    fitted = fit_motion(motion_of(4, 8), SensorSize(2, 2), "cover")
    assert fitted.instance.tolist() == [[3, 5], [3, 5]]
    assert fitted.depth.tolist() == [[2, 2], [4, 4]]
    assert fitted.forward[0, 1].tolist() == [2.5, 0.5]  # the vector (5, 1) in pixels twice as large
    assert np.array_equal(fitted.backward, -fitted.forward)


def test_bars_stand_still_far_away():
    fitted = fit_motion(motion_of(2, 4), SensorSize(4, 4), "contain")
    assert fitted.instance[[0, 3]].tolist() == [[0] * 4] * 2
    assert np.isinf(fitted.depth[[0, 3]]).all()
    assert not fitted.forward[[0, 3]].any()
    assert np.array_equal(fitted.forward[1:3], motion_of(2, 4).forward)


@given(sides, sides, sides, sides, st.sampled_from(["cover", "contain", "stretch"]))
def test_motion_fits_wherever_pixels_do(width, height, new_width, new_height, fit):
    size = SensorSize(new_width, new_height)
    motion = motion_of(height, width)
    fitted = fit_motion(motion, size, fit)
    assert fitted.forward.shape == (*size.shape, 2)
    assert (fitted.depth.shape, fitted.instance.shape) == (size.shape, size.shape)
    # The id is the old column: what a pixel shows lies within a pixel of where its own id says.
    shown = fit_pixels(motion.instance.astype(np.float32), size, fit)
    inside = np.isfinite(fitted.depth)
    widest = max(1.0, width / new_width, height / new_height)
    assert np.abs(shown - fitted.instance)[inside].max(initial=0) <= widest
    # Its centre is a point of the pixel whose column is the id, and whose row is below the depth.
    scale, shift = fit_place(SensorSize(width, height), size, fit)
    centres = (np.argwhere(inside)[:, ::-1] + 0.5 - shift) / scale
    own = np.stack([fitted.instance, fitted.depth - 1], axis=-1)[inside] + 0.5
    assert np.abs(centres - own).max(initial=0) <= 0.5 + 1e-6
    # A vector of the old pixel (x, y), here itself (x, y), is as much longer as the picture is.
    np.testing.assert_allclose(fitted.forward[inside], (own - 0.5) * scale, rtol=1e-6)


@given(sides, sides, sides, sides, st.sampled_from(["cover", "contain", "stretch"]))
def test_both_axes_are_fitted_alike(width, height, new_width, new_height, fit):
    motion, size = motion_of(height, width), SensorSize(new_width, new_height)
    pixels = np.random.default_rng(2).uniform(20, 200, (height, width)).astype(np.float32)
    turned_size = SensorSize(new_height, new_width)
    turned = fit_pixels(pixels.T.copy(), turned_size, fit).T
    assert np.allclose(fit_pixels(pixels, size, fit), turned, atol=1e-3)
    upright = MotionVectors(
        motion.forward.transpose(1, 0, 2)[..., ::-1].copy(),
        None,
        motion.depth.T.copy(),
        motion.instance.T.copy(),
    )
    fitted, turned = fit_motion(motion, size, fit), fit_motion(upright, turned_size, fit)
    assert np.array_equal(fitted.depth, turned.depth.T)
    assert np.array_equal(fitted.instance, turned.instance.T)
    assert np.allclose(fitted.forward, turned.forward.transpose(1, 0, 2)[..., ::-1])
    scale, shift = fit_place(SensorSize(width, height), size, fit)
    turned_scale, turned_shift = fit_place(SensorSize(height, width), turned_size, fit)
    assert np.array_equal([scale, shift], np.array([turned_scale, turned_shift])[:, ::-1])
