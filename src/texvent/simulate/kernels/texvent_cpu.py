"""Trigger levels compiled by Numba: one pass over the frame, close work only at candidates.

The frame is scanned in tiles of `NOISE_BLOCK` pixels, which stay in the nearest cache. A scan notes
in a byte per pixel whether it may fire, and how many do in each run of 64 pixels; both loops become
vector instructions. Runs without a candidate, nearly all where little moves, are then left alone.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels import texvent_numpy
from texvent.simulate.kernels.cpu_draws import allow_wrap_around
from texvent.simulate.kernels.order import read_only
from texvent.simulate.kernels.texvent import (
    NOISE_BLOCK,
    Fired,
    FireRule,
    Float64Array,
    Intensity,
    Levels,
    Memory,
)

ByteArray = NDArray[np.uint8]
Int64Array = NDArray[np.int64]
Uint64Array = NDArray[np.uint64]

RUN = 64
"""Pixels that are skipped together."""
FEW = 6
"""Up to so many candidates of a run are looked up one by one; with more, all its pixels are."""

# Numba turns a sum of uint64 and int64 into a float, so every constant is uint64.
_0, _1, _61 = (np.uint64(number) for number in (0, 1, 61))
_BYTE_NUMBER = np.uint64(sum(byte << (61 - 8 * byte) for byte in range(8)))
"""A word of which one byte is 1, times this, has that byte's number in its top three bits."""


class _Pictures(NamedTuple):
    """One tile of every array as large as a frame, or the whole arrays."""

    frame: Intensity
    reference: Intensity
    renewed: Intensity
    """[0] unless all references are renewed."""
    previous: Intensity
    """[0] unless events need it."""


class _Marks(NamedTuple):
    """Where a tile may fire."""

    pixel: ByteArray
    """[NOISE_BLOCK] 1 where a pixel may fire, else 0."""
    run: ByteArray
    """[NOISE_BLOCK / RUN] how many of a run may."""


def find_fired(frame: Intensity, memory: Memory, levels: Levels, rule: FireRule) -> Fired | None:
    """See `texvent_numpy.find_fired`."""
    with allow_wrap_around():
        return _find_fired(frame, memory, levels, rule)


def _find_fired(frame: Intensity, memory: Memory, levels: Levels, rule: FireRule) -> Fired | None:
    renewed = memory.renewed if rule.is_renewed else memory.renewed[:0]
    pictures = _Pictures(frame, memory.reference, renewed, memory.previous)
    work = _workspace(memory)
    if not memory.table.size:
        found = _find_candidates(pictures, levels, work.pixel)
        if found < 0:
            return None
        return texvent_numpy.settle(frame, work.pixel[:found], memory, rule)
    fire = _fire_bytes if frame.dtype == np.uint8 else _fire_words
    # A copied simulator has tables that can be written, which Numba would compile for again.
    found = fire(pictures, read_only(memory.table), levels, rule.threshold, work)
    if rule.is_renewed:
        memory.reference, memory.renewed = memory.renewed, memory.reference
    return work.first(found)


def warm_up(dtype: str) -> None:
    """Compile for one type of frames, or load what was compiled before."""
    picture, number, byte = np.ones(1, dtype), np.float32(1.0), np.uint8(1)
    table = np.zeros(0 if picture.dtype.kind == "f" else np.iinfo(dtype).max + 1)
    memory = Memory(picture, picture.copy(), picture[:0].copy(), np.empty(0), table)
    levels = Levels(number, number, number, number, number, byte)
    rule = FireRule(1.0, 1.0, False, False, True, False)
    find_fired(read_only(picture), memory, levels, rule)


def _workspace(memory: Memory) -> Fired:
    """Room for the worst case, all pixels; the system gives memory only to what is used."""
    if memory.work is None:
        pixels, lines = memory.reference.size, memory.previous.size
        line = (np.empty(lines) for _ in range(3))
        memory.work = Fired(np.empty(pixels, np.int64), np.empty(pixels), *line)
    return memory.work


