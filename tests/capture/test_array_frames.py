from fractions import Fraction

import numpy as np
import pytest

from texvent.capture.array_frames import ArrayFrames
from texvent.capture.frame_times import FrameTimes
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError, TexventWarning

AT_100 = CaptureConfig(fps=Fraction(100))


def ramp(dtype, shape=(3, 4, 6)):
    levels = np.arange(np.prod(shape)).reshape(shape) % 200 + 20
    return (levels * (257 if dtype == np.uint16 else 1)).astype(dtype)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.float32, np.float64])
@pytest.mark.parametrize("shape", [(3, 4, 6), (3, 4, 6, 3)])
def test_pixels_and_types_are_kept(dtype, shape):
    pixels = ramp(dtype, shape)
    frames = list(open_frames(pixels, AT_100))
    assert frames[0].pixels.dtype == dtype
    assert np.array_equal(np.stack([frame.pixels for frame in frames]), pixels)
    assert [frame.t_us for frame in frames] == [0, 10_000, 20_000]


def test_a_list_can_be_read_again_and_a_generator_once():
    images = list(ramp(np.uint8))
    stream = open_frames(images, AT_100)
    assert (len(list(stream)), len(list(stream)), stream.is_live) == (3, 3, False)
    stream = open_frames((image for image in images), AT_100)
    assert stream.is_live
    frames = list(stream)
    assert [np.array_equal(f.pixels, p) for f, p in zip(frames, images, strict=True)] == [True] * 3
    with pytest.raises(InputError, match="generator of frames can be read once, and was"):
        iter(stream).__next__()


def test_a_stream_of_floats_is_refused_at_its_first_frame_that_is_not_black():
    with pytest.raises(InputError, match=r"frame 1 holds floats that never exceed 0\.5"):
        list(open_frames(iter([np.zeros((4, 6)), np.full((4, 6), 0.5)]), AT_100))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -1.0])
@pytest.mark.parametrize("index", [0, 2])
def test_intensities_that_are_not_finite_and_positive_are_refused(bad, index):
    pixels = ramp(np.float32)
    pixels[index, 1, 2] = bad
    with pytest.raises(InputError, match=rf"frame {index} .*1 pixel"):
        list(open_frames(pixels, AT_100))


@pytest.mark.parametrize(
    ("pixels", "message"),
    [
        (np.zeros((0, 4, 6), np.uint8), "there is no frame"),
        (np.zeros((1, 4, 6), np.uint8), "only one frame"),
        (np.zeros((4, 6), np.uint8), "One image holds no change"),
        (np.zeros((2, 4, 6, 4), np.uint8), r"Drop the alpha channel"),
        (np.zeros((2, 3, 4, 6), np.uint8), r"Channels come last"),
        (np.zeros((2, 4, 6), np.int64), r"type int64.*\.astype\(np\.uint8\)"),
        (3, "cannot read frames from int"),
    ],
)
def test_wrong_arrays_are_refused_with_advice(pixels, message):
    with pytest.raises(InputError, match=message):
        list(open_frames(pixels, AT_100))


@pytest.mark.parametrize(
    ("t_us", "message"),
    [
        ([0, 10_000], "2 times for 3 frames"),
        ([0, 10, 10], "strictly increase"),
        ([0.0, 0.1, 0.2], r"whole microseconds .*1e6.*got float64, such as 0.1"),
    ],
)
def test_wrong_times_are_refused(t_us, message):
    with pytest.raises(InputError, match=message):
        open_frames(ramp(np.uint8), CaptureConfig(), t_us=t_us)


@pytest.mark.parametrize(("highest", "bits"), [(255, 8), (1023, 10), (1024, 12), (4095, 12)])
def test_few_bits_in_sixteen_are_said_with_the_option(highest, bits):
    frames = np.full((2, 4, 4), highest, np.uint16)
    with pytest.warns(TexventWarning, match=f"probably have {bits} bits; .*={(1 << bits) - 1},"):
        ArrayFrames(frames, FrameTimes(fps=Fraction(25)))
    ArrayFrames(frames, FrameTimes(fps=Fraction(25)), check_scale=False)  # no warning
    ArrayFrames((frames + (4096 - highest)).astype(np.uint16), FrameTimes(fps=Fraction(25)))
