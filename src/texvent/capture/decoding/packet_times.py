"""Times of a video's packets, read without decoding, and the constant rate that they round."""

from __future__ import annotations

import contextlib
import re
from dataclasses import dataclass
from fractions import Fraction
from mmap import ACCESS_READ, mmap
from pathlib import Path

import numpy as np
from av.container import InputContainer
from av.error import FFmpegError
from av.video.stream import VideoStream
from numpy.typing import NDArray

from texvent.frames import MICROSECONDS

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
