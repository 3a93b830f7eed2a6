"""The scan for pixels that fire (Eq. 5), compiled: one pass over the frame.

Tile by tile the frame is compared with trigger levels (`kernels.active_pixels` skips runs of
pixels that cannot fire). Candidates are then decided by the exact logarithms of the definition:
from a table for integers, from NumPy for floats, in a pass of their own.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import HIGHEST_INTENSITY, Float64Array, is_intensity
from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import read_only, take_scratch
from texvent.simulation.kernels.active_pixels import (
    RUN,
    ByteArray,
    MarkedRuns,
    as_bits,
    list_marked_runs,
    make_flags,
    number_of_lowest,
)
from texvent.simulation.kernels.compiled_elementary import exponential
from texvent.simulation.texvent.pixel_memory import (
    FiredPixels,
    FireRule,
    Intensity,
    Memory,
    ScanLevels,
)

LARGEST_FLOAT = np.float32(HIGHEST_INTENSITY).view(np.uint32)
"""Bits of the largest float that a frame may hold."""
FEW = 6
"""Up to so many candidates of a run are looked up one by one; of more, trigger levels first leave
out those that cannot fire, as in moving texture most cannot."""
_0, _1, _RUN = np.uint64(0), np.uint64(1), np.uint64(RUN)
_BYTE = np.dtype(np.uint8)
BLOCK = 256
"""Pixels whose levels are moved together."""
_CHUNK = 1 << 14
"""Pixels of float frames that are looked at together, twice: they stay in a near cache."""
Int64Array = NDArray[np.int64]


@jit
def mark_pixels(frame: Intensity, reference: Intensity, levels: ScanLevels) -> MarkedRuns:
    """Mark pixels at or beyond their trigger levels, and other bytes that differ enough.

    Bytes are marked that differ by `levels.least` or more, as long as they are few of a run.
    """
    is_marked, is_bytes = make_flags(frame.size), reference.dtype == _BYTE
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
    """Bits of the pixels after the last whole run that are at or beyond their trigger levels."""
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


class ScanArrays(NamedTuple):
    """All arrays as large as a frame."""

    frame: Intensity
    reference: Intensity
    previous: Intensity
    """[0] unless events need it."""
    level: Float64Array
    """[0] unless references lie between intensities."""


class _Logs(NamedTuple):
    """Brightness of the candidates of float frames, [n], by NumPy's own logarithm."""

    now: Float64Array
    then: Float64Array
    """[0] where `ScanArrays.level` has it."""
    before: Float64Array
    """[0] unless events need it."""


def detect_events(
    frame: Intensity, memory: Memory, levels: ScanLevels, rule: FireRule
) -> FiredPixels | None:
    """Pixels that fire in a sub-interval; changes what the pixels remember.

    Args:
        frame: intensity at its end, [n].
        memory: what the pixels remember of the frames before.
        levels: for the scan.
        rule: what firing is, and what it does.

    Returns:
        None where an intensity is NaN, infinite or negative; then nothing was changed. The arrays
        are scratch memory of this thread: the next call overwrites them.

    Equation: (5), section 3.2.2, as `pixel_memory` explains it.
    """
    pixels, lines = frame.size, memory.previous.size
    # Room for all pixels; the system gives memory only to what is used.
    columns = (take_scratch(f"fired {name}", lines, np.float64) for name in FiredPixels._fields[2:])
    change = take_scratch("fired change", pixels, np.float64)
    fired = FiredPixels(take_scratch("fired pixel", pixels, np.int64), change, *columns)
    arrays = ScanArrays(frame, memory.reference, memory.previous, memory.level)
    if memory.table.size:
        if memory.table.flags.writeable:
            # Of a copied simulator; Numba would compile for it again.
            memory.table = read_only(memory.table)
        found = _fire_integers(arrays, memory.table, levels, rule, fired)
    else:
        found = _fire_floats(arrays, levels, rule, fired)
    if found < 0:
        return None
    fired = fired.first(found)
    if memory.level.size:
        _move_levels(fired.pixel, fired.change, rule, memory.level, memory.reference)
    return fired


def _fire_floats(arrays: ScanArrays, levels: ScanLevels, rule: FireRule, out: FiredPixels) -> int:
    """Let the pixels of float frames fire; how many did, or −1 where an intensity is impossible."""
    frame, reference, previous, level = arrays
    candidates = take_scratch("candidates", frame.size, np.int64)
    count = _find_candidates(arrays, levels, candidates)
    if count < 0:
        if not is_intensity(frame):
            return -1
        # −0 is allowed; as 0 it passes.
        whole = arrays._replace(frame=read_only(frame + np.float32(0.0)))
        return _fire_floats(whole, levels, rule, out)
    candidates = candidates[:count]
    nothing = candidates[:0]
    logs = _Logs(
        _take_logs("now", frame, candidates, rule),
        _take_logs("then", reference, nothing if level.size else candidates, rule),
        _take_logs("before", previous, candidates if rule.has_line else nothing, rule),
    )
    found = _settle_floats(arrays, candidates, logs, rule, out)
    if rule.has_line:
        previous[:] = frame
    if rule.is_renewed:
        reference[:] = frame
    return found


