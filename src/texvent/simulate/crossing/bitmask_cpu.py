"""Which pixels may fire: the scans over frames, compiled.

A scan asks first, of each run of 64 pixels, whether any of them may fire: some vector instructions
for all 64, as fast as memory. Runs where none may, nearly all where little moves, are then left
alone. Of each of the others a second look makes a word with a bit per pixel, and whoever wants the
pixels takes the bits one by one: no branch is taken per pixel, and only one per run that cannot be
foreseen.

Arrays are passed whole, and never in tuples, to functions without branches: where Numba has to
count references to an array, that costs as much as looking at a run.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulate.texvent.kernels.scan import Intensity, Levels

ByteArray = NDArray[np.uint8]
Int64Array = NDArray[np.int64]

RUN = 64
"""Pixels that are skipped together: the bits of a word."""
LARGEST_FLOAT = np.finfo(np.float32).max.view(np.uint32)
"""Bits of the largest float32."""
FEW = 6
"""Up to so many candidates of a run are looked up one by one; of more, trigger levels first leave
out those that cannot fire, as in moving texture most cannot."""

# Numba turns a sum of uint64 and int64 into a float, so every constant is uint64. Pixels of a run
# are counted in uint64 too: a number that cannot be negative needs no check for counting from the
# end, and a loop without that check becomes vector instructions.
_0, _8, _56, _58 = (np.uint64(number) for number in (0, 8, 56, 58))
_RUN = np.uint64(RUN)
_GATHER = np.uint64(sum(1 << (56 - 7 * byte) for byte in range(8)))
"""A word of eight bytes that are 0 or 1, times this, has them as bits in its highest byte."""
_DE_BRUIJN = np.uint64(0x03F79D71B4CB0A89)
"""Its 64 runs of six bits are all different, so that a shift is known by the highest six."""
_BIT_NUMBER = np.empty(64, np.uint8)
_BIT_NUMBER[[int(_DE_BRUIJN) << bit >> 58 & 63 for bit in range(64)]] = np.arange(64)


@jit
def largest_word(words: NDArray[np.uint32]) -> np.uint32:
    """The bits of floats as integers, whose order is theirs: 0, ..., infinity, NaN, negative."""
    largest = np.uint32(0)
    # By number: a loop over the array itself does not become vector instructions.
    for i in range(words.size):
        largest = max(largest, words[i])
    return largest


class Marks(NamedTuple):
    """Pixels that may fire."""

    run: Int64Array
    """[m] numbers of runs, ascending."""
    bits: NDArray[np.uint64]
    """[m] which of their pixels: bit i for the i-th."""


@jit
def mark_bytes(frame: ByteArray, reference: ByteArray, levels: Levels) -> Marks:
    """Mark pixels whose bytes differ by `levels.least` or more.

    Where many of a run do, only those at or beyond their trigger levels.
    """
    is_marked, least = make_flags(frame.size), levels.least
    for number in range(frame.size // RUN):
        first, is_any = number * RUN, np.uint8(0)
        for i in range(first, first + RUN):
            is_any |= _differs(frame[i], reference[i], least)
        is_marked[number] = is_any
    run = list_marked(is_marked)
    bits, word = np.empty(run.size, np.uint64), np.empty(RUN // 8, np.uint64)
    mark = word.view(np.uint8)
    for k in range(run.size):
        if (run[k] + 1) * RUN > frame.size:
            bits[k] = _bits_of_rest(frame, reference, levels)
            continue
        first_pixel = np.uint64(run[k]) * _RUN
        if _mark_bytes(frame, reference, first_pixel, least, mark) > FEW:
            _mark_levels(frame, reference, first_pixel, levels, mark)
        bits[k] = as_bits(word)
    return Marks(run, bits)


@jit
def mark_levels(frame: Intensity, reference: Intensity, levels: Levels) -> Marks:
    """Mark pixels at or beyond their trigger levels."""
    is_marked = make_flags(frame.size)
    for number in range(frame.size // RUN):
        first, is_any = number * RUN, np.uint8(0)
        for i in range(first, first + RUN):
            is_any |= _is_beyond(frame[i], reference[i], levels)
        is_marked[number] = is_any
    run = list_marked(is_marked)
    bits, word = np.empty(run.size, np.uint64), np.empty(RUN // 8, np.uint64)
    mark = word.view(np.uint8)
    for k in range(run.size):
        if (run[k] + 1) * RUN > frame.size:
            bits[k] = _bits_of_rest(frame, reference, levels)
            continue
        _mark_levels(frame, reference, np.uint64(run[k]) * _RUN, levels, mark)
        bits[k] = as_bits(word)
    return Marks(run, bits)


@jit(inline="always")
def number_of(bit: np.uint64) -> Any:
    """Which bit of a word is set, of a word in which one is."""
    return _BIT_NUMBER[bit * _DE_BRUIJN >> _58]


@jit(inline="always")
def _differs(intensity: Any, reference: Any, least: np.uint8) -> Any:
    larger, smaller = max(intensity, reference), min(intensity, reference)
    return np.uint8(np.uint8(larger - smaller) >= least)


@jit(inline="always")
def _is_beyond(intensity: Any, reference: Any, levels: Levels) -> Any:
    value, level = np.float32(intensity), np.float32(reference)
    is_on = value >= level * levels.up + levels.up_offset
    return np.uint8(is_on | (value <= level * levels.down + levels.down_offset))


@jit
def _mark_bytes(
    frame: ByteArray, reference: ByteArray, first: np.uint64, least: np.uint8, mark: ByteArray
) -> np.uint8:
    """Mark the pixels of a run that differ; how many do."""
    count = np.uint8(0)
    for i in range(_RUN):
        is_other = _differs(frame[first + i], reference[first + i], least)
        mark[i] = is_other
        count = np.uint8(count + is_other)
    return count


@jit
def _mark_levels(
    frame: Intensity, reference: Intensity, first: np.uint64, levels: Levels, mark: ByteArray
) -> None:
    for i in range(_RUN):
        mark[i] = _is_beyond(frame[first + i], reference[first + i], levels)


@jit
def make_flags(pixels: int) -> ByteArray:
    """Room for a flag per run; that of a last one that is not whole is set."""
    return np.ones(-(-pixels // RUN), np.uint8)


@jit
def list_marked(is_marked: ByteArray) -> Int64Array:
    """The numbers of the flags that are set."""
    run, found = np.empty(is_marked.sum() + 1, np.int64), 0
    for number in range(is_marked.size):
        # Written always, kept if marked: without a branch that cannot be foreseen.
        run[found] = number
        found += int(is_marked[number])
    return run[:found]


@jit
def as_bits(word: NDArray[np.uint64]) -> np.uint64:
    """One bit for each of eight words of eight bytes that are 0 or 1."""
    bits = _0
    for number in range(np.uint64(RUN // 8)):
        bits |= (word[number] * _GATHER >> _56) << number * _8
    return bits


@jit
def _bits_of_rest(frame: Intensity, reference: Intensity, levels: Levels) -> np.uint64:
    """Which pixels after the last whole run are at or beyond their trigger levels."""
    bits, first = _0, frame.size // RUN * RUN
    for i in range(first, frame.size):
        bits |= np.uint64(_is_beyond(frame[i], reference[i], levels)) << np.uint64(i - first)
    return bits
