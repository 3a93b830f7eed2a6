"""Video files through PyAV: exact variable-frame-rate times, upright, at their own bit depth."""

from __future__ import annotations

import contextlib
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import av
import numpy as np
from av.container import InputContainer
from av.error import FFmpegError
from av.sidedata.sidedata import Type as SideDataType
from av.video.format import VideoFormat
from av.video.frame import VideoFrame
from av.video.reformatter import ColorRange
from av.video.stream import VideoStream
from numpy.typing import NDArray

from texvent.capture.frame_source import FrameSource, SourceFacts
from texvent.capture.frame_times import FrameTimes
from texvent.capture.linear_light import CODING, HALF, LINEAR, VIDEO_CODINGS
from texvent.errors import FileFormatError, warn
from texvent.io.input_checks import refuse_missing
from texvent.runtime.media_files import open_media
from texvent.sensor import checked_size
from texvent.video import MICROSECONDS, PREVIEW_MARK, Frame, PixelArray, frame_time_us

SLACK_US = 100_000
"""A file may end this much before its header says, or three frames, before it counts as cut."""
TEXT_ART = "tty"
"""libav "plays" any .txt file as terminal art, which is never meant."""


class VideoFile(FrameSource):
    """The frames of a video file; every iteration opens the file anew.

    Times are the file's own presentation times, `round(pts · time_base · 10⁶)` in exact
    arithmetic, counted from the first frame, unless `times` are given. Frames that repeat the time
    of the frame before (some recorders write them) are dropped and counted in `metadata`.

    Raises:
        InputError: the file does not exist.
        FileFormatError: it has no video that can be decoded; while iterating: it is damaged, ends
            before its header says, or its time goes backwards.
    """

    def __init__(self, path: Path, times: FrameTimes | None = None) -> None:
        self._path = path
        self._times = times
        with _opened(path) as (container, stream):
            comment = container.metadata.get("comment", "")
            if comment == PREVIEW_MARK:
                warn(
                    f"{path} is a preview that texvent drew of events, not what a camera saw; give "
                    "the video that the events were made of"
                )
            self._rate = _own_rate(container, stream)
            count = stream.frames or _count_by_duration(stream, container)
            first = next(self._decode(container, stream), None)
            if first is None:
                raise FileFormatError(
                    f"{path} has no frame that can be decoded; it may be cut off or empty"
                )
            pixels = decoded_pixels(first)
            self._metadata: dict[str, Any] = {
                "source": str(path),
                "kind": "video file",
                "codec": stream.codec_context.name,
                "pixel_format": first.format.name,
                "display_matrix": list(display_matrix(first)),
                "duplicate_times_dropped": 0,
                **coding_facts(first, comment),
            }
            size = checked_size(pixels.shape[1], pixels.shape[0])
            fps = times.fps if times else self._rate
            self._facts = SourceFacts(size, fps, count, self._metadata)

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order; see the class for what can go wrong."""
        clock = PresentationClock(self._path, self._times, self._rate)
        with _opened(self._path) as (container, stream):
            clock.is_counting = container.format.name == AVI and stream.codec_context.has_b_frames
            frames = self._decode(container, stream)
            while True:
                try:
                    decoded = next(frames, None)
                except FFmpegError as error:
                    raise _damaged(self._path, clock, f"is damaged ({error.strerror})") from error
                if decoded is None:
                    break
                t_us = clock.read(decoded)
                if t_us is not None:
                    yield Frame(decoded_pixels(decoded), t_us)
            self._check_end(stream, clock)
        self._metadata["duplicate_times_dropped"] = clock.dropped

    def _decode(self, container: InputContainer, stream: VideoStream) -> Iterator[VideoFrame]:
        """Whole frames; those before a damaged place come out before the error does."""
        for packet in container.demux(stream):
            if packet.is_corrupt:
                yield from _flushed(stream)
                raise av.error.InvalidDataError(0, "a packet is incomplete")
            try:
                decoded = packet.decode()
            except FFmpegError:
                yield from _flushed(stream)
                raise
            for frame in decoded:
                if frame.is_corrupt:
                    raise av.error.InvalidDataError(0, "a frame is incomplete")
                yield frame

    def _check_end(self, stream: VideoStream, clock: PresentationClock) -> None:
        end_us = _promised_end_us(stream, clock.first_pts_us)
        step_us = round(MICROSECONDS / self._rate) if self._rate else 0
        if end_us is not None and clock.end_us + max(SLACK_US, 3 * step_us) < end_us:
            problem = f"is cut off: its header promises {end_us / MICROSECONDS:g} s"
            raise _damaged(self._path, clock, problem)
        if self._times is not None:
            self._times.check_count(clock.count)


@dataclass
class PresentationClock:
    """Time of each decoded frame, µs; remembers where it is, for messages and checks."""

    path: Path
    times: FrameTimes | None
    rate: Fraction | None
    count: int = 0
    """Frames read."""
    dropped: int = 0
    """Frames left out because they repeat a time."""
    first_us: int = 0
    """Time of the first frame, on the clock that the caller sees."""
    last_us: int | None = None
    """Time of the last frame, on the clock that the caller sees."""
    end_us: int = 0
    """End of the last frame, on the file's own clock."""
    is_counting: bool = False
    """Whether frames have the times of the nominal rate, whatever the file says."""
    first_pts_us: Fraction = Fraction(0)
    """Presentation time of the first frame, before it is shifted to 0."""

    def read(self, frame: VideoFrame) -> int | None:
        """Time of the next frame, or None if it repeats the time of the frame before.

        Raises:
            FileFormatError: the time goes backwards, or there is none.
            InputError: more frames than times were given.
        """
        t_us = self._own_time_us(frame)
        if self.times is not None:
            t_us = self.times(self.count)
        self.count += 1
        if self.last_us is None:
            self.first_us = t_us
        elif t_us == self.last_us:
            self.dropped += 1
            return None
        elif t_us < self.last_us:
            raise FileFormatError(
                f"{self.path}: time goes back from {self.last_us} to {t_us} µs at frame "
                f"{self.count - 1}; give a frame rate that replaces the file's times (`fps`)"
            )
        self.last_us = t_us
        return t_us

    def _own_time_us(self, frame: VideoFrame) -> int:
        if frame.pts is None or frame.time_base is None or self.is_counting:
            return self._nominal_time_us()
        pts_us = frame.pts * frame.time_base * MICROSECONDS
        if self.count == 0:
            self.first_pts_us = pts_us
        t_us = round(pts_us - self.first_pts_us)
        duration_us = round((frame.duration or 0) * frame.time_base * MICROSECONDS)
        self.end_us = max(self.end_us, t_us + duration_us)
        return t_us

    def _nominal_time_us(self) -> int:
        if self.times is None and self.rate is None:
            raise FileFormatError(
                f"{self.path} states neither frame times nor a frame rate; give one with `fps`"
            )
        if not self.rate:
            return 0
        self.end_us = frame_time_us(self.count + 1, self.rate)
        return frame_time_us(self.count, self.rate)


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[tuple[InputContainer, VideoStream]]:
    """The container and its main video stream, decoding on all cores."""
    refuse_missing(path, "video")
    try:
        # With the protocol named, a colon in the path is not taken for one.
        container = open_media(f"file:{path}")
    except (FFmpegError, OSError) as error:
        raise FileFormatError(
            f"{path} is not a video that can be read ({error.strerror}); "
            "it may be cut off, still being written, or of another type"
        ) from error
    with container:
        stream = container.streams.best("video")
        if not isinstance(stream, VideoStream) or container.format.name == TEXT_ART:
            raise FileFormatError(f"{path} holds no video stream")
        stream.thread_type = "AUTO"
        try:
            yield container, stream
        except FFmpegError as error:
            raise FileFormatError(
                f"{path} has no frame that can be decoded ({error.strerror}); "
                "it may be cut off or encrypted"
            ) from error


