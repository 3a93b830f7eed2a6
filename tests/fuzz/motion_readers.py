"""Motion vectors, depth and passes beside frames, in every format."""

import warnings
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np

from texvent._require import require
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import TexventWarning

from .reader import Reader, digest

WIDTH, HEIGHT, COUNT = 24, 16, 3
VECTOR = np.float32([2.0, -1.0])


def motion_readers() -> list[Reader]:
    """One per format."""
    return [Reader(f"motion {ending}", make, _read) for ending, make in FORMATS.items()]


def _flow() -> np.ndarray:
    return np.zeros((COUNT, HEIGHT, WIDTH, 2), np.float32) + VECTOR


def _frames() -> np.ndarray:
    row, column = np.mgrid[:HEIGHT, :WIDTH]
    images = [100 + 40 * np.sin(0.5 * (column - 2 * k) + 0.4 * (row + k)) for k in range(COUNT)]
    return np.stack(images).astype(np.uint8)


def _make_npy(folder: Path) -> Path:
    np.save(folder / "flow.npy", _flow())
    return folder / "flow.npy"


def _make_npz(folder: Path) -> Path:
    depth = np.full((COUNT, HEIGHT, WIDTH), 3.0, np.float32)
    np.savez(folder / "a.npz", forward=_flow(), backward=-_flow(), depth=depth)
    return folder / "a.npz"


def _make_exr(folder: Path) -> Path:
    library = require("OpenEXR", extra="exr")
    planes = {"X": -2.0, "Y": -1.0, "Z": -2.0, "W": -1.0}
    channels = {
        f"ViewLayer.Vector.{name}": np.full((HEIGHT, WIDTH), value, np.float32)
        for name, value in planes.items()
    }
    channels["ViewLayer.Depth.Z"] = np.full((HEIGHT, WIDTH), 3.0, np.float32)
    header = {"compression": library.ZIP_COMPRESSION, "type": library.scanlineimage}
    for index in range(COUNT):
        library.File(header, channels).write(str(folder / f"{index}.exr"))
    return folder


def _read(path: Path) -> str:
    config = CaptureConfig(fps=Fraction(25), motion=path)
    warnings.simplefilter("ignore", TexventWarning)  # damaged vectors explain little
    parts: list[object] = []
    for frame in open_frames(_frames(), config):
        motion = frame.motion
        fields = (motion.forward, motion.backward, motion.depth, motion.instance)
        parts += [field for field in fields if field is not None]
    return digest(parts)


FORMATS: dict[str, Callable[[Path], Path]] = {
    ".npy": _make_npy,
    ".npz": _make_npz,
    ".exr": _make_exr,
}
