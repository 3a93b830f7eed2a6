from dataclasses import replace
from fractions import Fraction
from typing import get_args, get_type_hints

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.capture.fit_to_sensor import fit_motion, fit_pixels
from texvent.capture.intensity_scale import scale_to_levels
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.frames import MotionVectors, Video, frame_time_us
from texvent.sensor import SensorSize


@given(
    st.sampled_from([Fraction(10), Fraction(30_000, 1001), Fraction(100)]),
    st.integers(0, 900),
    st.integers(250, 1_200),
)
def test_start_is_included_and_stop_is_not(fps, first, length):
    config = CaptureConfig(fps=fps, start=first / 1000, stop=(first + length) / 1000)
    stream = open_frames(np.zeros((100, 2, 2), np.uint8), config)
    times_us = [frame_time_us(index, fps) for index in range(100)]
    expected = [t for t in times_us if first <= t / 1000 < first + length]
    assert [frame.t_us for frame in stream] == expected
    assert stream.frame_count == len(expected)


def test_nothing_between_start_and_stop_is_an_error_that_says_how_long_the_input_is():
    config = CaptureConfig(fps=Fraction(100), start=5.0)
    with pytest.raises(InputError, match=r"no frame between 5 s and the end .*up to 0\.99 s"):
        list(open_frames(np.zeros((100, 2, 2), np.uint8), config))


def test_a_stream_that_needs_nothing_is_returned_itself():
    video = Video(np.zeros((3, 4, 6), np.uint8), [0, 10_000, 20_000])
    assert open_frames(video, CaptureConfig()) is video
    assert open_frames(video, CaptureConfig(), size=SensorSize(6, 4)) is video


class Moving(Video):
    """A video whose pixels move by their own brightness."""

    def __iter__(self):
        for frame in super().__iter__():
            vectors = np.stack([frame.pixels, -frame.pixels], axis=-1).astype(np.float32)
            yield replace(frame, motion=MotionVectors(vectors, 2 * vectors))


@pytest.mark.parametrize("fit", get_args(get_type_hints(CaptureConfig)["fit"]))
@pytest.mark.parametrize("white_level", [None, 120.0])
def test_a_stream_is_fitted_with_its_motion_and_says_what_size_it_had(fit, white_level):
    pixels = np.random.default_rng(3).integers(0, 120, (3, 4, 6)).astype(np.uint8)
    video, size = Moving(pixels, [0, 10_000, 20_000]), SensorSize(3, 3)
    config = CaptureConfig(fit=fit, white_level=white_level)
    stream = open_frames(video, config, size=size)
    assert (stream.size, stream.metadata["size_before_fit"]) == ((3, 3), "6x4")
    for before, frame in zip(video, stream, strict=True):
        levels = before.pixels
        if white_level is not None:
            levels = scale_to_levels(levels, white_level)
        assert np.array_equal(frame.pixels, fit_pixels(levels, size, fit))
        expected = fit_motion(before.motion, size, fit)
        assert np.array_equal(frame.motion.forward, expected.forward)
        assert np.array_equal(frame.motion.backward, expected.backward)
