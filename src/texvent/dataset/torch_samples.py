"""Samples in torch: batches and map-style data sets; imports torch (extra `torch`)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from texvent._require import require
from texvent.config import check_range
from texvent.dataset.sample_table import SampleTable
from texvent.events import EventStream
from texvent.represent.tensors import TENSOR_TYPES, EventTensors, Tensor
from texvent.sensor import SensorSize

_torch: Any = require("torch", extra="torch")
_data: Any = require("torch.utils.data", extra="torch")
_Dataset: Any = _data.Dataset


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
    """End of the events of each sample."""
    sizes: tuple[SensorSize, ...]
    """Sensor size of each sample."""

    @classmethod
    def of(cls, streams: Sequence[EventStream]) -> EventBatch:
        """Copies of the events."""
        ends = tuple(np.cumsum([len(events) for events in streams]).tolist())
        x, y, t, p = (_joined(name, streams) for name in "xytp")
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
        """Number of the sample of each event, [n] int64, on the device of the events."""
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
    events an `EventBatch`, those of slices a list of one per sample; tables, such as boxes, a list
    of tables of tensors; other slices a list of lists; texts stay a list.
    """
    return {name: _collated([sample[name] for sample in samples]) for name in samples[0]}


def _collated(values: list[Any]) -> Any:
    first = values[0]
    if isinstance(first, EventStream):
        return EventBatch.of(values)
    if isinstance(first, tuple):
        are_events = isinstance(first[0], EventStream)
        return [EventBatch.of(one) if are_events else list(map(_tensors, one)) for one in values]
    if isinstance(first, Mapping):
        return list(map(_tensors, values))
    if isinstance(first, np.ndarray | np.generic | _torch.Tensor):
        tensors = [_torch.as_tensor(value) for value in values]
        same = all(value.shape == first.shape for value in values)
        return _data.default_collate(tensors) if same else tensors
    if isinstance(first, int):
        return _torch.tensor(values)
    return values


def _tensors(value: Any) -> Any:
    """An array, or the arrays of a table, as tensors."""
    if isinstance(value, Mapping):
        return {name: _torch.as_tensor(array) for name, array in value.items()}
    return _torch.as_tensor(value)


def _joined(name: str, streams: Sequence[EventStream]) -> Tensor:
    """A column of all streams."""
    columns = [getattr(events, name).astype(TENSOR_TYPES[name]) for events in streams]
    return _torch.from_numpy(np.concatenate(columns))


class SampleDataset(_Dataset):
    """Samples as a map-style dataset for torch's loaders and samplers; see `collate`.

    `[i]` gives sample `first + i`. For new samples in every epoch, make one for each: of stored
    samples with its `epoch`, of simulated ones with `first = epoch · count`.
    """

    def __init__(
        self,
        samples: SampleTable,
        *,
        count: int | None = None,
        first: int = 0,
        epoch: int = 0,
    ) -> None:
        """Choose the samples; nothing is read or simulated yet.

        Args:
            samples: where they come from.
            count: how many; None: all stored ones, or one per source.
            first: number of the first.
            epoch: which draws of their augmentation.

        Raises:
            ConfigError: count below 1, or first or epoch below 0.
        """
        super().__init__()
        check_range("count", count, 1)
        check_range("first", first, 0)
        check_range("epoch", epoch, 0)
        self.samples, self.first, self.epoch = samples, first, epoch
        self.count = samples.count if count is None else count

    def __len__(self) -> int:
        """Number of samples."""
        return self.count

    def __getitem__(self, number: int) -> dict[str, Any]:
        """The arrays of a sample.

        Raises:
            IndexError: there is no such sample.
        """
        if not 0 <= number < self.count:
            raise IndexError(f"sample {number} does not exist; there are {self.count}")
        return self.samples.make(self.first + int(number), epoch=self.epoch)
