"""Small samples in the layouts of Isaac Lab, CARLA and Unreal.

    python -m tests.capture.motion_vectors.renderer_samples

None of the three engines ran: what Blender rendered (`blender_sample`) is written as their
documentation says that they write it. It needs the package OpenEXR.
"""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.video import Frame
from texvent.view.drawing.event_image import frame_image

HERE = Path(__file__).parent
BLENDER = HERE / "blender_sample"


def main() -> None:
    """Write the three folders anew."""
    frames = list(open_frames(BLENDER, CaptureConfig(motion=BLENDER / "motion")))
    for name, write in {"isaac": write_isaac, "carla": write_carla, "unreal": write_unreal}.items():
        folder = HERE / f"{name}_sample"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        for index, frame in enumerate(frames):
            write(folder, index, frame)


def write_isaac(folder: Path, index: int, frame: Frame) -> None:
    """As BasicWriter of Replicator: four numbers per vector, the last two unused."""
    height, width = frame.luma.shape
    vectors = np.zeros((height, width, 4), np.float32)
    vectors[..., :2] = backward(frame)
    depth = np.where(np.isinf(frame.motion.depth), 0, frame.motion.depth).astype(np.float32)
    write_png(folder / f"rgb_{index:04}.png", frame)
    np.save(folder / f"motion_vectors_{index:04}.npy", vectors)
    np.save(folder / f"distance_to_image_plane_{index:04}.npy", depth)


def write_carla(folder: Path, index: int, frame: Frame) -> None:
    """As `image.save_to_disk` writes rgb, and the flow's raw data as an array."""
    for name in ("rgb", "flow"):
        (folder / name).mkdir(exist_ok=True)
    write_png(folder / "rgb" / f"{index:06}.png", frame)
    np.save(folder / "flow" / f"{index:06}.npy", ndc(frame))


def write_unreal(folder: Path, index: int, frame: Frame) -> None:
    """As Movie Render Queue: one OpenEXR file per frame with all passes, half floats."""
    import OpenEXR

    light = frame.pixels / np.float32(255)
    planes: dict[str, Any] = {name: light[..., k] for k, name in enumerate("RGB")}
    planes["A"] = np.ones(light.shape[:2])
    vectors, depth = ndc(frame) / 4 + 0.5, frame.motion.depth * 100
    for k, name in enumerate("RG"):
        planes[f"FinalImageMovieRenderQueue_MotionVectors.{name}"] = vectors[..., k]
    planes["FinalImageMovieRenderQueue_WorldDepth.R"] = depth  # cm
    halves = {name: np.ascontiguousarray(plane, np.float16) for name, plane in planes.items()}
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, halves).write(str(folder / f"Sequence.{index:04}.exr"))


def write_png(path: Path, frame: Frame) -> None:
    """The frame in 8 bits."""
    pixels = frame_image(frame)
    cv2.imwrite(str(path), pixels[..., ::-1])


def backward(frame: Frame) -> np.ndarray:
    """Vectors to the previous frame; engines store zeros in the first one."""
    vectors = frame.motion.backward
    return np.zeros((*frame.luma.shape, 2), np.float32) if vectors is None else vectors


def ndc(frame: Frame) -> np.ndarray:
    """The motion since the previous frame, in normalised device coordinates, y up."""
    height, width = frame.luma.shape
    return (backward(frame) * np.float32([-2 / width, 2 / height])).astype(np.float32)


if __name__ == "__main__":
    main()
