"""Writers of event videos, and of image sequences as videos or folders."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from fractions import Fraction
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.frames import MICROSECONDS, PREVIEW_MARK, Frame
from texvent.io.atomic import AtomicOutput, atomic_folder, check_output, check_output_folder
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import png_bytes
from texvent.view.drawing.event_image import count_ceiling, frame_image
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Palette, get_palette
from texvent.view.drawing.panels import TARGET_WIDTH, PanelLayout
from texvent.view.video_encoder import VIDEO_EXTENSIONS, VideoEncoder
from texvent.view.windows import EventWindow, compose_window

TIMES, FACTS = "timestamps.txt", "texvent.json"
WHITE = 255.0


class ImageSink(Protocol):
    """Takes images in time order."""

    def add(self, t_us: int, image: NDArray[np.floating]) -> None:
        """Take one.

        Args:
            t_us: its time, µs, increasing.
            image: [H, W], or [H, W, 3] RGB, 0..1.
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
        path: file to write.
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


def write_images(frames: Iterable[Frame], folder: Path, *, overwrite: bool) -> None:
    """A folder of images with their times in `timestamps.txt`, in 8 bits.

    Raises:
        OutputError: it exists already, or cannot be written.
    """
    with atomic_folder(folder, overwrite=overwrite, is_own=_is_own) as part:
        sink = _FolderSink(part)
        for frame in frames:
            image = frame.pixels if frame.pixels.dtype == np.uint8 else frame_image(frame)
            sink.write(frame.t_us, image)
        (part / TIMES).write_text("".join(sink.times), encoding="utf-8")


def write_clips(
    clips: Iterable[tuple[str, Iterable[Frame]]], folder: Path, *, overwrite: bool
) -> None:
    """A folder with a folder of images per clip, complete or not there; see `write_images`.

    Args:
        clips: (name, frames), read one after the other.
        folder: to write.
        overwrite: whether a folder of such folders may be replaced.

    Raises:
        OutputError: it exists already, holds other files, or cannot be written.
    """
    with atomic_folder(folder, overwrite=overwrite, is_own=_is_own, is_nested=True) as part:
        for name, frames in clips:
            write_images(frames, part / name, overwrite=False)


class _VideoSink:
    def __init__(self, video: VideoEncoder, rows: int, columns: int) -> None:
        self._video = video
        self._more = ((0, rows), (0, columns), (0, 0))
        self._first_us: int | None = None

    def add(self, t_us: int, image: NDArray[np.floating]) -> None:
        self._first_us = t_us if self._first_us is None else self._first_us
        rgb = np.broadcast_to(_levels(image.reshape(*image.shape[:2], -1)), (*image.shape[:2], 3))
        self._video.write(np.pad(rgb, self._more, mode="edge"), t_us - self._first_us)


class _FolderSink:
    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.times: list[str] = []

    def add(self, t_us: int, image: NDArray[np.floating]) -> None:
        self.write(t_us, _levels(image))

    def write(self, t_us: int, levels: NDArray[Any]) -> None:
        """Write an image of 8 bits, [H, W] or [H, W, 3] RGB."""
        name = f"frame_{len(self.times):010d}.png"
        (self._folder / name).write_bytes(png_bytes(levels))
        sign, (seconds, rest) = "-" if t_us < 0 else "", divmod(abs(t_us), MICROSECONDS)
        self.times.append(f"{sign}{seconds}.{rest:06d} {name}\n")


def _levels(image: NDArray[np.floating]) -> NDArray[np.uint8]:
    levels = np.rint(np.clip(image, 0.0, 1.0) * WHITE)
    return np.asarray(levels, np.uint8)


def _is_own(path: Path) -> bool:
    return path.name in (TIMES, FACTS) or bool(re.fullmatch(r"frame_\d+\.png", path.name))


GIF_WIDTH = 640.0
"""A gif compresses badly, so it is kept small."""
CEILING_MEMORY = 0.9
"""Share of the colour scale that is kept from one video frame to the next, against flicker."""


class VideoWriter(AtomicOutput):
    """Writes an mp4 or gif of windows while they come in; memory stays flat.

    Each is shown until the next one. Times are kept to the µs (gif: 1/100 s).

    Raises:
        ConfigError: the extension is not .mp4 or .gif, or the palette is unknown.
        OutputError: the file exists already or cannot be written.
    """

    def __init__(
        self,
        path: str | Path,
        *,
        size: SensorSize,
        fps: Fraction | None,
        palette: str | Palette = DEFAULT_PALETTE,
        side_by_side: bool = True,
        overwrite: bool = False,
        title: str = "",
    ) -> None:
        """Check the path; the `with` statement opens it.

        Args:
            path: .mp4 or .gif file.
            size: sensor size, pixels.
            fps: nominal rate of the source frames, or None where it is not known.
            palette: colours, by name.
            side_by_side: whether the frames are shown, or only the events.
            overwrite: whether an existing file may be replaced.
            title: text of the caption, such as the prompt.
        """
        super().__init__()
        width = GIF_WIDTH if Path(path).suffix.lower() == ".gif" else TARGET_WIDTH
        self._layout = PanelLayout(size, get_palette(palette), side_by_side, width)
        self._encoder = VideoEncoder(
            path,
            width=self._layout.width,
            height=self._layout.height,
            fps=fps or Fraction(30),
            comment=PREVIEW_MARK,
            overwrite=overwrite,
        )
        self._title = title
        self._first_us: int | None = None
        self._stop_us: int | None = None
        self._ceiling = 1.0

    def _open(self, stack: ExitStack) -> None:
        stack.enter_context(self._encoder)

    def show(self, window: EventWindow, *, video_start_us: int | None = None) -> None:
        """Add one video frame.

        Args:
            window: events of the image.
            video_start_us: when it appears, µs from the start of the video; default: as long
                after the first window as in the recording.
        """
        if self._first_us is None:
            self._first_us = window.start_us
        start_us = window.start_us - self._first_us if video_start_us is None else video_start_us
        self._ceiling = max(count_ceiling(window.counts), CEILING_MEMORY * self._ceiling)
        image = compose_window(
            window,
            self._layout,
            title=self._title,
            facts=window.caption,
            ceiling=self._ceiling,
        )
        self._encoder.write(image, start_us)
        # With its own timing, the caller's nominal rate decides how long the last one stays.
        self._stop_us = window.stop_us - self._first_us if video_start_us is None else None

    def _complete(self) -> None:
        if self._stop_us is not None:
            self._encoder.end(self._stop_us)
