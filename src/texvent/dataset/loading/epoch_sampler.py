"""Order of the samples in an epoch, and the share of each training process."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.simulate.random.draws import frame_key, frame_keys

MAX_SEED = 2**63 - 1
_SHARDS, _PLACES = 0, 1
_UNITS = 2.0**64


@dataclass(frozen=True, kw_only=True)
class EpochSampler:
    """Samples of a training process in an epoch: which, in which order and batches.

    Raises:
        ConfigError: a value out of range, or a shuffle_buffer without shuffle.
    """

    batch_size: int = 1
    """Samples per batch."""
    shuffle: bool = False
    """Whether each epoch has an order of its own."""
    seed: int = 0
    """Seed of the orders."""
    shuffle_buffer: int | None = None
    """Shuffle as a buffer of this size does, and read shards in sequence, as slow discs and
    networks like it; None: every order is as likely."""
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
        check_range("shuffle_buffer", self.shuffle_buffer, 1)
        check_range("world_size", self.world_size, 1)
        check_range("rank", self.rank, 0, self.world_size - 1)
        if self.shuffle_buffer is not None and not self.shuffle:
            raise ConfigError("shuffle_buffer belongs to shuffle; give shuffle=True with it")

    def numbers(self, shard: NDArray[np.int64], epoch: int) -> NDArray[np.int64]:
        """Numbers of the samples of this process, in order.

        Processes get consecutive parts of the order, so each reads shards of its own.

        Args:
            shard: [n] shard of each sample.
            epoch: 0 or more.
        """
        order: NDArray[np.int64] = np.arange(len(shard))
        if self.shuffle:
            order = epoch_order(
                shard, seed=self.seed, epoch=epoch, shuffle_buffer=self.shuffle_buffer
            )
        if self.drop_last:
            length = len(order) // (self.world_size * self.batch_size) * self.batch_size
            return order[self.rank * length : (self.rank + 1) * length]
        begin, end = (len(order) * one // self.world_size for one in (self.rank, self.rank + 1))
        return order[begin:end]


def epoch_order(
    shard: NDArray[np.int64], *, seed: int, epoch: int, shuffle_buffer: int | None = None
) -> NDArray[np.int64]:
    """All samples once, shuffled: a function of the arguments alone.

    Without `shuffle_buffer`, every order is as likely. With it, shards come in a random order and
    are read in sequence, and each sample moves by at most `shuffle_buffer` places.

    Args:
        shard: [n] shard of each sample.
        seed: 0..2⁶³−1.
        epoch: 0 or more.
        shuffle_buffer: see above.

    Returns:
        [n] numbers of samples.
    """
    places = np.arange(len(shard))
    draws = _draws(seed, epoch, _PLACES, places)
    if shuffle_buffer is None:
        return np.argsort(draws, kind="stable")
    in_sequence = np.argsort(_draws(seed, epoch, _SHARDS, shard), kind="stable")
    moved = places + draws[in_sequence] / _UNITS * shuffle_buffer
    return in_sequence[np.argsort(moved, kind="stable")]


def _draws(seed: int, epoch: int, purpose: int, numbers: NDArray[np.int64]) -> NDArray[np.uint64]:
    key = int(frame_key(int(frame_key(seed, epoch)) >> 1, purpose)) >> 1
    return frame_keys(key, numbers)
