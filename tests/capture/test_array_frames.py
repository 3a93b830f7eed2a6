from contextlib import nullcontext
from fractions import Fraction

import numpy as np
import pytest

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
    with pytest.raises(InputError, match=r"the generator has no frame \(left\); if it was read"):
        open_frames(iter([]), AT_100)
    with pytest.raises(InputError, match="a FrameStream has its own times; leave out fps, t_us"):
        open_frames(stream, AT_100)


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
        (np.zeros((2, 4, 6), np.int64), r"type int64.*np\.asarray\(frames, np\.uint8\)"),
        (np.zeros((1, 9, 4, 6), np.uint8), r"frames\[0\]|moveaxis"),
        (np.zeros((2, 4, 6, 2), np.uint8), r"alpha channel: frames\[..., 0\]"),
        (3, "cannot read frames from int"),
        (b"abc", "cannot read frames from bytes"),
        ({0: np.zeros((4, 6))}, "cannot read frames from dict"),
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
        (np.array(["2024-05-01T12"] * 3, "M8[h]"), "holds dates or spans"),
        ([0.0, 0.1, 0.2], r"whole microseconds .*1e6.*got float64, such as 0.1"),
    ],
)
def test_wrong_times_are_refused(t_us, message):
    with pytest.raises(InputError, match=message):
        open_frames(ramp(np.uint8), CaptureConfig(), t_us=t_us)


def test_one_colour_image_that_reads_as_slender_frames_is_said():
    with pytest.warns(TexventWarning, match=r"as 40 frames of 3x32; if the last axis is colour"):
        open_frames(np.full((40, 32, 3), 90, np.uint8), AT_100)


@pytest.mark.parametrize("kind", ["array", "list", "generator", "file"])
def test_there_is_a_time_for_every_frame_and_no_other(tmp_path, kind):
    frames = np.random.default_rng(1).integers(0, 255, (4, 6, 8)).astype(np.uint8)
    np.save(tmp_path / "a.npy", frames)
    for more in (-1, 0, 1):
        forms = {"array": frames, "list": list(frames), "generator": iter(list(frames))}
        t_us = [10_000 * number for number in range(4 + more)]
        with pytest.raises(InputError, match="time per frame") if more else nullcontext():
            stream = open_frames(forms.get(kind, tmp_path / "a.npy"), CaptureConfig(), t_us=t_us)
            assert [frame.t_us for frame in stream] == t_us
