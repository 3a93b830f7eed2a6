"""EVT2 words ↔ events: words of 32 bits, little-endian.

    bits 31..28   type: 0 OFF, 1 ON, 8 TIME_HIGH; others (10 trigger, 14, 15) are skipped
    OFF, ON       27..22 low 6 bits of t (µs) · 21..11 x · 10..0 y
    TIME_HIGH     27..0  t >> 6

Coordinates below 2048, times below 2^34 µs (4 h 46 min). Readers disagree on what follows when
the counter wraps, so texvent does not write later times; it reads wrapped files. A TIME_HIGH word
is written when its value changes.

Source: Prophesee, "EVT 2.0 Format".
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit

WORD = "<u4"
START = (0x8000_0000,)
"""TIME_HIGH 0: see `texvent.io.prophesee.evt`."""
DECODER_STATE = (0, -1)
"""Number of wraps of TIME_HIGH, and its value (−1: none yet)."""
ENCODER_STATE = (0, 0)
TIME_HIGH = 8
HALF_TURN = 1 << 27
"""A fall of TIME_HIGH by more than this is a wrap of its 28 bits."""


def count_words(times: NDArray[np.int64], state: NDArray[np.int64]) -> int:
    """Room for the words of these events."""
    return 2 * len(times)


@jit
def count_events(words: NDArray[np.uint32]) -> int:
    """Number of ON and OFF words."""
    count = np.int64(0)
    for i in range(words.size):
        count += (np.int64(words[i]) >> 28) <= 1
    return int(count)


@jit
def decode_words(
    words: NDArray[np.uint32], state: NDArray[np.int64], columns: tuple[NDArray[Any], ...]
) -> int:
    """Fill columns x, y, t, p; returns the number of events."""
    x, y, t, p = columns
    turns, high = state[0], state[1]
    # Negative until there is a TIME_HIGH.
    base = ((turns << 28) | high) << 6
    count = 0
    for i in range(words.size):
        word = np.int64(words[i])
        kind = word >> 28
        if kind <= 1:
            if base >= 0:
                x[count] = (word >> 11) & 0x7FF
                y[count] = word & 0x7FF
                t[count] = base + ((word >> 22) & 0x3F)
                p[count] = kind
                count += 1
        elif kind == TIME_HIGH:
            fresh = word & 0xFFF_FFFF
            if high - fresh > HALF_TURN:
                turns += 1
            high = fresh
            base = ((turns << 28) | high) << 6
    state[0], state[1] = turns, high
    return count


@jit
def encode_events(
    columns: tuple[NDArray[Any], ...], state: NDArray[np.int64], words: NDArray[np.uint32]
) -> int:
    """Fill words from columns x, y, t, p; returns their number."""
    x, y, t, p = columns
    high = state[1]
    count = 0
    for i in range(t.size):
        time = np.int64(t[i])
        if time >> 6 != high:
            high = time >> 6
            words[count] = (TIME_HIGH << 28) | high
            count += 1
        place = (np.int64(x[i]) << 11) | np.int64(y[i])
        words[count] = (np.int64(p[i]) << 28) | ((time & 0x3F) << 22) | place
        count += 1
    state[1] = high
    return count