def _flushed(stream: VideoStream) -> list[VideoFrame]:
    """What the decoder still holds when no more data can come."""
    frames: list[VideoFrame] = []
    with contextlib.suppress(FFmpegError, EOFError):
        frames.extend(frame for frame in stream.decode(None) if not frame.is_corrupt)
    return frames


def _damaged(path: Path, clock: PresentationClock, problem: str) -> FileFormatError:
    shown_us = (clock.last_us or clock.first_us) - clock.first_us
    # Rounded down, so that the last whole frame is the one at which reading stops.
    stop = shown_us // 1000 / 1000
    advice = f"keep what is whole with stop={stop:g}, or repair the file" if stop else "repair it"
    return FileFormatError(
        f"{path} {problem}; its frames end at {shown_us / MICROSECONDS:g} s "
        f"after {clock.count} frames; {advice}"
    )


def _promised_end_us(stream: VideoStream, first_pts_us: Fraction) -> int | None:
    """When the file's header says the video ends, counted from its first frame."""
    if stream.duration and stream.time_base:
        return round(stream.duration * stream.time_base * MICROSECONDS)
    # Matroska and WebM: "00:00:01.200000000", the end on the file's own clock.
    tag = re.fullmatch(r"(\d+):(\d+):(\d+(?:\.\d+)?)", stream.metadata.get("DURATION", ""))
    if tag is None:
        return None
    seconds = int(tag[1]) * 3600 + int(tag[2]) * 60 + Fraction(tag[3])
    return round(seconds * MICROSECONDS - first_pts_us)


