"""The pixel circuits, compiled by Numba: the reference's bits, block of pixels by block.

A block in which no light changed and no pixel can fire is skipped. Otherwise all its pixels are
advanced as if they were calm, which fills whole vector registers, and those that may not be calm
then walk through the interval one by one.
"""

from __future__ import annotations

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.firings import Firings
from texvent.simulate.kernels.circuit import (
    ALMOST_BLACK,
    BLOCK,
    DARK_OFFSET,
    WHITE,
    Float64Array,
    Light,
    Luma,
    NoiseEvents,
    Optics,
    Pixels,
    PixelState,
    ResetRules,
    new_state,
)
from texvent.simulate.kernels.circuit_reference import SETTLED

# Numba's cache looks at this file only: whoever changes `walk_pixel` must change this one too.
from texvent.simulate.kernels.circuit_walk_cpu import Events, walk_pixel
from texvent.simulate.kernels.elementary_cpu import decay_and_gain, exponential, natural_log
from texvent.simulate.kernels.order import read_only
from texvent.simulate.kernels.threads import count_threads, run_parts, split

SHARE = 64 * BLOCK
"""Fewest pixels that are worth a thread of their own."""
NOT_CALM = -(2**62)
FOREVER = 2**62


class _Block(NamedTuple):
    """What is known of the pixels of one block, [BLOCK] each."""

    bright: Float64Array
    corner: Float64Array
    bright_now: Float64Array
    corner_now: Float64Array
    output: Float64Array
    """At the end of the interval, if the pixel is calm."""
    low: Float64Array
    """The outputs stay above it."""
    high: Float64Array
    """The outputs stay below it."""
    decay: Float64Array
    gain: Float64Array
    is_calm: NDArray[np.bool_]
    restless: NDArray[np.int64]