def _take_logs(use: str, intensity: Intensity, pixel: Int64Array, rule: FireRule) -> Float64Array:
    """Brightness of some pixels, as `balanced_log` computes it."""
    brightness = take_scratch(f"{use} log", pixel.size, np.float64)
    _add_balance(read_only(intensity), pixel, rule.balance, brightness)
    return np.asarray(np.log(brightness, out=brightness))


@jit
def _add_balance(
    intensity: Intensity, pixel: Int64Array, balance: float, balanced: Float64Array
) -> None:
    for k in range(pixel.size):
        balanced[k] = np.float64(intensity[np.uint64(pixel[k])]) + balance


@jit
def _find_candidates(arrays: ScanArrays, levels: ScanLevels, pixel: Int64Array) -> int:
    """List the pixels of float frames that may fire; −1 if an intensity has a sign or no end."""
    found = _0
    for start in range(0, arrays.frame.size, _CHUNK):
        frame, reference = arrays.frame[start : start + _CHUNK], arrays.reference[start:]
        if largest_word(frame.view(np.uint32)) > LARGEST_FLOAT:
            return -1
        runs, words = mark_pixels(frame, reference, levels)
        for k in range(runs.size):
            first, bits = np.uint64(start) + np.uint64(runs[k]) * _RUN, words[k]
            while bits != _0:
                pixel[found] = first + number_of_lowest(bits)
                bits &= bits - _1
                found += _1
    return int(np.int64(found))


@jit
def _settle_floats(
    arrays: ScanArrays, candidates: Int64Array, logs: _Logs, rule: FireRule, out: FiredPixels
) -> int:
    """List the candidates that fire, and move what those pixels remember; how many there are."""
    # Arrays are taken out of their tuples once: counting references to them in the loop is slow.
    frame, reference, _, level = arrays
    nows, thens, befores = logs
    pixel, changes, start, stop, at_start = out
    found = _0
    for k in range(candidates.size):
        i, now = np.uint64(candidates[k]), nows[k]
        then = level[i] if level.size else thens[k]
        change = now - then
        if abs(change) < rule.threshold:
            continue
        pixel[found], changes[found] = i, change
        if rule.has_line:
            start[found], stop[found], at_start[found] = befores[k], now, then
        found += _1
        if not level.size and not rule.is_renewed:
            reference[i] = frame[i]
        elif level.size and not rule.is_step:
            level[i] = now
    return int(np.int64(found))


@jit
def _fire_integers(
    arrays: ScanArrays, table: Float64Array, levels: ScanLevels, rule: FireRule, out: FiredPixels
) -> int:
    """Let the pixels of uint8 or uint16 frames fire; how many did."""
    frame, reference, previous, level = arrays
    pixel, changes, start, stop, at_start = out
    runs, words = mark_pixels(frame, reference, levels)
    has_line, has_level, found = previous.size > 0, level.size > 0, _0
    for k in range(runs.size):
        first, bits = np.uint64(runs[k]) * _RUN, words[k]
        while bits != _0:
            i = first + number_of_lowest(bits)
            bits &= bits - _1
            now = table[frame[i]]
            then = level[i] if has_level else table[np.uint16(reference[i])]
            change = now - then
            # Written always, kept if it fires: without a branch that cannot be foreseen.
            pixel[found], changes[found] = i, change
            if has_line:
                start[found], stop[found], at_start[found] = table[previous[i]], now, then
            fires = abs(change) >= rule.threshold
            if fires and not rule.is_renewed:
                if not has_level:
                    reference[i] = frame[i]
                elif not rule.is_step:
                    level[i] = now
            found += np.uint64(fires)
    if rule.is_renewed:
        _copy(frame, reference)
    _copy(frame, previous)
    return int(np.int64(found))


@jit(error_model="numpy")
def _move_levels(
    pixel: Int64Array,
    changes: Float64Array,
    rule: FireRule,
    level: Float64Array,
    reference: NDArray[np.float32],
) -> None:
    """Move the levels of pixels that fired by δ for each event, or leave them where they are now.

    Loops over a block each, which become vector instructions, also find their intensity.
    """
    own = np.empty(BLOCK)
    for first in range(0, pixel.size, BLOCK):
        pixels, change = pixel[first : first + BLOCK], changes[first : first + BLOCK]
        for j in range(np.uint64(pixels.size)):
            own[j] = level[np.uint64(pixels[j])]
        if rule.is_step:
            for j in range(np.uint64(pixels.size)):
                size = abs(change[j])
                number = np.floor(size / rule.threshold) if rule.multi_event else 1.0
                moved = number * rule.threshold
                own[j] += moved if change[j] > 0 else -moved
            for j in range(np.uint64(pixels.size)):
                level[np.uint64(pixels[j])] = own[j]
        for j in range(np.uint64(pixels.size)):
            own[j] = exponential(own[j])
        for j in range(np.uint64(pixels.size)):
            reference[np.uint64(pixels[j])] = own[j]


@jit
def _copy(source: Intensity, target: Intensity) -> None:
    """Copy a frame, if there is anything to copy it to."""
    for i in range(target.size):
        target[i] = source[i]
