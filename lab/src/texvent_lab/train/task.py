"""Interface of training tasks: network, loss, scores and batches."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.torch_samples import collate
from texvent.errors import TexventError
from texvent.extending import require
from texvent.networks import Tensor
from texvent_lab.train.schedule import EXTRA, epoch_order


class TrainingTask(Protocol):
    """A network, its samples, its loss and its scores.

    `validate` and `loss` are given the network on its device and move what they need there.
    """

    score: ClassVar[str]
    """Name of the score, in what `validate` gives, whose highest value is the best epoch's."""

    @property
    def identity(self) -> str:
        """Identity of the validation samples, and of its first weights; see `MakeSample`."""
        ...

    def make_network(self) -> Any:
        """The network, a torch module, with initial weights that depend on the seed alone."""
        ...

    def batches(self, *, workers: int) -> Batches:
        """The training samples, which are opened here.

        Raises:
            InputError, ConfigError, FileFormatError: they do not fit; the message says why.
        """
        ...

    def loss(self, network: Any, batch: Mapping[str, Any], device: Any) -> Tensor:
        """Loss of a batch, a scalar; it depends on its arguments alone."""
        ...

    def validate(
        self, network: Any, device: Any, *, workers: int
    ) -> tuple[dict[str, float], dict[str, list[Any]]]:
        """Scores on the validation samples by name.

        Returns:
            The scores; predictions, a value per sample in columns by name, or {}.
        """
        ...

    def published(self, network: Any) -> Mapping[str, Any]:
        """The trained network as a checkpoint in its published layout."""
        ...

    def read(self, network: Any, content: Mapping[str, Any], path: Path) -> None:
        """Take over the weights of a checkpoint, `published` here or elsewhere.

        Raises:
            FileFormatError: they do not fit the network or the samples.
        """
        ...


_data: Any = require("torch.utils.data", extra=EXTRA)
_Dataset: Any = _data.Dataset
_AUGMENTATION = 1


class MakeSample(Protocol):
    """Samples as arrays by name; picklable, for worker processes."""

    @property
    def identity(self) -> str:
        """Identity of the samples; a training goes on with equal ones alone."""
        ...

    def __call__(self, number: int, chance: np.random.Generator) -> Mapping[str, Any]:
        """A sample, by its number and the chance of this sample in this epoch."""
        ...


@dataclass(frozen=True)
class Batches:
    """Samples that are made anew in every epoch, by worker processes if there are any.

    The number of workers changes no batch.
    """

    make: MakeSample
    count: int
    """Number of samples."""
    batch_size: int
    seed: int
    shuffle: bool = True
    workers: int = 0

    def __len__(self) -> int:
        """Number of batches of an epoch."""
        return -(-self.count // self.batch_size)

    def epoch(self, number: int) -> Iterator[dict[str, Any]]:
        """The batches of an epoch, 0 or more; see `collate`."""
        numbers: NDArray[np.int64] = np.arange(self.count)
        if self.shuffle:
            numbers = epoch_order(self.count, seed=self.seed, epoch=number)
        # Workers end with the epoch: they hold its number.
        loader = _data.DataLoader(
            _Epoch(self, number),
            sampler=numbers.tolist(),
            batch_size=self.batch_size,
            num_workers=self.workers,
            collate_fn=collate,
            multiprocessing_context="spawn" if self.workers else None,
        )
        try:
            yield from loader
        except TexventError as error:
            # torch puts the worker's traceback, which ends with the message, in its place.
            raise type(error)(str(error).rpartition(f".{type(error).__name__}: ")[2]) from error


class _Epoch(_Dataset):
    def __init__(self, batches: Batches, number: int) -> None:
        super().__init__()
        self._batches, self._number = batches, number

    def __len__(self) -> int:
        return self._batches.count

    def __getitem__(self, sample: int) -> Mapping[str, Any]:
        keys = (self._batches.seed, _AUGMENTATION, self._number, sample)
        return self._batches.make(sample, np.random.default_rng(keys))
