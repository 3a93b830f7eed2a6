"""EVT2 words → events: words of 32 bits, little-endian.

    bits 31..28   type: 0 OFF, 1 ON, 8 TIME_HIGH; others (10 trigger, 14, 15) are skipped
    OFF, ON       27..22 low 6 bits of t (µs) · 21..11 x · 10..0 y
    TIME_HIGH     27..0  t >> 6

Coordinates below 2048. The time wraps every 2^34 µs (4 h 46 min).

Source: Prophesee, "EVT 2.0 Format".
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.io.prophesee.time_high import FIRST_STATE, follow
from texvent.runtime.jit import jit

WORD = "<u4"
DECODER_STATE = FIRST_STATE
TIME_HIGH, HIGH_BITS = 8, 28


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
    # Negative until there is a TIME_HIGH.
    base = ((state[0] << HIGH_BITS) | state[1]) << 6
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
            follow(state, word & 0xFFF_FFFF, HIGH_BITS)
            base = ((state[0] << HIGH_BITS) | state[1]) << 6
    return count
