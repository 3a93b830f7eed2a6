"""Events in torch tensors, on a CPU or a GPU."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.represent.array_ops import ArrayOps, DType, EventColumns, Events
from texvent.sensor import SensorSize

Tensor: TypeAlias = Any
"""torch.Tensor; torch is imported only when tensors are made."""

TENSOR_TYPES: Mapping[str, type[np.generic]] = {
    "x": np.int32,
    "y": np.int32,
    "t": np.int64,
    "p": np.int8,
    "label": np.int8,
    "instance": np.int32,
    "class_id": np.int32,
}
"""torch computes with few unsigned types, and takes uint8 in an index for a mask."""


@dataclass(frozen=True, eq=False)
class EventTensors:
    """Events in tensors of one device; every representation takes them in place of an EventStream.

    Raises:
        InputError: lengths differ, a type is not an integer, a coordinate is outside the sensor,
            time decreases, or a polarity is not 0/1.
    """

    x: Tensor
    """Column, pixels, [n], any integer type."""
    y: Tensor
    """Row, pixels from the top, [n], any integer type."""
    t: Tensor
    """Time, µs, [n] int64, non-decreasing."""
    p: Tensor
    """Polarity, [n]: 1 = ON, 0 = OFF."""
    size: SensorSize
    """Width and height of the sensor, pixels."""

    def __post_init__(self) -> None:
        columns = {"x": self.x, "y": self.y, "t": self.t, "p": self.p}
        shapes = {name: tuple(column.shape) for name, column in columns.items()}
        if len(set(shapes.values())) != 1 or len(shapes["t"]) != 1:
            raise InputError(f"x, y, t, p must be one-dimensional and equally long; got {shapes}")
        if not len(self):
            return
        sides = {"x": self.size.width, "y": self.size.height, "p": 2}
        for name, column in columns.items():
            if column.is_floating_point() or column.is_complex():
                raise InputError(f"{name} must hold integers; got {column.dtype}")
        for name, side in sides.items():
            low, high = int(columns[name].min()), int(columns[name].max())
            if low < 0 or high >= side:
                raise InputError(f"{name} runs from {low} to {high}; allowed: 0..{side - 1}")
        if bool((self.t[1:] < self.t[:-1]).any()):
            raise InputError("time decreases; events must be in time order")

    @classmethod
    def of(cls, events: EventStream, device: str = "cpu") -> EventTensors:
        """Copies of the columns on `device`.

        Raises:
            ConfigError: torch knows or finds no such device.
            MissingDependencyError: torch is not installed.
        """
        columns = to_torch(events, device)
        return cls(columns["x"], columns["y"], columns["t"], columns["p"], events.size)

    @classmethod
    def unchecked(cls, x: Tensor, y: Tensor, t: Tensor, p: Tensor, *, size: SensorSize) -> Self:
        """From columns known to be right: a check would wait for the device."""
        tensors = object.__new__(cls)
        vars(tensors).update(x=x, y=y, t=t, p=p, size=size)
        return tensors

    def to(self, device: str) -> EventTensors:
        """The same events on another device; the same tensors if they are there already.

        Raises:
            ConfigError: torch knows or finds no such device.
        """
        columns = (self.x, self.y, self.t, self.p)
        with _device_errors(device):
            x, y, t, p = (column.to(device) for column in columns)
        return EventTensors(x, y, t, p, self.size)

    def __len__(self) -> int:
        return len(self.t)

    def as_columns(self) -> EventColumns:
        """The events as int64 columns on the same device, copied."""
        ops = TorchOps(str(self.t.device))
        x, y, t, p = (ops.cast(column, "int64") for column in (self.x, self.y, self.t, self.p))
        return EventColumns(x, y, t, p, self.size, ops)


@dataclass(frozen=True)
class TorchOps(ArrayOps):
    """The operations of `ArrayOps` in torch."""

    device: str

    @cached_property
    def xp(self) -> Any:
        """The module torch."""
        return require("torch", extra="torch")

    def cast(self, array: Tensor, dtype: DType) -> Tensor:
        """As `ArrayOps.cast`."""
        return array.to(getattr(self.xp, dtype), copy=True)

    def from_numpy(self, array: NDArray[Any]) -> Tensor:
        """As `ArrayOps.from_numpy`."""
        return self.xp.tensor(array, device=self.device)

    def count_at(self, index: Tensor, cells: int) -> Tensor:
        """As `ArrayOps.count_at`."""
        return self.xp.bincount(index, minlength=cells)

    def add_at(self, index: Tensor, values: Tensor, cells: int) -> Tensor:
        """As `ArrayOps.add_at`."""
        sums = self.xp.zeros(cells, dtype=values.dtype, device=self.device)
        return sums.index_add_(0, index, values)

    def latest_at(self, index: Tensor, t: Tensor, cells: int, never: int) -> Tensor:
        """As `ArrayOps.latest_at`."""
        latest = self.xp.full((cells,), never, dtype=t.dtype, device=self.device)
        return latest.scatter_reduce_(0, index, t, "amax")


def to_torch(events: EventStream, device: str = "cpu") -> dict[str, Tensor]:
    """EventColumns as tensors; see `EventStream.to_torch`."""
    torch = require("torch", extra="torch")
    with _device_errors(device):
        return {
            name: torch.tensor(column.astype(TENSOR_TYPES[name]), device=device)
            for name, column in events.columns().items()
        }


def put_events(events: Events, device: str) -> EventTensors:
    """Events of either kind as tensors on `device`.

    Raises:
        ConfigError: torch knows or finds no such device.
        InputError: `events` is something else.
        MissingDependencyError: torch is not installed.
    """
    if isinstance(events, EventTensors):
        return events.to(device)
    if not isinstance(events, EventStream):
        raise InputError(
            f"events must be an EventStream or EventTensors; got {type(events).__name__}"
        )
    return EventTensors.of(events, device)


@contextmanager
def _device_errors(device: str) -> Iterator[None]:
    """Name the device when torch cannot use it."""
    try:
        yield
    except (RuntimeError, AssertionError) as error:
        reason = str(error).splitlines()[0]
        raise ConfigError(
            f"torch cannot put events on device {device!r}: {reason} Use 'cpu', or a GPU that "
            "torch.cuda.is_available() finds"
        ) from error
