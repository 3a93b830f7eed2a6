"""Stationary blocks: the part of a recording whose event rate does not change."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream

WINDOWS = 16
"""Parts of the recording whose counts are compared."""
BLOCK = 16
"""Side of the blocks of pixels that are judged together."""
SURPRISE = 5.0
"""Standard deviations by which the counts of a block may vary more than those of a Poisson
process."""
MAINS_HZ = (100.0, 120.0)
"""At which lamps on the mains flicker."""
MAINS_SHARE, MAINS_SURPRISE = 0.1, 5.0
"""Events follow the mains if a tenth of them and five times chance do."""


def find_rest(events: EventStream) -> NDArray[np.bool_]:
    """Pixels in blocks whose number of events does not change over time, [H, W].

    In 16 equal windows, counts of a Poisson process with the same rate give a sum of squared
    deviations over the mean that is distributed as χ² of 15 degrees of freedom; noise, hot pixels
    and leak stay below its mean plus five standard deviations, moving blocks do not.
    """
    width, height = events.size
    rows, columns = -(-height // BLOCK), -(-width // BLOCK)
    start_us, stop_us = events.time_range or (0, 1)
    block = (events.y // BLOCK).astype(np.int64) * columns + events.x // BLOCK
    window = (events.t - start_us) * WINDOWS // max(stop_us - start_us, 1)
    counts = np.bincount(window * (rows * columns) + block, minlength=WINDOWS * rows * columns)
    counts = counts.reshape(WINDOWS, rows * columns)
    mean = counts.mean(axis=0)
    deviation = ((counts - mean) ** 2).sum(axis=0) / np.maximum(mean, 1e-9)
    freedom = WINDOWS - 1
    rests = deviation <= freedom + SURPRISE * math.sqrt(2 * freedom)
    return np.kron(rests.reshape(rows, columns), np.ones((BLOCK, BLOCK), np.bool_))[
        :height, :width
    ].astype(np.bool_)


def mains_flicker(events: EventStream) -> float | None:
    """The frequency of lamps on the mains if the events follow it, Hz, else None.

    The events follow a frequency if the mean of `exp(2πi f t)` is well above `1 / √n`.
    """
    if not len(events):
        return None
    seconds = (events.t - events.t[0]) / 1e6
    share = {hz: float(np.abs(np.exp(2j * np.pi * hz * seconds).mean())) for hz in MAINS_HZ}
    hz = max(MAINS_HZ, key=lambda one: share[one])
    limit = max(MAINS_SHARE, MAINS_SURPRISE / math.sqrt(len(events)))
    return hz if share[hz] > limit else None
