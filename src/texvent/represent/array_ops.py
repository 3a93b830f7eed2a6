"""Operations of representations: integer columns, and sums at an index.

NumPy and torch agree on arithmetic, comparison and reshaping; they differ in how values are added
up at an index. `ArrayOps` holds these differences, so every representation has one definition that
runs on NumPy arrays and on torch tensors, on a CPU or a GPU. Sums are int64 wherever they can be:
they are exact, so their order does not matter and every device gives the same result.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize

Array: TypeAlias = Any
"""A NumPy array when the events are an `EventStream`, a torch tensor when `EventTensors`."""
DType: TypeAlias = Literal["uint8", "int32", "int64", "float32", "float64"]
Axis: TypeAlias = tuple[Array, int]
"""A coordinate per event, and how many values it can take."""


class ArrayOps:
    """NumPy's operations where torch's differ; `represent.tensors.TorchOps` has those."""

    @property
    def xp(self) -> Any:
        """The module: `where`, `exp`, `sign` and the like have the same names in both."""
        return np

    def cast(self, array: Array, dtype: DType) -> Array:
        """The array with another type, always a new one."""
        return array.astype(dtype)

    def from_numpy(self, array: NDArray[Any]) -> Array:
        """A copy of a NumPy array, on the device of the events."""
        return array.copy()

    def count_at(self, index: Array, cells: int) -> Array:
        """Number of occurrences of each of `0..cells − 1` in `index`, [cells] int64."""
        return np.bincount(index, minlength=cells)

    def add_at(self, index: Array, values: Array, cells: int) -> Array:
        """Sum of the values at each index, [cells], of the type of `values`."""
        sums = np.zeros(cells, values.dtype)
        # Not bincount: its weights are float64, which would round sums of large integers.
        np.add.at(sums, index, values)
        return sums

    def latest_at(self, index: Array, t: Array, cells: int, never: int) -> Array:
        """Largest `t` at each index, [cells] int64; `never` where there is none."""
        latest = np.full(cells, never, np.int64)
        np.maximum.at(latest, index, t)
        return latest


NUMPY_OPS = ArrayOps()


@dataclass(frozen=True, eq=False)
class EventColumns:
    """Events as int64 columns, copied, so that no computation can reach the caller's arrays."""

    x: Array
    """Column, pixels, [n]."""
    y: Array
    """Row, pixels from the top, [n]."""
    t: Array
    """Time, µs, [n], non-decreasing."""
    p: Array
    """Polarity, [n]: 1 = ON, 0 = OFF."""
    size: SensorSize
    ops: ArrayOps

    def __len__(self) -> int:
        return len(self.t)

    @property
    def polarity(self) -> Array:
        """Polarity as ±1, [n] int64."""
        return self.p * 2 - 1

    @property
    def pixel_axes(self) -> tuple[Axis, Axis]:
        """Row and column, as axes of `count`."""
        return ((self.y, self.size.height), (self.x, self.size.width))

    def count(self, *axes: Axis) -> Array:
        """Number of events per cell, int64, one dimension per axis, slowest first."""
        sides = sides_of(axes)
        return self.ops.count_at(flat_index(*axes), math.prod(sides)).reshape(sides)


@runtime_checkable
class ColumnSource(Protocol):
    """Events that give their columns themselves, as `EventTensors` do."""

    def as_columns(self) -> EventColumns:
        """The events as int64 columns."""
        ...


Events: TypeAlias = EventStream | ColumnSource


def columns_of(events: Events) -> EventColumns:
    """The events as int64 columns, in the library that holds them.

    Raises:
        InputError: `events` is something else.
    """
    if isinstance(events, ColumnSource):
        return events.as_columns()
    if not isinstance(events, EventStream):
        raise InputError(
            f"events must be an EventStream or EventTensors; got {type(events).__name__}. "
            "EventStream.from_columns makes one from arrays x, y, t, p"
        )
    x, y, t, p = (column.astype(np.int64) for column in (events.x, events.y, events.t, events.p))
    return EventColumns(x, y, t, p, events.size, NUMPY_OPS)


def flat_index(*axes: Axis) -> Array:
    """Row-major index into an array from (coordinate, side) per axis, slowest axis first.

    The first coordinate must be int64: a narrower type would overflow.
    """
    index, _ = axes[0]
    for coordinate, side in axes[1:]:
        index = index * side + coordinate
    return index


def sides_of(axes: Sequence[Axis]) -> tuple[int, ...]:
    """Shape of the array that `axes` index."""
    return tuple(side for _, side in axes)
