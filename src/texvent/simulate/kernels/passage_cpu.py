"""First-passage sampling, compiled by Numba: pixel after pixel, the reference's bits."""

from __future__ import annotations

import math

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.cpu_draws import draw_uniform
from texvent.simulate.kernels.passage import (
    DRAWS_PER_EVENT,
    FIRST_DRAW,
    MOST_RESIDUAL,
    Float64Array,
    Motion,
    Passages,
    Voltage,
)

Columns = tuple[NDArray[np.int64], Float64Array, NDArray[np.uint8], NDArray[np.bool_]]


def find_passages(motion: Motion, voltage: Voltage, key: np.uint64, duration_us: float) -> Passages:
    """Alternate between polarity and time; see `passage_reference.find_passages`."""
    # With NUMBA_DISABLE_JIT=1 this runs in NumPy, which would warn where the hash wraps around and
    # where extremes overflow.
    with np.errstate(all="ignore"):
        return Passages(*_find_passages(motion, voltage, key, float(duration_us)))


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _find_passages(motion: Motion, voltage: Voltage, key: np.uint64, duration_us: float) -> Columns:
    height, width = motion.drift.shape
    columns = _columns(height * width)
    found = 0
    for y in range(height):
        for x in range(width):
            now, order = 0.0, FIRST_DRAW
            signal, speed = motion.signal[y, x], abs(motion.drift[y, x])
            forward = 1.0 if motion.drift[y, x] >= 0 else -1.0
            way, driven = voltage.residual[y, x], voltage.signal[y, x]
            while True:
                sign, distance, gap = _sample(
                    (speed, motion.sigma[y, x]), forward, way, (key, y, x, order)
                )
                if not now + gap < duration_us:
                    break
                if found == columns[0].size:
                    columns = _grown(columns)
                columns[0][found] = y * width + x
                columns[1][found] = now + gap
                columns[2][found] = sign > 0
                columns[3][found] = sign * (driven + signal * gap) < 0.5
                found += 1
                now += gap
                way = driven = 0.0
                order += DRAWS_PER_EVENT
            left = duration_us - now
            gone = way + sign * distance * (left / gap)
            voltage.residual[y, x] = min(max(gone, -MOST_RESIDUAL), MOST_RESIDUAL)
            voltage.signal[y, x] = driven + signal * left
    return columns[0][:found], columns[1][:found], columns[2][:found], columns[3][:found]


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
    normal = math.sqrt(-2.0 * math.log(1.0 - draw_uniform(key, y, x, order + 1)))
    normal = normal * math.cos(2.0 * math.pi * draw_uniform(key, y, x, order + 2))
    chance = draw_uniform(key, y, x, order + 3)
    return sign, distance, _passage_time(distance, speed, sigma, normal, chance)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _chance_along(speed: float, sigma: float, along: float, against: float) -> float:
    steer = 0.0 if speed == 0 else 2.0 * speed / (sigma * sigma)
    whole = math.expm1(-steer * (along + against))
    if whole == 0:
        return against / (along + against)
    return math.expm1(-steer * against) / whole


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _passage_time(
    distance: float, speed: float, sigma: float, normal: float, chance: float
) -> float:
    spread, pull = sigma * sigma * normal * normal, 2.0 * speed * distance
    if spread == 0 and speed == 0:
        return math.inf
    mean = distance / speed
    if spread < pull:
        w = spread / pull
        short = mean / (1.0 + w + math.sqrt(w * (w + 2.0)))
    else:
        q = pull / spread
        short = 2.0 * distance * distance / spread / (1.0 + q + math.sqrt(1.0 + 2.0 * q))
    if speed == 0 or chance * (mean + short) <= mean:
        return short
    return mean * mean / short


@numba.njit(cache=True, nogil=True)
def _columns(size: int) -> Columns:
    return (
        np.empty(size, np.int64),
        np.empty(size, np.float64),
        np.empty(size, np.uint8),
        np.empty(size, np.bool_),
    )


@numba.njit(cache=True, nogil=True)
def _grown(columns: Columns) -> Columns:
    """The same columns with room for as many events again."""
    size = columns[0].size
    larger = _columns(2 * size)
    larger[0][:size] = columns[0]
    larger[1][:size] = columns[1]
    larger[2][:size] = columns[2]
    larger[3][:size] = columns[3]
    return larger
