"""Frames of AEDAT4 recordings, as a DAVIS makes them beside its events.

Each packet of the stream FRME is one table:

    slot 0 i64 time · 1, 2 i64 start and end of the frame · 3, 4 i64 start and end of the exposure
    slot 5 i8 OpenCV's number of the pixel type · 6, 7 i16 width, height · 8, 9 i16 position
    slot 10 vector of bytes, the pixels row by row · 11 i64 length of the exposure

An image shows the mean of its exposure, so a frame's time is the middle of it. Slot 0 cannot be
relied on for that: the first DV software wrote the middle there, later versions the start.

Source: iniVation, AEDAT 4.0 file format and dv-processing's description of frames.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from texvent.capture.frame_source import FrameSource
from texvent.capture.given_times import FrameTimes
from texvent.errors import FileFormatError
from texvent.frames import Frame, PixelArray
from texvent.io.aedat.aedat4_container import FRAMES, MAGIC, Container, open_container, stored_size
from texvent.io.aedat.aedat4_tables import StreamInfo, Table
from texvent.io.input_checks import begins_with
from texvent.sensor import SensorSize, checked_size

PIXELS: Mapping[int, tuple[int, str]] = {
    **{0: (1, "u1"), 16: (3, "u1"), 24: (4, "u1")},
    **{2: (1, "<u2"), 18: (3, "<u2"), 26: (4, "<u2")},
}
"""OpenCV's number of a pixel type → channels (grey, BGR, BGRA) and type of their values."""


def is_aedat4(path: Path) -> bool:
    """True if the file begins as AEDAT4 does."""
    return begins_with(path, MAGIC)


def count_frames(path: Path) -> int:
    """Number of frames of an AEDAT4 file; only the heads of its packets are read."""
    container = open_container(path)
    return sum(map(container.count_packets, container.streams_of(FRAMES)))


class Aedat4Frames(FrameSource):
    """The frames of an AEDAT4 file; every iteration opens the file anew.

    Times are the middle of each exposure on the recording's own clock, that of its events, unless
    `times` are given.

    Raises:
        FileFormatError: it holds no frames or was cut off; while iterating: a frame is damaged, of
            another size than the sensor, or of another type of pixels.
        InputError: another number of times is given than there are frames.
        MissingDependencyError: it is compressed with Zstandard, which is not installed.
    """

    def __init__(self, path: Path, times: FrameTimes | None = None) -> None:
        self._times = times
        self._container, self._stream = _open_stream(path)
        frame_count = self._container.count_packets(self._stream)
        if times is not None:
            times.check_count(frame_count)
        metadata = {
            "source": str(path),
            "kind": "AEDAT4 frames",
            "camera": self._stream.attributes.get("source"),
            "times": "given" if times else "middle of the exposure",
        }
        fps = None if times is None else times.fps
        super().__init__(self._find_size(), fps, frame_count, metadata)

    @property
    def times_us(self) -> Sequence[int] | None:
        """Times of all frames, µs; pixels are passed over."""
        if self._times is not None:
            return self._times.of(self.frame_count or 0)
        return [read_exposure(table)[0] for table in self._tables()]

    def __iter__(self) -> Iterator[Frame]:
        """Frames in order; see the class for what can go wrong."""
        for index, table in enumerate(self._tables()):
            try:
                pixels, t_us = _read_pixels(table), read_exposure(table)[0]
            except FileFormatError as error:
                raise FileFormatError(f"{self._container.path}, frame {index}: {error}") from error
            height, width = pixels.shape[:2]
            if (width, height) != self.size:
                raise FileFormatError(
                    f"{self._container.path}, frame {index} is {width}x{height}, the sensor "
                    f"{self.size}; frames of a part of the sensor cannot be used"
                )
            yield Frame(pixels, t_us if self._times is None else self._times(index))

    def _tables(self) -> Iterator[Table]:
        for end, packet in self._container.read_packets(self._stream):
            try:
                yield Table.root(packet, FRAMES.encode())
            except FileFormatError as error:
                path = self._container.path
                raise FileFormatError(f"{path}, before byte {end}: {error}") from error

    def _find_size(self) -> SensorSize:
        """Size that the header states, else that of the first frame."""
        stored = stored_size(self._container.path, self._stream)
        if stored is not None:
            return checked_size(*stored)
        pixels = _read_pixels(next(self._tables()))
        return checked_size(pixels.shape[1], pixels.shape[0])


def read_exposure(table: Table) -> tuple[int, int]:
    """Middle and length of a frame's exposure, µs.

    Returns:
        The middle, rounded down, from the stated start and end; from the start and the length
        where only these are there; else the frame's one time and a length of 0.

    Raises:
        FileFormatError: the table is damaged.
    """
    start, end = table.number(3, "<q", 0), table.number(4, "<q", 0)
    if end <= start:
        start = table.number(0, "<q", 0)
        end = start + max(table.number(11, "<q", 0), 0)
    return (start + end) // 2, end - start


def _open_stream(path: Path) -> tuple[Container, StreamInfo]:
    container = open_container(path)
    stream = next(iter(container.streams_of(FRAMES)), None)
    if stream is None or not container.count_packets(stream):
        kinds = ", ".join(one.identifier for one in container.streams)
        raise FileFormatError(
            f"{path} holds no frames (its streams: {kinds or 'none'}); only cameras such as the "
            "DAVIS record frames beside events"
        )
    return container, stream


def _read_pixels(table: Table) -> PixelArray:
    """[H, W] grey or [H, W, 3] RGB, uint8 or uint16."""
    kind = table.number(5, "<b", 0)
    width, height = table.number(6, "<h", 0), table.number(7, "<h", 0)
    if kind not in PIXELS:
        raise FileFormatError(
            f"pixels of OpenCV type {kind}; texvent reads grey, BGR and BGRA of 8 bits (0, 16, 24) "
            "or 16 (2, 18, 26)"
        )
    channels, dtype = PIXELS[kind]
    start, count = table.vector(10)
    values = width * height * channels
    if width < 1 or height < 1 or count != values * np.dtype(dtype).itemsize:
        raise FileFormatError(f"{count} bytes of pixels for {width}x{height}x{channels}")
    if start + count > len(table.data):
        raise FileFormatError("its pixels reach past the end of the packet")
    flat = np.frombuffer(table.data, dtype, values, start)
    if channels == 1:
        return flat.reshape(height, width)
    return np.ascontiguousarray(flat.reshape(height, width, channels)[..., 2::-1])
