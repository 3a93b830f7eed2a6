from dataclasses import replace
from fractions import Fraction
from typing import get_args, get_type_hints

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.capture.fit_to_sensor import fit_motion, fit_pixels
from texvent.capture.frame_source import ChangedFrames
from texvent.capture.intensity_scale import scale_to_levels
from texvent.capture.linear_light import GammaCodedFrames, LinearFrames
from texvent.capture.motion_vectors.frames import MotionFrames
from texvent.capture.open import open_frames
from texvent.capture.prepare import PreparedFrames
from texvent.capture.recorded_frames import DsecFrames
from texvent.capture.scale_check import CheckedFrames, check_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.frames import MotionVectors, Video, frame_time_us
from texvent.sensor import SensorSize
from texvent.transfer import Transfer


@given(
    st.sampled_from([Fraction(10), Fraction(30_000, 1001), Fraction(100), None]),
    st.integers(-(10**10), 10**10),
    st.integers(0, 900),
    st.integers(250, 1_200),
)
def test_start_is_included_and_stop_is_not(fps, begin_us, first, length):
    ends = {"start": first / 1000, "stop": (first + length) / 1000}
    listed = None if fps else [begin_us + 211 * index**2 + 7000 * index for index in range(100)]
    stream = open_frames(
        np.zeros((100, 2, 2), np.uint8), CaptureConfig(fps=fps, **ends), t_us=listed
    )
    times_us = listed or [frame_time_us(index, fps) for index in range(100)]
    expected = [t for t in times_us if first <= (t - times_us[0]) / 1000 < first + length]
    assert [frame.t_us for frame in stream] == list(stream.times_us) == expected
    assert stream.frame_count == (len(expected) if fps else None)


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


FACTS = {"source": "made", "note": "kept"}
CHANGES = {
    CheckedFrames: lambda source: check_frames(source, CaptureConfig(white_level=255.0)),
    LinearFrames: lambda source: LinearFrames(source, "pq", None),
    GammaCodedFrames: GammaCodedFrames,
    PreparedFrames: lambda source: PreparedFrames(source, CaptureConfig(white_level=200.0)),
}
"""Classes that change frames as they come; others bring or replace what belongs to them."""


@pytest.mark.parametrize("kind", CHANGES)
def test_frames_that_are_changed_keep_all_that_is_not_changed(kind):
    assert set(ChangedFrames.__subclasses__()) == {*CHANGES, DsecFrames, MotionFrames}
    pixels = np.random.default_rng(3).integers(0, 120, (3, 4, 6)).astype(np.float32)
    times_us = [-5, 10_000, 20_000]
    linear = {"transfer": Transfer.LINEAR} if kind is GammaCodedFrames else {}
    made = [
        replace(frame, is_source=frame.t_us > 0, **linear)
        for frame in Moving(pixels, times_us, Fraction(100), FACTS)
    ]

    class Made(Video):
        def __iter__(self):
            return iter(made)

    stream = CHANGES[kind](Made(pixels, times_us, Fraction(100), FACTS))
    assert (stream.size, stream.fps, stream.frame_count) == ((6, 4), 100, 3)
    assert list(stream.times_us) == times_us
    assert stream.metadata.items() >= FACTS.items()
    for before, frame in zip(made, stream, strict=True):
        assert (frame.t_us, frame.is_source) == (before.t_us, before.is_source)
        assert frame.motion is before.motion
        assert frame.pixels.shape == before.pixels.shape
