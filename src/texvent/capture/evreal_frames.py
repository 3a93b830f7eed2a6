"""Frames of EVREAL's folders: images and their times as memory-mapped arrays.

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
from texvent.errors import FileFormatError
from texvent.io.arrays.npy_file import map_array
from texvent.sensor import checked_size
from texvent.video import MICROSECONDS, Frame

IMAGES, TIMES = "images.npy", "images_ts.npy"


def is_evreal(folder: Path) -> bool:
    """True for a folder with EVREAL's arrays of images and their times."""
    return all((folder / name).is_file() for name in (IMAGES, TIMES))


class EvrealFrames(FrameSource):
    """The images of a folder in order; they are mapped, not read, until they are asked for.

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
        images = map_array(folder / IMAGES)
        if images.ndim == 4 and images.shape[3] == 1:
            images = images[..., 0]
        if images.ndim not in (3, 4):
            raise FileFormatError(
                f"{folder / IMAGES} has shape {images.shape}; images are [n, H, W]"
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
            pixels = usable_pixels(np.array(image), str(self._folder / IMAGES))
            yield Frame(pixels, self._times(index))


def _read_times(path: Path) -> FrameTimes:
    seconds = np.asarray(map_array(path)).reshape(-1)
    if seconds.dtype.kind not in "fiu" or not np.isfinite(seconds).all():
        raise FileFormatError(f"{path} holds {seconds.dtype} that are not all seconds")
    return listed_times(np.rint(seconds * MICROSECONDS).astype(np.int64), path.name)
