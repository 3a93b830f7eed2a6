"""Stored samples for torch; importing this module imports torch (extra `torch`).

The order of an epoch is known before it begins (see `order`), so the process that trains hands
out numbers of samples, and workers read. Order and batches are those of one process, whatever the
number of workers; an epoch goes on from any batch; nothing is read twice.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.batch.manifest import describe_differences
from texvent.config import check_range
from texvent.dataset.loading.collate import as_tensors, collate
from texvent.dataset.loading.order import epoch_order, share_of
from texvent.dataset.loading.stored_samples import StoredSamples
from texvent.errors import ConfigError

_torch: Any = require("torch", extra="torch")
_data: Any = require("torch.utils.data", extra="torch")
_Dataset: Any = _data.Dataset
_IterableDataset: Any = _data.IterableDataset

MAX_SEED = 2**63 - 1


@dataclass(frozen=True, kw_only=True)
class Sharing:
    """Which samples a process gets in an epoch, in which order and batches.

    Raises:
        ConfigError: a value out of range, or a shuffle_buffer without shuffle.
    """

    batch_size: int = 1
    """Samples per batch."""
    shuffle: bool = False
    """Whether each epoch has an order of its own."""
    seed: int = 0
    """Of the orders."""
    shuffle_buffer: int | None = None
    """Shuffle as a buffer of so many samples does, and read shards in sequence, as slow discs and
    networks like it; None: every order is as likely."""
    drop_last: bool = False
    """Whether all processes get the same number of whole batches, as training by
    DistributedDataParallel needs it; otherwise every sample comes once."""
    rank: int = 0
    """Of this training process."""
    world_size: int = 1
    """Number of training processes."""

    def __post_init__(self) -> None:
        check_range("batch_size", self.batch_size, 1)
        check_range("seed", self.seed, 0, MAX_SEED)
        check_range("shuffle_buffer", self.shuffle_buffer, 1)
        check_range("world_size", self.world_size, 1)
        check_range("rank", self.rank, 0, self.world_size - 1)
        if self.shuffle_buffer is not None and not self.shuffle:
            raise ConfigError("shuffle_buffer belongs to shuffle; give shuffle=True with it")

    @classmethod
    def of(cls, rank: int | None, world_size: int | None, **options: Any) -> Sharing:
        """With rank and world size of torch.distributed where they are not given.

        Raises:
            ConfigError: only one of them is given.
        """
        if (rank is None) != (world_size is None):
            raise ConfigError("give both rank and world_size, or none of them")
        if rank is None or world_size is None:
            distributed = _torch.distributed
            rank, world_size = 0, 1
            if distributed.is_available() and distributed.is_initialized():
                rank, world_size = distributed.get_rank(), distributed.get_world_size()
        return cls(rank=rank, world_size=world_size, **options)

    def numbers(self, samples: StoredSamples, epoch: int) -> NDArray[np.int64]:
        """The samples of this process in an epoch, in order."""
        if self.shuffle:
            order = epoch_order(
                samples.index.shard,
                seed=self.seed,
                epoch=epoch,
                shuffle_buffer=self.shuffle_buffer,
            )
        else:
            order = np.arange(len(samples))
        return share_of(
            order,
            rank=self.rank,
            world_size=self.world_size,
            batch_size=self.batch_size,
            drop_last=self.drop_last,
        )


class StoredDataset(_Dataset):
    """Stored samples as a map-style dataset, for samplers and loaders of your own.

    `[i]` gives what `StoredSamples.make` gives; `collate` puts such samples together. `[i, epoch]`
    draws the augmentation of that epoch, and `[i]` that of epoch 0: with a sampler that gives
    numbers alone, augmentations are the same in every epoch. Let it give pairs `(i, epoch)`, or
    use `Loader` or `StoredStream`.
    """

    def __init__(self, samples: StoredSamples) -> None:
        """Nothing is read yet."""
        super().__init__()
        self.samples = samples

    def __len__(self) -> int:
        """Number of samples."""
        return len(self.samples)

    def __getitem__(self, number: int | tuple[int, int]) -> dict[str, Any]:
        """The arrays of a sample."""
        number, epoch = number if isinstance(number, tuple) else (number, 0)
        return self.samples.make(int(number), epoch=epoch)


class StoredStream(_IterableDataset):
    """Stored samples as an iterable dataset, shared out over ranks and worker processes.

    Workers take whole batches in turn, so a DataLoader of the same `batch_size` gives the same
    batches for any number of them.
    """

    def __init__(
        self,
        samples: StoredSamples,
        *,
        rank: int | None = None,
        world_size: int | None = None,
        **sharing: Any,
    ) -> None:
        """Nothing is read yet.

        Args:
            samples: which.
            rank: of this training process; None: as torch.distributed says.
            world_size: number of training processes; None: as torch.distributed says.
            **sharing: further fields of `Sharing`, such as `batch_size=8, shuffle=True`.

        Raises:
            ConfigError: as `Sharing`.
        """
        super().__init__()
        self.samples = samples
        self.sharing = Sharing.of(rank, world_size, **sharing)
        # Shared with worker processes, which keep their copy of this object between epochs.
        self._epoch = _torch.zeros(1, dtype=_torch.int64).share_memory_()

    def set_epoch(self, epoch: int) -> None:
        """Choose order and augmentations of the next pass, also in workers that run already.

        Raises:
            ConfigError: epoch is below 0.
        """
        check_range("epoch", epoch, 0)
        self._epoch[0] = epoch

    def __len__(self) -> int:
        """Number of samples of this rank."""
        return len(self.sharing.numbers(self.samples, int(self._epoch[0])))

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """This worker's samples, arrays as tensors; all of the rank's outside a worker."""
        info = _data.get_worker_info()
        worker, workers = (0, 1) if info is None else (info.id, info.num_workers)
        epoch = int(self._epoch[0])  # of the whole pass, whatever set_epoch says meanwhile
        numbers, size = self.sharing.numbers(self.samples, epoch), self.sharing.batch_size
        for begin in range(worker * size, len(numbers), workers * size):
            for number in numbers[begin : begin + size].tolist():
                yield as_tensors(self.samples.make(number, epoch=epoch))


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
        **sharing: Any,
    ) -> None:
        """No process is started yet.

        Args:
            samples: which.
            workers: processes that read and make arrays; 0: this one. They run until the loader
                is deleted.
            prefetch: batches that each worker makes ahead.
            pin_memory: whether batches lie in memory that a GPU can read while it computes; None:
                where there is one.
            start_method: "spawn", which needs `if __name__ == "__main__":` in a script, or "fork":
                starts at once, and can hang after Numba or a GPU has been used.
            rank: of this training process; None: as torch.distributed says.
            world_size: number of training processes; None: as torch.distributed says.
            **sharing: further fields of `Sharing`, such as `batch_size=8, shuffle=True`.

        Raises:
            ConfigError: a value out of range; see `Sharing`.
        """
        check_range("workers", workers, 0)
        check_range("prefetch", prefetch, 1)
        self.samples = samples
        self.sharing = Sharing.of(rank, world_size, **sharing)
        self._position = 0
        # It knows nothing of this object: a cycle of references would keep worker processes.
        self._batches = _Batches(samples, self.sharing)
        options = {}
        if workers:
            options = {
                "prefetch_factor": prefetch,
                "persistent_workers": True,
                "multiprocessing_context": start_method,
            }
        self._loader = _data.DataLoader(
            StoredDataset(samples),
            batch_sampler=self._batches,
            num_workers=workers,
            collate_fn=collate,
            pin_memory=_torch.cuda.is_available() if pin_memory is None else pin_memory,
            **options,
        )

    def __len__(self) -> int:
        """Number of batches of a whole epoch."""
        return -(-len(self.sharing.numbers(self.samples, 0)) // self.sharing.batch_size)

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
        """Where the loader stands: epoch, and samples given out in it. Also while it runs."""
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
        key = {**asdict(self.sharing), "samples": self.samples.index.identity}
        if not self.sharing.drop_last:
            del key["batch_size"]
        return key


@dataclass
class _Batches:
    """Number and epoch of the samples of each batch of an epoch, for the DataLoader."""

    samples: StoredSamples
    sharing: Sharing
    epoch: int = 0
    begin: int = 0
    """Samples that were given out before."""

    def __iter__(self) -> Iterator[list[tuple[int, int]]]:
        epoch, size = self.epoch, self.sharing.batch_size
        numbers = self.sharing.numbers(self.samples, epoch)
        for begin in range(self.begin, len(numbers), size):
            yield [(number, epoch) for number in numbers[begin : begin + size].tolist()]

    def __len__(self) -> int:
        count = len(self.sharing.numbers(self.samples, self.epoch)) - self.begin
        return -(-count // self.sharing.batch_size)
