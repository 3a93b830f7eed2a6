"""Cameras, network streams, named pipes and standard input: frames that come only once."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator

from av.container import InputContainer
from av.error import FFmpegError
from av.video.frame import VideoFrame
from av.video.stream import VideoStream

from texvent.capture.decoding import PixelReader, coding_facts, warn_of_pixels
from texvent.capture.frame_source import FrameSource
from texvent.capture.given_times import FrameTimes
from texvent.errors import InputError, is_address, warn, without_password
from texvent.frames import MICROSECONDS, Frame
from texvent.runtime.files.media_files import (
    is_timeless,
    only_self_contained,
    open_media,
    raise_scarcity,
)
from texvent.runtime.read_once import ReadOnce
from texvent.runtime.work.interrupts import stop_on_interrupt
from texvent.sensor import checked_size

STANDARD_INPUT = "-"
ARRIVAL = "arrival"
TIMEOUT_S = 15.0
"""Time for which a silent network stream is waited for."""
OPTIONS = {"fpsprobesize": "0"}
"""Do not collect frames to guess a rate: they would then all arrive at once."""


class LiveFrames(FrameSource):
    """Frames as they arrive; memory stays flat because one frame is read only when asked for.

    Times are the stream's own presentation times, or, where its format has none (MJPEG over a pipe
    or the network, raw H.264), the moments of arrival; both count from the first frame. Frames
    whose time does not increase are dropped and counted in `metadata`. Ctrl-C ends the stream
    after the current frame, so that results are complete; a second Ctrl-C interrupts.

    Args:
        address: a device (`/dev/video0`), an address (`rtsp://...`), a named pipe, or `-`.
        times: a frame rate or list of times that replaces the stream's.

    Raises:
        InputError: nothing can be read there; or the stream is iterated a second time.
    """

    def __init__(self, address: str, times: FrameTimes | None = None) -> None:
        self._name = without_password(address)
        self._times = times
        self._container = _open_live(address, self._name)
        stream = self._container.streams.best("video")
        if not isinstance(stream, VideoStream):
            raise InputError(f"{self._name} holds no video stream")
        self._frames = self._decode(stream)
        self._arrivals = ReadOnce(self._arriving(), f"{self._name} is live; it")
        first = next(self._frames, None)
        if first is None:
            self._container.close()
            raise InputError(f"{self._name} ended before its first frame")
        self._first, self._arrived_us = first, _now_us()
        self._clock = _clock_name(self._container, first, times)
        if self._clock == ARRIVAL and not (is_address(address) or address.startswith("/dev/")):
            warn(
                f"{self._name} holds no times, so frames have the moments at which they arrive; "
                "unless a camera sends them now, give their rate (`fps`)"
            )
        self._reader = PixelReader(self._name)
        pixels = self._reader.read(first)
        metadata = {
            "source": self._name,
            "kind": "live",
            "pixel_format": first.format.name,
            "clock": self._clock,
            "frames_dropped": 0,
            **coding_facts(first),
        }
        size = checked_size(pixels.shape[1], pixels.shape[0])
        warn_of_pixels(stream, first, pixels, self._name)
        super().__init__(size, times.fps if times else None, None, metadata, is_live=True)

    def __iter__(self) -> Iterator[Frame]:
        """Frames until the stream ends or Ctrl-C.

        Raises:
            InputError: the frames were read before.
        """
        return self._run(iter(self._arrivals))

    def _run(self, arrivals: Iterator[tuple[VideoFrame, int]]) -> Iterator[Frame]:
        last_us = -1
        with self._container, stop_on_interrupt() as request:
            for index, (frame, arrived_us) in enumerate(arrivals):
                t_us = self._time_us(index, frame, arrived_us)
                if t_us > last_us:
                    yield Frame(self._reader.read(frame), t_us)
                    last_us = t_us
                else:
                    if not self._metadata["frames_dropped"]:
                        warn(
                            f"{self._name}: frames are left out from {last_us} µs on, whose time "
                            "is not after the one before; if they are evenly spaced, give `fps`"
                        )
                    self._metadata["frames_dropped"] += 1
                if request.number is not None:
                    return

    def _arriving(self) -> Iterator[tuple[VideoFrame, int]]:
        yield self._first, self._arrived_us
        for frame in self._frames:
            yield frame, _now_us()

    def _time_us(self, index: int, frame: VideoFrame, arrived_us: int) -> int:
        if self._times is not None:
            return self._times(index)
        if self._clock == ARRIVAL or frame.time_base is None:
            return arrived_us - self._arrived_us
        pts, first_pts = frame.pts or 0, self._first.pts or 0
        return round((pts - first_pts) * frame.time_base * MICROSECONDS)

    def _decode(self, stream: VideoStream) -> Iterator[VideoFrame]:
        """Decoded frames; a stream that breaks off has ended, which is how live streams end."""
        try:
            yield from self._container.decode(stream)
        except (FFmpegError, EOFError) as error:
            raise_scarcity(error, self._name)


def _open_live(address: str, name: str) -> InputContainer:
    try:
        if address.startswith("/dev/video"):
            return open_media(address, format="v4l2", options=OPTIONS)
        if is_address(address):
            return open_media(address, timeout=TIMEOUT_S, options=OPTIONS)
        given = sys.stdin.buffer if address == STANDARD_INPUT else address
        return open_media(given, options={**OPTIONS, **only_self_contained()})
    except (FFmpegError, OSError, ValueError) as error:
        raise_scarcity(error, name)
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(
            f"{name} cannot be opened as live video ({reason}); check that it exists, is not in "
            "use, and sends a format that libav knows"
        ) from error


def _clock_name(container: InputContainer, first: VideoFrame, times: FrameTimes | None) -> str:
    if times is not None:
        return "given"
    return ARRIVAL if is_timeless(container) or first.pts is None else "presentation"


def _now_us() -> int:
    return time.monotonic_ns() // 1000
