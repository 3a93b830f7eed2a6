"""Samples in torch: batches, map-style data sets and the loader; imports torch (extra `torch`).

The order of an epoch is known before it begins (`EpochSampler`): the process that trains hands out
numbers of samples, and workers read. Order and batches are those of one process, whatever the
number of workers; an epoch goes on from any batch; nothing is read twice.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from texvent._require import require
from texvent.batch.manifest import describe_differences
from texvent.config import check_range
from texvent.dataset.loading.epoch_sampler import EpochSampler
from texvent.dataset.loading.stored_samples import StoredSamples
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.represent.tensors import TENSOR_TYPES, EventTensors, Tensor
from texvent.sensor import SensorSize

if TYPE_CHECKING:
    from texvent.dataset.samples import SimulatedSamples

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
    events an `EventBatch`, those of slices a list of one per sample; texts stay a list.
    """
    return {name: _collated([sample[name] for sample in samples]) for name in samples[0]}


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


class SampleDataset(_Dataset):
    """Samples as a map-style dataset, for samplers and loaders of your own.

    `[i]` gives `samples.make(first + i)`; `collate` puts such samples together. Of stored samples,
    `[i, epoch]` draws the augmentation of that epoch, `[i]` that of epoch 0: let a sampler give
    pairs `(i, epoch)`, or use `Loader`. Of simulated ones, give `first = epoch · count` for new
    samples in every epoch.
    """

    def __init__(
        self, samples: StoredSamples | SimulatedSamples, *, count: int | None = None, first: int = 0
    ) -> None:
        """Choose the samples; nothing is read or simulated yet.

        Args:
            samples: where they come from.
            count: how many; None: all stored ones, or one per source.
            first: number of the first.

        Raises:
            ConfigError: count below 1, or first below 0.
        """
        super().__init__()
        self.samples, self.first = samples, first
        if count is None:
            count = len(samples) if isinstance(samples, StoredSamples) else samples.source_count
        self.count = count
        check_range("count", count, 0 if isinstance(samples, StoredSamples) else 1)
        check_range("first", first, 0)

    def __len__(self) -> int:
        """Number of samples."""
        return self.count

    def __getitem__(self, number: int | tuple[int, int]) -> dict[str, Any]:
        """The arrays of a sample.

        Raises:
            IndexError: there is no such sample.
        """
        place, *epoch = number if isinstance(number, tuple) else (number,)
        if not 0 <= place < self.count:
            raise IndexError(f"sample {place} does not exist; there are {self.count}")
        options = {"epoch": epoch[0]} if epoch else {}
        return self.samples.make(self.first + int(place), **options)


class Loader:
    """Batches of stored samples, epoch after epoch, read ahead by worker processes.

    Every pass gives the next epoch. After a pass that was not finished, the next one begins the
    same epoch again; `state_dict` and `load_state_dict` go on where it stopped.
    """

    def __init__(
        self,
        samples: StoredSamples,
        *,
        workers: int = 0,
        prefetch: int = 2,
        pin_memory: bool | None = None,
        start_method: str = "spawn",
        rank: int | None = None,
        world_size: int | None = None,
        **order: Any,
    ) -> None:
        """No process is started yet.

        Args:
            samples: which.
            workers: processes that read and make arrays; 0: this one. They run until the loader
                is deleted.
            prefetch: batches that each worker makes ahead.
            pin_memory: whether batches are in page-locked memory, which a GPU copies while it
                computes; None: where there is one.
            start_method: "spawn", which needs `if __name__ == "__main__":` in a script, or "fork":
                starts at once, and can hang after Numba or a GPU has been used.
            rank: of this training process; None: as torch.distributed says.
            world_size: number of training processes; None: as torch.distributed says.
            **order: further fields of `EpochSampler`, such as `batch_size=8, shuffle=True`.

        Raises:
            ConfigError: a value out of range; see `EpochSampler`.
        """
        check_range("workers", workers, 0)
        check_range("prefetch", prefetch, 1)
        self.samples = samples
        self.sampler = _sampler(rank, world_size, order)
        self._position = 0
        # It knows nothing of this object: a cycle of references would keep worker processes.
        self._batches = _Batches(len(samples), self.sampler)
        options = {}
        if workers:
            options = {
                "prefetch_factor": prefetch,
                "persistent_workers": True,
                "multiprocessing_context": start_method,
            }
        self._loader = _data.DataLoader(
            SampleDataset(samples),
            batch_sampler=self._batches,
            num_workers=workers,
            collate_fn=collate,
            pin_memory=_torch.cuda.is_available() if pin_memory is None else pin_memory,
            **options,
        )

    def __len__(self) -> int:
        """Number of batches of a whole epoch."""
        return -(-len(self.sampler.numbers(len(self.samples), 0)) // self.sampler.batch_size)

    @property
    def epoch(self) -> int:
        """The epoch of the next pass, or of the one that runs."""
        return self._batches.epoch

    @epoch.setter
    def epoch(self, epoch: int) -> None:
        check_range("epoch", epoch, 0)
        self._batches.epoch, self._batches.begin = epoch, 0

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """The batches of the epoch; see `collate`."""
        self._position = self._batches.begin
        for batch in self._loader:
            self._position += len(batch["number"])
            yield batch
        self.epoch += 1
        self._position = 0

    def state_dict(self) -> dict[str, Any]:
        """State of the loader: epoch, and samples given out in it; also while it runs."""
        return {"epoch": self.epoch, "position": self._position, "key": self._key}

    def load_state_dict(self, state: Mapping[str, Any]) -> None:
        """Let the next pass go on where another loader of the same samples stood.

        Without `drop_last`, batches may have another size from there on.

        Raises:
            ConfigError: it had other samples, or gave this process others or in another order.
        """
        changed = describe_differences(state["key"], self._key)
        if changed:
            raise ConfigError(
                f"the state is of another loader: {changed}; make one of the same samples with the "
                "same options"
            )
        self.epoch = state["epoch"]
        self._position = self._batches.begin = state["position"]

    @cached_property
    def _key(self) -> dict[str, Any]:
        """All that decides which samples this process gets, in which order."""
        key = {**asdict(self.sampler), "samples": self.samples.index.identity}
        if not self.sampler.drop_last:
            del key["batch_size"]
        return key


@dataclass
class _Batches:
    """Number and epoch of the samples of each batch of an epoch, for the DataLoader."""

    count: int
    """Of all samples."""
    sampler: EpochSampler
    epoch: int = 0
    begin: int = 0
    """Samples that were given out before."""

    def __iter__(self) -> Iterator[list[tuple[int, int]]]:
        epoch, size = self.epoch, self.sampler.batch_size
        numbers = self.sampler.numbers(self.count, epoch)
        for begin in range(self.begin, len(numbers), size):
            yield [(number, epoch) for number in numbers[begin : begin + size].tolist()]

    def __len__(self) -> int:
        count = len(self.sampler.numbers(self.count, self.epoch)) - self.begin
        return -(-count // self.sampler.batch_size)


def _sampler(rank: int | None, world_size: int | None, order: Mapping[str, Any]) -> EpochSampler:
    """A sampler, with the rank and world size of torch.distributed where they are not given."""
    if (rank is None) != (world_size is None):
        raise ConfigError("give both rank and world_size, or none of them")
    if rank is None or world_size is None:
        distributed = _torch.distributed
        rank, world_size = 0, 1
        if distributed.is_available() and distributed.is_initialized():
            rank, world_size = distributed.get_rank(), distributed.get_world_size()
    return EpochSampler(rank=rank, world_size=world_size, **order)
