"""Frames of a DSEC sequence as the left event camera would see them.

The two cameras stand 4.5 cm apart. The frames are turned into the raw pixels of the event camera
as if everything were far away: what is near stays displaced (1 px beyond about 25 m).

Source: Gehrig et al., DSEC: A Stereo Event Camera Dataset for Driving Scenarios, RA-L 2021, and
its description of calibration files.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.capture.dsec_layout import CALIBRATION, PICTURES, RECTIFY_MAP, TIMESTAMPS
from texvent.capture.image_folder import ImageFolder
from texvent.errors import FileFormatError
from texvent.sensor import SensorSize
from texvent.video import Frame


@dataclass(frozen=True, eq=False)
class DsecFrames:
    """The left frame camera's pictures in the pixels of the left event camera."""

    folder: Path
    pictures: ImageFolder
    column: NDArray[np.float32]
    """[480, 640] column of the frame that each pixel of the event camera sees."""
    row: NDArray[np.float32]

    @classmethod
    def open(cls, folder: Path) -> DsecFrames:
        """A sequence; the calibration is read, the pictures are not yet.

        Raises:
            InputError: pictures or times are missing.
            FileFormatError: the calibration is missing, damaged or lacks an entry.
        """
        pictures = ImageFolder(folder / PICTURES, timestamps=folder / TIMESTAMPS, unit="us")
        rectified = _read_rectify_map(folder / RECTIFY_MAP)
        homography = _read_homography(folder / CALIBRATION)
        ones = np.ones((*rectified.shape[:2], 1))
        seen = np.concatenate([rectified, ones], axis=2) @ homography.T
        column, row = (seen[..., axis] / seen[..., 2] for axis in (0, 1))
        return cls(folder, pictures, column.astype(np.float32), row.astype(np.float32))

    @property
    def size(self) -> SensorSize:
        """Width and height of the event camera, pixels."""
        height, width = self.column.shape
        return SensorSize(width, height)

    @property
    def fps(self) -> Fraction | None:
        """None: each frame has its own time."""
        return self.pictures.fps

    @property
    def frame_count(self) -> int:
        """Number of pictures."""
        return self.pictures.frame_count

    @property
    def is_live(self) -> bool:
        """False: the folder can be read again."""
        return False

    @property
    def metadata(self) -> Mapping[str, Any]:
        """Folder and kind."""
        return {"source": str(self.folder), "kind": "DSEC sequence"}

    def __iter__(self) -> Iterator[Frame]:
        """Frames in order, read one by one; places that no frame shows are black."""
        for frame in self.pictures:
            pixels = cv2.remap(
                np.asarray(frame.pixels), self.column, self.row, interpolation=cv2.INTER_LINEAR
            )
            yield Frame(np.asarray(pixels), frame.t_us)


def _read_rectify_map(path: Path) -> NDArray[np.float64]:
    h5py = require("h5py")
    try:
        with h5py.File(path) as file:
            rectified = np.asarray(file["rectify_map"], np.float64)
    except (OSError, KeyError) as error:
        raise FileFormatError(f"{path} holds no rectify_map ({error})") from error
    if rectified.ndim != 3 or rectified.shape[2] != 2:
        raise FileFormatError(f"{path}: rectify_map has shape {rectified.shape}, not [H, W, 2]")
    return rectified


def _read_homography(path: Path) -> NDArray[np.float64]:
    """Rectified pixel of the event camera → rectified pixel of the frame camera, at infinity.

    `K1 · (R_rect1 · R_10 · R_rect0⁻¹) · K0⁻¹`.
    """
    yaml = require("yaml")
    try:
        facts = yaml.safe_load(path.read_text(encoding="utf-8"))
        event, picture = (_camera_matrix(facts["intrinsics"][f"camRect{i}"]) for i in (0, 1))
        extrinsics = facts["extrinsics"]
        between = np.asarray(extrinsics["T_10"], np.float64)[:3, :3]
        turns = [np.asarray(extrinsics[f"R_rect{i}"], np.float64) for i in (0, 1)]
        turn = turns[1] @ between @ turns[0].T
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise FileFormatError(f"calibration {path} cannot be read ({error})") from error
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise FileFormatError(f"calibration {path} lacks an entry ({error!r})") from error
    return np.asarray(picture @ turn @ np.linalg.inv(event))


def _camera_matrix(camera: Mapping[str, Any]) -> NDArray[np.float64]:
    """From DSEC's [fx, fy, cx, cy]."""
    fx, fy, cx, cy = (float(value) for value in camera["camera_matrix"])
    return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])
