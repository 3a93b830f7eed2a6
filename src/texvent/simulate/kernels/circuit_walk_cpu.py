"""One pixel circuit on its way through an interval, compiled by Numba for `circuit_cpu`.

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
    LEAK_SHARE,
    PIECES_PER_ANGLE,
    PIECES_PER_LOG,
    SETTLED,
)
from texvent.simulate.kernels.crossing_time import NEGLIGIBLE, NEVER
from texvent.simulate.kernels.crossing_time_cpu import time_to_threshold
from texvent.simulate.kernels.elementary_cpu import exponential

Events = NDArray[np.int64]
"""[3, room] pixel, time in µs, and p + 2 · label."""
SLACK = 1e-9
"""Log units by which bounds are widened, for what is rounded."""


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
    fine = max(corner, corner_now) * duration * PIECES_PER_ANGLE
    pieces = max(math.ceil(min(abs(rise) * PIECES_PER_LOG, fine)), 1.0)
    length, slope = duration / pieces, rise / duration
    lag, steady, transient = bright - output, 0.0, 0.0
    corner = (corner + corner_now) * 0.5
    glow, growth, kept = 0.0, 1.0, 1.0
    if pieces > 1.0:
        glow, growth = exponential(bright + rise * (0.5 / pieces)), exponential(rise / pieces)
    k, last_k = own_noise
    for piece in range(int(pieces)):
        end = duration if piece == pieces - 1.0 else (piece + 1.0) * length
        if corner_per_level > 0:
            if pieces > 1.0:
                corner = corner_per_level * (glow + corner_offset)
                glow *= growth
            steady = slope / corner
            transient = lag - steady
            kept = exponential(-corner * (end - piece * length))
        transient, level, since, k, found = _run_piece(
            where,
            (bright, slope, steady, transient, corner, kept, piece * length, end),
            (on, off, leak),
            (level, since),
            (k, last_k),
            noise_times,
            events,
            found,
        )
        if found < 0:
            break
        lag = steady + transient
    lag = 0.0 if abs(lag) < SETTLED else lag
    return found, bright_now - lag, level, since


@numba.njit(cache=True, nogil=True, inline="always", error_model="numpy")
def _run_piece(
    where: tuple[int, int, int, int, bool],
    course: tuple[float, float, float, float, float, float, float, float],
    limits: tuple[float, float, float],
    reset: tuple[float, float],
    own_noise: tuple[int, int],
    noise_times: NDArray[np.int64],
    events: Events,
    found: int,
) -> tuple[float, float, float, int, int]:
    """Fire what there is to fire on a piece on which the corner frequency is constant."""
    i, start_us, stop_us, refractory_us, resets_by_noise = where
    bright, slope, steady, transient, corner, kept, now, end = course
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
            level = bright + slope * now - steady - transient
        if abs(transient) <= NEGLIGIBLE * min(on, off):
            transient = 0.0
        line = bright + slope * now, slope, bright + slope * end
        crossing, p = _next_crossing(
            line, (steady, transient, corner, kept), (now, end), limits, (level, since)
        )
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
            return transient, level, since, k, -1
        after = math.floor(now)
        events[0, found] = i
        events[1, found] = min(start_us + int(after), stop_us - 1)
        events[2, found] = p + 2 * label
        found += 1
        if resets:
            level = bright + slope * now - steady - transient
            since = float(after + refractory_us)
    return transient * kept, level, since, k, found


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


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _next_crossing(
    line: tuple[float, float, float],
    lag: tuple[float, float, float, float],
    span: tuple[float, float],
    limits: tuple[float, float, float],
    reset: tuple[float, float],
) -> tuple[float, int]:
    """When the change next reaches a threshold, and its polarity."""
    (bright, slope, bright_end), (steady, transient, corner, kept) = line, lag
    (now, end), (on, off, leak), (level, since) = span, limits, reset
    output = bright - steady - transient
    way = output - level, bright - level, bright_end - level
    if not _may_fire(way, leak * (end - since), on, off):
        return NEVER, 0
    change = output - level + leak * (now - since)
    course = change, slope + leak, transient, corner, end - now, kept
    wait, p = time_to_threshold(course, on, off)
    return now + wait, p


@numba.njit(cache=True, nogil=True)
def _may_fire(way: tuple[float, float, float], leaked: float, on: float, off: float) -> bool:
    """Whether a low-pass can get to a threshold, given how far it and its input are from reset."""
    output, begin, end = way
    high, low = max(output, max(begin, end)), min(output, min(begin, end))
    return high + leaked >= on - SLACK or -low >= off - SLACK
