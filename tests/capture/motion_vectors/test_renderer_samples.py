"""A sample in the layout of Unreal gives the vectors that it was made of.

Unreal did not run: what Blender rendered (`blender_sample`) is written as its documentation says
that Movie Render Queue writes it.
"""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from texvent.capture.motion_vectors.frames import find_motion_sidecar
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.view.drawing.event_image import frame_image

OpenEXR = pytest.importorskip("OpenEXR")
BLENDER = Path(__file__).parent / "blender_sample"
EXACT_PX = 0.05
"""Unreal's half floats are 1/2048 apart around 0.5: a thousandth of the image's width."""


def write_unreal(folder, index, frame):
    """As Movie Render Queue: one OpenEXR file per frame with all passes, half floats."""
    light = frame.pixels / np.float32(255)
    planes = {name: light[..., k] for k, name in enumerate("RGB")}
    planes["A"] = np.ones(light.shape[:2])
    vectors, depth = ndc(frame) / 4 + 0.5, frame.motion.depth * 100
    for k, name in enumerate("RG"):
        planes[f"FinalImageMovieRenderQueue_MotionVectors.{name}"] = vectors[..., k]
    planes["FinalImageMovieRenderQueue_WorldDepth.R"] = depth  # cm
    halves = {name: np.ascontiguousarray(plane, np.float16) for name, plane in planes.items()}
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, halves).write(str(folder / f"Sequence.{index:04}.exr"))


def backward(frame):
    """Vectors to the previous frame; engines store zeros in the first one."""
    vectors = frame.motion.backward
    return np.zeros((*frame.luma.shape, 2), np.float32) if vectors is None else vectors


def ndc(frame):
    """The motion since the previous frame, in normalised device coordinates, y up."""
    height, width = frame.luma.shape
    return (backward(frame) * np.float32([-2 / width, 2 / height])).astype(np.float32)


@pytest.fixture(scope="module")
def truth():
    """The frames that Blender rendered, with their motion."""
    return list(open_frames(BLENDER, CaptureConfig(motion=BLENDER / "motion")))


@pytest.fixture
def frames_of(tmp_path, truth):
    """Write the sample and open it."""

    def build(**options):
        for index, frame in enumerate(truth):
            write_unreal(tmp_path, index, frame)
        config = CaptureConfig(fps=Fraction(24), motion=tmp_path, depth_scale=0.01, **options)
        return list(open_frames(tmp_path, config))

    return build


def test_a_sample_gives_the_vectors_it_was_made_of(tmp_path, truth, frames_of):
    frames = frames_of()
    assert len(frames) == len(truth)
    assert all(frame.motion.forward is None for frame in frames)
    assert frames[0].motion.backward is None
    for frame, true in zip(frames[1:], truth[1:], strict=True):
        np.testing.assert_allclose(
            frame.motion.backward, true.motion.backward, rtol=0, atol=EXACT_PX
        )
        np.testing.assert_allclose(frame.motion.depth, true.motion.depth, rtol=1e-3)
        shown, true_shown = (frame_image(one).astype(int) for one in (frame, true))
        assert np.abs(shown - true_shown).max() <= 1
    assert find_motion_sidecar(tmp_path) == tmp_path


def test_another_convention_is_refused(frames_of):
    with pytest.raises(InputError, match="do not fit the frames"):
        frames_of(motion_convention="unreal,y-down")
