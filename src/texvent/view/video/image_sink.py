"""Grey images as they are made: into a video, or a folder of PNG files with their times."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.io.atomic import atomic_folder, check_output, check_output_folder
from texvent.sensor import SensorSize
from texvent.video import MICROSECONDS
from texvent.view.drawing.canvas import png_bytes
from texvent.view.video.encoder import VIDEO_EXTENSIONS, VideoEncoder

TIMES, FACTS = "timestamps.txt", "texvent.json"
WHITE = 255.0


class ImageSink(Protocol):
    """Takes images in time order."""

    def add(self, t_us: int, image: NDArray[np.floating]) -> None:
        """Take one.

        Args:
            t_us: its time, µs, increasing.
            image: [H, W], 0..1.
        """
        ...


def check_image_output(path: Path, *, overwrite: bool) -> None:
    """Refuse a place that images cannot be put at, before any work.

    Raises:
        OutputError: it exists already, holds other files, or cannot be written.
    """
    if path.suffix.lower() in VIDEO_EXTENSIONS:
        check_output(path, overwrite=overwrite)
    else:
        check_output_folder(path, overwrite=overwrite, is_own=_is_own)


@contextmanager
def open_image_sink(
    path: Path, *, size: SensorSize, fps: Fraction, facts: Mapping[str, Any], overwrite: bool
) -> Iterator[ImageSink]:
    """A video (.mp4, .gif) or else a folder, complete when the `with` block ends without error.

    Args:
        path: what to write.
        size: of every image, pixels.
        fps: nominal rate; the times given with the images are what counts.
        facts: how they were made (JSON-serialisable); a folder keeps them, a video cannot.
        overwrite: whether a video, or a folder of such images, may be replaced.

    Raises:
        OutputError: it exists already, or cannot be written.
        InputError: the block ends without an image.
    """
    if path.suffix.lower() in VIDEO_EXTENSIONS:
        # Videos have even sides; an odd one is shown with its last row or column twice.
        width, height = size.width + size.width % 2, size.height + size.height % 2
        with VideoEncoder(path, width=width, height=height, fps=fps, overwrite=overwrite) as video:
            yield _VideoSink(video, height - size.height, width - size.width)
        return
    with atomic_folder(path, overwrite=overwrite, is_own=_is_own) as part:
        sink = _FolderSink(part)
        yield sink
        if not sink.times:
            raise InputError(f"no image for {path}; the recording holds no event")
        (part / TIMES).write_text("".join(sink.times), encoding="utf-8")
        (part / FACTS).write_text(json.dumps(dict(facts), indent=1) + "\n", encoding="utf-8")


class _VideoSink:
    def __init__(self, video: VideoEncoder, rows: int, columns: int) -> None:
        self._video = video
        self._more = ((0, rows), (0, columns), (0, 0))
        self._first_us: int | None = None

    def add(self, t_us: int, image: NDArray[np.floating]) -> None:
        self._first_us = t_us if self._first_us is None else self._first_us
        rgb = np.repeat(_levels(image)[..., None], 3, axis=2)
        self._video.write(np.pad(rgb, self._more, mode="edge"), t_us - self._first_us)


class _FolderSink:
    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.times: list[str] = []

    def add(self, t_us: int, image: NDArray[np.floating]) -> None:
        name = f"frame_{len(self.times):010d}.png"
        (self._folder / name).write_bytes(png_bytes(_levels(image)))
        sign, (seconds, rest) = "-" if t_us < 0 else "", divmod(abs(t_us), MICROSECONDS)
        self.times.append(f"{sign}{seconds}.{rest:06d} {name}\n")


def _levels(image: NDArray[np.floating]) -> NDArray[np.uint8]:
    levels = np.rint(np.clip(image, 0.0, 1.0) * WHITE)
    return np.asarray(levels, np.uint8)


def _is_own(path: Path) -> bool:
    return path.name in (TIMES, FACTS) or bool(re.fullmatch(r"frame_\d+\.png", path.name))
