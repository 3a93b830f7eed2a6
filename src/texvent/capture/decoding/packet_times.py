"""Times of a video's packets, read without decoding: count, repeats, and a rate that they round."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from av.container import InputContainer
from av.error import FFmpegError
from av.video.stream import VideoStream

FEW_TICKS = 10
"""Frames closer than this many ticks of the file's clock have intervals wrong by more than 5 %."""


@dataclass(frozen=True)
class PacketTimes:
    """Facts of a whole file."""

    count: int
    """Packets that hold a frame to be shown."""
    repeats: int
    """Those whose time another one before them has."""
    constant_rate: Fraction | None
    """Frames per second where the file's clock is too coarse for its rate, and all times are those
    of this rate, rounded; else None."""


def needs_packet_times(stream: VideoStream) -> bool:
    """Whether a file does not say how many frames it has, or its clock is coarse for its rate."""
    return not stream.frames or bool(_coarse_rates(stream))


def read_packet_times(container: InputContainer, stream: VideoStream) -> PacketTimes:
    """Read all packets of a stream; what is damaged ends the count, and decoding says so."""
    times: list[int | None] = []
    with contextlib.suppress(FFmpegError):
        for packet in container.demux(stream):
            if packet.size and not packet.is_discard:
                times.append(packet.pts)
    if None in times:
        return PacketTimes(len(times), 0, None)
    ticks = np.sort(np.array(times, np.int64))
    for rate, ticks_per_frame in _coarse_rates(stream).items():
        even = np.arange(len(ticks)) * ticks_per_frame
        if len(ticks) > 1 and (np.abs(ticks - ticks[0] - even) <= 1).all():
            return PacketTimes(len(times), 0, rate)
    return PacketTimes(len(times), int(np.count_nonzero(np.diff(ticks) == 0)), None)


def _coarse_rates(stream: VideoStream) -> dict[Fraction, float]:
    """Rates that the file states for which its clock is coarse, and their ticks for each frame."""
    stated = (stream.average_rate, stream.guessed_rate, stream.base_rate)
    ticks = {Fraction(rate): float(1 / (rate * (stream.time_base or 1))) for rate in stated if rate}
    return {rate: count for rate, count in ticks.items() if count < FEW_TICKS}
