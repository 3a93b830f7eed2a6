from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.frames import Video, frame_time_us
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


def test_a_stream_is_fitted_and_says_what_size_it_had():
    video = Video(np.full((3, 4, 6), 80, np.uint8), [0, 10_000, 20_000])
    stream = open_frames(video, CaptureConfig(), size=SensorSize(3, 2))
    assert (stream.size, stream.metadata["size_before_fit"]) == ((3, 2), "6x4")
    assert [frame.pixels.shape for frame in stream] == [(2, 3)] * 3
