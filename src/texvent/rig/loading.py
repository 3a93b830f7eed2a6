"""A recorded rig, read back (layout hdf5)."""

from __future__ import annotations

import csv
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.event_packets import EventPackets
from texvent.io.files import open_events
from texvent.rig.description import Float64Array, Rig, RigCamera
from texvent.rig.kalibr import HALF_PIXEL, read_rig
from texvent.rig.layouts.parts import CALIBRATION, FACTS
from texvent.scenes.lens import Lens
from texvent.sensor import SensorSize

_NS_PER_US = 1000


@dataclass(frozen=True, eq=False)
class LoadedCamera:
    """One camera of a recorded rig."""

    folder: Path
    """Folder of its files."""
    mount: RigCamera
    """Its name, size, lens and place."""

    @property
    def events(self) -> EventPackets:
        """Its events, read when packets are asked for; `.collect()` reads them into memory."""
        return open_events(self.folder / "events.h5")

    @cached_property
    def frame_t_us(self) -> NDArray[np.int64]:
        """[n] times of its frames, µs; empty where none were recorded."""
        return np.array([int(row["t_us"]) for row in self._rows], dtype=np.int64)

    def frame(self, index: int) -> NDArray[np.uint8]:
        """Frame `index`, [H, W, 3] uint8 RGB.

        Raises:
            InputError: there is no such frame, or its file cannot be read.
        """
        import cv2

        if not 0 <= index < len(self._rows):
            raise InputError(f"{self.folder} has {len(self._rows)} frames; there is no {index}")
        path = self.folder / self._rows[index]["file"]
        image = cv2.imread(str(path), cv2.IMREAD_COLOR)
        if image is None:
            raise InputError(f"{path} is missing or no image")
        return np.ascontiguousarray(image[..., ::-1], dtype=np.uint8)

    @property
    def matrix(self) -> Float64Array:
        """[3, 3] pinhole matrix as OpenCV takes it: the middle of the first pixel is (0, 0)."""
        lens = self._lens
        middle = lens.cx - HALF_PIXEL, lens.cy - HALF_PIXEL
        return np.array([[lens.fx, 0, middle[0]], [0, lens.fy, middle[1]], [0, 0, 1.0]])

    @property
    def coefficients(self) -> Float64Array:
        """[4] distortion as `cv2.projectPoints` (radtan) or `cv2.fisheye.projectPoints` take it."""
        return np.array(self._lens.coefficients)

    @property
    def _lens(self) -> Lens:
        if self.mount.lens is None:
            raise FileFormatError(f"{self.folder.parent / CALIBRATION} states no intrinsics")
        return self.mount.lens

    @cached_property
    def _rows(self) -> list[dict[str, str]]:
        path = self.folder / "frames.csv"
        if not path.exists():
            return []
        with path.open(encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))


@dataclass(frozen=True, eq=False)
class LoadedRig:
    """A recorded rig; its files are read when they are asked for."""

    folder: Path
    rig: Rig
    """Lenses and places."""
    facts: Mapping[str, Any]
    """Provenance: rig.json."""

    @property
    def cameras(self) -> tuple[LoadedCamera, ...]:
        """In the order of the rig file."""
        return tuple(LoadedCamera(self.folder / one.name, one) for one in self.rig.cameras)

    @cached_property
    def imu_t_us(self) -> NDArray[np.int64]:
        """[n] times of the IMU's samples, µs; empty without an IMU."""
        return (self._imu[:, 0] // _NS_PER_US).astype(np.int64)

    @property
    def imu_rate(self) -> Float64Array:
        """[n, 3] angular velocity in the IMU's axes, rad/s."""
        return self._imu[:, 1:4]

    @property
    def imu_acceleration(self) -> Float64Array:
        """[n, 3] specific force in the IMU's axes, m/s²."""
        return self._imu[:, 4:]

    @cached_property
    def poses(self) -> Float64Array:
        """[m, 8] true poses: time s, place m, quaternion x y z w from the IMU to the world."""
        return np.loadtxt(self.folder / "poses.txt", ndmin=2)

    @cached_property
    def _imu(self) -> Float64Array:
        path = self.folder / "imu.csv"
        return np.loadtxt(path, delimiter=",", ndmin=2) if path.exists() else np.empty((0, 7))


def load(folder: str | Path) -> LoadedRig:
    """A rig that `texvent rig` recorded with layout hdf5.

    Args:
        folder: what was given as `-o`.

    Raises:
        InputError: it is no such folder, or has another layout.
        FileFormatError: its rig.json is damaged.
    """
    folder = Path(folder)
    try:
        facts = json.loads((folder / FACTS).read_text(encoding="utf-8"))
        layout = facts["rig"]["options"]["layout"]
        names = list(facts["pixel_seeds"])
    except OSError as error:
        raise InputError(
            f"{folder} is no recorded rig: {FACTS} cannot be read ({error.strerror})"
        ) from error
    except (ValueError, KeyError, TypeError) as error:
        raise FileFormatError(f"{folder / FACTS} is damaged ({one_line(error)})") from error
    if layout != "hdf5":
        raise InputError(
            f"{folder} has layout {shown(layout)}, made for other programs; rig.load reads hdf5"
        )
    rig, _ = read_rig(folder / CALIBRATION, SensorSize(1, 1))
    cameras = tuple(
        RigCamera(name, one.size, one.lens, one.from_first)
        for name, one in zip(names, rig.cameras, strict=True)
    )
    return LoadedRig(folder, Rig(cameras, rig.first_from_imu), facts)
