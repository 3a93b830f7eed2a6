"""The intervals of a call on the host: times, keys, and when references are renewed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.frames import LATEST_US
from texvent.options.arrays import as_array, whole_numbers

Int64Array = NDArray[np.int64]
Float64Array = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Span:
    """The intervals of one call, [B, T] each: the time between neighbouring frames."""

    start_us: Int64Array
    """Time of the earlier frame, µs."""
    stop_us: Int64Array
    """Time of the later frame, µs."""
    first_us: Int64Array
    """Time of the first frame of each clip, [B, 1], µs."""
    from_source: BoolArray
    """Whether the earlier frame is a source frame, so that a pair begins with it."""
    is_new: bool
    """Whether the first of them is the first of the clips."""

    @property
    def duration_us(self) -> Int64Array:
        """Lengths, µs."""
        return self.stop_us - self.start_us

    @property
    def origins_us(self) -> Int64Array:
        """Offsets of the times of each clip, so that the clips follow each other from 0, [B]."""
        lengths = self.stop_us[:, -1] - self.start_us[:, 0]
        return np.asarray(np.cumsum(lengths) - lengths - self.start_us[:, 0])

    @property
    def axis_us(self) -> int:
        """Length of that axis, µs."""
        return int((self.stop_us[:, -1] - self.start_us[:, 0]).sum())


class Clock:
    """The times of the frames that a batch of clips has seen."""

    def __init__(self, clips: int) -> None:
        """A clock for `clips` clips that have seen no frame."""
        self._clips = clips
        self._first_us: Int64Array | None = None
        self._last_us: Int64Array = np.empty((clips, 0), np.int64)
        self._last_is_source: BoolArray = np.empty((clips, 0), np.bool_)
        self._is_new = True

    def read(self, frames: int, times_us: Any, is_source: Any) -> Span:
        """The intervals that new frames end; `advance` makes the frames the last ones.

        Args:
            frames: T, how many there are per clip.
            times_us: their times, [T] or [B, T], µs.
            is_source: whether each is a source frame, [T] or [B, T]; None: all are.

        Raises:
            InputError: the shapes do not fit, or times do not strictly increase.
        """
        times = self._spread("times_us", times_us, frames)
        times = whole_numbers(times, "times_us", "whole microseconds")
        if (beyond := (times > LATEST_US) | (times < -LATEST_US)).any():
            raise InputError(
                f"times_us holds {times[beyond][0]} µs, beyond ±{LATEST_US} µs (285 years); give "
                "times in µs, not ns, that count from a later moment"
            )
        flags = np.ones((self._clips, frames), np.bool_)
        if is_source is not None:
            flags = self._spread("is_source", is_source, frames).astype(np.bool_)
        known = np.concatenate([self._last_us, times.astype(np.int64)], axis=1)
        sources = np.concatenate([self._last_is_source, flags], axis=1)
        falls = np.argwhere(np.diff(known, axis=1) <= 0)
        if len(falls):
            clip, index = falls[0]
            raise InputError(
                f"times_us of clip {clip}: {known[clip, index + 1]} µs does not come after "
                f"{known[clip, index]} µs; frame times must strictly increase"
            )
        first_us = known[:, :1] if self._first_us is None else self._first_us
        is_new = self._is_new and known.shape[1] < 2
        self._pending = first_us, known[:, -1:], sources[:, -1:], is_new
        return Span(known[:, :-1], known[:, 1:], first_us, sources[:, :-1], self._is_new)

    def advance(self) -> None:
        """Make the frames read last the last ones seen."""
        self._first_us, self._last_us, self._last_is_source, self._is_new = self._pending

    def _spread(self, name: str, values: Any, frames: int) -> NDArray[Any]:
        """[B, T] from [T] or [B, T] of any array type."""
        array = as_array(values, name)
        if array.shape not in ((frames,), (self._clips, frames)):
            raise InputError(
                f"{name} must be [{frames}] or [{self._clips}, {frames}], one per frame (and "
                f"clip); got {list(array.shape)}"
            )
        return np.broadcast_to(array, (self._clips, frames))
