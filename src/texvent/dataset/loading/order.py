"""The order of samples in an epoch, and the share of each process of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.random.draws import frame_key, frame_keys

_SHARDS, _PLACES = 0, 1
_UNITS = 2.0**64


def epoch_order(
    shard: NDArray[np.int64], *, seed: int, epoch: int, shuffle_buffer: int | None = None
) -> NDArray[np.int64]:
    """All samples once, shuffled: a function of the arguments alone.

    Without `shuffle_buffer`, every order is as likely. With it, shards come in a random order and
    are read in sequence, and each sample moves by at most `shuffle_buffer` places: as from a
    buffer of that size, but without one, since samples are read by number.

    Args:
        shard: [n] of each sample.
        seed: 0..2⁶³−1.
        epoch: 0 or more.
        shuffle_buffer: see above.

    Returns:
        [n] numbers of samples.
    """
    count = len(shard)
    places = np.arange(count)
    draws = _draws(seed, epoch, _PLACES, places)
    if shuffle_buffer is None:
        return np.argsort(draws, kind="stable")
    in_sequence = np.argsort(_draws(seed, epoch, _SHARDS, shard), kind="stable")
    moved = places + draws[in_sequence] / _UNITS * shuffle_buffer
    return in_sequence[np.argsort(moved, kind="stable")]


def share_of(
    order: NDArray[np.int64], *, rank: int, world_size: int, batch_size: int, drop_last: bool
) -> NDArray[np.int64]:
    """The part of an order that one of several training processes gets.

    Parts stand one after another in the order, so each process reads shards of its own.

    Args:
        order: of all samples.
        rank: of the process, 0..world_size−1.
        world_size: number of processes.
        batch_size: samples per batch.
        drop_last: True: every process gets the same number of whole batches, and up to
            batch_size · world_size − 1 samples at the end of the order are left out. False: every
            sample goes to one process, and their numbers differ by at most one.
    """
    if drop_last:
        length = len(order) // (world_size * batch_size) * batch_size
        return order[rank * length : (rank + 1) * length]
    begin, end = (len(order) * one // world_size for one in (rank, rank + 1))
    return order[begin:end]


def _draws(seed: int, epoch: int, purpose: int, numbers: NDArray[np.int64]) -> NDArray[np.uint64]:
    key = int(frame_key(int(frame_key(seed, epoch)) >> 1, purpose)) >> 1
    return frame_keys(key, numbers)
