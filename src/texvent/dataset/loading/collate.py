"""Samples put together to batches of tensors; importing this module imports torch."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from texvent._require import require
from texvent.events import EventStream
from texvent.represent.tensors import TENSOR_TYPES, EventTensors, Tensor
from texvent.sensor import SensorSize

_torch: Any = require("torch", extra="torch")
_data: Any = require("torch.utils.data", extra="torch")


@dataclass(frozen=True, eq=False)
class EventBatch:
    """Events of several samples, end to end in four tensors; `batch[i]` are those of sample i.

    Four tensors go to a GPU, or from a worker process, in a fraction of the time of four per
    sample.
    """

    x: Tensor
    """Column, pixels, [n] int32."""
    y: Tensor
    """Row, pixels from the top, [n] int32."""
    t: Tensor
    """Time, µs, [n] int64; begins again with each sample."""
    p: Tensor
    """Polarity, [n] int8: 1 = ON, 0 = OFF."""
    ends: tuple[int, ...]
    """Where the events of each sample end."""
    sizes: tuple[SensorSize, ...]
    """Of the sensor of each sample."""

    @classmethod
    def of(cls, streams: Sequence[EventStream]) -> EventBatch:
        """Copies of the events."""
        ends = tuple(np.cumsum([len(events) for events in streams]).tolist())
        x, y, t, p = (_joined(name, streams, ends[-1] if ends else 0) for name in "xytp")
        return cls(x, y, t, p, ends, tuple(events.size for events in streams))

    def __len__(self) -> int:
        """Number of samples."""
        return len(self.ends)

    def __getitem__(self, number: int) -> EventTensors:
        """The events of a sample, without a copy."""
        number = range(len(self))[number]
        part = slice(self.ends[number - 1] if number else 0, self.ends[number])
        columns = (column[part] for column in (self.x, self.y, self.t, self.p))
        return EventTensors.unchecked(*columns, size=self.sizes[number])

    def __iter__(self) -> Iterator[EventTensors]:
        """The events of each sample."""
        return (self[number] for number in range(len(self)))

    @property
    def sample(self) -> Tensor:
        """Which sample each event belongs to, [n] int64, on the device of the events."""
        ends = _torch.tensor(self.ends, device=self.t.device)
        counts = _torch.diff(ends, prepend=ends.new_zeros(1))
        return _torch.repeat_interleave(counts)

    def to(self, device: Any, *, non_blocking: bool = False) -> EventBatch:
        """The same on another device."""
        return self._mapped(lambda column: column.to(device, non_blocking=non_blocking))

    def pin_memory(self, device: Any = None) -> EventBatch:
        """The same in memory that a GPU can read; the DataLoader calls it."""
        return self._mapped(lambda column: column.pin_memory())

    def _mapped(self, change: Any) -> EventBatch:
        return replace(self, **{name: change(getattr(self, name)) for name in "xytp"})


def collate(samples: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """A batch: name → the values of all samples.

    Arrays of equal shape become one tensor, others a list of tensors; numbers become a tensor;
    events an `EventBatch`, those of slices a list of one per sample; texts stay a list.
    """
    return {name: _collated([sample[name] for sample in samples]) for name in samples[0]}


def as_tensors(sample: Mapping[str, Any]) -> dict[str, Any]:
    """A sample with arrays as tensors."""
    return {
        name: _torch.as_tensor(np.ascontiguousarray(value) if np.ndim(value) else value)
        if isinstance(value, np.ndarray | np.generic)
        else value
        for name, value in sample.items()
    }


def _collated(values: list[Any]) -> Any:
    first = values[0]
    if isinstance(first, EventStream):
        return EventBatch.of(values)
    if isinstance(first, tuple):
        return [EventBatch.of(slices) for slices in values]
    if isinstance(first, np.ndarray | np.generic | _torch.Tensor):
        tensors = [_torch.as_tensor(value) for value in values]
        same = all(value.shape == first.shape for value in values)
        return _data.default_collate(tensors) if same else tensors
    if isinstance(first, int):
        return _torch.tensor(values)
    return values


def _joined(name: str, streams: Sequence[EventStream], count: int) -> Tensor:
    """A column of all streams."""
    joined = _new_tensor(count, _torch.from_numpy(np.empty(0, TENSOR_TYPES[name])))
    column, begin = joined.numpy(), 0
    for events in streams:
        column[begin : begin + len(events)] = getattr(events, name)
        begin += len(events)
    return joined


def _new_tensor(count: int, like: Tensor) -> Tensor:
    """A tensor, in a worker in the memory that it is handed over in, as torch's own collation."""
    if _data.get_worker_info() is None or not count:
        return like.new_empty(count)
    storage = like._typed_storage()._new_shared(count, device=like.device)
    return like.new(storage).resize_(count)
