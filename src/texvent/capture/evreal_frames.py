"""Frames of EVREAL's folders: pictures and their times as memory-mapped arrays.

    images.npy     u1 [n, H, W] or [n, H, W, 1]
    images_ts.npy  f8 [n] or [n, 1], seconds, on the clock of the events

Source: Ercan et al., EVREAL: Towards a Comprehensive Benchmark and Analysis Suite for
Event-based Video Reconstruction, CVPRW 2023, and its reader.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from texvent.capture.intensity_scale import usable_pixels
from texvent.capture.times import FrameTimes, listed_times
from texvent.errors import FileFormatError
from texvent.io.arrays.npy_file import map_array
from texvent.sensor import SensorSize, checked_size
from texvent.video import MICROSECONDS, Frame

PICTURES, TIMES = "images.npy", "images_ts.npy"


def is_evreal(folder: Path) -> bool:
    """True for a folder with EVREAL's arrays of pictures and their times."""
    return all((folder / name).is_file() for name in (PICTURES, TIMES))


class EvrealFrames:
    """The pictures of a folder in order; they are mapped, not read, until they are asked for.

    Args:
        folder: holds images.npy and images_ts.npy.
        times: frame times that replace the folder's own.

    Raises:
        FileFormatError: an array is damaged or of another shape.
        InputError: another number of times is given than there are pictures, or times that do not
            increase.
    """

    def __init__(self, folder: Path, times: FrameTimes | None = None) -> None:
        self._folder = folder
        pictures = map_array(folder / PICTURES)
        if pictures.ndim == 4 and pictures.shape[3] == 1:
            pictures = pictures[..., 0]
        if pictures.ndim not in (3, 4):
            raise FileFormatError(
                f"{folder / PICTURES} has shape {pictures.shape}; pictures are [n, H, W]"
            )
        self._pictures = pictures
        self._times = times or _read_times(folder / TIMES)
        self._times.check_count(len(pictures))
        self._size = checked_size(pictures.shape[2], pictures.shape[1])

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        return self._size

    @property
    def fps(self) -> Fraction | None:
        """The frame rate that was given, or None: each frame has its own time."""
        return self._times.fps

    @property
    def frame_count(self) -> int:
        """Number of pictures."""
        return len(self._pictures)

    @property
    def is_live(self) -> bool:
        """False: the folder can be read again."""
        return False

    @property
    def metadata(self) -> Mapping[str, Any]:
        """Folder and kind."""
        return {"source": str(self._folder), "kind": "EVREAL folder"}

    def __iter__(self) -> Iterator[Frame]:
        """Frames in order, read one by one."""
        for index, picture in enumerate(self._pictures):
            pixels = usable_pixels(np.array(picture), str(self._folder / PICTURES))
            yield Frame(pixels, self._times(index))


def _read_times(path: Path) -> FrameTimes:
    seconds = np.asarray(map_array(path)).reshape(-1)
    if seconds.dtype.kind not in "fiu" or not np.isfinite(seconds).all():
        raise FileFormatError(f"{path} holds {seconds.dtype} that are not all seconds")
    return listed_times(np.rint(seconds * MICROSECONDS).astype(np.int64), path.name)
