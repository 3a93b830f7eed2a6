"""Interface of metrics: the check of a pair of streams, and both cut into the same windows of time.

Edges of windows are at multiples of the window from 0.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, ClassVar, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
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


Better: TypeAlias = Literal["lower", "higher", "one"]
"""Direction of good values: low, high, or close to 1."""

UNDEFINED = float("nan")
"""Value of a metric that the two streams do not define."""


@dataclass(frozen=True, kw_only=True)
class Metric(ABC):
    """Compares two event streams of one sensor; built without arguments it has its defaults.

    A metric's parameters are fields, its facts class attributes; it computes its value in `_score`.
    """

    name: ClassVar[str]
    """Short name, as in the registry."""
    unit: ClassVar[str] = ""
    """Unit of the value; empty for a pure number."""
    better: ClassVar[Better] = "lower"
    range: ClassVar[tuple[float, float]] = (0.0, 1.0)
    """Smallest and largest value possible."""
    blind_to: ClassVar[str]
    """Differences that this metric does not see, for the reader of a table."""

    def __call__(self, predicted: EventStream, reference: EventStream) -> float:
        """Score of `predicted`.

        Args:
            predicted: the stream to judge.
            reference: the true stream, or another recording of the same scene.

        Returns:
            The value, or NaN where the two streams do not define one.

        Raises:
            InputError: the sensors differ in size, or weights that the metric needs are not here.
        """
        check_pair(predicted, reference)
        return self._score(predicted, reference)

    def missing(self) -> str | None:
        """Missing requirement of this metric, such as network weights; None if nothing is missing.

        Such a metric is left out of `compare` unless it is named.
        """
        return None

    @abstractmethod
    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        """The value for two streams of the same size."""


def check_pair(predicted: EventStream, reference: EventStream) -> None:
    """Refuse streams that no paired metric can compare.

    Raises:
        InputError: the sensors differ in size.
    """
    if predicted.size != reference.size:
        raise InputError(
            f"cannot compare a {predicted.size} sensor with a {reference.size} one; "
            "simulate at the size of the reference, or crop both to a common size"
        )
