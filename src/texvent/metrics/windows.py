"""Two streams cut into the same windows of time, with edges at multiples of the window from 0."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.represent import array_ops

Int64Array = NDArray[np.int64]


class Window(NamedTuple):
    """The events of both streams in one window; at least one stream has some."""

    predicted: EventStream
    reference: EventStream


def rate_of_window(window_us: int) -> Fraction:
    """Windows per second from the length of one, µs."""
    return Fraction(MICROSECONDS, window_us)


def bin_index(t: Int64Array, rate_hz: Fraction) -> Int64Array:
    """`floor(t · rate)` in exact integers: the bin that each time falls in.

    Args:
        t: times, µs, [n] int64; may be negative.
        rate_hz: bins per second.

    Returns:
        [n] int64.
    """
    # One period of the rate at a time, so that recordings with epoch times cannot overflow.
    period = MICROSECONDS * rate_hz.denominator
    whole, rest = np.divmod(t, period)
    return np.asarray(whole * rate_hz.numerator + rest * rate_hz.numerator // period)


def occupied_windows(
    predicted: EventStream, reference: EventStream, rate_hz: Fraction
) -> Iterator[Window]:
    """The windows in which at least one of the streams has events, in time order."""
    indices = [bin_index(stream.t, rate_hz) for stream in (predicted, reference)]
    occupied = np.union1d(*indices)
    bounds = [
        (np.searchsorted(index, occupied, "left"), np.searchsorted(index, occupied, "right"))
        for index in indices
    ]
    for number in range(len(occupied)):
        yield Window(
            *(
                stream[int(first[number]) : int(last[number])]
                for stream, (first, last) in zip((predicted, reference), bounds, strict=True)
            )
        )


def count_windows(predicted: EventStream, reference: EventStream, rate_hz: Fraction) -> int:
    """Windows from the first event of both streams to the last, empty ones included."""
    ends = [stream.t[[0, -1]] for stream in (predicted, reference) if len(stream)]
    if not ends:
        return 0
    index = bin_index(np.concatenate(ends), rate_hz)
    return int(index.max() - index.min()) + 1


def flat_index(*axes: tuple[Any, int]) -> Int64Array:
    """`represent.array_ops.flat_index` of NumPy columns of any integer type."""
    (first, side), *rest = axes
    index: Int64Array = array_ops.flat_index((np.asarray(first, np.int64), side), *rest)
    return index
