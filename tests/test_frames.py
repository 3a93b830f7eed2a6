"""Frames and streams: exact times, kept precision, and the checks at the door."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import InputError
from texvent.frames import Frame, FrameStream, Video, frame_time_us


def test_convention_time_comes_from_the_index_and_never_drifts():
    fps = Fraction(30_000, 1001)
    assert frame_time_us(30_000 * 600, fps) == 1001 * 600 * 1_000_000
    assert [frame_time_us(i, Fraction(24)) for i in range(4)] == [0, 41_667, 83_333, 125_000]


@given(st.integers(0, 10**6), st.fractions(min_value=Fraction(1, 10), max_value=2000))
def test_frame_times_strictly_increase(index, fps):
    assert frame_time_us(index + 1, fps) > frame_time_us(index, fps)


PER_LEVEL = {"uint8": 1, "uint16": 257, "float32": 1, "float64": 1}


@given(
    st.sampled_from(sorted(PER_LEVEL)), st.sampled_from([(5, 3), (5, 3, 3)]), st.integers(0, 99),
    st.sampled_from([1, 255]),
)  # fmt: skip
def test_convention_luma_of_every_type_is_bt601_from_0_to_255(name, shape, seed, most):
    """Eight-bit grey stays eight-bit, and all else is not rounded."""
    pixels = np.random.default_rng(seed).uniform(0, most * PER_LEVEL[name], shape).astype(name)
    pixels[0], pixels[1] = 0, 255 * PER_LEVEL[name]
    levels = pixels.astype(float) / PER_LEVEL[name]
    expected = levels @ [0.299, 0.587, 0.114] if len(shape) == 3 else levels
    frame = Frame(pixels, 0)
    assert frame.luma.dtype == ("uint8" if expected is levels and name == "uint8" else "float32")
    assert frame.luma.max() == pytest.approx(255.0)
    for found, step in (
        (frame.luma, 1),
        (frame.float_luma, 1),
        (Frame(pixels, 0).sampled_luma(2), 2),
    ):
        np.testing.assert_allclose(found, expected[::step, ::step], atol=1e-4)


def test_a_video_in_memory_is_a_frame_stream_that_can_be_read_twice():
    video = Video(np.zeros((3, 4, 5), np.uint8), [0, 10, 20])
    assert isinstance(video, FrameStream)
    assert video.size == (5, 4)
    assert [frame.t_us for frame in video] == [frame.t_us for frame in video] == [0, 10, 20]


@pytest.mark.parametrize(
    ("pixels", "message"),
    [
        (np.zeros((2, 3, 4), np.uint8), r"\[H, W\] or \[H, W, 3\]; got shape \[2, 3, 4\]"),
        (np.zeros((0, 3), np.uint8), "at least one pixel"),
        (np.zeros((2, 3), np.int64), "type int64; allowed: uint8"),
    ],
)
def test_a_frame_of_the_wrong_form_is_refused(pixels, message):
    with pytest.raises(InputError, match=message):
        Frame(pixels, 0)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -1.0])
def test_nan_infinite_and_negative_intensities_are_refused_with_a_count(bad):
    pixels = np.ones((2, 4, 4))
    pixels[1, 2, 3] = bad
    with pytest.raises(InputError, match=r"frame 1 \(t = 5 µs\) has 1 pixel"):
        Video(pixels, [0, 5])


def test_empty_videos_and_miscounted_times_are_refused():
    with pytest.raises(InputError, match="no frame"):
        Video(np.zeros((0, 2, 2), np.uint8), [])
    with pytest.raises(InputError, match="3 frames but 2 times"):
        Video(np.zeros((3, 2, 2), np.uint8), [0, 1])
    with pytest.raises(InputError, match=r"\[N, H, W\]"):
        Video(np.zeros((2, 2), np.uint8), [0, 1])
