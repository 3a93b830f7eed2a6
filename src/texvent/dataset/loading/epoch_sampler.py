"""Order of the samples in an epoch, and the share of each training process."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.simulate.random.draws import frame_key, frame_keys

MAX_SEED = 2**63 - 1
_PLACES = 1
"""Purpose of the draws; another one gives other orders."""


@dataclass(frozen=True, kw_only=True)
class EpochSampler:
    """Samples of a training process in an epoch: which, in which order and batches.

    Raises:
        ConfigError: a value out of range.
    """

    batch_size: int = 1
    """Samples per batch."""
    shuffle: bool = False
    """Whether each epoch has an order of its own."""
    seed: int = 0
    """Seed of the orders."""
    drop_last: bool = False
    """True: every process gets the same number of whole batches, as DistributedDataParallel needs
    it, and up to batch_size · world_size − 1 samples at the end of the order are left out. False:
    every sample comes once, and the processes' numbers of samples differ by at most one."""
    rank: int = 0
    """Rank of this training process."""
    world_size: int = 1
    """Number of training processes."""

    def __post_init__(self) -> None:
        check_range("batch_size", self.batch_size, 1)
        check_range("seed", self.seed, 0, MAX_SEED)
        check_range("world_size", self.world_size, 1)
        check_range("rank", self.rank, 0, self.world_size - 1)

    def numbers(self, count: int, epoch: int) -> NDArray[np.int64]:
        """Numbers of the samples of this process, in order.

        Args:
            count: of all samples.
            epoch: 0 or more.
        """
        order: NDArray[np.int64] = np.arange(count)
        if self.shuffle:
            order = epoch_order(count, seed=self.seed, epoch=epoch)
        if self.drop_last:
            length = len(order) // (self.world_size * self.batch_size) * self.batch_size
            return order[self.rank * length : (self.rank + 1) * length]
        begin, end = (len(order) * one // self.world_size for one in (self.rank, self.rank + 1))
        return order[begin:end]


def epoch_order(count: int, *, seed: int, epoch: int) -> NDArray[np.int64]:
    """The numbers 0..count−1 once, shuffled: a function of the arguments alone.

    Args:
        count: number of samples.
        seed: 0..2⁶³−1.
        epoch: 0 or more.

    Returns:
        [count] numbers of samples; every order is as likely.
    """
    key = int(frame_key(int(frame_key(seed, epoch)) >> 1, _PLACES)) >> 1
    return np.argsort(frame_keys(key, np.arange(count)), kind="stable")
