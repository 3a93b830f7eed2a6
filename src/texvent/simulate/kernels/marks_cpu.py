"""Which pixels may fire: the scans over tiles of a frame, compiled.

A scan notes in a byte per pixel whether it may fire, and how many do in each run of 64 pixels; both
loops become vector instructions. Runs without a candidate, nearly all where little moves, are then
left alone.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.texvent import NOISE_BLOCK, Intensity, Levels

ByteArray = NDArray[np.uint8]
Int64Array = NDArray[np.int64]

TILE = NOISE_BLOCK
"""Pixels scanned at a time: what belongs to them stays in the nearest cache."""
RUN = 64
"""Pixels that are skipped together."""
LARGEST_FLOAT = np.finfo(np.float32).max.view(np.uint32)
"""Bits of the largest float32."""
FEW = 6
"""Up to so many candidates of a run are looked up one by one; with more, all its pixels are."""

# Numba turns a sum of uint64 and int64 into a float, so every constant is uint64.
_0, _1, _61 = (np.uint64(number) for number in (0, 1, 61))
_BYTE_NUMBER = np.uint64(sum(byte << (61 - 8 * byte) for byte in range(8)))
"""A word of which one byte is 1, times this, has that byte's number in its top three bits."""


class Pictures(NamedTuple):
    """One tile of every array as large as a frame, or the whole arrays."""

    frame: Intensity
    reference: Intensity
    renewed: Intensity
    """[0] unless all references are renewed."""
    previous: Intensity
    """[0] unless events need it."""


class Marks(NamedTuple):
    """Where a tile may fire."""

    pixel: ByteArray
    """[TILE] 1 where a pixel may fire, else 0."""
    run: ByteArray
    """[TILE / RUN] how many of a run may."""


@numba.njit(cache=True, nogil=True)
def make_marks() -> Marks:
    """Room for the marks of a tile."""
    return Marks(np.empty(TILE, np.uint8), np.empty(TILE // RUN, np.uint8))


@numba.njit(cache=True, nogil=True)
def cut(pictures: Pictures, first: int) -> Pictures:
    """The tile that begins at pixel `first`."""
    last = first + TILE
    return Pictures(
        pictures.frame[first:last],
        pictures.reference[first:last],
        pictures.renewed[first:last],
        pictures.previous[first:last],
    )


@numba.njit(cache=True, nogil=True)
def largest_word(words: NDArray[np.uint32]) -> np.uint32:
    """The bits of floats as integers, whose order is theirs: 0, ..., infinity, NaN, negative."""
    largest = np.uint32(0)
    # By number: a loop over the array itself does not become vector instructions.
    for i in range(words.size):
        largest = max(largest, words[i])
    return largest


@numba.njit(cache=True, nogil=True)
def mark_bytes(frame: ByteArray, reference: ByteArray, least: np.uint8, marks: Marks) -> None:
    """Mark pixels that differ from their reference by `least` or more."""
    whole = frame.size // RUN
    for run in range(whole):
        first, marked = run * RUN, np.uint8(0)
        for i in range(first, first + RUN):
            larger, smaller = max(frame[i], reference[i]), min(frame[i], reference[i])
            mark = np.uint8(np.uint8(larger - smaller) >= least)
            marks.pixel[i] = mark
            marked += mark
        marks.run[run] = marked
    _clear(marks, whole)
    for i in range(whole * RUN, frame.size):
        larger, smaller = max(frame[i], reference[i]), min(frame[i], reference[i])
        marks.pixel[i] = np.uint8(larger - smaller) >= least
        marks.run[whole] += marks.pixel[i]


@numba.njit(cache=True, nogil=True)
def mark_again(tile: Pictures, levels: Levels, marks: Marks) -> None:
    """Mark by trigger levels where many bytes differ, as in moving texture: most do not fire."""
    frame, reference, most = tile.frame, tile.reference, np.uint8(0)
    for run in range(marks.run.size):
        most = max(most, marks.run[run])
    if most <= FEW:
        return
    for run in range(frame.size // RUN):
        if marks.run[run] > FEW:
            first, marked = run * RUN, np.uint8(0)
            for i in range(first, first + RUN):
                mark = np.uint8(_is_beyond(frame[i], reference[i], levels))
                marks.pixel[i] = mark
                marked += mark
            marks.run[run] = marked


@numba.njit(cache=True, nogil=True)
def mark_levels(tile: Pictures, levels: Levels, marks: Marks) -> None:
    """Mark pixels at or beyond their trigger levels."""
    frame, reference, whole = tile.frame, tile.reference, tile.frame.size // RUN
    for run in range(whole):
        first, marked = run * RUN, np.uint8(0)
        for i in range(first, first + RUN):
            mark = np.uint8(_is_beyond(frame[i], reference[i], levels))
            marks.pixel[i] = mark
            marked += mark
        marks.run[run] = marked
    _clear(marks, whole)
    for i in range(whole * RUN, frame.size):
        marks.pixel[i] = _is_beyond(frame[i], reference[i], levels)
        marks.run[whole] += marks.pixel[i]


@numba.njit(cache=True, nogil=True, inline="always")
def _is_beyond(intensity: Any, reference: Any, levels: Levels) -> Any:
    value, level = np.float32(intensity), np.float32(reference)
    is_on = value >= level * levels.up + levels.up_offset
    return is_on | (value <= level * levels.down + levels.down_offset)


@numba.njit(cache=True, nogil=True)
def _clear(marks: Marks, whole: int) -> None:
    """Mark nothing in the runs that are not whole."""
    marks.pixel[whole * RUN :] = 0
    marks.run[whole:] = 0


@numba.njit(cache=True, nogil=True)
def list_marks(marks: Marks, place: Int64Array) -> int:
    """List the marked pixels of a tile in ascending order; how many there are."""
    words, found = marks.pixel.view(np.uint64), 0
    for run in range(marks.run.size):
        if marks.run[run] == 0:
            continue
        if marks.run[run] <= FEW:
            for number in range(run * (RUN // 8), (run + 1) * (RUN // 8)):
                word = words[number]
                while word != _0:
                    lowest = word & (~word + _1)
                    place[found] = number * 8 + np.int64(lowest * _BYTE_NUMBER >> _61)
                    found += 1
                    word ^= lowest
        else:
            of_run = marks.pixel[run * RUN : (run + 1) * RUN]
            for i in range(of_run.size):
                # Written always, kept if marked: without a branch that cannot be foreseen.
                place[found] = run * RUN + i
                found += int(of_run[i])
    return found
