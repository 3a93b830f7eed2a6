"""Trigger levels compiled by Numba: one pass over the frame, close work only at candidates.

Tile by tile the frame is scanned (`scan_bitmask_cpu`), and what may fire is settled by the exact
logarithms of the definition: from a table for integers, from NumPy for floats, which takes a pass
of its own.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.read_only import read_only
from texvent.simulate.crossing.bitmask_cpu import RUN, number_of
from texvent.simulate.random.draws_cpu import allow_wrap_around
from texvent.simulate.texvent.kernels import scan_numpy
from texvent.simulate.texvent.kernels.scan import (
    Fired,
    FireRule,
    Float64Array,
    Intensity,
    Memory,
    ScanLevels,
)
from texvent.simulate.texvent.kernels.scan_bitmask_cpu import (
    LARGEST_FLOAT,
    largest_word,
    mark_pixels,
)

Int64Array = NDArray[np.int64]
_0, _1 = np.uint64(0), np.uint64(1)
_CHUNK = 1 << 14
"""Pixels of float frames that are looked at together, twice: they stay in a near cache."""


class ScanArrays(NamedTuple):
    """All arrays as large as a frame."""

    frame: Intensity
    reference: Intensity
    renewed: Intensity
    """[0] unless all references are renewed."""
    previous: Intensity
    """[0] unless events need it."""


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


def find_fired(
    frame: Intensity, memory: Memory, levels: ScanLevels, rule: FireRule
) -> Fired | None:
    """See `scan_numpy.find_fired`."""
    work: _Work = memory.work or _make_room(memory)
    memory.work = work
    renewed = memory.renewed if rule.is_renewed else memory.renewed[:0]
    arrays = ScanArrays(frame, memory.reference, renewed, memory.previous)
    if not memory.table.size:
        return _find_fired_floats(arrays, memory, levels, rule)
    table, fired = memory.table, work.fired
    if table.flags.writeable:
        # Of a copied simulator; Numba would compile for it again.
        table = memory.table = read_only(table)
    with allow_wrap_around():
        found = _fire_integers(arrays, table, levels, rule.threshold, fired)
    if rule.is_renewed:
        memory.reference, memory.renewed = memory.renewed, memory.reference
    return fired.first(found)


def _find_fired_floats(
    arrays: ScanArrays, memory: Memory, levels: ScanLevels, rule: FireRule
) -> Fired | None:
    work: _Work = memory.work
    fired, candidates, logs = work
    with allow_wrap_around():
        count = _find_candidates(arrays, levels, candidates)
    if count < 0:
        # Rare enough to be looked at in NumPy: −0 is possible, negative numbers are not.
        return scan_numpy.find_fired(arrays.frame, memory, levels, rule)
    candidates = candidates[:count]
    _take_logs(arrays.frame, candidates, rule, logs.balanced, logs.now)
    if memory.level.size == 0:
        _take_logs(memory.reference, candidates, rule, logs.balanced, logs.then)
    if rule.has_line:
        _take_logs(memory.previous, candidates, rule, logs.balanced, logs.before)
    found = _settle_floats(arrays, candidates, logs, memory.level, rule, fired)
    if rule.has_line:
        memory.previous[:] = arrays.frame
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


def _make_room(memory: Memory) -> _Work:
    pixels, lines = memory.reference.size, memory.previous.size
    start, stop, reference = (np.empty(lines) for _ in range(3))
    places, change = np.empty(pixels, np.int64), np.empty(pixels)
    fired = Fired(places, change, start, stop, reference)
    floats = 0 if memory.table.size else pixels
    logs = (np.empty(size) for size in (floats, floats, floats, lines))
    return _Work(fired, np.empty(floats, np.int64), _Logs(*logs))


@jit
def _add_balance(
    intensity: Intensity, pixel: Int64Array, balance: float, balanced: Float64Array
) -> None:
    for k in range(pixel.size):
        balanced[k] = np.float64(intensity[pixel[k]]) + balance


@jit
def _settle_floats(
    arrays: ScanArrays,
    candidates: Int64Array,
    logs: _Logs,
    level: Float64Array,
    rule: FireRule,
    out: Fired,
) -> int:
    """List the candidates that fire, and move what those pixels remember; how many there are."""
    # Arrays are taken out of their tuples once: counting references to them in the loop is slow.
    frame, reference, _, _ = arrays
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


@jit(inline="always")
def _step(level: float, change: float, rule: FireRule) -> float:
    """The reference after its events: a threshold further for each."""
    number = math.floor(abs(change) / rule.threshold) if rule.multi_event else 1.0
    moved = number * rule.threshold
    return level + moved if change > 0 else level - moved


@jit
def _find_candidates(arrays: ScanArrays, levels: ScanLevels, pixel: Int64Array) -> int:
    """List the pixels of float frames that may fire; −1 if an intensity has a sign or no end."""
    found = 0
    for first in range(0, arrays.frame.size, _CHUNK):
        last = first + _CHUNK
        frame, reference = arrays.frame[first:last], arrays.reference[first:last]
        if largest_word(frame.view(np.uint32)) > LARGEST_FLOAT:
            return -1
        runs, words = mark_pixels(frame, reference, levels)
        for k in range(runs.size):
            bits = words[k]
            while bits != _0:
                bit = bits & (~bits + _1)
                bits ^= bit
                pixel[found] = first + runs[k] * RUN + number_of(bit)
                found += 1
    _copy(arrays.frame, arrays.renewed)
    return found


@jit
def _fire_integers(
    arrays: ScanArrays, table: Float64Array, levels: ScanLevels, threshold: float, out: Fired
) -> int:
    """Let the pixels of uint8 or uint16 frames fire; how many did."""
    frame, reference, renewed, previous = arrays
    pixel, change, start, stop, at_start = out
    runs, words = mark_pixels(frame, reference, levels)
    is_renewed, has_line, found = renewed.size > 0, previous.size > 0, 0
    for k in range(runs.size):
        bits = words[k]
        while bits != _0:
            bit = bits & (~bits + _1)
            bits ^= bit
            i = runs[k] * RUN + number_of(bit)
            now, then = table[frame[i]], table[reference[i]]
            # Written always, kept if it fires: without a branch that cannot be foreseen.
            pixel[found], change[found] = i, now - then
            if has_line:
                start[found], stop[found], at_start[found] = table[previous[i]], now, then
            fires = abs(now - then) >= threshold
            if fires and not is_renewed:
                reference[i] = frame[i]
            found += int(fires)
    _copy(frame, renewed)
    _copy(frame, previous)
    return found


@jit
def _copy(source: Intensity, target: Intensity) -> None:
    """Copy a frame, if there is anything to copy it to."""
    for i in range(target.size):
        target[i] = source[i]
