"""Linear blending, and frames rendered by the scene itself."""

from fractions import Fraction

import numpy as np
import pytest

from texvent.config import InterpolateConfig
from texvent.errors import ConfigError
from texvent.frames import Frame, Video
from texvent.interpolate.simple import BlendInterpolator, ExactInterpolator
from texvent.transfer import Transfer


def test_blend_mixes_by_the_share_of_time_that_passed(pair, stream):
    first, second = pair(np.full((2, 2), 100, np.uint8), np.full((2, 2), 200, np.uint8))
    blend = BlendInterpolator(InterpolateConfig(), stream)
    frames = list(blend.between(first, second, [100, 500, 990]))
    assert [frame.t_us for frame in frames] == [100, 500, 990]
    assert [float(frame.pixels[0, 0]) for frame in frames] == [110.0, 150.0, 199.0]
    assert all(frame.pixels.dtype == np.float32 and not frame.is_source for frame in frames)


def test_blend_works_on_luma_of_colour_and_16_bit_frames(pair, stream):
    blend = BlendInterpolator(InterpolateConfig(), stream)
    red, green = np.zeros((2, 2, 3), np.uint8), np.zeros((2, 2, 3), np.uint8)
    red[..., 0], green[..., 1] = 255, 255
    (frame,) = blend.between(*pair(red, green), [500])
    assert frame.pixels == pytest.approx(255 * (0.299 + 0.587) / 2, abs=1e-3)
    deep = pair(np.full((2, 2), 25_700, np.uint16), np.full((2, 2), 25_701, np.uint16))
    (frame,) = blend.between(*deep, [500])
    assert frame.pixels == pytest.approx(float(Fraction(51_401, 2 * 257)), abs=1e-4)


class Brightening(Video):
    """A grey field that brightens by one level per 100 µs, at any instant."""

    def at(self, t_us: int) -> Frame:
        levels = np.full((4, 4, 3), t_us / 100, np.float32)
        return Frame(levels, t_us, is_source=False, transfer=Transfer.LINEAR)


@pytest.fixture
def renderable() -> Brightening:
    return Brightening(np.stack([np.zeros((4, 4, 3)), np.full((4, 4, 3), 10.0)]), [0, 1000])


def test_exact_frames_are_what_the_scene_shows_then(renderable):
    exact = ExactInterpolator(InterpolateConfig(interpolate="exact"), renderable)
    frames = list(exact.between(renderable[0], renderable[1], [250, 999]))
    assert [frame.t_us for frame in frames] == [250, 999]
    for frame, level in zip(frames, (2.5, 9.99), strict=True):
        assert frame.pixels.shape == (4, 4)
        assert frame.pixels.dtype == np.float32
        assert frame.pixels == pytest.approx(level, abs=1e-4)
        assert (frame.is_source, frame.transfer) == (False, Transfer.LINEAR)


def test_exact_fails_on_a_recorded_video_and_names_the_choices(stream):
    with pytest.raises(ConfigError, match="use flow, blend or none"):
        ExactInterpolator(InterpolateConfig(interpolate="exact"), stream)
