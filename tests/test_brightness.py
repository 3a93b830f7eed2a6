"""Balanced log: Eq. 5's L(α + I), the same for every dtype."""

import math

import numpy as np
import pytest

from texvent.brightness import balanced_log, luma_bt601
from texvent.errors import ConfigError


def test_balanced_log_is_the_natural_logarithm_of_alpha_plus_intensity():
    got = balanced_log(np.array([[0, 255]], np.uint8), 30.0)
    assert got.dtype == np.float64
    assert got[0].tolist() == pytest.approx([math.log(30), math.log(285)], abs=1e-15)


def test_eight_bit_and_float_input_give_the_same_bits():
    grey = np.arange(256, dtype=np.uint8).reshape(16, 16)
    for balance in (0.5, 30.0):
        table = balanced_log(grey, balance)
        assert np.array_equal(table, balanced_log(grey.astype(np.float32), balance))
        assert np.array_equal(table, balanced_log(grey.astype(np.float64), balance))


def test_no_balance_is_refused():
    with pytest.raises(ConfigError, match="balance is 0; it must be above 0"):
        balanced_log(np.array([[1, 3]], np.uint8), 0.0)


def test_luma_of_grey_is_grey():
    grey = np.full((2, 2, 3), 77.25, np.float32)
    assert luma_bt601(grey) == pytest.approx(77.25)
    assert luma_bt601(grey).dtype == np.float32


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.float32, np.float64])
@pytest.mark.parametrize("height", [1, 16, 37])
def test_luma_by_bands_equals_luma_of_the_whole(dtype, height):
    rgb = np.random.default_rng(1).integers(0, 256, (height, 5, 3)).astype(dtype)
    red, green, blue = np.float32(0.299), np.float32(0.587), np.float32(0.114)
    whole = rgb[..., 0] * red
    whole += rgb[..., 1] * green
    whole += rgb[..., 2] * blue
    np.testing.assert_array_equal(luma_bt601(rgb), whole.astype(np.float32))
