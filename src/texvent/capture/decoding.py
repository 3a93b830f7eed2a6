"""Decoded video: pixels, upright, grey or RGB, at their own bit depth, and times of its packets.

Times of packets are read without decoding, and the constant rate that they round is found.
"""

from __future__ import annotations

import contextlib
import json
import re
from dataclasses import dataclass
from fractions import Fraction
from mmap import ACCESS_READ, mmap
from pathlib import Path
from typing import Any

import numpy as np
from av.container import InputContainer
from av.error import FFmpegError
from av.sidedata.sidedata import Type as SideDataType
from av.video.format import VideoFormat
from av.video.frame import VideoFrame
from av.video.reformatter import ColorRange, VideoReformatter
from av.video.stream import VideoStream
from numpy.typing import NDArray

from texvent.capture.linear_light import CODING, HALF, LINEAR, VIDEO_CODINGS
from texvent.errors import warn
from texvent.frames import MICROSECONDS, PixelArray
from texvent.runtime.files.media_files import raise_scarcity

ROUNDING_TICKS = 1.02
"""Times of one rate, rounded or truncated to ticks, differ from even ones by values that lie less
than a tick apart; a little more if a file with a finer clock was made into this one."""
SAME_RATE = 1e-5
"""Files round rates: Matroska states 60000/1001 as 19001/317."""

DELAYS = {
    "gif": re.compile(rb"\x21\xf9\x04.(..).\0(?=[\x21\x2c])", re.DOTALL),
    "apng": re.compile(rb"\0\0\0\x1afcTL.{20}(..)", re.DOTALL),
}
"""Delays of the frames of animations, by libav's names of the formats."""


@dataclass(frozen=True)
class PacketTimes:
    """Facts of a whole file."""

    count: int
    """Packets that hold a frame to be shown."""
    times_us: NDArray[np.int64] | None
    """Their times from the first, without repeats, µs; None where packets have none.

    They go back where those of decoding do.
    """
    constant_rate: Fraction | None
    """Frames per second where the file states a rate and all times are those of it, rounded."""

    @property
    def repeats(self) -> int:
        """Packets whose time another one before them has."""
        if self.times_us is None or self.constant_rate is not None:
            return 0
        return self.count - len(self.times_us)


def needs_packet_times(stream: VideoStream) -> bool:
    """Whether a file does not say how many frames it has, or its clock rounds its rate."""
    return not stream.frames or any(ticks % 1 for ticks in _ticks_per_frame(stream).values())


def read_packet_times(container: InputContainer, stream: VideoStream) -> PacketTimes:
    """Read all packets of a stream; what is damaged ends the count, and decoding says so."""
    times: list[int | None] = []
    falls: list[int] = []
    last = None
    with contextlib.suppress(FFmpegError):
        for packet in container.demux(stream):
            if packet.size and not packet.is_discard:
                if last is not None and packet.dts is not None and packet.dts < last:
                    falls.append(len(times))
                last = packet.dts
                times.append(packet.pts)
    if not times or None in times:
        return PacketTimes(len(times), None, None)
    ticks = np.concatenate([*map(np.sort, np.split(np.array(times, np.int64), falls))])
    ticks -= ticks[0]
    rates = (rate for rate, step in _ticks_per_frame(stream).items() if _is_even(ticks, step))
    tick_us = float((stream.time_base or 1) * MICROSECONDS)
    shown = ticks[np.diff(ticks, prepend=-1) != 0]
    times_us = np.rint(shown * tick_us).astype(np.int64)
    return PacketTimes(len(times), times_us, next(rates, None) if len(times) > 1 else None)


def _is_even(ticks: NDArray[np.int64], step: Fraction) -> bool:
    return bool(np.ptp(ticks - np.arange(len(ticks)) * float(step)) < ROUNDING_TICKS)


def _ticks_per_frame(stream: VideoStream) -> dict[Fraction, Fraction]:
    """Ticks of the file's clock for each frame, by rates that it states, usual ones first."""
    stated = (stream.average_rate, stream.guessed_rate, stream.base_rate)
    rates = [Fraction(rate) for rate in stated if rate]
    usual = [
        one
        for rate in rates
        for one in (Fraction(round(rate)), Fraction(round(rate * 1001 / 1000) * 1000, 1001))
        if abs(one - rate) < SAME_RATE * rate
    ]
    return {rate: 1 / (rate * (stream.time_base or 1)) for rate in (*usual, *rates)}


def count_undelayed(path: Path, container: InputContainer, stream: VideoStream) -> int:
    """Frames of an animation after which it states no delay, or 0; the last one does not count."""
    pattern = DELAYS.get(container.format.name)
    if pattern is None:
        return 0
    with path.open("rb") as file, mmap(file.fileno(), 0, access=ACCESS_READ) as data:
        delays = [found[1] for found in pattern.finditer(data)]
    return delays[:-1].count(b"\0\0") + max(0, stream.frames - max(1, len(delays)))


