"""Events of the bodies of ECF chunks; the layout is described in `prophesee_ecf.py`.

Decoders return how many bytes they used, or −1 where the body is damaged. They never read beyond
the body nor write beyond the columns, whatever the bytes say.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit

Bytes = NDArray[np.uint8]
DAMAGED = -1
EXTENSION = 15
"""High nibble of a byte that carries four bits of a long time step."""
MAX_STEP_NIBBLES = 16
STOP_US = 1 << 62
"""Exclusive limit of times: with a step more they would leave 64 bits."""
MASK_BITS = 5
GROUP = 4


@jit
def decode_times(body: Bytes, origin: int, t: NDArray[np.int64]) -> int:
    """Fill all times from the runs at the start of `body`."""
    time = np.int64(origin)
    at = 0
    i = 0
    while i < t.size:
        step, nibbles = np.int64(0), 0
        while at < body.size and body[at] >> 4 == EXTENSION and nibbles < MAX_STEP_NIBBLES:
            step |= np.int64(body[at] & 0xF) << (4 * nibbles)
            nibbles += 1
            at += 1
        if at >= body.size or body[at] >> 4 == EXTENSION or not 0 <= step < STOP_US:
            return DAMAGED
        time += step + np.int64(body[at] >> 4)
        if time >= STOP_US:
            return DAMAGED
        at, run = _read_run(body, at, np.int64(body[at] & 0xF), EXTENSION)
        if run < 0 or run > t.size - i:
            return DAMAGED
        t[i : i + run] = time
        i += int(run)
    return at


@jit
def decode_polarities(body: Bytes, p: NDArray[np.uint8]) -> int:
    """Fill all polarities from the runs at the start of `body`."""
    at = 0
    i = 0
    while i < p.size:
        if at >= body.size:
            return DAMAGED
        sign = body[at] >> 7
        at, run = _read_run(body, at, np.int64(body[at] & 0x7F), 0x7F)
        if run < 0 or run > p.size - i:
            return DAMAGED
        p[i : i + run] = sign
        i += int(run)
    return at


@jit
def decode_rows(body: Bytes, y: NDArray[np.uint16]) -> int:
    """Fill all rows from the runs at the start of `body`."""
    at = 0
    i = 0
    while i < y.size:
        if at + 2 > body.size:
            return DAMAGED
        word = _read_u16(body, at)
        run = word & 0x1F
        at += 2
        if run == 0x1F:
            if at + 2 > body.size:
                return DAMAGED
            run = _read_u16(body, at)
            at += 2
        if run > y.size - i:
            return DAMAGED
        y[i : i + run] = word >> 5
        i += int(run)
    return at


@jit
def decode_masked(body: Bytes, x: NDArray[np.uint16]) -> int:
    """Fill all columns from words of a column and which of the next five follow it."""
    at = 0
    i = 0
    while i < x.size:
        if at + 2 > body.size:
            return DAMAGED
        word = _read_u16(body, at)
        at += 2
        x[i] = word >> 5
        i += 1
        for j in range(MASK_BITS):
            # Prophesee's encoder may set bits beyond the last event.
            if (word >> (MASK_BITS - 1 - j)) & 1 and i < x.size:
                x[i] = (word >> 5) + j + 1
                i += 1
    return at


@jit
def decode_pairs(body: Bytes, columns: tuple[NDArray[Any], ...]) -> int:
    """Fill columns and polarities of 12 bits per event, in groups of four."""
    x, p = columns
    end = (x.size + GROUP - 1) // GROUP * 6
    if end > body.size:
        return DAMAGED
    for i in range(x.size):
        at = i // GROUP * 6
        first, second, third = (
            _read_u16(body, at),
            _read_u16(body, at + 2),
            _read_u16(body, at + 4),
        )
        place = i % GROUP
        if place == 0:
            value = first >> 4
        elif place == 1:
            value = (first & 0xF) | ((second >> 8) << 4)
        elif place == 2:
            value = (second & 0xFF) | ((third >> 12) << 8)
        else:
            value = third & 0xFFF
        x[i] = value >> 1
        p[i] = value & 1
    return end


@jit
def decode_packed(body: Bytes, columns: tuple[NDArray[Any], ...]) -> int:
    """Fill x, y, p of 24 bits per event, in groups of four."""
    x, y, p = columns
    end = (x.size + GROUP - 1) // GROUP * 12
    if end > body.size:
        return DAMAGED
    for i in range(x.size):
        # Bytes of three little-endian words, put in order of the 24-bit values they share.
        at = i // GROUP * 12
        place = i % GROUP
        if place == 0:
            low, middle, high = at + 1, at + 2, at + 3
        elif place == 1:
            low, middle, high = at, at + 6, at + 7
        elif place == 2:
            low, middle, high = at + 4, at + 5, at + 11
        else:
            low, middle, high = at + 8, at + 9, at + 10
        value = np.int64(body[low]) | (np.int64(body[middle]) << 8) | (np.int64(body[high]) << 16)
        x[i] = (value >> 1) & 0x7FF
        y[i] = (value >> 12) & 0x7FF
        p[i] = value & 1
    return end


@jit
def _read_run(body: Bytes, at: int, run: np.int64, long_run: int) -> tuple[int, np.int64]:
    """End of the run's bytes, and its length (−1: damaged); 16 bits follow a long run."""
    if run != long_run:
        return at + 1, run
    if at + 3 > body.size:
        return at, np.int64(-1)
    return at + 3, _read_u16(body, at + 1)


@jit
def _read_u16(body: Bytes, at: int) -> np.int64:
    return np.int64(body[at]) | (np.int64(body[at + 1]) << 8)
