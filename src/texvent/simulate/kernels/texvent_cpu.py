"""Trigger levels compiled by Numba: one pass over the frame, close work only at candidates.

The frame is scanned in tiles of `NOISE_BLOCK` pixels, which stay in the nearest cache. A scan notes
in a byte per pixel whether it may fire, and how many do in each run of 64 pixels; both loops become
vector instructions. Runs without a candidate, nearly all where little moves, are then left alone.
"""

from __future__ import annotations

import math
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
LARGEST_FLOAT = np.finfo(np.float32).max.view(np.uint32)
"""Bits of the largest float32."""
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


class _Logs(NamedTuple):
    """Balanced intensities of the candidates of float frames, [n], and their logarithms."""

    balanced: Float64Array
    now: Float64Array
    then: Float64Array
    before: Float64Array
    """[0] unless events need it."""


class _Work(NamedTuple):
    """Room for the worst case, all pixels; the system gives memory only to what is used."""

    fired: Fired
    candidates: Int64Array
    """[n], or [0] where tables serve; so are the logarithms."""
    logs: _Logs


def find_fired(frame: Intensity, memory: Memory, levels: Levels, rule: FireRule) -> Fired | None:
    """See `texvent_numpy.find_fired`."""
    work: _Work = memory.work or _make_room(memory)
    memory.work = work
    renewed = memory.renewed if rule.is_renewed else memory.renewed[:0]
    pictures = _Pictures(frame, memory.reference, renewed, memory.previous)
    if not memory.table.size:
        return _find_fired_floats(pictures, memory, levels, rule)
    fire = _fire_bytes if frame.dtype == np.uint8 else _fire_words
    # A copied simulator has tables that can be written, which Numba would compile for again.
    table, fired = read_only(memory.table), work.fired
    with allow_wrap_around():
        found = fire(pictures, table, levels, rule.threshold, fired)
    if rule.is_renewed:
        memory.reference, memory.renewed = memory.renewed, memory.reference
    return fired.first(found)


def _find_fired_floats(
    pictures: _Pictures, memory: Memory, levels: Levels, rule: FireRule
) -> Fired | None:
    work: _Work = memory.work
    fired, candidates, logs = work
    with allow_wrap_around():
        count = _find_candidates(pictures, levels, candidates)
    if count < 0:
        # Rare enough to be looked at in NumPy: −0 is possible, negative numbers are not.
        return texvent_numpy.find_fired(pictures.frame, memory, levels, rule)
    candidates = candidates[:count]
    _take_logs(pictures.frame, candidates, rule, logs.balanced, logs.now)
    if memory.level.size == 0:
        _take_logs(memory.reference, candidates, rule, logs.balanced, logs.then)
    if rule.has_line:
        _take_logs(memory.previous, candidates, rule, logs.balanced, logs.before)
    found = _settle_floats(pictures, candidates, logs, memory.level, rule, fired)
    if rule.has_line:
        memory.previous[:] = pictures.frame
    if rule.is_renewed:
        memory.reference, memory.renewed = memory.renewed, memory.reference
    return fired.first(found)


def _take_logs(
    intensity: Intensity,
    pixel: Int64Array,
    rule: FireRule,
    balanced: Float64Array,
    brightness: Float64Array,
) -> None:
    """Brightness of some pixels as `balanced_log` computes it, by NumPy's own logarithm."""
    _add_balance(read_only(intensity), pixel, rule.balance, balanced)
    np.log(balanced[: pixel.size], out=brightness[: pixel.size])


def warm_up(dtype: str) -> None:
    """Compile for one type of frames, or load what was compiled before."""
    picture, number, byte = np.ones(1, dtype), np.float32(1.0), np.uint8(1)
    table = np.zeros(0 if picture.dtype.kind == "f" else np.iinfo(dtype).max + 1)
    memory = Memory(picture, picture.copy(), picture[:0].copy(), np.empty(0), table)
    levels = Levels(number, number, number, number, byte)
    rule = FireRule(1.0, 1.0, False, False, True, False)
    find_fired(read_only(picture), memory, levels, rule)


def _make_room(memory: Memory) -> _Work:
    pixels, lines = memory.reference.size, memory.previous.size
    line = (np.empty(lines) for _ in range(3))
    fired = Fired(np.empty(pixels, np.int64), np.empty(pixels), *line)
    floats = 0 if memory.table.size else pixels
    logs = (np.empty(size) for size in (floats, floats, floats, lines))
    return _Work(fired, np.empty(floats, np.int64), _Logs(*logs))


@numba.njit(cache=True, nogil=True)
def _add_balance(
    intensity: Intensity, pixel: Int64Array, balance: float, balanced: Float64Array
) -> None:
    for k in range(pixel.size):
        balanced[k] = np.float64(intensity[pixel[k]]) + balance


@numba.njit(cache=True, nogil=True)
def _settle_floats(
    pictures: _Pictures,
    candidates: Int64Array,
    logs: _Logs,
    level: Float64Array,
    rule: FireRule,
    out: Fired,
) -> int:
    """List the candidates that fire, and move what those pixels remember; how many there are."""
    # Arrays are taken out of their tuples once: counting references to them in the loop is slow.
    frame, reference, _, _ = pictures
    _, nows, thens, befores = logs
    pixel, changes, start, stop, at_start = out
    found = 0
    for k in range(candidates.size):
        i, now = candidates[k], nows[k]
        then = level[i] if level.size else thens[k]
        change = now - then
        if abs(change) < rule.threshold:
            continue
        pixel[found], changes[found] = i, change
        if rule.has_line:
            start[found], stop[found], at_start[found] = befores[k], now, then
        found += 1
        if level.size:
            level[i] = now if not rule.is_step else _step(then, change, rule)
            reference[i] = np.float32(math.exp(level[i]))
        elif not rule.is_renewed:
            reference[i] = frame[i]
    return found


@numba.njit(cache=True, nogil=True, inline="always")
def _step(level: float, change: float, rule: FireRule) -> float:
    """The reference after its events: a threshold further for each."""
    number = math.floor(abs(change) / rule.threshold) if rule.multi_event else 1.0
    moved = number * rule.threshold
    return level + moved if change > 0 else level - moved


@numba.njit(cache=True, nogil=True)
def _find_candidates(pictures: _Pictures, levels: Levels, pixel: Int64Array) -> int:
    """List the pixels of float frames that may fire; −1 if an intensity has a sign or no end."""
    marks = _Marks(np.empty(NOISE_BLOCK, np.uint8), np.empty(NOISE_BLOCK // RUN, np.uint8))
    place, found = np.empty(NOISE_BLOCK + 1, np.int64), 0
    for first in range(0, pictures.frame.size, NOISE_BLOCK):
        tile = _cut(pictures, first)
        if _largest_word(tile.frame.view(np.uint32)) > LARGEST_FLOAT:
            return -1
        _mark_levels(tile, levels, marks)
        for k in range(_list_marks(marks, place)):
            pixel[found] = first + place[k]
            found += 1
        _copy(tile.frame, tile.renewed)
    return found


@numba.njit(cache=True, nogil=True)
def _largest_word(words: NDArray[np.uint32]) -> np.uint32:
    """The bits of floats as integers, whose order is theirs: 0, ..., infinity, NaN, negative."""
    largest = np.uint32(0)
    # By number: a loop over the array itself does not become vector instructions.
    for i in range(words.size):
        largest = max(largest, words[i])
    return largest


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
def _mark_levels(tile: _Pictures, levels: Levels, marks: _Marks) -> None:
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
