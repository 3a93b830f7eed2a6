"""How v2e's pixels follow the light, compiled by Numba: one pass, block by block."""

from __future__ import annotations

import math
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.elementary_cpu import natural_log
from texvent.simulate.kernels.follow import (
    DARK_OFFSET,
    WHITE_LEVEL,
    Float64Array,
    Light,
    Pixels,
    PixelState,
    Restless,
)
from texvent.simulate.kernels.order import read_only
from texvent.simulate.kernels.threads import count_threads, run_parts, split

SHARE = 1 << 18
"""Fewest pixels that are worth a thread of their own."""
BLOCK, WORD = 512, 8
"""Pixels that are moved together, and pixels that are passed over together."""


def follow_light(
    light: Light, pixels: Pixels, state: PixelState, elapsed_us: tuple[float, float]
) -> Restless:
    """See `follow_reference.follow_light`."""
    nothing = np.empty(0)
    leak, voltage = pixels.leak, state.voltage or (nothing, nothing)

    def follow(part: slice) -> tuple[NDArray[np.int64], Float64Array, Float64Array]:
        # Numba leaves out branches for arguments that are None, but not for their fields.
        pixel, start, stop = _follow_light(
            read_only(light.luma[part]),
            light.table,
            (light.linear_below, light.angle),
            (pixels.threshold_on[part], pixels.threshold_off[part]),
            (state.brightness[part], state.reference[part]),
            (nothing if leak is None else leak[part], *elapsed_us),
            (voltage[0][part], voltage[1][part]),
        )
        return pixel + part.start, start, stop

    parts = run_parts(follow, split(light.luma.size, count_threads(), unit=SHARE))
    pixel, start, stop = (np.concatenate(columns) for columns in zip(*parts, strict=True))
    return Restless(pixel, start, stop)


def warm_up(dtype: str) -> None:
    """Compile for one type of frames, or load what was compiled before."""
    table = np.ones((2, 256)) if dtype == "uint8" else None
    light, one = Light(np.ones(1, dtype), table, 20.0, 1.0), np.ones(1)
    follow_light(light, Pixels(one, one, None), PixelState(one.copy(), one, None), (0.0, 1.0))


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _follow_light(
    luma: NDArray[Any],
    table: Float64Array | None,
    curve: tuple[float, float],
    thresholds: tuple[Float64Array, Float64Array],
    state: tuple[Float64Array, Float64Array],
    leaking: tuple[Float64Array, float, float],
    voltage: tuple[Float64Array, Float64Array],
) -> tuple[NDArray[np.int64], Float64Array, Float64Array]:
    size = luma.size
    leak, start_us, stop_us = leaking
    pixel, change = np.empty(size // 16 + BLOCK, np.int64), np.empty((2, size // 16 + BLOCK))
    start, stop, weight = np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK)
    words, found = np.zeros(BLOCK // WORD, np.uint64), 0
    marks = words.view(np.uint8)
    for first in range(0, size, BLOCK):
        last = min(first + BLOCK, size)
        if found + BLOCK >= pixel.size:
            pixel, change = _grown(pixel, change)
        _see(luma[first:last], table, curve, stop, weight)
        _move(state[0][first:last], state[1][first:last], weight, start, stop)
        if leak.size > 0:
            _add(start, leak[first:last], start_us)
            _add(stop, leak[first:last], stop_us)
        if voltage[0].size > 0:
            _add(start, voltage[0][first:last], 1.0)
            _add(stop, voltage[1][first:last], 1.0)
        on, off = thresholds[0][first:last], thresholds[1][first:last]
        _mark(stop, on, off, marks)
        for word in range(-(-(last - first) // WORD)):
            if words[word] == 0:
                continue
            for j in range(WORD * word, WORD * word + WORD):
                pixel[found], change[0, found], change[1, found] = first + j, start[j], stop[j]
                found += marks[j]
    return pixel[:found], change[0, :found], change[1, :found]


@numba.njit(cache=True, nogil=True, error_model="numpy")
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


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _move(
    brightness: Float64Array,
    reference: Float64Array,
    weight: Float64Array,
    start: Float64Array,
    stop: Float64Array,
) -> None:
    """On entry `stop` is the brightness of the frame; on return the change at the end."""
    for j in range(brightness.size):
        start[j] = brightness[j] - reference[j]
    for j in range(brightness.size):
        before, now = brightness[j], stop[j]
        brightness[j] = before + weight[j] * (now - before) if weight[j] < 1.0 else now
    for j in range(brightness.size):
        stop[j] = brightness[j] - reference[j]


@numba.njit(cache=True, nogil=True)
def _add(target: Float64Array, term: Float64Array, factor: float) -> None:
    for j in range(term.size):
        target[j] += term[j] * factor


@numba.njit(cache=True, nogil=True)
def _mark(
    stop: Float64Array, on: Float64Array, off: Float64Array, marks: NDArray[np.uint8]
) -> None:
    """1 where a pixel has reached a threshold, else 0, also beyond the last."""
    for j in range(on.size):
        marks[j] = (stop[j] >= on[j]) | (-stop[j] >= off[j])
    marks[on.size :] = 0


@numba.njit(cache=True, nogil=True)
def _grown(
    pixel: NDArray[np.int64], change: Float64Array
) -> tuple[NDArray[np.int64], Float64Array]:
    """The same columns with room for as many again."""
    size = pixel.size
    more, changes = np.empty(2 * size, np.int64), np.empty((2, 2 * size))
    more[:size], changes[:, :size] = pixel, change
    return more, changes
