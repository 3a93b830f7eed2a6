"""EVT3 words ↔ events: words of 16 bits, little-endian, each coding only a change.

    bits 15..12   type; value in bits 11..0
     0 ADDR_Y       row of the events that follow, bits 10..0
     2 ADDR_X       one event: polarity bit 11, column bits 10..0
     3 VECT_BASE_X  polarity and column of the next vector word
     4 VECT_12      bit i set: an event at base + i; then base += 12
     5 VECT_8       the same with 8 bits
     6 TIME_LOW     low 12 bits of t (µs)
     8 TIME_HIGH    next 12 bits of t; a new value sets the low bits to 0
     1              row of events of another kind, skipped until the next ADDR_Y
     others         triggers and continuations, skipped

Coordinates below 2048. The counter wraps every 2^24 µs (16.78 s). texvent writes the last and the
first value of every turn that a silence spans, so long silences survive. Times below 2^42 µs (51
days): beyond, that padding would pass 1 MB.

Every event is written as ADDR_X: OpenEB loses events in vector words that do not come as
12 + 12 + 8. A new time repeats the row, as the cameras do.

Source: Prophesee, "EVT 3.0 Format".
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.io.prophesee.time_high import FIRST_STATE, follow
from texvent.runtime.jit import jit

WORD = "<u2"
START = (0x8000,)
"""TIME_HIGH 0: see `texvent.io.prophesee.evt`."""
DECODER_STATE = (*FIRST_STATE, 0, -1, 0, 0)
"""The high half of the time, and its low half; row (−1: none); first column and polarity of the
next vector word."""
ENCODER_STATE = (0, 0, -1, -1)
"""Turns and high of the time; row (−1: to be written); time of the last event, µs (−1: none)."""
ADDR_Y, OTHER_Y, ADDR_X, VECT_BASE_X, VECT_12, VECT_8, TIME_LOW, TIME_HIGH = 0, 1, 2, 3, 4, 5, 6, 8
HIGH_BITS = 12


def count_words(times: NDArray[np.int64], state: NDArray[np.int64]) -> int:
    """Room for the words of these events: TIME_HIGH, TIME_LOW, y, x, and two for each wrap."""
    if len(times) == 0:
        return 0
    return 4 * len(times) + 2 * ((int(times[-1]) >> 24) - int(state[0]))


@jit
def count_events(words: NDArray[np.uint16]) -> int:
    """Number of single events and valid bits."""
    count = 0
    for i in range(words.size):
        word = np.int64(words[i])
        kind = word >> 12
        if kind == ADDR_X:
            count += 1
        elif kind in (VECT_12, VECT_8):
            bits = word & _vector_mask(kind)
            while bits:
                bits &= bits - 1
                count += 1
    return count


@jit
def decode_words(
    words: NDArray[np.uint16], state: NDArray[np.int64], columns: tuple[NDArray[Any], ...]
) -> int:
    """Fill columns x, y, t, p; returns the number of events."""
    x, y, t, p = columns
    row, base, sign = state[5], state[6], state[7]
    # Negative until there is a TIME_HIGH.
    time = (((state[0] << 12) | state[1]) << 12) | state[4]
    count = 0
    for i in range(words.size):
        word = np.int64(words[i])
        kind, value = word >> 12, word & 0xFFF
        if kind == ADDR_X:
            if time >= 0 and row >= 0:
                x[count], y[count], t[count], p[count] = value & 0x7FF, row, time, value >> 11
                count += 1
        elif kind in (TIME_LOW, TIME_HIGH):
            time = _next_time(state, kind, value)
        elif kind in (ADDR_Y, OTHER_Y):
            row = value & 0x7FF if kind == ADDR_Y else np.int64(-1)
        elif kind == VECT_BASE_X:
            base, sign = value & 0x7FF, value >> 11
        elif kind in (VECT_12, VECT_8):
            bits = value & _vector_mask(kind) if time >= 0 and row >= 0 else np.int64(0)
            column = base
            while bits:
                if bits & 1:
                    x[count], y[count], t[count], p[count] = column, row, time, sign
                    count += 1
                bits >>= 1
                column += 1
            base += 12 if kind == VECT_12 else 8
    state[5], state[6], state[7] = row, base, sign
    return count


@jit
def encode_events(
    columns: tuple[NDArray[Any], ...], state: NDArray[np.int64], words: NDArray[np.uint16]
) -> int:
    """Fill words from columns x, y, t, p; returns their number."""
    x, y, t, p = columns
    turns, high, row, last = state[0], state[1], state[2], state[3]
    count = 0
    for i in range(t.size):
        time = np.int64(t[i])
        if time != last:
            # One turn of the counter after the other, each with its last and its first value.
            while turns < time >> 24:
                words[count] = (TIME_HIGH << 12) | 0xFFF
                words[count + 1] = TIME_HIGH << 12
                count += 2
                turns += 1
                high = np.int64(0)
            if (time >> 12) & 0xFFF != high:
                high = (time >> 12) & 0xFFF
                words[count] = (TIME_HIGH << 12) | high
                count += 1
            words[count] = (TIME_LOW << 12) | (time & 0xFFF)
            count += 1
            last = time
            row = np.int64(-1)
        if y[i] != row:
            row = np.int64(y[i])
            words[count] = (ADDR_Y << 12) | row
            count += 1
        words[count] = (ADDR_X << 12) | (np.int64(p[i]) << 11) | np.int64(x[i])
        count += 1
    state[0], state[1], state[2], state[3] = turns, high, row, last
    return count


@jit(inline="always")
def _vector_mask(kind: np.int64) -> int:
    return 0xFFF if kind == VECT_12 else 0xFF


@jit
def _next_time(state: NDArray[np.int64], kind: np.int64, value: np.int64) -> np.int64:
    """Time after a word TIME_LOW or TIME_HIGH, µs."""
    if kind == TIME_LOW:
        state[4] = value
    elif value != state[1]:
        follow(state, value, HIGH_BITS)
        # Until its low half follows, a new high half means its first µs.
        state[4] = 0
    time: np.int64 = (((state[0] << 12) | state[1]) << 12) | state[4]
    return time
