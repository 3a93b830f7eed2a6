"""EVT2.1 words → events: words of 64 bits for up to 32 events each.

    bits 63..60   type: 0 OFF, 1 ON, 8 TIME_HIGH; others are skipped
    OFF, ON       59..54 low 6 bits of t (µs) · 53..43 first x, a multiple of 32 · 42..32 y
                  31..0  bit i set: an event at x + i
    TIME_HIGH     59..32 t >> 6

Coordinates below 2048. The time wraps every 2^34 µs (4 h 46 min), as in EVT2.

The words come in one of two orders of bytes, as the header says: `endianness=little`, plain, or
`endianness=legacy`, upper half first (each half little-endian), as the IMX636 sends them. Where
nothing is stated, cameras of Prophesee with a system number below 0x37 count as legacy, the others
as little, as in OpenEB.

A word of 64 bits is handled as two numbers of 32 bits, upper half first, the way it is written:
Numba has no type that holds both signed and unsigned 64 bits.

Source: Prophesee, "EVT 2.1 Format".
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
VECTOR = 32
DE_BRUIJN = 0x077C_B531
"""Its product with 2^i differs in the upper five bits for every i."""
LOWEST_BIT = np.zeros(VECTOR, dtype=np.uint8)
LOWEST_BIT[[(DE_BRUIJN << i & 0xFFFF_FFFF) >> 27 for i in range(VECTOR)]] = np.arange(VECTOR)
"""Upper five bits of that product → i."""


@jit
def count_events(words: NDArray[np.uint32]) -> int:
    """Number of valid bits in ON and OFF words."""
    count = 0
    for i in range(0, words.size, 2):
        if (np.int64(words[i]) >> 28) <= 1:
            bits = np.int64(words[i + 1])
            while bits:
                bits &= bits - 1
                count += 1
    return count


@jit
def decode_words(
    words: NDArray[np.uint32], state: NDArray[np.int64], columns: tuple[NDArray[Any], ...]
) -> int:
    """Fill columns x, y, t, p; returns the number of events."""
    x, y, t, p = columns
    # Negative until there is a TIME_HIGH.
    base = ((state[0] << HIGH_BITS) | state[1]) << 6
    count = 0
    for i in range(0, words.size, 2):
        upper = np.int64(words[i])
        kind = upper >> 28
        if kind <= 1 and base >= 0:
            bits = np.int64(words[i + 1])
            time = base + ((upper >> 22) & 0x3F)
            column = (upper >> 11) & 0x7FF
            while bits:
                # Without a loop over the bits that are not set, which costs more than all else.
                lowest = bits & -bits
                bits ^= lowest
                x[count] = column + LOWEST_BIT[(lowest * DE_BRUIJN & 0xFFFF_FFFF) >> 27]
                y[count] = upper & 0x7FF
                t[count] = time
                p[count] = kind
                count += 1
        elif kind == TIME_HIGH:
            follow(state, upper & 0xFFF_FFFF, HIGH_BITS)
            base = ((state[0] << HIGH_BITS) | state[1]) << 6
    return count
