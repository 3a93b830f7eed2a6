"""A video that plays on a surface, read as it is needed."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from texvent.errors import FileFormatError
from texvent.scenes.image import SurfaceImage, decode_srgb, surface_image

CACHED_FRAMES = 4
"""Images that are kept: renderers look at a few neighbouring instants at a time."""


class PlayedVideo:
    """The frames of a video by their own times; its end is followed by its beginning.

    Memory stays flat: times of all frames, and a few decoded images.

    Args:
        path: the file.

    Raises:
        FileFormatError: no frame of it can be decoded.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._lock = threading.Lock()
        self._images: OrderedDict[int, SurfaceImage] = OrderedDict()
        self._frames: Iterator[Any] | None = None
        self._next = 0
        self._times_s, self._duration_s = self._read_times()

    def __reduce__(self) -> tuple[type, tuple[Path]]:
        return PlayedVideo, (self._path,)

    def at(self, time_s: float) -> SurfaceImage:
        """The frame shown at an instant, s from the first one."""
        shown_s = time_s % self._duration_s
        index = max(int(np.searchsorted(self._times_s, shown_s, side="right")) - 1, 0)
        with self._lock:
            if index not in self._images:
                self._images[index] = self._decode(index)
                if len(self._images) > CACHED_FRAMES:
                    self._images.popitem(last=False)
            self._images.move_to_end(index)
            return self._images[index]

    def _read_times(self) -> tuple[np.ndarray, float]:
        """Times of all frames, s from the first, and how long the video lasts, s."""
        times = []
        for frame in self._open():
            times.append(float(frame.pts * frame.time_base) if frame.pts is not None else None)
        if not times:
            raise FileFormatError(f"{self._path} has no frame that can be decoded")
        if any(time is None for time in times):
            times = [index / 25.0 for index in range(len(times))]
        counted = np.array(times, dtype=np.float64)
        counted -= counted[0]
        last = float(np.median(np.diff(counted))) if len(counted) > 1 else 1.0
        return np.maximum.accumulate(counted), float(counted[-1]) + max(last, 1e-3)

    def _open(self) -> Iterator[Any]:
        import av  # most scenes show no video
        from av.error import FFmpegError

        try:
            with av.open(str(self._path)) as container:
                yield from container.decode(video=0)
        except (FFmpegError, IndexError, OSError) as error:
            raise FileFormatError(
                f"{self._path} is no video that can be decoded "
                f"({getattr(error, 'strerror', None) or error}); name another file"
            ) from error

    def _decode(self, index: int) -> SurfaceImage:
        """Read on to a frame, from the beginning where it lies behind."""
        if self._frames is None or index < self._next:
            self._frames, self._next = self._open(), 0
        for frame in self._frames:
            self._next += 1
            if self._next == index + 1:
                coded = frame.to_ndarray(format="rgb24")
                return surface_image(decode_srgb(np.asarray(coded, dtype=np.uint8)))
        raise FileFormatError(
            f"{self._path} ends before frame {index}; it changed while it was read"
        )
