"""Simulated samples as a torch dataset; importing this module imports torch (extra `torch`)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from texvent._require import require
from texvent.config import check_range
from texvent.dataset.loading.collate import as_tensors
from texvent.dataset.samples import Sample, SimulatedSamples

_data: Any = require("torch.utils.data", extra="torch")
_IterableDataset: Any = _data.IterableDataset


class SimulatedDataset(_IterableDataset):
    """Samples `first` .. `first + count − 1` of `SimulatedSamples`, simulated when asked for.

    Worker processes share the numbers out by whole batches, so batches and their order are the
    same for any number of workers. Give `first = epoch · count` for new samples in every epoch.
    """

    def __init__(
        self,
        samples: SimulatedSamples,
        *,
        count: int | None = None,
        first: int = 0,
        batch_size: int = 1,
    ) -> None:
        """Choose the samples; nothing is simulated yet.

        Args:
            samples: where they come from.
            count: how many; None: one per source.
            first: number of the first.
            batch_size: samples per batch of the DataLoader, which `loader` makes to match.

        Raises:
            ConfigError: count or batch_size below 1, or first below 0.
        """
        super().__init__()
        self.samples = samples
        self.count = len(samples.prompts or samples.videos) if count is None else count
        self.first = first
        self.batch_size = batch_size
        check_range("count", self.count, 1)
        check_range("first", first, 0)
        check_range("batch_size", batch_size, 1)

    def __len__(self) -> int:
        """Number of samples."""
        return self.count

    def __iter__(self) -> Iterator[Sample]:
        """This worker's samples, arrays as tensors; all of them outside a worker."""
        info = _data.get_worker_info()
        worker, workers = (0, 1) if info is None else (info.id, info.num_workers)
        for begin in range(worker * self.batch_size, self.count, workers * self.batch_size):
            for offset in range(begin, min(begin + self.batch_size, self.count)):
                yield as_tensors(self.samples.make(self.first + offset))

    def loader(self, *, workers: int = 0, **options: Any) -> Any:
        """A torch DataLoader with this dataset's batches.

        Args:
            workers: processes that simulate; 0: this one. They are started afresh, not forked:
                a fork of a process in which Numba has run threads can hang.
            **options: further options of DataLoader, such as `pin_memory=True`.
        """
        context = "spawn" if workers else None
        settings = {"num_workers": workers, "multiprocessing_context": context, **options}
        return _data.DataLoader(self, batch_size=self.batch_size, **settings)
