"""How v2e's pixels follow the light, compiled by Numba: one pass, block by block."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.scratch import take_scratch
from texvent.runtime.threads import count_threads, run_parts, split
from texvent.simulate.backend.elementary_cpu import natural_log
from texvent.simulate.backend.lanes_cpu import WORD, is_equal, list_marked
from texvent.simulate.packets.sorting import read_only
from texvent.simulate.v2e.kernels.low_pass import (
    BLOCK,
    DARK_OFFSET,
    SETTLED,
    WHITE_LEVEL,
    Float32Array,
    Float64Array,
    Light,
    Pixels,
    PixelState,
    Restless,
)

SHARE = 1 << 18
"""Fewest pixels that are worth a thread of their own."""


def follow_light(
    light: Light, pixels: Pixels, state: PixelState, elapsed_us: tuple[float, float]
) -> Restless:
    """See `follow_reference.follow_light`."""
    nothing, none = np.empty(0), np.empty(0, np.float32)
    leak, voltage = pixels.leak, state.voltage or (nothing, nothing)

    def follow(part: slice) -> Restless:
        size = part.stop - part.start
        room = (
            take_scratch("restless pixels", size, np.int64),
            take_scratch("start of restless pixels", size, np.float64),
            take_scratch("stop of restless pixels", size, np.float64),
        )
        # Numba leaves out branches for arguments that are None, but not for their fields.
        found = _follow_light(
            (light.before[part], read_only(light.luma[part])),
            light.table,
            (light.linear_below, light.angle),
            (pixels.threshold_on[part], pixels.threshold_off[part]),
            (
                state.brightness[part],
                state.reference[part],
                state.calm_until_us[part.start // BLOCK : -(-part.stop // BLOCK)],
            ),
            (none if leak is None else leak[part], *elapsed_us),
            (voltage[0][part], voltage[1][part]),
            room,
        )
        return Restless(*(column[:found] for column in room))

    parts = split(light.luma.size, count_threads(), unit=SHARE)
    if len(parts) == 1:
        return follow(parts[0])

    def follow_and_copy(part: slice) -> Restless:
        # A thread may do several parts, and has one scratch.
        pixel, start, stop = follow(part)
        return Restless(pixel + part.start, start.copy(), stop.copy())

    columns = zip(*run_parts(follow_and_copy, parts), strict=True)
    return Restless(*(np.concatenate(column) for column in columns))


def warm_up(dtype: str) -> None:
    """Compile for one type of frames, or load what was compiled before."""
    table, luma = np.ones((2, 256)) if dtype == "uint8" else None, np.ones(1, dtype)
    one, threshold = np.ones(1), np.ones(1, np.float32)
    state = PixelState(one.copy(), one, None, one.copy())
    pixels = Pixels(threshold, threshold, None)
    follow_light(Light(luma.copy(), luma, table, 20.0, 1.0), pixels, state, (0.0, 1.0))


@jit(error_model="numpy")
def _follow_light(
    luma: tuple[NDArray[Any], NDArray[Any]],
    table: Float64Array | None,
    curve: tuple[float, float],
    thresholds: tuple[Float32Array, Float32Array],
    state: tuple[Float64Array, Float64Array, Float64Array],
    leaking: tuple[Float32Array, float, float],
    voltage: tuple[Float64Array, Float64Array],
    room: tuple[NDArray[np.int64], Float64Array, Float64Array],
) -> int:
    """Fill in who is restless; return how many are."""
    (before, now), (leak, start_us, stop_us) = luma, leaking
    (on, off), (brightness, reference, calm_until_us) = thresholds, state
    size = now.size
    pixel, start_change, stop_change = room
    local = np.empty(BLOCK + WORD, np.uint64)
    start, stop, weight = np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK)
    words, found = np.zeros(BLOCK // WORD, np.uint64), 0
    marks = words.view(np.uint8)
    for first in range(0, size, BLOCK):
        last = min(first + BLOCK, size)
        is_still = voltage[0].size == 0 and is_equal(before[first:last], now[first:last])
        if is_still and stop_us <= calm_until_us[first // BLOCK]:
            continue
        before[first:last] = now[first:last]
        _see(now[first:last], table, curve, stop, weight)
        moving = _move(brightness[first:last], reference[first:last], weight, start, stop)
        if leak.size > 0:
            _add(start, leak[first:last], start_us)
            _add(stop, leak[first:last], stop_us)
        if voltage[0].size > 0:
            _add(start, voltage[0][first:last], 1.0)
            _add(stop, voltage[1][first:last], 1.0)
        _mark(stop, on[first:last], off[first:last], marks)
        restless = list_marked(words[: -(-(last - first) // WORD)], marks, local)
        for k in range(restless):
            pixel[found + k] = first + local[k]
            start_change[found + k], stop_change[found + k] = start[local[k]], stop[local[k]]
        found += restless
        calm_until = -np.inf
        if is_still and moving == 0 and restless == 0:
            calm_until = _calm_until(
                brightness[first:last], reference[first:last], on[first:last], leak[first:last]
            )
        calm_until_us[first // BLOCK] = calm_until
    return found


@jit(error_model="numpy")
def _see(
    luma: NDArray[Any],
    table: Float64Array | None,
    curve: tuple[float, float],
    bright: Float64Array,
    weight: Float64Array,
) -> None:
    """Fill in brightness, and how far the low-pass moves towards it."""
    bend, angle = curve
    if table is not None:
        for j in range(luma.size):
            bright[j] = table[0, luma[j]]
        for j in range(luma.size):
            weight[j] = min(table[1, luma[j]] * angle, 1.0)
    else:
        slope = math.log(bend) / bend
        for j in range(luma.size):
            level = np.float64(luma[j])
            log = natural_log(max(level, bend))
            bright[j] = level * slope if level <= bend else log
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
    moving = 0
    for j in range(brightness.size):
        before, now = brightness[j], stop[j]
        lags = (weight[j] < 1.0) & (abs(now - before) >= SETTLED)
        brightness[j] = before + weight[j] * (now - before) if lags else now
        moving |= brightness[j] != now
    for j in range(brightness.size):
        stop[j] = brightness[j] - reference[j]
    return moving


@jit(error_model="numpy")
def _calm_until(
    brightness: Float64Array, reference: Float64Array, on: Float32Array, leak: Float32Array
) -> float:
    """The time up to which no pixel of a block at rest fires by its leak."""
    soonest = np.inf
    for j in range(leak.size):
        left = np.float64(on[j]) - (brightness[j] - reference[j])
        soonest = min(soonest, left / np.float64(leak[j]))
    # A microsecond for what is rounded here.
    return soonest - 1.0


@jit
def _add(target: Float64Array, term: NDArray[Any], factor: float) -> None:
    for j in range(term.size):
        target[j] += np.float64(term[j]) * factor


@jit
def _mark(
    stop: Float64Array, on: Float32Array, off: Float32Array, marks: NDArray[np.uint8]
) -> None:
    """1 where a pixel has reached a threshold, else 0, also beyond the last."""
    for j in range(on.size):
        marks[j] = (stop[j] >= on[j]) | (-stop[j] >= off[j])
    marks[on.size :] = 0
