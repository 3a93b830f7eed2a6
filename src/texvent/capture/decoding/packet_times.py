"""Times of a video's packets, read without decoding: count, repeats, and a rate that they round."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from av.container import InputContainer
from av.error import FFmpegError
from av.video.stream import VideoStream
from numpy.typing import NDArray

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
    is_stated: bool = True
    """Whether the file states that rate; else it is a fit."""


def needs_packet_times(stream: VideoStream) -> bool:
    """Whether a file does not say how many frames it has, or its clock is coarse for its rate."""
    return not stream.frames or any(map(_is_coarse(stream), _rates(stream)))


def read_packet_times(container: InputContainer, stream: VideoStream) -> PacketTimes | None:
    """Read all packets of a stream; what is damaged ends the count, and decoding says so.

    Returns:
        None where packets have no time.
    """
    times: list[int] = []
    with contextlib.suppress(FFmpegError):
        for packet in container.demux(stream):
            if packet.size and not packet.is_discard:
                if packet.pts is None:
                    return None
                times.append(packet.pts)
    ticks = np.sort(np.array(times, np.int64))
    repeats = int(np.count_nonzero(np.diff(ticks) == 0))
    stated = _rates(stream)
    rates = [*stated, *(_fitted_rates(ticks, stream) if repeats else ())]
    coarse = filter(_is_coarse(stream), rates)
    rate = next((rate for rate in coarse if _is_rounded(ticks, rate, stream)), None)
    return PacketTimes(len(times), 0 if rate else repeats, rate, rate in stated)


def _rates(stream: VideoStream) -> list[Fraction]:
    stated = (stream.average_rate, stream.guessed_rate, stream.base_rate)
    return [Fraction(rate) for rate in stated if rate]


def _fitted_rates(ticks: NDArray[np.int64], stream: VideoStream) -> list[Fraction]:
    """Frames per second from the first frame to the last."""
    span = int(ticks[-1] - ticks[0])
    return [Fraction(len(ticks) - 1, span) / stream.time_base] if span and stream.time_base else []


def _is_coarse(stream: VideoStream) -> Callable[[Fraction], bool]:
    tick_s = stream.time_base or Fraction(0)
    return lambda rate: tick_s * rate * FEW_TICKS > 1


def _is_rounded(ticks: NDArray[np.int64], rate: Fraction, stream: VideoStream) -> bool:
    """Whether all times are less than a tick from frames of that rate."""
    if len(ticks) < 2 or stream.time_base is None:
        return False
    even = np.arange(len(ticks)) * float(1 / (rate * stream.time_base))
    return bool((np.abs(ticks - ticks[0] - even) <= 1).all())
