"""Blending, motion-compensated interpolation, and frames that the scene itself renders."""

from fractions import Fraction

import numpy as np
import pytest

from texvent.config import InterpolateConfig
from texvent.errors import ConfigError
from texvent.frames import Frame, Video
from texvent.interpolate.flow import FlowInterpolator
from texvent.interpolate.simple import BlendInterpolator, ExactInterpolator
from texvent.pairs import motion_interpolation
from texvent.transfer import Transfer


@pytest.fixture
def flow(stream):
    return FlowInterpolator(InterpolateConfig(), stream)


@pytest.fixture
def blend(stream):
    return BlendInterpolator(InterpolateConfig(interpolate="blend"), stream)


def middle(interpolator, first, second):
    (frame,) = interpolator.between(Frame(first, 0), Frame(second, 1000), [500])
    return frame.pixels


def test_known_translation_beats_blending_by_6_db(moving_texture, psnr, flow, blend):
    first, second, truth = moving_texture(0), moving_texture(-6, 2), moving_texture(-3, 1)
    moved, mixed = (psnr(middle(part, first, second), truth) for part in (flow, blend))
    assert moved >= mixed + 6.0
    assert moved >= 30.0


def test_a_covered_background_is_taken_from_the_frame_that_shows_it(
    moving_texture, psnr, flow, blend
):
    def scene(position):
        image = moving_texture(0)
        y, x = np.mgrid[: image.shape[0], : image.shape[1]]
        disc = (x - 70 - position) ** 2 + (y - 60) ** 2 < 25**2
        return np.where(disc, moving_texture(position + 50, 40), image)

    moved, mixed = (psnr(middle(part, scene(0), scene(8)), scene(4)) for part in (flow, blend))
    assert moved >= mixed + 6.0


def test_images_drawn_together_are_those_drawn_alone(moving_texture, flow, monkeypatch):
    first, second = Frame(moving_texture(0), 0), Frame(moving_texture(4), 600)
    monkeypatch.setattr(motion_interpolation, "DRAWN_BYTES", 3 * first.luma.nbytes)
    found = flow.between(first, second, [100, 200, 300, 400, 500])
    frames = list(found)
    assert [frame.t_us for frame in frames] == [100, 200, 300, 400, 500]
    for index, frame in enumerate(frames):
        np.testing.assert_array_equal(frame.pixels, found.image(index))


def test_much_of_unrelated_frames_is_blended(moving_texture, psnr, flow, blend):
    first, second = moving_texture(0), moving_texture(0)[::-1, ::-1]
    moved, mixed = middle(flow, first, second), middle(blend, first, second)
    still = np.mean(np.abs(moved - mixed) < 0.25 * np.abs(second - first))
    assert still > 0.4


@pytest.mark.parametrize("shape", [(1, 1), (6, 8), (3, 400)])
def test_tiny_frames_give_finite_frames_of_their_size(flow, shape):
    rng = np.random.default_rng(1)
    first, second = (rng.integers(0, 256, shape).astype(np.uint8) for _ in range(2))
    got = middle(flow, first, second)
    assert got.shape == shape
    low, high = np.minimum(first, second).min(), np.maximum(first, second).max()
    assert ((got >= low - 1e-3) & (got <= high + 1e-3)).all()


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
