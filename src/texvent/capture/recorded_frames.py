"""Frames of recordings with events: DSEC sequences, and EVREAL's folders of arrays.

Files of a DSEC sequence, once the archives are unpacked into one folder:

    events/left/events.h5          the left event camera, 640x480
    events/left/rectify_map.h5     rectify_map f4 [480, 640, 2]: raw pixel → rectified (x, y)
    images/left/rectified/*.png    the left frame camera, rectified, another resolution
    images/timestamps.txt          µs, on the clock of the events
    calibration/cam_to_cam.yaml    intrinsics camRect0, camRect1; extrinsics T_10, R_rect0, R_rect1

The two cameras are 4.5 cm apart. The frames are turned into the raw pixels of the event camera
as if everything were far away: what is near stays displaced (1 px beyond about 25 m).

Images of an EVREAL folder:

    images.npy     u1 [n, H, W] or [n, H, W, 1]
    images_ts.npy  f8 [n] or [n, 1], seconds, on the clock of the events

Source: Gehrig et al., DSEC: A Stereo Event Camera Dataset for Driving Scenarios, RA-L 2021, and
its description of calibration files; Ercan et al., EVREAL: Towards a Comprehensive Benchmark and
Analysis Suite for Event-based Video Reconstruction, CVPRW 2023, and its reader.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.array_frames import ArrayFrames
from texvent.capture.frame_source import ChangedFrames
from texvent.capture.given_times import FrameTimes, check_seconds, listed_times
from texvent.capture.image_folder import ImageFolder
from texvent.errors import FileFormatError, one_line, shown
from texvent.frames import MICROSECONDS, Frame
from texvent.io.arrays.npy_file import StoredArray
from texvent.runtime.files.yaml_text import load_yaml
from texvent.sensor import SensorSize

DSEC_EVENTS = Path("events/left/events.h5")
RECTIFY_MAP = Path("events/left/rectify_map.h5")
DSEC_IMAGES = Path("images/left/rectified")
DSEC_TIMES = Path("images/timestamps.txt")
CALIBRATION = Path("calibration/cam_to_cam.yaml")
NOT_RIGID = 1e-3
"""Most that the determinant of a rotation may be off."""


def is_dsec(folder: Path) -> bool:
    """True for the folder of a DSEC sequence."""
    return (folder / DSEC_IMAGES).is_dir() and (folder / DSEC_EVENTS).is_file()


class DsecFrames(ChangedFrames):
    """The left frame camera's images in the pixels of the left event camera.

    The calibration is read when the sequence is opened, the images one by one.

    Raises:
        InputError: images or times are missing.
        FileFormatError: the calibration is missing, damaged or lacks an entry.
    """

    def __init__(self, folder: Path) -> None:
        times = folder / DSEC_TIMES
        super().__init__(ImageFolder(folder / DSEC_IMAGES, timestamps=times, unit="us"))
        rectified = _read_places(folder / RECTIFY_MAP)
        homography = _read_homography(folder / CALIBRATION)
        height, width = rectified.shape[:2]
        seen = np.concatenate([rectified, np.ones((height, width, 1))], axis=2) @ homography.T
        # Column and row of the frame that each pixel of the event camera sees, [480, 640].
        self._column, self._row = (
            (seen[..., axis] / seen[..., 2]).astype(np.float32) for axis in (0, 1)
        )
        self.size, self._folder = SensorSize(width, height), folder

    @property
    def metadata(self) -> Mapping[str, Any]:
        """The sequence, instead of its folder of images."""
        return {"source": str(self._folder), "kind": "DSEC sequence"}

    def __iter__(self) -> Iterator[Frame]:
        """Frames in order, read one by one; places that no frame shows are black."""
        import cv2  # only frames of DSEC need it here

        for frame in self.source:
            pixels = cv2.remap(
                np.asarray(frame.pixels), self._column, self._row, interpolation=cv2.INTER_LINEAR
            )
            yield Frame(np.asarray(pixels), frame.t_us)


def _read_places(path: Path) -> NDArray[np.float64]:
    from texvent.io.calibration import read_rectify_map  # brings h5py

    rectified = read_rectify_map(path)
    if not np.isfinite(rectified).all():
        raise FileFormatError(f"{path}: rectify_map holds values that are NaN or infinite")
    return rectified


def _read_homography(path: Path) -> NDArray[np.float64]:
    """Rectified pixel of the event camera → rectified pixel of the frame camera, at infinity.

    `K1 · (R_rect1 · R_10 · R_rect0⁻¹) · K0⁻¹`.
    """
    try:
        facts = load_yaml(path.read_text(encoding="utf-8"))
        event, frame = (_camera_matrix(facts["intrinsics"][f"camRect{i}"]) for i in (0, 1))
        extrinsics = facts["extrinsics"]
        between = np.asarray(extrinsics["T_10"], np.float64)[:3, :3]
        turns = [np.asarray(extrinsics[f"R_rect{i}"], np.float64) for i in (0, 1)]
        turn = turns[1] @ between @ turns[0].T
        homography = frame @ turn @ np.linalg.inv(event)
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(f"calibration {path} cannot be read ({one_line(error)})") from error
    except (KeyError, TypeError, ValueError, IndexError, RecursionError) as error:
        raise FileFormatError(f"calibration {path} lacks an entry ({one_line(error)})") from error
    if not np.isfinite(homography).all() or abs(np.linalg.det(turn) - 1.0) > NOT_RIGID:
        raise FileFormatError(
            f"calibration {path} holds numbers that are not finite, or turns that are none"
        )
    return np.asarray(homography)


def _camera_matrix(camera: Mapping[str, Any]) -> NDArray[np.float64]:
    """From DSEC's [fx, fy, cx, cy]."""
    fx, fy, cx, cy = (float(value) for value in camera["camera_matrix"])
    return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])


IMAGES, TIMES = "images.npy", "images_ts.npy"
LAST_S = 2**51 / MICROSECONDS
"""Later times, s, are not kept to the µs by the file's own numbers."""


def is_evreal(folder: Path) -> bool:
    """True for a folder with EVREAL's arrays of images and their times."""
    return all((folder / name).is_file() for name in (IMAGES, TIMES))


def open_evreal(folder: Path, times: FrameTimes | None) -> ArrayFrames:
    """The images of a folder in order, read when asked for; `times` replace the folder's own.

    Raises:
        FileFormatError: an array is damaged, or the times are no seconds.
        InputError: images of another shape, another number of times than images, or times that do
            not increase.
    """
    images = StoredArray(folder / IMAGES)
    facts = {"source": str(folder), "kind": "EVREAL folder"}
    times = times or _read_times(folder / TIMES)
    return ArrayFrames(images, times, metadata=facts)


def _read_times(path: Path) -> FrameTimes:
    stored = StoredArray(path)
    if stored.dtype.kind not in "fiu" or stored.ndim == 0:
        raise FileFormatError(f"{path} holds {shown(stored.dtype)}, not a list of seconds")
    seconds = stored.rows(0, len(stored)).reshape(-1).astype(np.float64)
    if not (np.abs(seconds) < LAST_S).all():
        raise FileFormatError(f"{path} holds {stored.dtype} that are not all seconds")
    times_us = np.rint(seconds * MICROSECONDS).astype(np.int64)
    times = listed_times(times_us, path.name)
    check_seconds(str(path), times_us.tolist(), "give `t_us` instead, in µs")
    return times
