"""Images → mp4 or gif, each at its exact time. The file that knows PyAV for output."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from fractions import Fraction
from pathlib import Path
from typing import Any

import av
import av.filter

from texvent.errors import ConfigError, InputError, OutputError
from texvent.frames import MICROSECONDS
from texvent.io.atomic import AtomicOutput, atomic_file, check_output, is_disk_full
from texvent.view.drawing.canvas import Image

TIME_BASE = Fraction(1, MICROSECONDS)
CRF = "18"
"""x264 quality: visually lossless."""
GIF_TICKS_PER_S = 100
VIDEO_EXTENSIONS = (".mp4", ".gif")


class VideoEncoder(AtomicOutput):
    """Streams images into an mp4 (H.264, yuv420p, BT.709, index first) or gif file.

    Raises:
        ConfigError: the extension is not .mp4 or .gif.
        OutputError: the file exists already, its folder refuses it, or encoding fails.
        InputError: the `with` block ends without an image.
    """

    def __init__(
        self,
        path: str | Path,
        *,
        width: int,
        height: int,
        fps: Fraction,
        overwrite: bool,
        comment: str | None = None,
    ) -> None:
        """Check that the file can be written; it is opened by the `with` statement.

        Args:
            path: .mp4 or .gif file.
            width: of every image, pixels, even.
            height: of every image, pixels, even.
            fps: nominal rate; the times given with the images are what counts.
            overwrite: whether an existing file may be replaced.
            comment: metadata of an mp4.
        """
        super().__init__()
        self._comment = comment
        self._path = Path(path)
        if self._path.suffix.lower() not in VIDEO_EXTENSIONS:
            raise ConfigError(f"{path} is no video; its name must end in .mp4 or .gif")
        check_output(path, overwrite=overwrite)
        self._is_gif = self._path.suffix.lower() == ".gif"
        self._width, self._height, self._fps = width, height, fps
        self._overwrite = overwrite
        self._container: Any = None
        self._stream: Any = None
        self._last: tuple[int, Any] | None = None
        self._durations: dict[int, int] = {}
        self._count = 0

    def _open(self, stack: ExitStack) -> None:
        part = stack.enter_context(atomic_file(self._path, overwrite=self._overwrite))
        options = {} if self._is_gif else {"movflags": "faststart"}
        container = "gif" if self._is_gif else "mp4"
        with _reporting(self._path):
            self._container = stack.enter_context(
                av.open(str(part), "w", format=container, options=options)
            )
            if self._comment is not None:
                self._container.metadata["comment"] = self._comment
            self._add_stream()

    def write(self, image: Image, t_us: int) -> None:
        """Show `image` from `t_us` on (µs from the start of the video, increasing)."""
        if self._stream is None:
            raise OutputError(f"{self._path} is not open; write inside the encoder's with block")
        if self._is_gif:
            frame, pts = _with_own_colours(image), t_us * GIF_TICKS_PER_S // MICROSECONDS
        else:
            rgb = av.VideoFrame.from_ndarray(image, format="rgb24")
            # Untagged HD video is read as BT.709, so encode it that way and say so.
            frame = rgb.reformat(format="yuv420p", dst_colorspace="ITU709", dst_color_range="MPEG")
            pts = t_us
        if self._last is not None and pts <= self._last[0]:
            # gif counts in hundredths of a second: of two images in one, the first stays.
            return
        self._put_last(pts)
        self._last = (pts, frame)
        self._count += 1

    def end(self, t_us: int) -> None:
        """Say when the last image ends, µs from the start of the video."""
        ticks = t_us * GIF_TICKS_PER_S // MICROSECONDS if self._is_gif else t_us
        self._put_last(ticks)
        self._last = None

    def _complete(self) -> None:
        if self._count == 0:
            raise InputError(f"no image for {self._path}; a video needs at least one frame")
        if self._last is not None:
            self.end(self._last[0] + self._frame_ticks())
        self._encode(None)
        with _reporting(self._path):
            self._container.close()

    def _frame_ticks(self) -> int:
        ticks = GIF_TICKS_PER_S if self._is_gif else MICROSECONDS
        return max(1, round(ticks / self._fps))

    def _add_stream(self) -> None:
        rate = self._fps.limit_denominator(100_000)
        codec = "gif" if self._is_gif else "libx264"
        stream: Any = self._container.add_stream(codec, rate=rate)
        stream.width, stream.height = self._width, self._height
        if self._is_gif:
            stream.pix_fmt = "pal8"
            base = Fraction(1, GIF_TICKS_PER_S)
        else:
            stream.pix_fmt = "yuv420p"
            # No B-frames: their reordering would give the video an edit list and a late start.
            # No macroblock tree: x264's reads memory that it did not set, so files would differ.
            stream.options = {"crf": CRF, "preset": "veryfast", "bf": "0", "mbtree": "0"}
            context = stream.codec_context
            context.colorspace, context.color_range = 1, 1
            context.color_primaries, context.color_trc = 1, 1
            base = TIME_BASE
        stream.time_base = base
        stream.codec_context.time_base = base
        self._base = base
        self._stream = stream

    def _put_last(self, next_pts: int) -> None:
        """Encode the image held back, now that its duration is known."""
        if self._last is None:
            return
        pts, frame = self._last
        frame.pts, frame.time_base = pts, self._base
        self._durations[pts] = max(1, next_pts - pts)
        self._encode(frame)

    def _encode(self, frame: Any) -> None:
        with _reporting(self._path):
            for encoded in self._stream.encode(frame):
                # The encoder states the nominal duration, not the true one.
                encoded.duration = self._durations.pop(encoded.pts, encoded.duration)
                self._container.mux(encoded)


def _with_own_colours(image: Image) -> Any:
    """The image with the 256 colours that suit it best: gif frames may each have their own."""
    frame = av.VideoFrame.from_ndarray(image, format="rgb24")
    frame.pts, frame.time_base = 0, TIME_BASE
    graph = av.filter.Graph()
    source = graph.add_buffer(
        width=frame.width, height=frame.height, format=frame.format, time_base=TIME_BASE
    )
    split, choose = graph.add("split"), graph.add("palettegen", "stats_mode=single")
    use, sink = graph.add("paletteuse", "dither=bayer:bayer_scale=4"), graph.add("buffersink")
    source.link_to(split)
    split.link_to(use, 0, 0)
    split.link_to(choose, 1, 0)
    choose.link_to(use, 0, 1)
    use.link_to(sink)
    graph.configure()
    graph.push(frame)
    graph.push(None)
    return graph.pull()


@contextmanager
def _reporting(path: Path) -> Iterator[None]:
    """Turn an encoder's error into one line; a full disk stays as it is for `atomic_file`."""
    try:
        yield
    except av.error.FFmpegError as error:
        if is_disk_full(error):
            raise
        raise OutputError(f"cannot encode {path}: {error.strerror}") from error
