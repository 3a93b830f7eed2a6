"""Events of an interval into the order of a packet, compiled: sorting by counting.

An event is one 64-bit key: from the highest bits down its time since the start of the interval, its
pixel, p and label, so that the order of the keys is the order of a packet. A stable counting sort
by digits, lowest first (radix sort), sorts them. Most models give their events by pixel, p and
label; then only the digits of the time are left, and an interval of few µs is a single digit.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import read_only, take_scratch
from texvent.simulation.packets import SortedEvents, UnsortedEvents

Uint64Array = NDArray[np.uint64]

# Numba turns a sum of uint64 and int64 into a float, so every constant is uint64.
_1, _2, _NEXT = np.uint64(1), np.uint64(2), np.uint32(1)
MOST_KEY_BITS = 64
FEWEST_BITS, MOST_BITS = 8, 13
"""Bits of a digit; 2¹³ counters of 32 bits fit the first cache. One digit of many bits beats two
of half as many where there are about as many events as counters."""
KEY_USES = ("keys", "sorted keys")
"""Parts of `scratch`: what is sorted, and room to sort it."""


def sort_events(
    events: UnsortedEvents, span_us: tuple[int, int], shape: tuple[int, int]
) -> SortedEvents:
    """Events in the order of a packet: by (t, y, x, p), then labels.

    Args:
        events: events of one interval, in any order.
        span_us: start (included) and stop (excluded) of the interval, µs.
        shape: (height, width) of the sensor.

    Raises:
        InputError: the interval is too long for a sensor of this size.
    """
    duration_us = span_us[1] - span_us[0]
    low = key_bits(duration_us, shape)
    bits = low + duration_us.bit_length()
    keys, spare = (take_scratch(use, len(events.t), np.uint64) for use in KEY_USES)
    given = UnsortedEvents(*(read_only(column) for column in events))
    return SortedEvents(*_sort_events(given, (keys, spare), span_us[0], shape[1], (low, bits)))


def key_bits(duration_us: int, shape: tuple[int, int]) -> int:
    """Bits of a key below its time: those of the pixel, and one each for p and label.

    Raises:
        InputError: the time and the pixel of an event do not fit a key together.
    """
    low = (shape[0] * shape[1] - 1).bit_length() + 2
    if low + duration_us.bit_length() > MOST_KEY_BITS:
        longest_s = 2 ** (MOST_KEY_BITS - low) // 1_000_000
        raise InputError(
            f"two frames are {duration_us / 1e6:.6g} s apart; with {shape[1]}x{shape[0]} pixels "
            f"at most {longest_s} s are possible: cut the video where it pauses"
        )
    return low


def sort_keyed_events(
    keys: Uint64Array, span_us: tuple[int, int], shape: tuple[int, int]
) -> SortedEvents:
    """As `sort_events`, of events that are keys already.

    Args:
        keys: [n] by pixel; used as scratch.
        span_us: start (included) and stop (excluded) of the interval, µs.
        shape: (height, width) of the sensor.
    """
    duration_us = span_us[1] - span_us[0]
    low = key_bits(duration_us, shape)
    bits = low + duration_us.bit_length()
    spare = take_scratch(KEY_USES[1], keys.size, np.uint64)
    return SortedEvents(*_sort_keyed_events(keys, spare, span_us[0], (shape[1], low, bits)))


@jit
def _sort_events(
    events: UnsortedEvents,
    scratch: tuple[Uint64Array, Uint64Array],
    start_us: int,
    width: int,
    key_size: tuple[int, int],
) -> Any:
    (pixel, t, p, label), (keys, spare), (low, bits) = events, scratch, key_size
    mask, last, steps_back = (_1 << np.uint64(low)) - _1, np.uint64(0), np.int64(0)
    for i in range(pixel.size):
        key = np.uint64(pixel[i]) << _2 | np.uint64(p[i]) << _1 | np.uint64(label[i])
        steps_back += key < last
        last = key
        keys[i] = np.uint64(t[i] - start_us) << np.uint64(low) | key & mask
    keys = sort_keys(keys, spare, 0 if steps_back else low, bits)
    return unpack_keys(keys, start_us, width, low)


@jit
def _sort_keyed_events(
    keys: Uint64Array, spare: Uint64Array, start_us: int, layout: tuple[int, int, int]
) -> Any:
    width, low, bits = layout
    keys = sort_keys(keys, spare, low, bits)
    # Events of one pixel and microsecond may still be in another order than that of p and label.
    steps_back = 0
    for i in range(1, keys.size):
        steps_back += keys[i] < keys[i - 1]
    if steps_back:
        sort_almost_sorted(keys)
    return unpack_keys(keys, start_us, width, low)


@jit
def sort_almost_sorted(keys: Uint64Array) -> None:
    """Sort keys of which none is far from its place, by insertion."""
    for i in range(1, keys.size):
        j, key = i, keys[i]
        while j > 0 and keys[j - 1] > key:
            keys[j] = keys[j - 1]
            j -= 1
        keys[j] = key


@jit
def sort_keys(keys: Uint64Array, spare: Uint64Array, first: int, bits: int) -> Uint64Array:
    """Keys in ascending order of their bits `first`..`bits`; equal ones stay in order.

    Args:
        keys: [n]; overwritten.
        spare: [n] scratch.
        first: bits below it are sorted already, or do not matter.
        bits: how many bits a key has.

    Returns:
        [n], `keys` or `spare`.
    """
    widest = FEWEST_BITS
    while widest < MOST_BITS and 1 << widest < keys.size:
        widest += 1
    digits = -(-(bits - first) // widest)
    while digits > 0:
        width = -(-(bits - first) // digits)
        _sort_by_digit(keys, spare, first, width)
        keys, spare = spare, keys
        first += width
        digits -= 1
    return keys


@jit
def _sort_by_digit(keys: Uint64Array, target: Uint64Array, first: int, width: int) -> None:
    shift, mask = np.uint64(first), np.uint64((1 << width) - 1)
    place = np.zeros(1 << width, np.uint32)
    for i in range(keys.size):
        place[keys[i] >> shift & mask] += 1
    count_to_start(place)
    for i in range(keys.size):
        key = keys[i]
        digit = key >> shift & mask
        # Read once: whatever is written might be one of the counters, for all the compiler knows.
        at = place[digit]
        place[digit] = at + _NEXT
        target[at] = key


@jit
def merge_keys(one: Uint64Array, other: Uint64Array, low: int) -> Uint64Array:
    """Two lists of keys by pixel as one; those of `one` come first at each pixel.

    Args:
        one: [n] by pixel.
        other: [m] by pixel.
        low: how many bits there are below the time.
    """
    keys, waiting = np.empty(one.size + other.size, np.uint64), 0
    mask = (_1 << np.uint64(low)) - _1
    for i in range(one.size):
        pixel = (one[i] & mask) >> _2
        while waiting < other.size and (other[waiting] & mask) >> _2 < pixel:
            keys[i + waiting] = other[waiting]
            waiting += 1
        keys[i + waiting] = one[i]
    keys[one.size + waiting :] = other[waiting:]
    return keys


@jit
def count_to_start(place: NDArray[np.uint32]) -> None:
    """Turn how many there are of each into where each begins, in place."""
    start = 0
    for digit in range(place.size):
        count = place[digit]
        place[digit] = start
        start += count


@jit
def unpack_keys(keys: Uint64Array, start_us: int, width: int, low: int) -> Any:
    """Columns x, y, t, p, label of sorted keys.

    Args:
        keys: [n].
        start_us: start of the interval, µs.
        width: of the sensor, pixels.
        low: how many bits there are below the time.
    """
    n = keys.size
    # One piece of memory, which the system, unlike five, does not take back between packets.
    block = np.empty(14 * n, np.uint8)
    t = block[: 8 * n].view(np.int64)
    x, y = block[8 * n : 10 * n].view(np.uint16), block[10 * n : 12 * n].view(np.uint16)
    p, label = block[12 * n : 13 * n], block[13 * n :]
    mask, inverse = (_1 << np.uint64(low)) - _1, 1.0 / width
    for i in range(n):
        key = keys[i]
        t[i] = start_us + np.int64(key >> np.uint64(low))
        pixel = np.int64((key & mask) >> _2)
        # Half a pixel off the row's start, so that rounding of the product cannot miss the row.
        row = np.int64((np.float64(pixel) + 0.5) * inverse)
        y[i], x[i] = row, pixel - row * width
        p[i], label[i] = key >> _1 & _1, key & _1
    return x, y, t, p, label
