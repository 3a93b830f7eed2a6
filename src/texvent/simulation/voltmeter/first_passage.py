"""First passages of Brownian motion with drift, compiled: block of pixels by block.

Where the luma does not change, drift and diffusion stay as they are. So a first passage that was
drawn once holds until it happens or the luma changes, over as many frames as that takes.

Pixels whose luma changed or that are about to cross a threshold are active. Blocks without an
active pixel are skipped. The active pixels of a block are put side by side, in lanes, and sampled
in rounds: the next first passages of all lanes are drawn in loops that fill vector registers, and
lanes that reach the end of the interval leave.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE
from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import read_only
from texvent.runtime.threads import count_threads, run_parts, split
from texvent.simulation.kernels.active_pixels import WORD, append_by_lane, list_marked, make_room
from texvent.simulation.kernels.compiled_elementary import cosine_of_turns, natural_log
from texvent.simulation.kernels.radix_sort import key_bits, sort_keyed_events
from texvent.simulation.packets import FrameInterval, SortedEvents
from texvent.simulation.random.compiled_draws import draw_halves_at, draw_uniform_at, place_of
from texvent.simulation.random.draws import Purpose
from texvent.simulation.voltmeter.config import Constants
from texvent.simulation.voltmeter.voltage import (
    BLOCK,
    LONGEST_US,
    FirstPassageInput,
    Float64Array,
    Voltage,
    drift_and_diffusion,
)

FIRST_DRAW: int = Purpose.FIRST_PASSAGE.draw()
DRAWS_PER_PASSAGE = 3
"""Polarity, the size of a normal number, and its angle with which of two roots."""
CERTAIN = 40.0
"""e^(−40) vanishes beside 1: where `s · against` is above, the drift decides the direction."""
MOST_DISPLACEMENT = 1.0 - 2.0**-52
"""Displacements kept between intervals stay between both thresholds, whatever is rounded."""
Uint64Array = NDArray[np.uint64]
_drift_and_diffusion = jit(error_model="numpy")(drift_and_diffusion)

PIXELS_PER_THREAD = 16 * BLOCK
"""Fewest pixels that are worth a thread of their own."""
ROOM = BLOCK + 8
"""Columns of `lanes`: rows a power of two apart would share few lines of the nearest cache."""
(
    DISPLACEMENT,
    SINCE,
    NEXT_CROSSING,
    RATE,
    BY_SIGNAL,
    SIGNAL_DRIFT,
    DIRECTION,
    SPEED,
    VARIANCE,
    SQUARE,
    CHANCE,
    DISTANCE,
) = range(12)
"""Rows of `lanes`, [12, BLOCK] float64: motion of the active pixels, as
`drift_and_diffusion` gives it. BY_SIGNAL is the signal displacement, DIRECTION the sign of the
drift, VARIANCE σ². It is one array because Numba counts the references to each array passed on."""
PIXEL, FIRST_LANE, PLACE = range(3)
"""Rows of `lane_of`, [3, BLOCK] uint64: the pixel in each lane, the lane it had at first, and its
row and column."""
VoltageFields = tuple[
    Float64Array, Float64Array, NDArray[np.uint8], NDArray[np.float32], Float64Array
]
"""The fields of `Voltage`."""
_1, _2 = np.uint64(1), np.uint64(2)
_NOISE = np.uint64(NOISE)


def find_first_passages(
    light: FirstPassageInput, voltage: Voltage, interval: FrameInterval, first_us: int
) -> SortedEvents:
    """Alternate between choosing a polarity and sampling a time, until the interval ends.

    Where the luma does not change, a first passage beyond the end is remembered, and its pixel
    needs no further draw until then. A change of luma before that ends it: the displacement is then
    the share of the distance that the elapsed time makes up.

    Args:
        light: over the interval; `before` is overwritten with `now`.
        voltage: of every pixel at the start; brought up to date here.
        interval: where in time; its key decides the draws.
        first_us: time of the first frame, µs.

    Returns:
        The events in the order of a packet; times rounded down.

    Raises:
        InputError: the interval is too long for a sensor of this size.

    Source: Lin et al., "DVS-Voltmeter: stochastic process-based event simulator for dynamic
        vision sensors", ECCV 2022, Algorithm 1.
    """
    shape = light.now.shape
    low = key_bits(interval.duration_us, shape)
    before, now = light.before.reshape(-1), read_only(light.now.reshape(-1))
    span = float(interval.start_us - first_us), float(interval.stop_us - first_us)

    def find(part: slice) -> Uint64Array:
        blocks = slice(part.start // BLOCK, -(-part.stop // BLOCK))
        fields = (
            voltage.next_crossing_us[part],
            voltage.rate[part],
            voltage.has_changed[part].view(np.uint8),
            voltage.signal_displacement[part],
            voltage.quiescent_until_us[blocks],
        )
        place = part.start, shape[1], low
        keys: Uint64Array = _find_first_passages(
            (before[part], now[part]), light.constants, fields, place, interval.key, span
        )
        return keys

    # A pixel of this model takes as long as several of others: small frames are worth sharing.
    parts = run_parts(find, split(now.size, count_threads(), unit=PIXELS_PER_THREAD))
    keys = parts[0] if len(parts) == 1 else np.concatenate(parts)
    return sort_keyed_events(keys, (interval.start_us, interval.stop_us), shape)


@jit(error_model="numpy")
def _find_first_passages(
    ends: tuple[NDArray[Any], NDArray[Any]],
    constants: Constants,
    fields: VoltageFields,
    place: tuple[int, int, int],
    key: np.uint64,
    span: tuple[float, float],
) -> Uint64Array:
    before, now = ends
    next_us, rate, has_changed, by_signal, quiescent_until_us = fields
    stop, base = span[1], (np.uint64(place[0]), np.uint64(place[2]), span[0])
    keys, found = np.empty(now.size // 4 + 64, np.uint64), 0
    lanes, lane_of = np.empty((12, ROOM)), np.empty((3, ROOM), np.uint64)
    words, listed = np.zeros((2, BLOCK // WORD), np.uint64), np.empty((2, BLOCK + WORD), np.int64)
    changes, marks = words[0].view(np.uint8), words[1].view(np.uint8)
    events, count = np.empty((2, 2 * BLOCK), np.uint64), np.empty(BLOCK, np.int64)
    for first in range(0, now.size, BLOCK):
        last = min(first + BLOCK, now.size)
        is_static = _mark_changes(before[first:last], now[first:last], changes)
        if is_static and quiescent_until_us[first // BLOCK] >= stop:
            continue
        _mark_active(next_us[first:last], stop, changes, has_changed[first:last], marks)
        active, made, order = list_marked(words[1], marks, listed[0]), 0, FIRST_DRAW
        quiescent_until_us[first // BLOCK] = (
            _earliest(next_us[first:last]) if is_static and active == 0 else -np.inf
        )
        pixel = lane_of[PIXEL, :active]
        for k in range(active):
            pixel[k] = first + listed[0, k]
        for k in range(active):
            i = pixel[k]
            lanes[SQUARE, k], lanes[CHANCE, k] = before[i], now[i]
            lanes[DISTANCE, k] = changes[listed[0, k]]
            lanes[NEXT_CROSSING, k], lanes[RATE, k] = next_us[i], rate[i]
            lanes[BY_SIGNAL, k] = by_signal[i]
        _number_lanes(lane_of, active, place)
        _start_lanes(lanes, active, constants, span)
        before[first:last] = now[first:last]
        count[:active] = 0
        n, going = active, _split_lanes(lanes[NEXT_CROSSING, :active], stop, listed)
        while True:
            events = make_room(events, made + going)
            firing, is_first = listed[0, :going], order == FIRST_DRAW
            made = _fire(lanes, lane_of, firing, is_first, base, events, made, count)
            n = n if is_first else going
            if n == 0:
                break
            _draw_passages(lanes, lane_of[PLACE, :n], key, order)
            going = _split_lanes(lanes[NEXT_CROSSING, :n], stop, listed)
            for j in listed[1, : n - going]:
                i = lane_of[PIXEL, j]
                elapsed = stop - lanes[SINCE, j]
                by_signal[i] = lanes[BY_SIGNAL, j] + lanes[SIGNAL_DRIFT, j] * elapsed
                next_us[i], rate[i] = lanes[NEXT_CROSSING, j], lanes[RATE, j]
            order += DRAWS_PER_PASSAGE
        keys, found = append_by_lane(events[:, :made], count[:active], keys, found)
    return keys[:found]


@jit
def _mark_changes(before: NDArray[Any], now: NDArray[Any], changes: NDArray[np.uint8]) -> bool:
    """Set 1 where the luma changes, else 0; return whether it changes nowhere."""
    different = 0
    for j in range(now.size):
        changes[j] = before[j] != now[j]
    for j in range(now.size):
        different |= changes[j]
    return different == 0


@jit
def _mark_active(
    next_us: Float64Array,
    stop: float,
    changes: NDArray[np.uint8],
    has_changed: NDArray[np.uint8],
    marks: NDArray[np.uint8],
) -> None:
    """Set 1 where the luma changes or just did, or a threshold is crossed; else 0, also beyond.

    On return `changes` marks the first two, whose first passages must be drawn.
    """
    for j in range(next_us.size):
        has_changed[j], changes[j] = changes[j], changes[j] | has_changed[j]
    for j in range(next_us.size):
        marks[j] = next_us[j] < stop
    for j in range(next_us.size):
        marks[j] |= changes[j]
    marks[next_us.size :] = 0


@jit
def _earliest(next_us: Float64Array) -> float:
    # As integers: only their minimum is found in vector registers. None is below 0.
    bits = next_us.view(np.int64)
    first = bits[0]
    for one in bits:
        first = min(first, one)
    return float(np.int64(first).view(np.float64))


@jit(error_model="numpy")
def _start_lanes(
    lanes: Float64Array, n: int, constants: Constants, span: tuple[float, float]
) -> None:
    """Motion of the lanes; keeps the first passages of pixels whose luma does not change."""
    start, stop = span
    for j in range(n):
        lanes[SIGNAL_DRIFT, j], lanes[DIRECTION, j], lanes[VARIANCE, j] = _drift_and_diffusion(
            lanes[SQUARE, j], lanes[CHANCE, j], stop - start, constants
        )
    for j in range(n):
        drift, sigma = lanes[DIRECTION, j], lanes[VARIANCE, j]
        lanes[SPEED, j], lanes[DIRECTION, j] = abs(drift), 1.0 if drift >= 0 else -1.0
        lanes[VARIANCE, j] = sigma * sigma
    for j in range(n):
        left = lanes[RATE, j] * (lanes[NEXT_CROSSING, j] - start)
        displacement = math.copysign(1.0, lanes[RATE, j]) - left
        lanes[DISPLACEMENT, j] = min(max(displacement, -MOST_DISPLACEMENT), MOST_DISPLACEMENT)
        lanes[SINCE, j] = start
        lanes[NEXT_CROSSING, j] = np.inf if lanes[DISTANCE, j] > 0 else lanes[NEXT_CROSSING, j]


@jit
def _split_lanes(next_us: Float64Array, stop: float, listed: NDArray[np.int64]) -> int:
    """List the lanes that fire before the end, then the others; return how many fire."""
    going, left = 0, 0
    for j in range(next_us.size):
        fires = next_us[j] < stop
        listed[0, going], listed[1, left] = j, j
        going += fires
        left += not fires
    return going


@jit(error_model="numpy")
def _draw_passages(lanes: Float64Array, places: Uint64Array, key: np.uint64, order: int) -> None:
    """Draw the next first passages; see `reference`."""
    n = places.size
    for j in range(n):
        lanes[SQUARE, j] = 1.0 - draw_uniform_at(key, places[j], order + 1)
    for j in range(n):
        lanes[NEXT_CROSSING, j], lanes[CHANCE, j] = draw_halves_at(key, places[j], order + 2)
    for j in range(n):
        cosine = cosine_of_turns(lanes[NEXT_CROSSING, j])
        lanes[SQUARE, j] = -2.0 * natural_log(lanes[SQUARE, j]) * (cosine * cosine)
    undecided = 0
    for j in range(n):
        displacement, direction = lanes[DISPLACEMENT, j], lanes[DIRECTION, j]
        lanes[RATE, j], lanes[DISTANCE, j] = direction, 1.0 - direction * displacement
        pull = 2.0 * lanes[SPEED, j] * (1.0 + direction * displacement)
        undecided += not pull > CERTAIN * lanes[VARIANCE, j]
    if undecided:
        _choose_directions(lanes, places, key, order)
    for j in range(n):
        distance, speed = lanes[DISTANCE, j], lanes[SPEED, j]
        spread, pull = lanes[VARIANCE, j] * lanes[SQUARE, j], 2.0 * speed * distance
        whole = pull + spread + math.sqrt(spread * (spread + 2.0 * pull))
        is_short = lanes[CHANCE, j] * (whole + pull) <= whole
        above = 2.0 * distance * distance if is_short else whole
        wait = min(above / (whole if is_short else 2.0 * speed * speed), LONGEST_US)
        lanes[NEXT_CROSSING, j] = lanes[SINCE, j] + wait
        lanes[RATE, j] *= distance / wait


@jit(error_model="numpy")
def _choose_directions(
    lanes: Float64Array, places: Uint64Array, key: np.uint64, order: int
) -> None:
    """Send some lanes against the drift at random, by the probability of first passage."""
    for j in range(places.size):
        speed, variance = lanes[SPEED, j], lanes[VARIANCE, j]
        displacement = lanes[DIRECTION, j] * lanes[DISPLACEMENT, j]
        along, against = 1.0 - displacement, 1.0 + displacement
        if 2.0 * speed * against > CERTAIN * variance:
            continue
        steer = 0.0 if speed == 0 else 2.0 * speed / variance
        whole, chance = math.expm1(-steer * (along + against)), against / (along + against)
        if whole != 0:
            chance = math.expm1(-steer * against) / whole
        if not draw_uniform_at(key, places[j], order) < chance:
            lanes[RATE, j], lanes[DISTANCE, j] = -lanes[DIRECTION, j], against


@jit
def _fire(
    lanes: Float64Array,
    lane_of: Uint64Array,
    firing: NDArray[np.int64],
    stays: bool,
    base: tuple[np.uint64, np.uint64, float],
    events: Uint64Array,
    made: int,
    count: NDArray[np.int64],
) -> int:
    """Add the events of some lanes, reset them, and return how many events there are now.

    Unless `stays`, the lanes move to the front.
    """
    first, low, start = base
    for k in range(firing.size):
        j = firing[k]
        to = j if stays else k
        next_us, signal, is_on = lanes[NEXT_CROSSING, j], lanes[SIGNAL_DRIFT, j], lanes[RATE, j] > 0
        by_signal = lanes[BY_SIGNAL, j] + signal * (next_us - lanes[SINCE, j])
        is_noise = (by_signal if is_on else -by_signal) < 0.5
        kind = np.uint64(is_on) << _1 | (_NOISE if is_noise else np.uint64(0))
        pixel, number = lane_of[PIXEL, j], lane_of[FIRST_LANE, j]
        events[0, made + k] = (
            np.uint64(np.int64(next_us - start)) << low | (first + pixel) << _2 | kind
        )
        events[1, made + k] = number
        count[number] += 1
        lanes[DISPLACEMENT, to], lanes[BY_SIGNAL, to], lanes[SINCE, to] = 0.0, 0.0, next_us
        lanes[SIGNAL_DRIFT, to], lanes[DIRECTION, to] = signal, lanes[DIRECTION, j]
        lanes[SPEED, to], lanes[VARIANCE, to] = lanes[SPEED, j], lanes[VARIANCE, j]
        lane_of[PIXEL, to], lane_of[FIRST_LANE, to], lane_of[PLACE, to] = (
            pixel,
            number,
            lane_of[PLACE, j],
        )
    return made + firing.size


@jit
def _number_lanes(lane_of: Uint64Array, n: int, place: tuple[int, int, int]) -> None:
    """Number the lanes, and set row and column of their pixels."""
    inverse = 1.0 / place[1]
    for k in range(n):
        lane_of[FIRST_LANE, k] = k
        pixel = int(lane_of[PIXEL, k]) + place[0]
        # Half a pixel off the row's start, so that rounding of the product cannot miss the row.
        y = int((pixel + 0.5) * inverse)
        lane_of[PLACE, k] = place_of(y, pixel - y * place[1])