LIMITED = (16, 235)
"""Black and white of limited range."""
GIF = "gif"
SQUARE_ENOUGH = 0.01
"""Pixels are called square, and turns quarters of a circle, up to this share."""
UNSPECIFIED = 2
"""libav's number of an unknown transfer characteristic."""


class PixelReader:
    """Pixels of the frames of one stream, turned as the display matrix of its first frame says.

    The stream has one scaler: those of libav keep a thread for each core.

    Args:
        name: of the stream, for errors.

    Raises:
        OSError: while reading: the system has no more threads or memory.
    """

    def __init__(self, name: object) -> None:
        self._name = name
        self._reformatter = VideoReformatter()
        self._matrix: tuple[int, int, int, int] | None = None

    def read(self, frame: VideoFrame) -> PixelArray:
        """Pixels of a decoded frame.

        Returns:
            [H, W] for grey formats, else [H, W, 3] RGB; uint8 for up to 8 bits per component,
            uint16 (65535 is white) for more. Alpha is dropped. YUV becomes RGB by the matrix and
            range that the file states; files that state none are read as BT.601 limited range, as
            libav does. libav's 16-bit RGB of deep YUV has its white at 65283, 0.4 % below full
            scale.
        """
        return _upright(self._levels(frame), self.matrix(frame))

    def matrix(self, frame: VideoFrame) -> tuple[int, int, int, int]:
        """The display matrix of the stream; `frame` is one of it."""
        if self._matrix is None:
            # A frame whose side data were looked at is held by them until the garbage collector
            # runs, so this is done once.
            self._matrix = _signs(*display_matrix(frame))
        return self._matrix

    def _levels(self, frame: VideoFrame) -> NDArray[Any]:
        try:
            image = self._reformatter.reformat(
                frame, format=pixel_format(frame.format), dst_color_range=ColorRange.JPEG
            )
        except FFmpegError as error:
            raise_scarcity(error, self._name)
            raise
        return image.to_ndarray()


def warn_of_pixels(stream: VideoStream, frame: VideoFrame, pixels: PixelArray, name: str) -> None:
    """Warn of marks of a video that are not followed: its frames are read as they are stored.

    libav reads and writes all grey as full range, but a file made from limited colour may keep its
    mark.

    Args:
        stream: it states the shape of pixels.
        frame: the first one.
        pixels: its levels; some outside the limited range tell that they are full.
        name: of the file or stream.
    """
    if frame.interlaced_frame:
        warn(
            f"{name} is marked as interlaced: lines of a frame are of two times, which makes "
            "events at every edge that moves; deinterlace it (ffmpeg -vf bwdif)"
        )
    aspect = stream.sample_aspect_ratio or Fraction(1)
    if abs(aspect - 1) > SQUARE_ENOUGH:
        warn(
            f"{name} states pixels of {aspect.numerator}:{aspect.denominator}, width to height, "
            "and is read pixel by pixel, so shapes and motion are squeezed; make its pixels square "
            "(ffmpeg -vf scale=iw*sar:ih,setsar=1)"
        )
    a, b, c, d = display_matrix(frame)
    turned, straight = abs(b) + abs(c), abs(a) + abs(d)
    if min(turned, straight) > SQUARE_ENOUGH * max(turned, straight):
        warn(
            f"{name} is to be shown turned by {np.degrees(np.arctan2(b, a)):.3g}°, and is read "
            "turned by the nearest quarter of a circle; turn it (ffmpeg -vf rotate), or remove "
            "the mark (ffmpeg -display_rotation 0)"
        )
    if stream.codec_context.name == GIF and not frame.to_ndarray(format="rgba")[..., 3].all():
        warn(
            f"{name} has transparent pixels, of which a GIF has no colour: they are read as white; "
            "give it a background, or save it as animated PNG"
        )
    low, high = (round(level * np.iinfo(pixels.dtype).max / 255) for level in LIMITED)
    is_limited = pixels.ndim == 2 and frame.color_range == ColorRange.MPEG
    if is_limited and low <= pixels.min() and pixels.max() <= high:
        warn(
            f"{name} is grey and marked as limited range, which grey video hardly is: levels are "
            "read as they are. If black is 16 and white 235, stretch them first "
            "(ffmpeg -vf 'lutyuv=y=(val-16)*255/219')"
        )


def display_matrix(frame: VideoFrame) -> tuple[int, ...]:
    """a, b, c, d of a frame's display matrix: x' = a x + c y, y' = b x + d y."""
    side_data: Any = frame.side_data  # keys are of a type that its stub does not know
    stored = side_data.get(SideDataType.DISPLAYMATRIX)
    if stored is None:
        return 1, 0, 0, 1
    a, b, _, c, d = np.frombuffer(bytes(stored), "<i4", 5).tolist()
    return a, b, c, d


def _signs(a: int, b: int, c: int, d: int) -> tuple[int, int, int, int]:
    """Signs of a display matrix; angles between quarter turns count as the nearest."""
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


def coding_facts(frame: VideoFrame, comment: str = "") -> dict[str, str]:
    """Coding of a decoded frame, for a source's metadata: nothing where it is gamma-coded.

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
