"""Order of the samples in an epoch."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.random.draws import frame_key, frame_keys

_PLACES = 1
"""Purpose of the draws; another one gives other orders."""


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