def advance_pixels(
    light: Light,
    pixels: Pixels,
    state: PixelState,
    noise: NoiseEvents,
    rules: ResetRules,
    span_us: tuple[int, int],
) -> Firings:
    """Every event between two frames; see `circuit_reference.advance_pixels`."""
    table = None if light.table is None else np.stack(light.table)

    def advance(part: slice) -> tuple[Events, int]:
        first, last = part.start, part.stop
        noisy = slice(*np.searchsorted(noise.pixel, [first, last]))
        noise_times = (noise.t[noisy] - span_us[0]) * 2 + noise.p[noisy]
        room = len(noise_times) + (last - first) // 16 + 64
        # With NUMBA_DISABLE_JIT=1 this runs in NumPy, which would warn where extremes overflow.
        with np.errstate(all="ignore"):
            events = _advance_blocks(
                (light.before[part], read_only(light.now[part]), table, light.optics),
                Pixels(*(column[part] for column in pixels)),
                PixelState(
                    state.output[part],
                    state.level[part],
                    state.since_us[part],
                    state.calm_until_us[first // BLOCK : -(-last // BLOCK)],
                ),
                (noise.pixel[noisy] - first, noise_times),
                rules,
                span_us,
                room,
            )
        return events, first

    parts = run_parts(advance, split(light.now.size, count_threads(), unit=SHARE))
    pixel = np.concatenate([events[0] + first for events, first in parts])
    t, kind = (np.concatenate([events[i] for events, _ in parts]) for i in (1, 2))
    return Firings(pixel, t, (kind & 1).astype(np.uint8), (kind >> 1).astype(np.uint8))


def warm_up(dtype: str) -> None:
    """Compile for one type of frames, or load what was compiled before."""
    luma, one, none = np.zeros(1, dtype), np.ones(1, np.float32), np.zeros(0, np.int64)
    table = (np.ones(256), np.ones(256)) if dtype == "uint8" else None
    light = Light(luma.copy(), luma, Optics(1.0, 1.0, 0.0), table)
    state = new_state(np.zeros(1), np.zeros(1), 0)
    noise = NoiseEvents(none, none, none.astype(np.uint8))
    advance_pixels(light, Pixels(one, one, one), state, noise, ResetRules(0, True), (0, 1))


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _advance_blocks(
    light: tuple[Luma, Luma, Float64Array | None, Optics],
    pixels: Pixels,
    state: PixelState,
    noise: tuple[NDArray[np.int64], NDArray[np.int64]],
    rules: ResetRules,
    span_us: tuple[int, int],
    room: int,
) -> Events:
    before, now, table, optics = light
    start_us, stop_us = span_us
    duration = float(stop_us - start_us)
    events = np.empty((3, room), np.int64)
    noise_pixel, found, noise_done = noise[0], 0, 0
    block = _new_block()
    for first in range(0, now.size, BLOCK):
        last = min(first + BLOCK, now.size)
        noise_first = noise_done
        while noise_done < noise_pixel.size and noise_pixel[noise_done] < last:
            noise_done += 1
        is_still = _is_equal(before[first:last], now[first:last])
        is_left_alone = is_still and noise_first == noise_done
        if is_left_alone and stop_us <= state.calm_until_us[first // BLOCK]:
            continue
        _see(before[first:last], table, optics, block.bright, block.corner)
        _see(now[first:last], table, optics, block.bright_now, block.corner_now)
        before[first:last] = now[first:last]
        own = (
            Pixels(
                pixels.threshold_on[first:last],
                pixels.threshold_off[first:last],
                pixels.leak[first:last],
            ),
            PixelState(
                state.output[first:last],
                state.level[first:last],
                state.since_us[first:last],
                state.calm_until_us,
            ),
        )
        _advance_calmly(block, own[1].output, duration, optics.corner_per_level > 0)
        restless = _find_restless(block, own, stop_us, noise_pixel[noise_first:noise_done] - first)
        calm_until = NOT_CALM
        if is_left_alone and restless == 0:
            calm_until = _calm_until(block, own, stop_us)
        state.calm_until_us[first // BLOCK] = calm_until
        found, events = _walk_restless(
            (first, restless, noise_first, found), block, own, optics, noise, rules, span_us, events
        )
        own[1].output[:] = block.output[: last - first]
    return events[:, :found]


@numba.njit(cache=True, nogil=True)
def _new_block() -> _Block:
    return _Block(
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK, np.bool_),
        np.empty(BLOCK, np.int64),
    )


@numba.njit(cache=True, nogil=True)
def _is_equal(one: Luma, two: Luma) -> bool:
    different = 0
    for j in range(one.size):
        different |= one[j] != two[j]
    return different == 0


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _see(
    luma: Luma,
    table: Float64Array | None,
    optics: Optics,
    bright: Float64Array,
    corner: Float64Array,
) -> None:
    """Fill in brightness and corner frequency; see `circuit.light_of`."""
    if table is not None:
        for j in range(luma.size):
            bright[j], corner[j] = table[0, luma[j]], table[1, luma[j]]
    else:
        for j in range(luma.size):
            level: float = np.float64(luma[j])
            if optics.gamma != 1.0:
                exponent = optics.gamma * natural_log((level + ALMOST_BLACK) / WHITE)
                level = WHITE * exponential(exponent)
            bright[j] = natural_log(optics.balance + level)
            corner[j] = optics.corner_per_level * (level + DARK_OFFSET)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _advance_calmly(block: _Block, output: Float64Array, duration: float, is_limited: bool) -> None:
    """Where the outputs go if nothing fires, and between which bounds.

    Short loops over few arrays each: Numba fills vector registers in no others.
    """
    size = output.size
    for j in range(size):
        block.low[j] = min(output[j], min(block.bright[j], block.bright_now[j]))
        block.high[j] = max(output[j], max(block.bright[j], block.bright_now[j]))
    if not is_limited:
        block.output[:size] = block.bright_now[:size]
        return
    for j in range(size):
        angle = (block.corner[j] + block.corner_now[j]) * 0.5 * duration
        block.decay[j], block.gain[j] = decay_and_gain(angle)
    for j in range(size):
        begin, end = block.bright[j], block.bright_now[j]
        lag = block.decay[j] * (begin - output[j]) + block.gain[j] * (end - begin)
        block.output[j] = end - (0.0 if abs(lag) < SETTLED else lag)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _find_restless(
    block: _Block, own: tuple[Pixels, PixelState], stop_us: int, noisy: NDArray[np.int64]
) -> int:
    """List the pixels that may fire, those with noise among them; return how many."""
    pixels, state = own
    size = state.level.size
    for j in range(size):
        drift = np.float64(pixels.leak[j]) * np.float64(stop_us - state.since_us[j])
        # Written so that NaN, the level of a pixel that is held, is not calm.
        block.is_calm[j] = block.high[j] - state.level[j] + drift < pixels.threshold_on[j]
    calm = 0
    for j in range(size):
        is_calm = block.is_calm[j] & (state.level[j] - block.low[j] < pixels.threshold_off[j])
        block.is_calm[j] = is_calm
        calm += is_calm
    if calm == size and noisy.size == 0:
        return 0
    for k in range(noisy.size):
        block.is_calm[noisy[k]] = False
    restless = 0
    for j in range(size):
        block.restless[restless] = j
        restless += not block.is_calm[j]
    return restless


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _calm_until(block: _Block, own: tuple[Pixels, PixelState], stop_us: int) -> int:
    """The time up to which no pixel of a block at rest fires by its leak; at once if in motion."""
    pixels, state = own
    soonest, moving = np.inf, 0
    for j in range(state.output.size):
        moving |= block.output[j] != block.bright[j]
        left = pixels.threshold_on[j] - (block.output[j] - state.level[j])
        after = left / np.float64(pixels.leak[j]) + np.float64(state.since_us[j])
        soonest = min(soonest, float(after))
    # A microsecond for what is rounded here.
    return stop_us if moving else int(min(soonest, float(FOREVER))) - 1


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _walk_restless(
    where: tuple[int, int, int, int],
    block: _Block,
    own: tuple[Pixels, PixelState],
    optics: Optics,
    noise: tuple[NDArray[np.int64], NDArray[np.int64]],
    rules: ResetRules,
    span_us: tuple[int, int],
    events: Events,
) -> tuple[int, Events]:
    """Send the restless pixels of a block through the interval; how many events there are now."""
    first, restless, k, found = where
    pixels, state = own
    noise_pixel, noise_times = noise
    start_us, stop_us = span_us
    for j in block.restless[:restless]:
        next_k = k
        while next_k < noise_pixel.size and noise_pixel[next_k] == first + j:
            next_k += 1
        circuit = (
            optics.corner_per_level,
            DARK_OFFSET - optics.balance,
            np.float64(pixels.threshold_on[j]),
            np.float64(pixels.threshold_off[j]),
            np.float64(pixels.leak[j]),
        )
        sight = block.bright[j], block.bright_now[j], block.corner[j], block.corner_now[j]
        held = state.output[j], state.level[j], float(state.since_us[j] - start_us)
        filled = -1
        while filled < 0:
            filled, output, level, since = walk_pixel(
                (first + j, start_us, stop_us, rules.refractory_us, rules.by_noise),
                circuit,
                sight,
                held,
                (k, next_k),
                noise_times,
                events,
                found,
            )
            if filled < 0:
                events = _grown(events)
        found, k = filled, next_k
        block.output[j] = output
        state.level[j] = np.nan if since > float(stop_us - start_us) else level
        state.since_us[j] = start_us + int(since)
    return found, events


@numba.njit(cache=True, nogil=True)
def _grown(events: Events) -> Events:
    """The same events with room for as many again."""
    larger = np.empty((3, 2 * events.shape[1]), np.int64)
    larger[:, : events.shape[1]] = events
    return larger
