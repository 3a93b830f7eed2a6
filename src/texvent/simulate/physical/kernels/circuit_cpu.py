"""The pixel circuits, compiled by Numba: the reference's bits, block of pixels by block.

A block in which no light changed and no pixel can fire is skipped. Otherwise all its pixels are
advanced as if they were calm, which fills whole vector registers, and those that may not be calm
then walk through the interval one by one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.threads import count_threads, run_parts, split
from texvent.simulate.backend.elementary_cpu import decay_and_gain, exponential, natural_log
from texvent.simulate.backend.lanes_cpu import append_by_lane, is_equal
from texvent.simulate.packets.sorting import SortedEvents, read_only
from texvent.simulate.packets.sorting_cpu import has_room_for_keys, key_bits, sort_keyed_events
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.physical.kernels import circuit_reference
from texvent.simulate.physical.kernels.circuit import (
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
from texvent.simulate.physical.kernels.circuit_lanes_cpu import (
    LANES,
    Block,
    load_lanes,
    new_block,
    new_work,
)
from texvent.simulate.physical.kernels.circuit_reference import SETTLED
from texvent.simulate.physical.kernels.circuit_walk_cpu import walk_lanes

SHARE = 64 * BLOCK
"""Fewest pixels that are worth a thread of their own."""
Uint64Array = NDArray[np.uint64]
NOT_CALM = -(2**62)
FOREVER = 2**62


def advance_pixels(
    light: Light,
    pixels: Pixels,
    state: PixelState,
    noise: NoiseEvents,
    rules: ResetRules,
    span_us: tuple[int, int],
) -> UnsortedEvents | SortedEvents:
    """Every event between two frames; see `circuit_reference.advance_pixels`."""
    shape = light.shape
    if not has_room_for_keys(span_us[1] - span_us[0], shape):
        return circuit_reference.advance_pixels(light, pixels, state, noise, rules, span_us)
    table = None if light.table is None else np.stack(light.table)
    low = key_bits(light.now.size)

    def advance(part: slice) -> Uint64Array:
        first, last = part.start, part.stop
        noisy = slice(*np.searchsorted(noise.pixel, [first, last]))
        noise_times = (noise.t[noisy] - span_us[0]) * 2 + noise.p[noisy]
        # With NUMBA_DISABLE_JIT=1 this runs in NumPy, which would warn where extremes overflow.
        with np.errstate(all="ignore"):
            keys: Uint64Array = _advance_blocks(
                (light.before[part], read_only(light.now[part]), table, light.optics),
                Pixels(*(column[part] for column in pixels)),
                PixelState(
                    state.output[part],
                    state.level[part],
                    state.since_us[part],
                    state.calm_until_us[first // BLOCK : -(-last // BLOCK)],
                ),
                (noise.pixel[noisy] - first, noise_times),
                (*rules, first, low),
                span_us,
            )
        return keys

    parts = run_parts(advance, split(light.now.size, count_threads(), unit=SHARE))
    keys = parts[0] if len(parts) == 1 else np.concatenate(parts)
    return sort_keyed_events(keys, span_us, shape)


def warm_up(dtype: str) -> None:
    """Compile for one type of frames, or load what was compiled before."""
    luma, one, none = np.zeros(1, dtype), np.ones(1, np.float32), np.zeros(0, np.int64)
    table = (np.ones(256), np.ones(256)) if dtype == "uint8" else None
    light = Light(luma.copy(), luma, Optics(1.0, 1.0, 0.0), table, (1, 1))
    state = new_state(np.zeros(1), np.zeros(1), 0)
    noise = NoiseEvents(none, none, none.astype(np.uint8))
    advance_pixels(light, Pixels(one, one, one), state, noise, ResetRules(0, True), (0, 1))


@jit(error_model="numpy")
def _advance_blocks(
    light: tuple[Luma, Luma, Float64Array | None, Optics],
    pixels: Pixels,
    state: PixelState,
    noise: tuple[NDArray[np.int64], NDArray[np.int64]],
    rules: tuple[int, bool, int, int],
    span_us: tuple[int, int],
) -> Uint64Array:
    before, now, table, optics = light
    start_us, stop_us = span_us
    duration = float(stop_us - start_us)
    keys, found = np.empty(now.size // 16 + noise[0].size + 64, np.uint64), 0
    events, work = np.empty((2, 2 * LANES), np.uint64), new_work()
    noise_pixel, noise_done, walking = noise[0], 0, 0
    refractory_us, resets_by_noise, first_of_part, low = rules
    walk = refractory_us, resets_by_noise, first_of_part, low, start_us, stop_us - start_us
    block = new_block()
    for first in range(0, now.size, BLOCK):
        last = min(first + BLOCK, now.size)
        noise_first = noise_done
        while noise_done < noise_pixel.size and noise_pixel[noise_done] < last:
            noise_done += 1
        is_still = is_equal(before[first:last], now[first:last])
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
        if walking + restless > LANES:
            events, made = walk_lanes(work, walking, state, optics, noise[1], walk, events)
            keys, found = append_by_lane(events[:, :made], work.events[:walking], keys, found)
            walking = 0
        load_lanes(work, walking, (first, restless, noise_first), block, own, noise, start_us)
        walking += restless
        own[1].output[:] = block.output[: last - first]
    events, made = walk_lanes(work, walking, state, optics, noise[1], walk, events)
    keys, found = append_by_lane(events[:, :made], work.events[:walking], keys, found)
    return keys[:found]


@jit(error_model="numpy")
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


@jit(error_model="numpy")
def _advance_calmly(block: Block, output: Float64Array, duration: float, is_limited: bool) -> None:
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


@jit(error_model="numpy")
def _find_restless(
    block: Block, own: tuple[Pixels, PixelState], stop_us: int, noisy: NDArray[np.int64]
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


@jit(error_model="numpy")
def _calm_until(block: Block, own: tuple[Pixels, PixelState], stop_us: int) -> int:
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
