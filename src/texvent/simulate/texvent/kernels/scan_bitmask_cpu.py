"""Which pixels of a frame are at or beyond their trigger levels, compiled; see `bitmask_cpu`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulate.crossing.bitmask_cpu import (
    RUN,
    ByteArray,
    MarkedRuns,
    as_bits,
    list_marked_runs,
    make_flags,
)
from texvent.simulate.texvent.kernels.scan import Intensity, ScanLevels
from texvent.video import HIGHEST_INTENSITY

LARGEST_FLOAT = np.float32(HIGHEST_INTENSITY).view(np.uint32)
"""Bits of the largest float that a frame may hold."""
FEW = 6
"""Up to so many candidates of a run are looked up one by one; of more, trigger levels first leave
out those that cannot fire, as in moving texture most cannot."""
_0, _RUN, _BYTE = np.uint64(0), np.uint64(RUN), np.dtype(np.uint8)


@jit
def mark_pixels(frame: Intensity, reference: Intensity, levels: ScanLevels) -> MarkedRuns:
    """Mark pixels at or beyond their trigger levels, and other bytes that differ enough.

    Bytes are marked that differ by `levels.least` or more, as long as they are few of a run.
    """
    is_marked, is_bytes = make_flags(frame.size), frame.dtype == _BYTE
    for number in range(frame.size // RUN):
        first, is_any = number * RUN, np.uint8(0)
        for i in range(first, first + RUN):
            # The type is known when this is compiled, so there is no branch.
            if is_bytes:
                is_any |= _differs(frame[i], reference[i], levels.least)
            else:
                is_any |= _is_beyond(frame[i], reference[i], levels)
        is_marked[number] = is_any
    run = list_marked_runs(is_marked)
    bits, word = np.empty(run.size, np.uint64), np.empty(RUN // 8, np.uint64)
    mark = word.view(np.uint8)
    for k in range(run.size):
        if (run[k] + 1) * RUN > frame.size:
            bits[k] = _bits_of_rest(frame, reference, levels)
            continue
        first_pixel = np.uint64(run[k]) * _RUN
        if not is_bytes or _mark_bytes(frame, reference, first_pixel, levels.least, mark) > FEW:
            _mark_levels(frame, reference, first_pixel, levels, mark)
        bits[k] = as_bits(word)
    return MarkedRuns(run, bits)


@jit(inline="always")
def _differs(intensity: Any, reference: Any, least: np.uint8) -> Any:
    larger, smaller = max(intensity, reference), min(intensity, reference)
    return np.uint8(np.uint8(larger - smaller) >= least)


@jit(inline="always")
def _is_beyond(intensity: Any, reference: Any, levels: ScanLevels) -> Any:
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
    frame: Intensity, reference: Intensity, first: np.uint64, levels: ScanLevels, mark: ByteArray
) -> None:
    for i in range(_RUN):
        mark[i] = _is_beyond(frame[first + i], reference[first + i], levels)


@jit
def _bits_of_rest(frame: Intensity, reference: Intensity, levels: ScanLevels) -> np.uint64:
    """Which pixels after the last whole run are at or beyond their trigger levels."""
    bits, first = _0, frame.size // RUN * RUN
    for i in range(first, frame.size):
        bits |= np.uint64(_is_beyond(frame[i], reference[i], levels)) << np.uint64(i - first)
    return bits


@jit
def largest_word(words: NDArray[np.uint32]) -> np.uint32:
    """The bits of floats as integers, whose order is theirs: 0, ..., infinity, NaN, negative."""
    largest = np.uint32(0)
    # By number: a loop over the array itself does not become vector instructions.
    for i in range(words.size):
        largest = max(largest, words[i])
    return largest
