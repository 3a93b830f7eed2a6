"""The pixel circuits between two frames, compiled: block of pixels by block.

A block whose luma did not change and in which no pixel can fire is skipped. Otherwise all its
pixels are first advanced as if none fired, in loops that fill vector registers. Those that may fire
are then advanced again in lanes, event by event; see `simd_lanes`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import read_only
from texvent.runtime.threads import count_threads, run_parts, split
from texvent.simulation.kernels.active_pixels import append_by_lane, is_equal
from texvent.simulation.kernels.compiled_elementary import decay_and_gain, exponential, natural_log
from texvent.simulation.kernels.radix_sort import key_bits, sort_keyed_events
from texvent.simulation.packets import SortedEvents
from texvent.simulation.physical.circuit import (
    ALMOST_BLACK,
    BLOCK,
    WHITE,
    CircuitState,
    Float64Array,
    Luma,
    NoiseEvents,
    PhotoreceptorConstants,
    PhotoreceptorInput,
)
from texvent.simulation.physical.simd_lanes import (
    LANES,
    SETTLED,
    PixelBlock,
    load_lanes,
    new_block,
    new_work,
)
from texvent.simulation.physical.simd_steps import EventRules, advance_lanes
from texvent.simulation.random.mismatch import PixelMismatch

PIXELS_PER_THREAD = 64 * BLOCK
"""Fewest pixels that are worth a thread of their own."""
Uint64Array = NDArray[np.uint64]
NOT_QUIESCENT = -(2**62)
FOREVER = 2**62


def advance_pixels(
    light: PhotoreceptorInput,
    mismatch: PixelMismatch,
    state: CircuitState,
    noise: NoiseEvents,
    refractory_us: int,
    span_us: tuple[int, int],
) -> SortedEvents:
    """Every event between two frames; moves the state to the end of the interval.

    The output of a photoreceptor is a first-order low-pass of the brightness. The change since the
    last reset grows with it and with the leak. Where it reaches the ON threshold or falls to minus
    the OFF threshold, the pixel fires and is reset. A noise event fires at its own time. A pixel
    that fired is held in reset for the refractory period: its change is zero until its release.

    Args:
        light: over the interval; `before` is overwritten with `now`.
        mismatch: thresholds and leak rates.
        state: at the start; changed in place.
        noise: noise events, by pixel and then by time.
        refractory_us: how long an event holds its pixel in reset, µs; 0 is none.
        span_us: start (included) and stop (excluded), µs.

    Returns:
        The events in the order of a packet; times rounded down, never the stop itself.

    Raises:
        InputError: the interval is too long for a sensor of this size.
    """
    shape = light.shape
    table = None if light.table is None else np.stack(light.table)
    low = key_bits(span_us[1] - span_us[0], shape)

    def advance(part: slice) -> Uint64Array:
        first, last = part.start, part.stop
        noisy = slice(*np.searchsorted(noise.pixel, [first, last]))
        noise_times = (noise.t[noisy] - span_us[0]) * 2 + noise.p[noisy]
        keys: Uint64Array = _advance_blocks(
            (light.before[part], light.brightness[part], light.cutoff[part]),
            (read_only(light.now[part]), table, light.optics),
            mismatch.part(part),
            CircuitState(
                state.output[part],
                state.level[part],
                state.since_us[part],
                state.quiescent_until_us[first // BLOCK : -(-last // BLOCK)],
            ),
            (noise.pixel[noisy] - first, noise_times),
            EventRules(refractory_us, first, low, span_us[0], span_us[1] - span_us[0]),
        )
        return keys

    parts = run_parts(advance, split(light.now.size, count_threads(), unit=PIXELS_PER_THREAD))
    keys = parts[0] if len(parts) == 1 else np.concatenate(parts)
    return sort_keyed_events(keys, span_us, shape)


@jit(error_model="numpy")
def _advance_blocks(
    start: tuple[Luma, Float64Array, Float64Array],
    stop: tuple[Luma, Float64Array | None, PhotoreceptorConstants],
    mismatch: PixelMismatch,
    state: CircuitState,
    noise: tuple[NDArray[np.int64], NDArray[np.int64]],
    rules: EventRules,
) -> Uint64Array:
    (before, brightness, cutoff), (now, table, optics) = start, stop
    start_us, duration = rules.start_us, float(rules.duration_us)
    stop_us = start_us + rules.duration_us
    keys, found = np.empty(now.size // 16 + noise[0].size + 64, np.uint64), 0
    events, work = np.empty((2, 2 * LANES), np.uint64), new_work()
    noise_pixel, noise_done, loaded = noise[0], 0, 0
    block = new_block()
    for first in range(0, now.size, BLOCK):
        last = min(first + BLOCK, now.size)
        noise_first = noise_done
        while noise_done < noise_pixel.size and noise_pixel[noise_done] < last:
            noise_done += 1
        is_static = is_equal(before[first:last], now[first:last])
        is_undisturbed = is_static and noise_first == noise_done
        if is_undisturbed and stop_us <= state.quiescent_until_us[first // BLOCK]:
            continue
        size = last - first
        block.brightness[:size], block.cutoff[:size] = brightness[first:last], cutoff[first:last]
        _convert(now[first:last], table, optics, block.brightness_stop, block.cutoff_stop)
        before[first:last] = now[first:last]
        brightness[first:last] = block.brightness_stop[:size]
        cutoff[first:last] = block.cutoff_stop[:size]
        own = (
            PixelMismatch(
                mismatch.threshold_on[first:last],
                mismatch.threshold_off[first:last],
                mismatch.leak[first:last],
            ),
            CircuitState(
                state.output[first:last],
                state.level[first:last],
                state.since_us[first:last],
                state.quiescent_until_us,
            ),
        )
        _advance_without_events(block, own[1].output, duration, optics.cutoff_per_level > 0)
        active = _list_active(block, own, stop_us, noise_pixel[noise_first:noise_done] - first)
        until_us = NOT_QUIESCENT
        if is_undisturbed and active == 0:
            until_us = _quiescent_until_us(block, own, stop_us)
        state.quiescent_until_us[first // BLOCK] = until_us
        if loaded + active > LANES:
            events, made = advance_lanes(work, loaded, state, optics, noise[1], rules, events)
            keys, found = append_by_lane(events[:, :made], work.events[:loaded], keys, found)
            loaded = 0
        load_lanes(work, loaded, (first, active, noise_first), block, own, noise, start_us)
        loaded += active
        own[1].output[:] = block.output[:size]
    events, made = advance_lanes(work, loaded, state, optics, noise[1], rules, events)
    keys, found = append_by_lane(events[:, :made], work.events[:loaded], keys, found)
    return keys[:found]


@jit(error_model="numpy")
def _convert(
    luma: Luma,
    table: Float64Array | None,
    optics: PhotoreceptorConstants,
    brightness: Float64Array,
    cutoff: Float64Array,
) -> None:
    """Fill in brightness and cutoff frequency; see `circuit.brightness_and_cutoff`."""
    if table is not None:
        for j in range(luma.size):
            brightness[j], cutoff[j] = table[0, luma[j]], table[1, luma[j]]
        return
    # A loop for each function: two in one need more registers than there are.
    current, size = cutoff, luma.size
    for j in range(size):
        current[j] = luma[j]
    if optics.gamma != 1.0:
        for j in range(size):
            current[j] = optics.gamma * natural_log((current[j] + ALMOST_BLACK) / WHITE)
        for j in range(size):
            current[j] = WHITE * exponential(current[j])
    for j in range(size):
        current[j] += optics.balance
    for j in range(size):
        brightness[j] = natural_log(current[j])
    for j in range(size):
        cutoff[j] = optics.cutoff_per_level * min(current[j], optics.most_current)


@jit(error_model="numpy")
def _advance_without_events(
    block: PixelBlock, output: Float64Array, duration: float, is_limited: bool
) -> None:
    """Outputs of the photoreceptors if nothing fires, and their bounds.

    Short loops over few arrays each: Numba fills vector registers in no others.
    """
    size, low, high, after = output.size, block.low, block.high, block.output
    begin, end, decay, gain = block.brightness, block.brightness_stop, block.decay, block.gain
    for j in range(size):
        low[j] = min(output[j], min(begin[j], end[j]))
        high[j] = max(output[j], max(begin[j], end[j]))
    if not is_limited:
        after[:size] = end[:size]
        return
    cutoff, cutoff_stop = block.cutoff, block.cutoff_stop
    for j in range(size):
        angle = (cutoff[j] + cutoff_stop[j]) * 0.5 * duration
        decay[j], gain[j] = decay_and_gain(angle)
    for j in range(size):
        lag = decay[j] * (begin[j] - output[j]) + gain[j] * (end[j] - begin[j])
        after[j] = end[j] - (0.0 if abs(lag) < SETTLED else lag)


@jit(error_model="numpy")
def _list_active(
    block: PixelBlock,
    own: tuple[PixelMismatch, CircuitState],
    stop_us: int,
    noisy: NDArray[np.int64],
) -> int:
    """List the pixels that may fire, those with noise among them; return how many."""
    (on, off, leak), (_, level, since_us, _) = own
    low, high, cannot_fire = block.low, block.high, block.cannot_fire
    size, quiet = level.size, 0
    for j in range(size):
        drift = np.float64(leak[j]) * np.float64(stop_us - since_us[j])
        # Written so that a pixel held in reset, whose level is NaN, may fire.
        is_quiet = (high[j] - level[j] + drift < on[j]) & (level[j] - low[j] < off[j])
        cannot_fire[j] = is_quiet
        quiet += is_quiet
    if quiet == size and noisy.size == 0:
        return 0
    for k in range(noisy.size):
        cannot_fire[noisy[k]] = False
    active = 0
    for j in range(size):
        block.active[active] = j
        active += not cannot_fire[j]
    return active


@jit(error_model="numpy")
def _quiescent_until_us(
    block: PixelBlock, own: tuple[PixelMismatch, CircuitState], stop_us: int
) -> int:
    """The time up to which no pixel of a settled block fires by its leak; else `stop_us`."""
    mismatch, state = own
    soonest, unsettled = np.inf, 0
    for j in range(state.output.size):
        unsettled |= block.output[j] != block.brightness[j]
        left = mismatch.threshold_on[j] - (block.output[j] - state.level[j])
        after = left / np.float64(mismatch.leak[j]) + np.float64(state.since_us[j])
        soonest = min(soonest, float(after))
    # A microsecond for rounding.
    return stop_us if unsettled else int(min(soonest, float(FOREVER))) - 1
