"""Linear blending."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from texvent.interpolate.simple import BlendInterpolator


def test_blend_mixes_by_the_share_of_time_that_passed(pair, config, stream):
    first, second = pair(np.full((2, 2), 100, np.uint8), np.full((2, 2), 200, np.uint8))
    frames = list(BlendInterpolator(config(), stream).between(first, second, [100, 500, 990]))
    assert [frame.t_us for frame in frames] == [100, 500, 990]
    assert [float(frame.pixels[0, 0]) for frame in frames] == [110.0, 150.0, 199.0]
    assert all(frame.pixels.dtype == np.float32 and not frame.is_source for frame in frames)


def test_blend_works_on_luma_of_colour_and_16_bit_frames(pair, config, stream):
    blend = BlendInterpolator(config(), stream)
    red, green = np.zeros((2, 2, 3), np.uint8), np.zeros((2, 2, 3), np.uint8)
    red[..., 0], green[..., 1] = 255, 255
    (frame,) = blend.between(*pair(red, green), [500])
    assert frame.pixels == pytest.approx(255 * (0.299 + 0.587) / 2, abs=1e-3)
    deep = pair(np.full((2, 2), 25_700, np.uint16), np.full((2, 2), 25_701, np.uint16))
    (frame,) = blend.between(*deep, [500])
    assert frame.pixels == pytest.approx(float(Fraction(51_401, 2 * 257)), abs=1e-4)
