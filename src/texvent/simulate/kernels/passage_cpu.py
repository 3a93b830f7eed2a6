"""First-passage sampling, compiled by Numba: pixel after pixel, the reference's bits."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.cpu_draws import draw_uniform
from texvent.simulate.kernels.elementary_cpu import cosine_of_turns, natural_log
from texvent.simulate.kernels.order import read_only
from texvent.simulate.kernels.passage import (
    CERTAIN,
    DRAWS_PER_EVENT,
    FIRST_DRAW,
    MOST_RESIDUAL,
    Constants,
    Float64Array,
    Light,
    Motion,
    Passages,
    Voltage,
)
from texvent.simulate.kernels.passage_reference import motion_of
from texvent.simulate.kernels.threads import count_threads, run_parts, split

# Numba's cache looks at this file only: whoever changes `motion_of` must touch this one as well.
_motion_of = numba.njit(cache=True, nogil=True, error_model="numpy")(motion_of)

Found = Float64Array
"""[3, room] pixel, time after the start in µs, and p + 2 · is noise. One array, for Numba counts
the references to each array of a tuple whenever it is passed on."""
BLOCK = 256
SHARE = 32 * BLOCK
"""Fewest pixels that are worth a thread of their own."""


class _Block(NamedTuple):
    """What is known of the pixels of one block, [BLOCK] each."""

    signal: Float64Array
    drift: Float64Array
    sigma: Float64Array
    distance: Float64Array
    """To the threshold in the direction of the drift."""
    normal: Float64Array
    chance: Float64Array
    gap: Float64Array
    """Time until it is reached, µs."""
    is_calm: NDArray[np.bool_]


def find_passages(motion: Motion, voltage: Voltage, key: np.uint64, duration_us: float) -> Passages:
    """Alternate between polarity and time; see `passage_reference.find_passages`."""
    return _find(motion, None, voltage, key, duration_us, 0)


def find_passages_in_light(
    light: Light, voltage: Voltage, key: np.uint64, duration_us: float
) -> Passages:
    """See `passage_reference.find_passages_in_light`."""
    height, width = light.now.shape

    def find(rows: slice) -> Passages:
        ends = read_only(light.before[rows]), read_only(light.now[rows]), light.constants
        volts = Voltage(voltage.residual[rows], voltage.signal[rows])
        return _find(None, ends, volts, key, duration_us, light.first_row + rows.start)

    # A pixel of this model takes as long as several of others: small frames are worth sharing.
    parts = run_parts(find, split(height, count_threads(), unit=max(1, SHARE // width)))
    return Passages(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))


def warm_up(dtype: str) -> None:
    """Compile for one type of frames, or load what was compiled before."""
    luma, voltage = np.zeros((1, 1), dtype), Voltage(np.zeros((1, 1)), np.zeros((1, 1)))
    light = Light(luma, luma, Constants(1.0, 1.0, 0.0, 0.0, 0.0, 0.0))
    find_passages_in_light(light, voltage, np.uint64(0), 1.0)


def _find(
    motion: Motion | None,
    ends: tuple[NDArray[Any], NDArray[Any], Constants] | None,
    voltage: Voltage,
    key: np.uint64,
    duration_us: float,
    first_row: int,
) -> Passages:
    width = voltage.residual.shape[1]
    flat = None
    if motion is not None:
        flat = motion.signal.reshape(-1), motion.drift.reshape(-1), motion.sigma.reshape(-1)
    volts = voltage.residual.reshape(-1), voltage.signal.reshape(-1)
    place = first_row * width, width
    # With NUMBA_DISABLE_JIT=1 this runs in NumPy, which would warn where the hash wraps around and
    # where extremes overflow.
    with np.errstate(all="ignore"):
        pixel, after, kind = _find_passages(flat, ends, volts, place, key, float(duration_us))
    kinds = kind.astype(np.uint8)
    return Passages(pixel.astype(np.int64), after, kinds & 1, (kinds >> 1).astype(np.bool_))


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _find_passages(
    motion: tuple[Float64Array, Float64Array, Float64Array] | None,
    ends: tuple[NDArray[Any], NDArray[Any], Constants] | None,
    volts: tuple[Float64Array, Float64Array],
    place: tuple[int, int],
    key: np.uint64,
    duration_us: float,
) -> Found:
    residual, driven = volts
    events, found = np.empty((3, residual.size // 4 + 64)), 0
    block = _Block(
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK, np.bool_),
    )
    for first in range(0, residual.size, BLOCK):
        last = min(first + BLOCK, residual.size)
        if motion is not None:
            size = last - first
            block.signal[:size] = motion[0][first:last]
            block.drift[:size] = motion[1][first:last]
            block.sigma[:size] = motion[2][first:last]
        if ends is not None:
            before, now, constants = ends
            _see(before[first:last], now[first:last], constants, duration_us, block)
        way, gone = residual[first:last], driven[first:last]
        _draw(block, place[0] + first, place[1], key, way.size)
        if _drift(block, way, gone, duration_us) == way.size:
            continue
        for j in range(way.size):
            if block.is_calm[j]:
                continue
            pace = block.signal[j], block.drift[j], block.sigma[j]
            while True:
                filled, left, part = _walk(
                    place[0] + first + j,
                    place[1],
                    key,
                    pace,
                    (way[j], gone[j]),
                    duration_us,
                    events,
                    found,
                )
                if filled >= 0:
                    break
                events = _grown(events)
            found, way[j], gone[j] = filled, left, part
    return events[:, :found]


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _see(
    before: NDArray[Any],
    now: NDArray[Any],
    constants: Constants,
    duration_us: float,
    block: _Block,
) -> None:
    for j in range(now.size):
        block.signal[j], block.drift[j], block.sigma[j] = _motion_of(
            np.float64(before[j]), np.float64(now[j]), duration_us, constants
        )


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _draw(block: _Block, first: int, width: int, key: np.uint64, size: int) -> None:
    """The random numbers of each pixel's first passage, the polarity's apart."""
    for j in range(size):
        y = (first + j) // width
        x = first + j - y * width
        block.normal[j] = 1.0 - draw_uniform(key, y, x, FIRST_DRAW + 1)
        block.gap[j] = draw_uniform(key, y, x, FIRST_DRAW + 2)
        block.chance[j] = draw_uniform(key, y, x, FIRST_DRAW + 3)
    for j in range(size):
        block.normal[j] = math.sqrt(-2.0 * natural_log(block.normal[j])) * cosine_of_turns(
            block.gap[j]
        )


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _drift(block: _Block, way: Float64Array, driven: Float64Array, duration_us: float) -> int:
    """Move the pixels that go with the drift for sure and do not arrive; return how many."""
    for j in range(way.size):
        speed, sigma = abs(block.drift[j]), block.sigma[j]
        forward = 1.0 if block.drift[j] >= 0 else -1.0
        against = 1.0 + forward * way[j]
        block.distance[j] = 1.0 - forward * way[j]
        # Not so where there is no diffusion or no drift, which is NaN or 0.
        block.is_calm[j] = 2.0 * speed / (sigma * sigma) * against > CERTAIN
    for j in range(way.size):
        speed = abs(block.drift[j])
        block.gap[j] = _passage_time(
            block.distance[j], speed, block.sigma[j], block.normal[j], block.chance[j]
        )
    calm = 0
    for j in range(way.size):
        is_calm = block.is_calm[j] & (block.gap[j] >= duration_us)
        block.is_calm[j] = is_calm
        calm += is_calm
    for j in range(way.size):
        forward = 1.0 if block.drift[j] >= 0 else -1.0
        gone = way[j] + forward * block.distance[j] * (duration_us / block.gap[j])
        gone = min(max(gone, -MOST_RESIDUAL), MOST_RESIDUAL)
        way[j] = gone if block.is_calm[j] else way[j]
    for j in range(way.size):
        driven[j] += block.signal[j] * duration_us if block.is_calm[j] else 0.0
    return calm


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _walk(
    i: int,
    width: int,
    key: np.uint64,
    pace: tuple[float, float, float],
    volts: tuple[float, float],
    duration_us: float,
    events: Found,
    found: int,
) -> tuple[int, float, float]:
    """One pixel, passage after passage.

    Returns:
        How many events there are now, −1 if there was no room for them; and where the voltage is.
    """
    y = i // width
    x = i - y * width
    now, order = 0.0, FIRST_DRAW
    signal, drift, sigma = pace
    forward = 1.0 if drift >= 0 else -1.0
    way, driven = volts
    while True:
        sign, distance, gap = _sample((abs(drift), sigma), forward, way, (key, y, x, order))
        if not now + gap < duration_us:
            break
        if found == events.shape[1]:
            return -1, way, driven
        is_noise = sign * (driven + signal * gap) < 0.5
        events[0, found], events[1, found] = i, now + gap
        events[2, found] = (1 if sign > 0 else 0) + (2 if is_noise else 0)
        found += 1
        now += gap
        way = driven = 0.0
        order += DRAWS_PER_EVENT
    left = duration_us - now
    gone = way + sign * distance * (left / gap)
    return found, min(max(gone, -MOST_RESIDUAL), MOST_RESIDUAL), driven + signal * left


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _sample(
    pace: tuple[float, float], forward: float, way: float, draw: tuple[np.uint64, int, int, int]
) -> tuple[float, float, float]:
    """The direction, distance and time of the next passage."""
    speed, sigma = pace
    key, y, x, order = draw
    along, against = 1.0 - forward * way, 1.0 + forward * way
    is_along = draw_uniform(key, y, x, order) < _chance_along(speed, sigma, along, against)
    sign = forward if is_along else -forward
    distance = along if is_along else against
    normal = math.sqrt(-2.0 * natural_log(1.0 - draw_uniform(key, y, x, order + 1)))
    normal = normal * cosine_of_turns(draw_uniform(key, y, x, order + 2))
    chance = draw_uniform(key, y, x, order + 3)
    return sign, distance, _passage_time(distance, speed, sigma, normal, chance)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _chance_along(speed: float, sigma: float, along: float, against: float) -> float:
    steer = 0.0 if speed == 0 else 2.0 * speed / (sigma * sigma)
    if steer * against > CERTAIN:
        return 1.0
    whole = math.expm1(-steer * (along + against))
    if whole == 0:
        return against / (along + against)
    return math.expm1(-steer * against) / whole


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _passage_time(
    distance: float, speed: float, sigma: float, normal: float, chance: float
) -> float:
    spread, pull = sigma * sigma * normal * normal, 2.0 * speed * distance
    mean = distance / speed
    w, q = spread / pull, pull / spread
    # Both roots, then one of them: without branches this fills vector registers.
    with_drift = mean / (1.0 + w + math.sqrt(w * (w + 2.0)))
    with_noise = 2.0 * distance * distance / spread / (1.0 + q + math.sqrt(1.0 + 2.0 * q))
    short = with_drift if spread < pull else with_noise
    long = mean * mean / short
    time = short if (speed == 0) | (chance * (mean + short) <= mean) else long
    return math.inf if (spread == 0) & (speed == 0) else time


@numba.njit(cache=True, nogil=True)
def _grown(events: Found) -> Found:
    """The same events with room for as many again."""
    larger = np.empty((3, 2 * events.shape[1]))
    larger[:, : events.shape[1]] = events
    return larger