@numba.njit(cache=True, nogil=True)
def _find_candidates(pictures: _Pictures, levels: Levels, pixel: Int64Array) -> int:
    """List the pixels of float frames that may fire; −1 if an intensity is impossible."""
    marks = _Marks(np.empty(NOISE_BLOCK, np.uint8), np.empty(NOISE_BLOCK // RUN, np.uint8))
    place, found, is_valid = np.empty(NOISE_BLOCK + 1, np.int64), 0, True
    for first in range(0, pictures.frame.size, NOISE_BLOCK):
        tile = _cut(pictures, first)
        is_valid &= _mark_levels(tile, levels, marks)
        for k in range(_list_marks(marks, place)):
            pixel[found] = first + place[k]
            found += 1
        _copy(tile.frame, tile.renewed)
    return found if is_valid else -1


@numba.njit(cache=True, nogil=True)
def _fire_bytes(
    pictures: _Pictures, table: Float64Array, levels: Levels, threshold: float, out: Fired
) -> int:
    """Let the pixels of uint8 frames fire; how many did."""
    marks = _Marks(np.empty(NOISE_BLOCK, np.uint8), np.empty(NOISE_BLOCK // RUN, np.uint8))
    place, found = np.empty(NOISE_BLOCK + 1, np.int64), 0
    for first in range(0, pictures.frame.size, NOISE_BLOCK):
        tile = _cut(pictures, first)
        _mark_bytes(tile.frame, tile.reference, levels.least, marks)
        places = place[: _list_marks(marks, place)]
        found = _settle(tile, places, table, threshold, out, found, first)
    return found


@numba.njit(cache=True, nogil=True)
def _fire_words(
    pictures: _Pictures, table: Float64Array, levels: Levels, threshold: float, out: Fired
) -> int:
    """Let the pixels of uint16 frames fire; how many did."""
    marks = _Marks(np.empty(NOISE_BLOCK, np.uint8), np.empty(NOISE_BLOCK // RUN, np.uint8))
    place, found = np.empty(NOISE_BLOCK + 1, np.int64), 0
    for first in range(0, pictures.frame.size, NOISE_BLOCK):
        tile = _cut(pictures, first)
        _mark_levels(tile, levels, marks)
        places = place[: _list_marks(marks, place)]
        found = _settle(tile, places, table, threshold, out, found, first)
    return found


@numba.njit(cache=True, nogil=True)
def _cut(pictures: _Pictures, first: int) -> _Pictures:
    """The tile that begins at pixel `first`."""
    last = first + NOISE_BLOCK
    return _Pictures(
        pictures.frame[first:last],
        pictures.reference[first:last],
        pictures.renewed[first:last],
        pictures.previous[first:last],
    )


@numba.njit(cache=True, nogil=True)
def _mark_bytes(frame: ByteArray, reference: ByteArray, least: np.uint8, marks: _Marks) -> None:
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
def _mark_levels(tile: _Pictures, levels: Levels, marks: _Marks) -> bool:
    """Mark pixels at or beyond their trigger levels; whether all intensities are possible."""
    frame, reference = tile.frame, tile.reference
    whole, impossible = frame.size // RUN, np.uint8(0)
    for run in range(whole):
        first, marked = run * RUN, np.uint8(0)
        for i in range(first, first + RUN):
            mark = np.uint8(_is_beyond(frame[i], reference[i], levels))
            marks.pixel[i] = mark
            marked += mark
            impossible |= np.uint8(not ((frame[i] >= 0) & (frame[i] < np.inf)))
        marks.run[run] = marked
    _clear(marks, whole)
    for i in range(whole * RUN, frame.size):
        marks.pixel[i] = _is_beyond(frame[i], reference[i], levels)
        marks.run[whole] += marks.pixel[i]
        impossible |= np.uint8(not ((frame[i] >= 0) & (frame[i] < np.inf)))
    return bool(impossible == 0)


@numba.njit(cache=True, nogil=True, inline="always")
def _is_beyond(intensity: Any, reference: Any, levels: Levels) -> Any:
    value = np.float32(intensity) + levels.balance
    level = np.float32(reference) + levels.reference_balance
    is_on = value + levels.floor >= level * levels.up
    return is_on | (value <= level * levels.down + levels.floor)


@numba.njit(cache=True, nogil=True)
def _clear(marks: _Marks, whole: int) -> None:
    """Mark nothing in the runs that are not whole."""
    marks.pixel[whole * RUN :] = 0
    marks.run[whole:] = 0


@numba.njit(cache=True, nogil=True)
def _list_marks(marks: _Marks, place: Int64Array) -> int:
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


@numba.njit(cache=True, nogil=True)
def _settle(
    tile: _Pictures,
    places: Int64Array,
    table: Float64Array,
    threshold: float,
    out: Fired,
    found: int,
    first: int,
) -> int:
    """Append the candidates of a tile that fire, and move what the tile remembers."""
    for place in places:
        now, then = table[tile.frame[place]], table[tile.reference[place]]
        if abs(now - then) < threshold:
            continue
        out.pixel[found] = first + place
        out.change[found] = now - then
        if tile.previous.size:
            out.start[found] = table[tile.previous[place]]
            out.stop[found], out.reference[found] = now, then
        if not tile.renewed.size:
            tile.reference[place] = tile.frame[place]
        found += 1
    _copy(tile.frame, tile.renewed)
    _copy(tile.frame, tile.previous)
    return found


@numba.njit(cache=True, nogil=True)
def _copy(source: Intensity, target: Intensity) -> None:
    """Copy a tile, if there is anything to copy it to."""
    for i in range(target.size):
        target[i] = source[i]