def _count_by_duration(stream: VideoStream, container: InputContainer) -> int | None:
    rate = stream.average_rate or stream.guessed_rate
    end_us = _promised_end_us(stream, Fraction(0)) or container.duration
    return round(Fraction(end_us, MICROSECONDS) * rate) if end_us and rate else None


RAW = ("h264", "hevc", "m4v", "mpegvideo", "vvc", "obu")
"""Containers that hold nothing but the stream."""
AVI = "avi"
"""Container without times: its frames follow one another, and B-frames mix up the order in it."""
UNSPECIFIED = 2
"""libav's number of an unknown transfer characteristic."""


def decoded_pixels(frame: VideoFrame) -> PixelArray:
    """Pixels of a decoded frame, turned as its display matrix says.

    Returns:
        [H, W] for grey formats, else [H, W, 3] RGB; uint8 for up to 8 bits per component, uint16
        (65535 is white) for more. Alpha is dropped. YUV becomes RGB by the matrix and range that
        the file states; files that state none are read as BT.601 limited range, as libav does.
        libav's 16-bit RGB of deep YUV has its white at 65283, 0.4 % below full scale.
    """
    image = frame.reformat(format=pixel_format(frame.format), dst_color_range=ColorRange.JPEG)
    return _upright(image.to_ndarray(), display_matrix(frame))


def display_matrix(frame: VideoFrame) -> tuple[int, int, int, int]:
    """Signs of a, b, c, d of a frame's display matrix: x' = a x + c y, y' = b x + d y.

    Angles between quarter turns, which no camera writes, count as the nearest.
    """
    side_data: Any = frame.side_data  # keys are of a type that its stub does not know
    stored = side_data.get(SideDataType.DISPLAYMATRIX)
    if stored is None:
        return 1, 0, 0, 1
    a, b, _, c, d = np.frombuffer(bytes(stored), "<i4", 5).tolist()
    is_turned = abs(b) > abs(a)
    kept = (0, b, c, 0) if is_turned else (a, 0, 0, d)
    return tuple(np.sign(kept).tolist())


def _upright(pixels: NDArray[Any], matrix: tuple[int, int, int, int]) -> PixelArray:
    """Pixels turned and mirrored by the signs of a display matrix."""
    a, b, c, d = matrix
    if b:
        pixels = np.swapaxes(pixels, 0, 1)
    pixels = pixels[:: -1 if -1 in (b, d) else 1, :: -1 if -1 in (a, c) else 1]
    return np.ascontiguousarray(pixels)


def _own_rate(container: InputContainer, stream: VideoStream) -> Fraction | None:
    """Frame rate of the stream; libav invents one for streams without a container."""
    rate = stream.average_rate or stream.guessed_rate
    if container.format.name in RAW:
        rate = stream.codec_context.framerate or rate
    return Fraction(rate) if rate else None


def coding_facts(frame: VideoFrame, comment: str = "") -> dict[str, str]:
    """How a decoded frame is coded, for a source's metadata: nothing where it is gamma-coded.

    Args:
        frame: it says its transfer characteristic.
        comment: of the file; texvent writes facts there as JSON, and light as half floats.
    """
    try:
        facts = json.loads(comment)
    except (ValueError, RecursionError):
        facts = None
    if isinstance(facts, dict) and (facts.get("transfer"), facts.get(CODING)) == (LINEAR, HALF):
        return {CODING: HALF}
    # PyAV 16 and older do not tell.
    coding = VIDEO_CODINGS.get(int(getattr(frame, "color_trc", UNSPECIFIED)))
    return {} if coding is None else {CODING: coding}


def pixel_format(source: VideoFormat) -> str:
    """The libav format that keeps the precision and the colour of `source`.

    Returns:
        `gray`, `gray16le`, `rgb24` or `rgb48le`.
    """
    # Palettes (GIF, PNG) have one component, but it is an index, not a grey level.
    planes = [component for component in source.components if not component.is_alpha]
    is_grey = len(planes) == 1 and planes[0].is_luma and not source.has_palette
    is_deep = max(component.bits for component in planes) > 8
    if is_grey:
        return "gray16le" if is_deep else "gray"
    return "rgb48le" if is_deep else "rgb24"
