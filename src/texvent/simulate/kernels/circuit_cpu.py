"""The pixel circuits, compiled by Numba: the reference's bits."""

from __future__ import annotations

import math

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE, SIGNAL
from texvent.simulate.firings import Firings
from texvent.simulate.kernels.circuit import Arrivals, Drive, Pixels, PixelState, ResetRules
from texvent.simulate.kernels.circuit_reference import LEAK_SHARE, NEVER, answer_to_line

# Numba's cache looks at this file only: whoever changes answer_to_line must touch this one as well.
_answer_to_line = numba.njit(cache=True, nogil=True, inline="always")(answer_to_line)

Events = tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.uint8], NDArray[np.uint8]]


def advance_pixels(
    drive: Drive,
    pixels: Pixels,
    state: PixelState,
    noise: Arrivals,
    rules: ResetRules,
    span_us: tuple[int, int],
) -> Firings:
    """Every event between two frames; see `circuit_reference.advance_pixels`."""
    active = np.empty(drive.rise.size, np.bool_)
    room = _find_active(drive, pixels, state, noise, span_us, active)
    events = (
        np.empty(room, np.int64),
        np.empty(room, np.int64),
        np.empty(room, np.uint8),
        np.empty(room, np.uint8),
    )
    found = _advance_all(drive, pixels, state, noise, rules, span_us, active, events)
    pixel, t, p, label = events
    return Firings(pixel[:found], t[:found], p[:found], label[:found])


@numba.njit(cache=True, nogil=True)
def _find_active(
    drive: Drive,
    pixels: Pixels,
    state: PixelState,
    noise: Arrivals,
    span_us: tuple[int, int],
    active: NDArray[np.bool_],
) -> int:
    """Mark the pixels that may fire; return how many events there can be at most."""
    start_us, stop_us = span_us
    duration = stop_us - start_us
    room = noise.pixel.size
    active[:] = False
    for k in range(noise.pixel.size):
        active[noise.pixel[k]] = True
    for i in range(active.size):
        lag, end = state.lag[i], state.lag[i] + drive.rise[i]
        low = state.change[i] + min(min(lag, end), 0.0)
        high = state.change[i] + max(max(lag, end), 0.0)
        leak = pixels.leak[i] * duration
        high += leak
        on, off = pixels.threshold_on[i], pixels.threshold_off[i]
        if high >= on or -low >= off or state.release_us[i] > start_us:
            active[i] = True
        if active[i]:
            # The output turns round at most once, so it travels at most twice its range; with
            # what it had travelled before, each threshold of travel is one event at most.
            travel = 2.0 * (high - low) + leak + abs(state.change[i])
            room += int(travel / min(on, off)) + 2
    return room


@numba.njit(cache=True, nogil=True)
def _advance_all(
    drive: Drive,
    pixels: Pixels,
    state: PixelState,
    noise: Arrivals,
    rules: ResetRules,
    span_us: tuple[int, int],
    active: NDArray[np.bool_],
    events: Events,
) -> int:
    """Fill in the events and bring every pixel to the end; return how many events there are."""
    start_us, stop_us = span_us
    duration = stop_us - start_us
    found, first_noise = 0, 0
    for i in range(active.size):
        if not active[i]:
            lag = drive.decay[i] * state.lag[i] + drive.gain[i] * drive.rise[i]
            leak = pixels.leak[i] * duration
            change = state.change[i] + (drive.rise[i] - (lag - state.lag[i])) + leak
            state.lag[i], state.change[i] = lag, change
            state.leaked[i] += leak
            continue
        last_noise = first_noise
        while last_noise < noise.pixel.size and noise.pixel[last_noise] == i:
            last_noise += 1
        found = _advance_one(
            i,
            (drive, pixels, state),
            (noise, first_noise, last_noise),
            rules,
            span_us,
            events,
            found,
        )
        first_noise = last_noise
    return found


@numba.njit(cache=True, nogil=True, inline="always")
def _advance_one(
    i: int,
    circuit: tuple[Drive, Pixels, PixelState],
    own_noise: tuple[Arrivals, int, int],
    rules: ResetRules,
    span_us: tuple[int, int],
    events: Events,
    found: int,
) -> int:
    """Send one pixel through the pieces of the interval."""
    drive, pixels, state = circuit
    noise, k, last_noise = own_noise
    start_us, stop_us = span_us
    duration = stop_us - start_us
    on, off, leak = pixels.threshold_on[i], pixels.threshold_off[i], pixels.leak[i]
    lag, change, leaked = state.lag[i], state.change[i], state.leaked[i]
    release = float(state.release_us[i] - start_us)
    pieces = drive.pieces[i]
    length = duration / pieces
    rise, glow, growth = drive.rise[i] / pieces, drive.glow[i], drive.growth[i]
    for piece in range(pieces):
        decay, gain = _answer_to_line(drive.corner_per_level * (glow + drive.corner_level) * length)
        glow *= growth
        new_lag = decay * lag + gain * rise
        slope = (rise - (new_lag - lag)) / length + leak
        now = piece * length
        end = float(duration) if piece == pieces - 1 else (piece + 1) * length
        while True:
            if release > now:
                change, leaked = 0.0, 0.0
                k = _skip_until(start_us + release, noise.t, k, last_noise)
                if release > end:
                    break
                now = release
            wait, p = _time_to_threshold(change, slope, on, off)
            crossing = now + wait
            arrival = float(noise.t[k] - start_us) if k < last_noise else NEVER
            event = min(crossing, arrival)
            elapsed = min(event, end) - now
            change += slope * elapsed
            leaked += leak * elapsed
            if event > end:
                break
            now = event
            label, resets = SIGNAL, True
            if arrival <= crossing:
                p, label, resets = int(noise.p[k]), NOISE, rules.by_noise
                k += 1
            elif p == 1 and leaked >= LEAK_SHARE * on:
                label = NOISE
            offset = math.floor(now)
            events[0][found], events[1][found] = i, min(start_us + offset, stop_us - 1)
            events[2][found], events[3][found] = p, label
            found += 1
            if resets:
                change, leaked = 0.0, 0.0
                if rules.refractory_us > 0:
                    release = float(offset + rules.refractory_us)
        lag = new_lag
    state.lag[i], state.change[i], state.leaked[i] = lag, change, leaked
    state.release_us[i] = start_us + int(release)
    return found


@numba.njit(cache=True, nogil=True, inline="always")
def _skip_until(time_us: float, t: NDArray[np.int64], k: int, last: int) -> int:
    """The first of the noise events k, k + 1, ..., last − 1 that is not before a time."""
    while k < last and t[k] < time_us:
        k += 1
    return k


@numba.njit(cache=True, nogil=True, inline="always")
def _time_to_threshold(change: float, slope: float, on: float, off: float) -> tuple[float, int]:
    """See `circuit_reference`."""
    if change >= on:
        return 0.0, 1
    if -change >= off:
        return 0.0, 0
    if slope > 0:
        return (on - change) / slope, 1
    if slope < 0:
        return (-off - change) / slope, 0
    return NEVER, 0
