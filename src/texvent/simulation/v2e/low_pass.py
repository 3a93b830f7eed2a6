"""The low-pass of v2e's photoreceptors from one frame to the next, compiled: block by block."""

from __future__ import annotations

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import read_only, take_scratch
from texvent.runtime.threads import count_threads, run_parts, split
from texvent.simulation.kernels.active_pixels import WORD, is_equal, list_marked
from texvent.simulation.kernels.compiled_elementary import natural_log
from texvent.simulation.random.mismatch import PixelMismatch
from texvent.simulation.v2e.config import LINEAR_BELOW

Float64Array: TypeAlias = NDArray[np.float64]

DARK_OFFSET, WHITE_LEVEL = 20.0, 275.0
"""Bandwidth and shot noise depend on (I + 20) / 275, which is never 0."""
SETTLED = 2.0**-40
"""A lag of brightness below this, log units, counts as none, so that a static pixel settles."""
BLOCK = 256
"""Pixels that a fast kernel looks at together, and skips together if nothing happens to them."""


class LowPassInput(NamedTuple):
    """The frames at both ends of the interval, and the constants of the low-pass."""

    before: NDArray[Any]
    """[n] luma at the start, 0..255 scale, uint8 or float32; a kernel overwrites it with `now`."""
    now: NDArray[Any]
    """[n] luma at the end, of the same type."""
    table: Float64Array | None
    """[2, 256] for uint8: brightness of every level, and its (I + 20) / 275; else None."""
    angle: float
    """2π · bandwidth at white · length of the interval; infinite for an unlimited bandwidth."""
    elapsed_us: tuple[float, float]
    """Time from the first frame to the start and to the end of the interval, µs."""


