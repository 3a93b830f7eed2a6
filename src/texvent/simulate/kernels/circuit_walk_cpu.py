"""One pixel circuit on its way through the interval, compiled by Numba for `circuit_cpu`.

Arguments are numbers in tuples and two arrays: Numba counts the references to every array of a
tuple whenever it is passed on, and that costs more than most pixels do.
"""

from __future__ import annotations

import math

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE, SIGNAL
from texvent.simulate.kernels.circuit_reference import (
    FEWEST_PER_LOG,
    LEAK_SHARE,
    MOST_PER_LOG,
    SETTLED,
    STRAIGHT,
)
from texvent.simulate.kernels.crossing_time import NEGLIGIBLE, NEVER
from texvent.simulate.kernels.crossing_time_cpu import time_to_threshold
from texvent.simulate.kernels.elementary_cpu import decay_and_gain, exponential

Events = NDArray[np.int64]
"""[3, room] pixel, time in µs, and p + 2 · label."""


@numba.njit(cache=True, nogil=True, error_model="numpy")
def walk_pixel(
    where: tuple[int, int, int, int, bool],
    circuit: tuple[float, float, float, float, float],
    sight: tuple[float, float, float, float],
    held: tuple[float, float, float],
    own_noise: tuple[int, int],
    noise_times: NDArray[np.int64],
    events: Events,
    found: int,
) -> tuple[int, float, float, float]:
    """Send one pixel through the pieces of the interval.

    Returns:
        How many events there are now, −1 if there was no room for them; and output, level and the
        time since the last reset at the end.
    """
    corner_per_level, corner_offset, on, off, leak = circuit
    bright, bright_now, corner, corner_now = sight
    output, level, since = held
    duration = float(where[2] - where[1])
    rise = bright_now - bright
    angle, size = max(corner, corner_now) * duration, abs(rise)
    pieces = np.ceil(min(max(angle, FEWEST_PER_LOG * size), MOST_PER_LOG * size))
    pieces = max(pieces, 1.0) if angle > 0 else 1.0
    length, slope = duration / pieces, rise / duration
    lag, corner_from = bright - output, corner
    base, tilt, transient, kept = bright, slope, 0.0, 1.0
    glow, growth = exponential(bright), exponential(rise / pieces)
    k, last_k = own_noise
    for piece in range(int(pieces)):
        end = duration if piece == pieces - 1.0 else (piece + 1.0) * length
        now = piece * length
        if corner_per_level > 0:
            ahead = glow * growth
            mean = (glow + ahead) * (1 / 6) + math.sqrt(glow * ahead) * (2 / 3)
            corner = corner_per_level * (mean + corner_offset)
            corner_to = corner_per_level * (ahead + corner_offset)
            angle = corner * length
            kept, gain = decay_and_gain(angle)
            is_straight = angle < STRAIGHT
            bend = (corner_to - corner_from) / corner * 0.5
            curl = (angle - 2.0 + kept * (angle + 2.0)) / (angle * angle)
            curl = 0.0 if is_straight else curl
            lag_to = lag * kept + slope * length * (gain - bend * curl)
            drop = slope - corner_from * lag
            room = 1.0 if is_straight else angle - 1.0 + kept
            transient = 0.0 if is_straight else (lag_to - lag - drop * length) / room
            drop = (lag_to - lag) / length if is_straight else drop + corner * transient
            tilt = slope - drop
            base = bright + slope * now - (lag - transient) - tilt * now
            lag, glow, corner_from = lag_to, ahead, corner_to
        level, since, k, found = _run_piece(
            where,
            (base, tilt, transient, corner, kept, now, end),
            (on, off, leak),
            (level, since),
            (k, last_k),
            noise_times,
            events,
            found,
        )
        if found < 0:
            break
    lag = 0.0 if abs(lag) < SETTLED else lag
    return found, bright_now - lag, level, since


@numba.njit(cache=True, nogil=True, inline="always", error_model="numpy")
def _run_piece(
    where: tuple[int, int, int, int, bool],
    piece: tuple[float, float, float, float, float, float, float],
    limits: tuple[float, float, float],
    reset: tuple[float, float],
    own_noise: tuple[int, int],
    noise_times: NDArray[np.int64],
    events: Events,
    found: int,
) -> tuple[float, float, int, int]:
    """Fire what there is to fire on a piece on which the corner frequency is constant."""
    i, start_us, stop_us, refractory_us, resets_by_noise = where
    base, tilt, transient, corner, kept, now, end = piece
    on, off, leak = limits
    level, since = reset
    k, last_k = own_noise
    while True:
        if since > now:
            k = _skip_until(since, noise_times, k, last_k)
            if since > end:
                break
            transient, kept = _decay(transient, corner, kept, since - now, since == end)
            now = since
            level = base + tilt * now - transient
        if abs(transient) <= NEGLIGIBLE * min(on, off):
            transient = 0.0
        change = base + tilt * now - transient - level + leak * (now - since)
        course = change, tilt + leak, transient, corner, end - now, kept
        wait, p = time_to_threshold(course, on, off)
        crossing = now + wait
        arrival = float(noise_times[k] >> 1) if k < last_k else NEVER
        event = min(crossing, arrival)
        if event > end:
            break
        transient, kept = _decay(transient, corner, kept, event - now, event == end)
        now = event
        label, resets = SIGNAL, True
        if arrival <= crossing:
            p, label, resets = int(noise_times[k] & 1), NOISE, resets_by_noise
            k += 1
        elif p == 1 and leak * (now - since) >= LEAK_SHARE * on:
            label = NOISE
        if found == events.shape[1]:
            return level, since, k, -1
        after = math.floor(now)
        events[0, found] = i
        events[1, found] = min(start_us + int(after), stop_us - 1)
        events[2, found] = p + 2 * label
        found += 1
        if resets:
            level = base + tilt * now - transient
            since = float(after + refractory_us)
    return level, since, k, found


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _decay(
    transient: float, corner: float, kept: float, elapsed: float, is_end: bool
) -> tuple[float, float]:
    """The transient after a time, and what share of it will be left at the end of the piece."""
    if is_end:
        return transient * kept, 1.0
    if transient == 0:
        return transient, kept
    now = exponential(-corner * elapsed)
    return transient * now, kept / now


@numba.njit(cache=True, nogil=True)
def _skip_until(time_us: float, noise_times: NDArray[np.int64], k: int, last_k: int) -> int:
    """The first of the noise events k, k + 1, ..., last_k − 1 that is not before a time."""
    while k < last_k and noise_times[k] >> 1 < time_us:
        k += 1
    return k
