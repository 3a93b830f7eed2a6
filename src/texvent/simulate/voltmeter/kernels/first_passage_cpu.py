"""First-passage sampling, compiled by Numba: block of pixels by block, the reference's bits.

Pixels whose light moved or whose time has come are busy. Those of a block are put side by side, in
lanes, and pass round after round: the next passages of all are drawn in loops that fill vector
registers, and whoever gets to the end of the interval leaves. Blocks without a busy pixel are
skipped.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE
from texvent.runtime.jit import jit
from texvent.runtime.threads import count_threads, run_parts, split
from texvent.simulate.backend.elementary_cpu import cosine_of_turns, natural_log
from texvent.simulate.backend.lanes_cpu import WORD, append_by_lane, list_marked, make_room
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents, read_only
from texvent.simulate.packets.sorting_cpu import has_room_for_keys, key_bits, sort_keyed_events
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws_cpu import draw_halves_at, draw_uniform_at, place_of
from texvent.simulate.voltmeter.kernels import first_passage_reference as passage_reference
from texvent.simulate.voltmeter.kernels.first_passage import (
    BLOCK,
    CERTAIN,
    DRAWS_PER_PASSAGE,
    FIRST_DRAW,
    LONGEST_US,
    MOST_RESIDUAL,
    Constants,
    Float64Array,
    Light,
    Voltage,
    new_voltage,
)

Uint64Array = NDArray[np.uint64]

_motion_of = jit(error_model="numpy")(passage_reference.motion_of)

SHARE = 16 * BLOCK
"""Fewest pixels that are worth a thread of their own."""
ROOM = BLOCK + 8
"""SortedEvents of `lanes`: rows a power of two apart would share few lines of the nearest cache."""
WAY, SINCE, DUE, PACE, DRIVEN, SIGNAL, FORWARD, SPEED, SPREAD, SQUARE, CHANCE, DISTANCE = range(12)
"""Rows of `lanes`, [12, BLOCK] float64: what busy pixels do, see `passage_reference._Going`.
FORWARD is the sign of the drift, SPREAD is σ². It is one array because Numba counts the references
to every array that is passed on."""
LOCAL, NUMBER, PLACE = range(3)
"""Rows of `names`, [3, BLOCK] uint64: which pixel a lane is, which lane it was at first, and its
row and column."""
Volts = tuple[Float64Array, Float64Array, NDArray[np.uint8], NDArray[np.float32], Float64Array]
"""The fields of `Voltage`."""
_1, _2 = np.uint64(1), np.uint64(2)
_NOISE = np.uint64(NOISE)


def find_passages(
    light: Light, voltage: Voltage, interval: FrameInterval, first_us: int
) -> UnsortedEvents | SortedEvents:
    """Alternate between polarity and time; see `passage_reference.find_passages`."""
    shape = light.now.shape
    if not has_room_for_keys(interval.duration_us, shape):
        return passage_reference.find_passages(light, voltage, interval, first_us)
    before, now = light.before.reshape(-1), read_only(light.now)
    span = float(interval.start_us - first_us), float(interval.stop_us - first_us)

    def find(part: slice) -> Uint64Array:
        blocks = slice(part.start // BLOCK, -(-part.stop // BLOCK))
        volts = (
            voltage.due_us[part],
            voltage.pace[part],
            voltage.is_moving[part].view(np.uint8),
            voltage.signal[part],
            voltage.soonest_us[blocks],
        )
        place = part.start, shape[1], key_bits(now.size)
        # With NUMBA_DISABLE_JIT=1 this runs in NumPy, which would warn where the hash wraps around
        # and where extremes overflow.
        with np.errstate(all="ignore"):
            keys: Uint64Array = _find_passages(
                (before[part], now[part]), light.constants, volts, place, interval.key, span
            )
        return keys

    # A pixel of this model takes as long as several of others: small frames are worth sharing.
    parts = run_parts(find, split(now.size, count_threads(), unit=SHARE))
    keys = parts[0] if len(parts) == 1 else np.concatenate(parts)
    return sort_keyed_events(keys, (interval.start_us, interval.stop_us), shape)


def warm_up(dtype: str) -> None:
    """Compile for one type of frames, or load what was compiled before."""
    light = Light(
        np.zeros((1, 1), dtype), np.zeros((1, 1), dtype), Constants(1.0, 1.0, 0.0, 0.0, 0.0, 0.0)
    )
    find_passages(light, new_voltage(np.zeros(1)), FrameInterval(0, 1, np.uint64(0)), 0)


@jit(error_model="numpy")
def _find_passages(
    ends: tuple[NDArray[Any], NDArray[Any]],
    constants: Constants,
    volts: Volts,
    place: tuple[int, int, int],
    key: np.uint64,
    span: tuple[float, float],
) -> Uint64Array:
    before, now = ends
    due, pace, is_moving, driven, soonest = volts
    stop, base = span[1], (np.uint64(place[0]), np.uint64(place[2]), span[0])
    keys, found = np.empty(now.size // 4 + 64, np.uint64), 0
    lanes, names = np.empty((12, ROOM)), np.empty((3, ROOM), np.uint64)
    words, listed = np.zeros((2, BLOCK // WORD), np.uint64), np.empty((2, BLOCK + WORD), np.int64)
    moves, marks = words[0].view(np.uint8), words[1].view(np.uint8)
    events, count = np.empty((2, 2 * BLOCK), np.uint64), np.empty(BLOCK, np.int64)
    for first in range(0, now.size, BLOCK):
        last = min(first + BLOCK, now.size)
        is_still = _mark_moves(before[first:last], now[first:last], moves)
        if is_still and soonest[first // BLOCK] >= stop:
            continue
        _mark_busy(due[first:last], stop, moves, is_moving[first:last], marks)
        busy, made, order = list_marked(words[1], marks, listed[0]), 0, FIRST_DRAW
        soonest[first // BLOCK] = _first_due(due[first:last]) if is_still and busy == 0 else -np.inf
        pixel = names[LOCAL, :busy]
        for k in range(busy):
            pixel[k] = first + listed[0, k]
        for k in range(busy):
            i = pixel[k]
            lanes[SQUARE, k], lanes[CHANCE, k] = before[i], now[i]
            lanes[DISTANCE, k] = moves[listed[0, k]]
            lanes[DUE, k], lanes[PACE, k], lanes[DRIVEN, k] = due[i], pace[i], driven[i]
        _name(names, busy, place)
        _begin(lanes, busy, constants, span)
        before[first:last] = now[first:last]
        count[:busy] = 0
        n, going = busy, _part(lanes[DUE, :busy], stop, listed)
        while True:
            events = make_room(events, made + going)
            firing, is_due = listed[0, :going], order == FIRST_DRAW
            made = _fire(lanes, names, firing, is_due, base, events, made, count)
            n = n if is_due else going
            if n == 0:
                break
            _draw(lanes, names[PLACE, :n], key, order)
            going = _part(lanes[DUE, :n], stop, listed)
            for j in listed[1, : n - going]:
                i = names[LOCAL, j]
                driven[i] = lanes[DRIVEN, j] + lanes[SIGNAL, j] * (stop - lanes[SINCE, j])
                due[i], pace[i] = lanes[DUE, j], lanes[PACE, j]
            order += DRAWS_PER_PASSAGE
        keys, found = append_by_lane(events[:, :made], count[:busy], keys, found)
    return keys[:found]


@jit
def _mark_moves(before: NDArray[Any], now: NDArray[Any], moves: NDArray[np.uint8]) -> bool:
    """1 where the light moves, else 0; whether it rests everywhere."""
    different = 0
    for j in range(now.size):
        moves[j] = before[j] != now[j]
    for j in range(now.size):
        different |= moves[j]
    return different == 0


@jit
def _mark_busy(
    due: Float64Array,
    stop: float,
    moves: NDArray[np.uint8],
    is_moving: NDArray[np.uint8],
    marks: NDArray[np.uint8],
) -> None:
    """1 where the light moves, has just come to rest, or a threshold is due; else 0, also beyond.

    On return `moves` says of the first two, whose passages must be drawn.
    """
    for j in range(due.size):
        is_moving[j], moves[j] = moves[j], moves[j] | is_moving[j]
    for j in range(due.size):
        marks[j] = due[j] < stop
    for j in range(due.size):
        marks[j] |= moves[j]
    marks[due.size :] = 0


@jit
def _first_due(due: Float64Array) -> float:
    # As integers, for only their smallest is found in vector registers; none is below 0.
    bits = due.view(np.int64)
    first = bits[0]
    for one in bits:
        first = min(first, one)
    return float(np.int64(first).view(np.float64))


@jit(error_model="numpy")
def _begin(lanes: Float64Array, n: int, constants: Constants, span: tuple[float, float]) -> None:
    """Motion of the lanes, and the passages that go on: those of pixels whose light rests."""
    start, stop = span
    for j in range(n):
        lanes[SIGNAL, j], lanes[FORWARD, j], lanes[SPREAD, j] = _motion_of(
            lanes[SQUARE, j], lanes[CHANCE, j], stop - start, constants
        )
    for j in range(n):
        drift, sigma = lanes[FORWARD, j], lanes[SPREAD, j]
        lanes[SPEED, j], lanes[FORWARD, j] = abs(drift), 1.0 if drift >= 0 else -1.0
        lanes[SPREAD, j] = sigma * sigma
    for j in range(n):
        way = math.copysign(1.0, lanes[PACE, j]) - lanes[PACE, j] * (lanes[DUE, j] - start)
        lanes[WAY, j] = min(max(way, -MOST_RESIDUAL), MOST_RESIDUAL)
        lanes[SINCE, j] = start
        lanes[DUE, j] = np.inf if lanes[DISTANCE, j] > 0 else lanes[DUE, j]


@jit
def _part(due: Float64Array, stop: float, listed: NDArray[np.int64]) -> int:
    """List the lanes that fire before the end, and those that do not; return how many fire."""
    going, left = 0, 0
    for j in range(due.size):
        fires = due[j] < stop
        listed[0, going], listed[1, left] = j, j
        going += fires
        left += not fires
    return going


@jit(error_model="numpy")
def _draw(lanes: Float64Array, places: Uint64Array, key: np.uint64, order: int) -> None:
    """The next passages; see `passage_reference`."""
    n = places.size
    for j in range(n):
        lanes[SQUARE, j] = 1.0 - draw_uniform_at(key, places[j], order + 1)
    for j in range(n):
        lanes[DUE, j], lanes[CHANCE, j] = draw_halves_at(key, places[j], order + 2)
    for j in range(n):
        cosine = cosine_of_turns(lanes[DUE, j])
        lanes[SQUARE, j] = -2.0 * natural_log(lanes[SQUARE, j]) * (cosine * cosine)
    undecided = 0
    for j in range(n):
        way, forward = lanes[WAY, j], lanes[FORWARD, j]
        lanes[PACE, j], lanes[DISTANCE, j] = forward, 1.0 - forward * way
        pull = 2.0 * lanes[SPEED, j] * (1.0 + forward * way)
        undecided += not pull > CERTAIN * lanes[SPREAD, j]
    if undecided:
        _decide(lanes, places, key, order)
    for j in range(n):
        distance, speed = lanes[DISTANCE, j], lanes[SPEED, j]
        spread, pull = lanes[SPREAD, j] * lanes[SQUARE, j], 2.0 * speed * distance
        whole = pull + spread + math.sqrt(spread * (spread + 2.0 * pull))
        is_short = lanes[CHANCE, j] * (whole + pull) <= whole
        above = 2.0 * distance * distance if is_short else whole
        wait = min(above / (whole if is_short else 2.0 * speed * speed), LONGEST_US)
        lanes[DUE, j] = lanes[SINCE, j] + wait
        lanes[PACE, j] *= distance / wait


@jit(error_model="numpy")
def _decide(lanes: Float64Array, places: Uint64Array, key: np.uint64, order: int) -> None:
    """Let chance send some lanes against the drift; see `passage_reference.chance_along`."""
    for j in range(places.size):
        speed, spread, way = lanes[SPEED, j], lanes[SPREAD, j], lanes[FORWARD, j] * lanes[WAY, j]
        along, against = 1.0 - way, 1.0 + way
        if 2.0 * speed * against > CERTAIN * spread:
            continue
        steer = 0.0 if speed == 0 else 2.0 * speed / spread
        whole, chance = math.expm1(-steer * (along + against)), against / (along + against)
        if whole != 0:
            chance = math.expm1(-steer * against) / whole
        if not draw_uniform_at(key, places[j], order) < chance:
            lanes[PACE, j], lanes[DISTANCE, j] = -lanes[FORWARD, j], against


@jit
def _fire(
    lanes: Float64Array,
    names: Uint64Array,
    firing: NDArray[np.int64],
    stays: bool,
    base: tuple[np.uint64, np.uint64, float],
    events: Uint64Array,
    made: int,
    count: NDArray[np.int64],
) -> int:
    """Add the events of some lanes, whose voltages begin anew; return how many there are now.

    They move to the front, where no others stay.
    """
    first, low, start = base
    for k in range(firing.size):
        j = firing[k]
        to = j if stays else k
        due, signal, is_on = lanes[DUE, j], lanes[SIGNAL, j], lanes[PACE, j] > 0
        by_signal = lanes[DRIVEN, j] + signal * (due - lanes[SINCE, j])
        is_noise = (by_signal if is_on else -by_signal) < 0.5
        kind = np.uint64(is_on) << _1 | (_NOISE if is_noise else np.uint64(0))
        pixel, number = names[LOCAL, j], names[NUMBER, j]
        events[0, made + k] = np.uint64(np.int64(due - start)) << low | (first + pixel) << _2 | kind
        events[1, made + k] = number
        count[number] += 1
        lanes[WAY, to], lanes[DRIVEN, to], lanes[SINCE, to] = 0.0, 0.0, due
        lanes[SIGNAL, to], lanes[FORWARD, to] = signal, lanes[FORWARD, j]
        lanes[SPEED, to], lanes[SPREAD, to] = lanes[SPEED, j], lanes[SPREAD, j]
        names[LOCAL, to], names[NUMBER, to], names[PLACE, to] = pixel, number, names[PLACE, j]
    return made + firing.size


@jit
def _name(names: Uint64Array, n: int, place: tuple[int, int, int]) -> None:
    """Number the lanes, and find the rows and columns of their pixels."""
    inverse = 1.0 / place[1]
    for k in range(n):
        names[NUMBER, k] = k
        pixel = int(names[LOCAL, k]) + place[0]
        # Half a pixel off the row's start, so that rounding of the product cannot miss the row.
        y = int((pixel + 0.5) * inverse)
        names[PLACE, k] = place_of(y, pixel - y * place[1])
