"""Motion-compensated interpolation."""

import numpy as np
import pytest

from texvent.config import InterpolateConfig
from texvent.frames import Frame
from texvent.interpolate.flow import FlowInterpolator
from texvent.interpolate.simple import BlendInterpolator
from texvent.pairs import motion_interpolation


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
