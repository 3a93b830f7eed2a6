"""The video that a model follows: upright 8-bit frames, and what is refused."""

from fractions import Fraction

import av
import numpy as np
import pytest

from texvent.capture.video_file import VideoFile
from texvent.errors import InputError
from texvent.generate.videos.reference_video import read_reference
from texvent.generate.videos.stored_video import write_video


def write_clip(path, codec, stored, *, rotation=0, coding=None):
    """Three frames of four colours."""
    colours = np.random.default_rng(0).integers(0, 255, (2, 2, 3), np.uint8)
    pixels = colours.repeat(16, axis=0).repeat(24, axis=1)
    with av.open(str(path), "w") as container:
        stream = container.add_stream(codec, rate=25)
        stream.height, stream.width = pixels.shape[:2]
        stream.pix_fmt = stored
        if rotation:
            stream.set_display_rotation(rotation)
        if coding is not None:
            stream.codec_context.color_trc = coding
        for index in range(3):
            frame = av.VideoFrame.from_ndarray(pixels, format="rgb24")
            frame.pts = index
            container.mux(stream.encode(frame))
        container.mux(stream.encode())
    return path


@pytest.mark.parametrize("rotation", [0, 90, -90, 180])
def test_frames_are_those_that_simulate_reads_turned_as_the_file_says(rotation, tmp_path):
    path = write_clip(tmp_path / "v.mp4", "h264", "yuv420p", rotation=rotation)
    expected = [frame.pixels for frame in VideoFile(path)]
    assert expected[0].shape[:2] == ((48, 32) if rotation in (90, -90) else (32, 48))
    np.testing.assert_array_equal(list(read_reference(path, 3)), expected)
    np.testing.assert_array_equal(list(read_reference(path, 2)), expected[:2])


@pytest.mark.parametrize(("coding", "name"), [(8, "linear"), (16, "HDR10"), (18, "HLG")])
def test_video_that_is_no_ordinary_one_is_refused(coding, name, tmp_path):
    path = write_clip(tmp_path / "v.mkv", "ffv1", "yuv420p10le", coding=coding)
    with pytest.raises(InputError, match=rf"is .*{name}.*texvent simulate makes its events"):
        next(read_reference(path, 3))


def test_light_that_texvent_stored_is_refused_and_other_videos_of_it_are_not(tmp_path):
    values = np.full((2, 8, 8, 3), 0.2, np.float32)
    for name, facts in (("light.avi", {"transfer": "linear"}), ("coded.avi", {})):
        write_video(values, tmp_path / name, Fraction(24), facts, overwrite=False)
    with pytest.raises(InputError, match="is linear light"):
        next(read_reference(tmp_path / "light.avi", 2))
    assert {int(frame.max()) for frame in read_reference(tmp_path / "coded.avi", 2)} == {51}


def test_a_video_that_is_too_short_says_how_many_frames_it_has(tmp_path):
    path = write_clip(tmp_path / "v.mp4", "h264", "yuv420p")
    with pytest.raises(InputError, match=r"has 3 frames, and 9 are to be made; .*frames=3"):
        list(read_reference(path, 9))
