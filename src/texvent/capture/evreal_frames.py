"""Frames of EVREAL's folders: images and their times as arrays.

    images.npy     u1 [n, H, W] or [n, H, W, 1]
    images_ts.npy  f8 [n] or [n, 1], seconds, on the clock of the events

Source: Ercan et al., EVREAL: Towards a Comprehensive Benchmark and Analysis Suite for
Event-based Video Reconstruction, CVPRW 2023, and its reader.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from texvent.capture.frame_source import FrameSource, SourceFacts
from texvent.capture.frame_times import FrameTimes, listed_times
from texvent.capture.intensity_scale import usable_pixels
from texvent.errors import FileFormatError, shown
from texvent.io.arrays.npy_file import StoredArray
from texvent.sensor import checked_size
from texvent.video import MICROSECONDS, Frame

IMAGES, TIMES = "images.npy", "images_ts.npy"
LAST_S = 2**51 / MICROSECONDS
"""Later times, s, are not kept to the µs by the file's own numbers."""


def is_evreal(folder: Path) -> bool:
    """True for a folder with EVREAL's arrays of images and their times."""
    return all((folder / name).is_file() for name in (IMAGES, TIMES))


class EvrealFrames(FrameSource):
    """The images of a folder in order; they are read when they are asked for.

    Args:
        folder: holds images.npy and images_ts.npy.
        times: frame times that replace the folder's own.

    Raises:
        FileFormatError: an array is damaged or of another shape.
        InputError: another number of times is given than there are images, or times that do not
            increase.
    """

    def __init__(self, folder: Path, times: FrameTimes | None = None) -> None:
        self._folder = folder
        images = StoredArray(folder / IMAGES)
        if images.ndim not in (3, 4):
            raise FileFormatError(
                f"{folder / IMAGES} has shape {shown(images.shape)}; images are [n, H, W]"
            )
        self._images = images
        self._times = times or _read_times(folder / TIMES)
        self._times.check_count(len(images))
        self._facts = SourceFacts(
            checked_size(images.shape[2], images.shape[1]),
            self._times.fps,
            len(images),
            {"source": str(folder), "kind": "EVREAL folder"},
        )

    def __iter__(self) -> Iterator[Frame]:
        """Frames in order, read one by one."""
        for index, image in enumerate(self._images):
            grey = image[..., 0] if image.shape[2:] == (1,) else image
            pixels = usable_pixels(grey, str(self._folder / IMAGES))
            yield Frame(pixels, self._times(index))


def _read_times(path: Path) -> FrameTimes:
    stored = StoredArray(path)
    if stored.dtype.kind not in "fiu" or stored.ndim == 0:
        raise FileFormatError(f"{path} holds {shown(stored.dtype)}, not a list of seconds")
    seconds = stored.rows(0, len(stored)).reshape(-1).astype(np.float64)
    if not (np.abs(seconds) < LAST_S).all():
        raise FileFormatError(f"{path} holds {stored.dtype} that are not all seconds")
    return listed_times(np.rint(seconds * MICROSECONDS).astype(np.int64), path.name)
