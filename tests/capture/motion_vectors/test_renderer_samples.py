"""Samples in the layouts of Isaac Lab, CARLA and Unreal give the vectors that they were made of.

None of the three engines ran: what Blender rendered (`blender_sample`) is written as their
documentation says that they write it.
"""

from fractions import Fraction
from pathlib import Path

import cv2
import numpy as np
import pytest

import texvent
from texvent.capture.motion_vectors.frames import find_motion_sidecar
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.view.drawing.event_image import frame_image

OpenEXR = pytest.importorskip("OpenEXR")
BLENDER = Path(__file__).parent / "blender_sample"
EXACT_PX = {"isaac": 0.0, "carla": 1e-5, "unreal": 0.05}
"""Unreal's half floats are 1/2048 apart around 0.5: a thousandth of the image's width."""


def write_isaac(folder, index, frame):
    """As BasicWriter of Replicator: four numbers per vector, the last two unused."""
    height, width = frame.luma.shape
    vectors = np.zeros((height, width, 4), np.float32)
    vectors[..., :2] = backward(frame)
    depth = np.where(np.isinf(frame.motion.depth), 0, frame.motion.depth).astype(np.float32)
    write_png(folder / f"rgb_{index:04}.png", frame)
    np.save(folder / f"motion_vectors_{index:04}.npy", vectors)
    np.save(folder / f"distance_to_image_plane_{index:04}.npy", depth)


def write_carla(folder, index, frame):
    """As `image.save_to_disk` writes rgb, and the flow's raw data as an array."""
    for name in ("rgb", "flow"):
        (folder / name).mkdir(exist_ok=True)
    write_png(folder / "rgb" / f"{index:06}.png", frame)
    np.save(folder / "flow" / f"{index:06}.npy", ndc(frame))


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


def write_png(path, frame):
    """The frame in 8 bits."""
    pixels = frame_image(frame)
    cv2.imwrite(str(path), pixels[..., ::-1])


def backward(frame):
    """Vectors to the previous frame; engines store zeros in the first one."""
    vectors = frame.motion.backward
    return np.zeros((*frame.luma.shape, 2), np.float32) if vectors is None else vectors


def ndc(frame):
    """The motion since the previous frame, in normalised device coordinates, y up."""
    height, width = frame.luma.shape
    return (backward(frame) * np.float32([-2 / width, 2 / height])).astype(np.float32)


WRITERS = {"isaac": write_isaac, "carla": write_carla, "unreal": write_unreal}


@pytest.fixture(scope="module")
def truth():
    """The frames that Blender rendered, with their motion."""
    return list(open_frames(BLENDER, CaptureConfig(motion=BLENDER / "motion")))


@pytest.fixture
def frames_of(tmp_path, truth):
    """Write a renderer's sample and open it."""

    def build(name, **more):
        for index, frame in enumerate(truth):
            WRITERS[name](tmp_path, index, frame)
        source, options = {
            "isaac": (
                tmp_path,
                {
                    "motion": tmp_path / "motion_vectors_*.npy",
                    "depth": tmp_path / "distance_to_image_plane_*.npy",
                    "motion_convention": "isaac",
                },
            ),
            "carla": (
                tmp_path / "rgb",
                {"motion": tmp_path / "flow", "motion_convention": "carla"},
            ),
            "unreal": (tmp_path, {"motion": tmp_path, "depth_scale": 0.01}),
        }[name]
        return list(open_frames(source, CaptureConfig(fps=Fraction(24), **{**options, **more})))

    return build


@pytest.mark.parametrize("name", WRITERS)
def test_a_sample_gives_the_vectors_it_was_made_of(name, truth, frames_of):
    frames = frames_of(name)
    assert len(frames) == len(truth)
    assert all(frame.motion.forward is None for frame in frames)
    assert frames[0].motion.backward is None
    for frame, true in zip(frames[1:], truth[1:], strict=True):
        np.testing.assert_allclose(
            frame.motion.backward, true.motion.backward, rtol=0, atol=EXACT_PX[name]
        )
        if name == "carla":  # its depth images are for the user to decode
            assert frame.motion.depth is None
        else:
            np.testing.assert_allclose(frame.motion.depth, true.motion.depth, rtol=1e-3)
        shown, true_shown = (frame_image(one).astype(int) for one in (frame, true))
        assert np.abs(shown - true_shown).max() <= 1


@pytest.mark.parametrize("name", WRITERS)
def test_another_renderer_s_convention_is_refused(name, frames_of):
    wrong = {"isaac": "standard", "carla": "carla,y-down", "unreal": "unreal,y-down"}[name]
    with pytest.raises(InputError, match="do not fit the frames"):
        frames_of(name, motion_convention=wrong)


def test_passes_within_the_frames_are_found(tmp_path, frames_of):
    frames_of("unreal")
    assert find_motion_sidecar(tmp_path) == tmp_path
    events = texvent.simulate(tmp_path, fps=24, depth_scale=0.01, noise="none")
    assert events.metadata["source"]["motion_convention"] == "unreal"