class V2ePixelState(NamedTuple):
    """State of the pixels.

    The change that fires it is brightness − reference + leak · time since the first frame.
    """

    brightness: Float64Array
    """[n] after the low-pass, log units; a kernel moves it to the end of the interval."""
    reference: Float64Array
    """[n] brightness at the last event, less what had leaked until then, log units."""
    quiescent_until_us: Float64Array
    """[blocks] time after the first frame, µs, up to which no pixel of a block fires if its luma
    does not change; only the fast kernel reads it."""

    def end_quiescence(self, pixel: NDArray[np.int64]) -> None:
        """Have kernels look at some pixels again, whose references have moved."""
        self.quiescent_until_us[pixel // BLOCK] = -np.inf


class CrossingPixels(NamedTuple):
    """The pixels that have reached a threshold at the end."""

    pixel: NDArray[np.int64]
    """[m] flat index, ascending."""
    start: Float64Array
    """[m] change against the reference at the start, log units."""
    stop: Float64Array
    """[m] change at the end."""


def new_state(brightness: Float64Array) -> V2ePixelState:
    """The state of pixels whose reference is the brightness of the first frame, [n] log units."""
    blocks = -(-brightness.size // BLOCK)
    return V2ePixelState(brightness, brightness.copy(), np.full(blocks, -np.inf))


Float32Array = NDArray[np.float32]

PIXELS_PER_THREAD = 1 << 18
"""Fewest pixels that are worth a thread of their own."""


def apply_low_pass(
    light: LowPassInput, mismatch: PixelMismatch, state: V2ePixelState
) -> CrossingPixels:
    """Move the brightness through the low-pass, and find the pixels that reach a threshold.

    Args:
        light: the frames; `before` is overwritten with `now`.
        mismatch: thresholds and leak.
        state: at the start; its brightness is moved to the end.

    Source: v2e (Hu, Liu and Delbruck, CVPRW 2021), section 4.2.
    """

    def apply(part: slice) -> CrossingPixels:
        size = part.stop - part.start
        blocks = slice(part.start // BLOCK, -(-part.stop // BLOCK))
        room = CrossingPixels(
            take_scratch("crossing pixels", size, np.int64),
            take_scratch("start of crossing pixels", size, np.float64),
            take_scratch("stop of crossing pixels", size, np.float64),
        )
        # Numba leaves out branches for arguments that are None, but not for their fields.
        found = _apply_low_pass(
            (light.before[part], read_only(light.now[part])),
            light.table,
            (light.angle, *light.elapsed_us),
            mismatch.part(part),
            V2ePixelState(
                state.brightness[part],
                state.reference[part],
                state.quiescent_until_us[blocks],
            ),
            room,
        )
        pixel, start, stop = room
        return CrossingPixels(pixel[:found], start[:found], stop[:found])

    parts = split(light.now.size, count_threads(), unit=PIXELS_PER_THREAD)
    if len(parts) == 1:
        return apply(parts[0])

    def apply_and_copy(part: slice) -> CrossingPixels:
        # A thread may do several parts, and has one scratch.
        pixel, start, stop = apply(part)
        return CrossingPixels(pixel + part.start, start.copy(), stop.copy())

    columns = zip(*run_parts(apply_and_copy, parts), strict=True)
    return CrossingPixels(*(np.concatenate(column) for column in columns))


@jit(error_model="numpy")
def _apply_low_pass(
    luma: tuple[NDArray[Any], NDArray[Any]],
    table: Float64Array | None,
    constants: tuple[float, float, float],
    mismatch: PixelMismatch,
    state: V2ePixelState,
    room: CrossingPixels,
) -> int:
    """Fill in the crossing pixels; return how many there are."""
    (before, now), (angle, start_us, stop_us) = luma, constants
    (on, off, leak), (brightness, reference, quiescent_until_us) = mismatch, state
    size = now.size
    pixel, start_change, stop_change = room
    local = np.empty(BLOCK + WORD, np.uint64)
    start, stop, weight = np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK)
    words, found = np.zeros(BLOCK // WORD, np.uint64), 0
    marks = words.view(np.uint8)
    for first in range(0, size, BLOCK):
        last = min(first + BLOCK, size)
        is_static = is_equal(before[first:last], now[first:last])
        if is_static and stop_us <= quiescent_until_us[first // BLOCK]:
            continue
        before[first:last] = now[first:last]
        _read_luma(now[first:last], table, angle, stop, weight)
        unsettled = _move(brightness[first:last], reference[first:last], weight, start, stop)
        if leak.size > 0:
            _add(start, leak[first:last], start_us)
            _add(stop, leak[first:last], stop_us)
        _mark(stop, on[first:last], off[first:last], marks)
        crossing = list_marked(words[: -(-(last - first) // WORD)], marks, local)
        for k in range(crossing):
            pixel[found + k] = first + local[k]
            start_change[found + k], stop_change[found + k] = start[local[k]], stop[local[k]]
        found += crossing
        until_us = -np.inf
        if is_static and unsettled == 0 and crossing == 0:
            until_us = _quiescent_until_us(
                brightness[first:last], reference[first:last], on[first:last], leak[first:last]
            )
        quiescent_until_us[first // BLOCK] = until_us
    return found


@jit(error_model="numpy")
def _read_luma(
    luma: NDArray[Any],
    table: Float64Array | None,
    angle: float,
    brightness: Float64Array,
    weight: Float64Array,
) -> None:
    """Fill in brightness, and how far the low-pass moves towards it."""
    if table is not None:
        for j in range(luma.size):
            brightness[j] = table[0, luma[j]]
        for j in range(luma.size):
            weight[j] = min(table[1, luma[j]] * angle, 1.0)
    else:
        slope = math.log(LINEAR_BELOW) / LINEAR_BELOW
        for j in range(luma.size):
            level = np.float64(luma[j])
            log = natural_log(max(level, LINEAR_BELOW))
            brightness[j] = level * slope if level <= LINEAR_BELOW else log
        for j in range(luma.size):
            weight[j] = min((np.float64(luma[j]) + DARK_OFFSET) / WHITE_LEVEL * angle, 1.0)


@jit(error_model="numpy")
def _move(
    brightness: Float64Array,
    reference: Float64Array,
    weight: Float64Array,
    start: Float64Array,
    stop: Float64Array,
) -> int:
    """On entry `stop` is the brightness of the frame; on return the change at the end.

    Returns:
        0 if all pixels have reached the brightness of the frame.
    """
    for j in range(brightness.size):
        start[j] = brightness[j] - reference[j]
    unsettled = 0
    for j in range(brightness.size):
        before, now = brightness[j], stop[j]
        lags = (weight[j] < 1.0) & (abs(now - before) >= SETTLED)
        brightness[j] = before + weight[j] * (now - before) if lags else now
        unsettled |= brightness[j] != now
    for j in range(brightness.size):
        stop[j] = brightness[j] - reference[j]
    return unsettled


@jit(error_model="numpy")
def _quiescent_until_us(
    brightness: Float64Array, reference: Float64Array, on: Float32Array, leak: Float32Array
) -> float:
    """The time up to which no pixel of a settled block fires by its leak."""
    soonest = np.inf
    for j in range(leak.size):
        left = np.float64(on[j]) - (brightness[j] - reference[j])
        soonest = min(soonest, left / np.float64(leak[j]))
    # A microsecond for rounding.
    return soonest - 1.0


@jit
def _add(target: Float64Array, term: NDArray[Any], factor: float) -> None:
    for j in range(term.size):
        target[j] += np.float64(term[j]) * factor


@jit
def _mark(
    stop: Float64Array, on: Float32Array, off: Float32Array, marks: NDArray[np.uint8]
) -> None:
    """Set 1 where a pixel has reached a threshold, else 0, also beyond the last."""
    for j in range(on.size):
        marks[j] = (stop[j] >= on[j]) | (-stop[j] >= off[j])
    marks[on.size :] = 0
