"""Pixel circuits on their way through an interval, compiled by Numba for `circuit_cpu`.

All pixels that may fire walk side by side, in lanes: piece after piece, and on each piece move
after move, as the reference does, in loops that fill vector registers. Lanes are the columns of one
array, for Numba counts the references to each array whenever it is passed on.
"""

from __future__ import annotations

import math

import numpy as np

from texvent.events import NOISE
from texvent.runtime.jit import jit
from texvent.simulate.backend.elementary_cpu import decay_and_gain, exponential
from texvent.simulate.backend.lanes_cpu import make_room
from texvent.simulate.physical.kernels.circuit import DARK_OFFSET, Optics, PixelState
from texvent.simulate.physical.kernels.circuit_lanes_cpu import (
    L_ARRIVAL,
    L_BASE,
    L_BEGIN,
    L_BRIGHT,
    L_BRIGHT_NOW,
    L_CORNER,
    L_CORNER_FROM,
    L_END,
    L_GLOW,
    L_GROWTH,
    L_KEPT,
    L_LAG,
    L_LEAK,
    L_LENGTH,
    L_LEVEL,
    L_NOW,
    L_OFF,
    L_ON,
    L_PIECES,
    L_SINCE,
    L_SLOPE,
    L_TILT,
    L_TRANSIENT,
    N_LAST_NOISE,
    N_NOISE,
    N_NUMBER,
    N_PIXEL,
    Float64Array,
    Int64Array,
    Uint64Array,
    Work,
    leave_lanes,
)
from texvent.simulate.physical.kernels.circuit_reference import (
    FEWEST_PER_LOG,
    LEAK_SHARE,
    MOST_PER_LOG,
    STRAIGHT,
)
from texvent.simulate.physical.kernels.crossing_time import NEGLIGIBLE, NEVER
from texvent.simulate.physical.kernels.crossing_time_cpu import (
    CHANGE,
    CORNER,
    KEPT,
    OFF,
    ON,
    RISES,
    ROOM,
    ROWS,
    SLOPE,
    TRANSIENT,
    WAIT,
    find_crossings,
)

R_NOW, R_AGE, R_SINCE, R_LEVEL, R_LEAK, R_WAITS = range(ROWS, ROWS + 6)
"""Rows of moves, besides those of `crossing_time_cpu`."""
Rules = tuple[int, bool, int, int, int, int]
"""Refractory period, whether noise resets, number of the first pixel, bits of a key below its time,
start and length of the interval; times in µs."""
_1, _2 = np.uint64(1), np.uint64(2)
_NOISE = np.uint64(NOISE)


@jit(error_model="numpy")
def walk_lanes(
    work: Work,
    size: int,
    state: PixelState,
    optics: Optics,
    noise_times: Int64Array,
    rules: Rules,
    events: Uint64Array,
) -> tuple[Uint64Array, int]:
    """Send all lanes through the interval; their events, and how many those are."""
    lanes, names, moves, solving, moving, firing, count = work
    duration, made, piece = float(rules[-1]), 0, 0.0
    view = optics.corner_per_level, DARK_OFFSET - optics.balance
    count[:size] = 0
    _begin_walk(lanes, size, duration, view[0] > 0)
    while size > 0:
        _enter_piece(lanes, size, piece, duration, view)
        going = size
        for j in range(size):
            moving[j] = j
        while going > 0:
            going = _move(lanes, names, moving[:going], noise_times, moves, solving, firing)
            events, out = make_room(events, made + going), (count, made)
            made = _fire(
                lanes, names, moving, firing[:going], moves, noise_times, rules, (events, *out)
            )
        piece += 1.0
        size = leave_lanes(lanes, names, size, piece, state, rules[-2])
    return events, made


@jit(error_model="numpy")
def _begin_walk(lanes: Float64Array, size: int, duration: float, is_limited: bool) -> None:
    """Cut the interval into pieces; on entry L_CORNER is the corner at the end.

    Args:
        lanes: [LANE_ROWS, room].
        size: how many lanes.
        duration: of the interval, µs.
        is_limited: whether the photoreceptors have a bandwidth.
    """
    for j in range(size):
        rise = lanes[L_BRIGHT_NOW, j] - lanes[L_BRIGHT, j]
        angle, span = max(lanes[L_CORNER_FROM, j], lanes[L_CORNER, j]) * duration, abs(rise)
        pieces = np.ceil(min(max(angle, FEWEST_PER_LOG * span), MOST_PER_LOG * span + 1.0))
        pieces = max(pieces, 1.0) if angle > 0 else 1.0
        lanes[L_PIECES, j], lanes[L_LENGTH, j] = pieces, duration / pieces
    for j in range(size):
        rise = lanes[L_BRIGHT_NOW, j] - lanes[L_BRIGHT, j]
        lanes[L_GLOW, j], lanes[L_SLOPE, j] = exponential(lanes[L_BRIGHT, j]), rise / duration
        lanes[L_GROWTH, j] = exponential(rise / lanes[L_PIECES, j])
    if is_limited:
        return
    for j in range(size):
        lanes[L_BASE, j], lanes[L_TILT, j] = lanes[L_BRIGHT, j], lanes[L_SLOPE, j]
        lanes[L_TRANSIENT, j], lanes[L_KEPT, j], lanes[L_LAG, j] = 0.0, 1.0, 0.0


@jit(error_model="numpy")
def _enter_piece(
    lanes: Float64Array, size: int, piece: float, duration: float, optics: tuple[float, float]
) -> None:
    """The photoreceptors on the next piece; see `circuit_reference._Walk.enter_piece`."""
    per_level, offset = optics
    for j in range(size):
        pieces, length = lanes[L_PIECES, j], lanes[L_LENGTH, j]
        lanes[L_BEGIN, j], lanes[L_NOW, j] = piece * length, piece * length
        lanes[L_END, j] = duration if piece == pieces - 1.0 else (piece + 1.0) * length
    if per_level == 0:
        return
    for j in range(size):
        glow = lanes[L_GLOW, j]
        ahead = glow * lanes[L_GROWTH, j]
        mean = (glow + ahead) * (1 / 6) + math.sqrt(glow * ahead) * (2 / 3)
        lanes[L_CORNER, j], lanes[L_GLOW, j] = per_level * (mean + offset), ahead
    for j in range(size):
        angle = lanes[L_CORNER, j] * lanes[L_LENGTH, j]
        lanes[L_KEPT, j], lanes[L_TRANSIENT, j] = decay_and_gain(angle)
    for j in range(size):
        corner, length, slope = lanes[L_CORNER, j], lanes[L_LENGTH, j], lanes[L_SLOPE, j]
        kept, gain, lag = lanes[L_KEPT, j], lanes[L_TRANSIENT, j], lanes[L_LAG, j]
        corner_from, corner_to = lanes[L_CORNER_FROM, j], per_level * (lanes[L_GLOW, j] + offset)
        angle = corner * length
        is_straight = angle < STRAIGHT
        bend = (corner_to - corner_from) / corner * 0.5
        curl = (angle - 2.0 + kept * (angle + 2.0)) / (angle * angle)
        curl = 0.0 if is_straight else curl
        lag_to = lag * kept + slope * length * (gain - bend * curl)
        drop = slope - corner_from * lag
        room = 1.0 if is_straight else angle - 1.0 + kept
        transient = 0.0 if is_straight else (lag_to - lag - drop * length) / room
        drop = (lag_to - lag) / length if is_straight else drop + corner * transient
        tilt, begin = slope - drop, lanes[L_BEGIN, j]
        lanes[L_BASE, j] = lanes[L_BRIGHT, j] + slope * begin - (lag - transient) - tilt * begin
        lanes[L_TILT, j], lanes[L_TRANSIENT, j] = tilt, transient
        lanes[L_LAG, j], lanes[L_CORNER_FROM, j] = lag_to, corner_to


@jit(error_model="numpy")
def _move(
    lanes: Float64Array,
    names: Int64Array,
    moving: Int64Array,
    noise_times: Int64Array,
    moves: Float64Array,
    solving: Float64Array,
    lane: Int64Array,
) -> int:
    """Find the next event of some lanes on this piece; list those that have one.

    Args:
        lanes: [LANE_ROWS, room].
        names: [4, room].
        moving: [m] which lanes.
        noise_times: times of noise events since the start of the interval, µs, times 2, plus p.
        moves: [MOVE_ROWS, room]; on return WAIT of each is the time of its event.
        solving: scratch of `find_crossings`.
        lane: [room]; on return which of `moving` fire.

    Returns:
        How many fire.
    """
    size = moving.size
    _look_up(lanes, names, moving, noise_times, moves)
    _set_out(moves, size)
    find_crossings(moves, solving, lane, size)
    found = 0
    for k in range(size):
        j = moving[k]
        lanes[L_LEVEL, j], lanes[L_NOW, j] = moves[R_LEVEL, k], moves[R_NOW, k]
        event = min(moves[R_NOW, k] + moves[WAIT, k], lanes[L_ARRIVAL, j])
        lane[found] = k
        found += (event <= lanes[L_END, j]) & (moves[R_WAITS, k] == 0)
    return found


@jit
def _look_up(
    lanes: Float64Array,
    names: Int64Array,
    moving: Int64Array,
    noise_times: Int64Array,
    moves: Float64Array,
) -> None:
    """Copy what a move needs to know of its lanes, which are on the piece or are released there."""
    for k in range(moving.size):
        j = moving[k]
        now, since = lanes[L_NOW, j], lanes[L_SINCE, j]
        if since > now and lanes[L_ARRIVAL, j] < since:
            _skip_noise(lanes, names, noise_times, j, since)
        now = since if (since > now) & (since <= lanes[L_END, j]) else now
        moves[R_NOW, k], moves[R_SINCE, k] = now, since
        moves[R_AGE, k], moves[ROOM, k] = now - lanes[L_BEGIN, j], lanes[L_END, j] - now
        moves[CHANGE, k] = lanes[L_BASE, j] + lanes[L_TILT, j] * now
        moves[SLOPE, k], moves[R_LEAK, k] = lanes[L_TILT, j], lanes[L_LEAK, j]
        moves[TRANSIENT, k], moves[CORNER, k] = lanes[L_TRANSIENT, j], lanes[L_CORNER, j]
        moves[KEPT, k], moves[R_LEVEL, k] = lanes[L_KEPT, j], lanes[L_LEVEL, j]
        moves[ON, k], moves[OFF, k] = lanes[L_ON, j], lanes[L_OFF, j]


@jit(error_model="numpy")
def _set_out(moves: Float64Array, size: int) -> None:
    """How the change goes on from where each lane is; those that were released take their level."""
    for k in range(size):
        left = exponential(-moves[CORNER, k] * moves[R_AGE, k])
        transient = moves[TRANSIENT, k] * left
        is_dead = abs(transient) <= NEGLIGIBLE * min(moves[ON, k], moves[OFF, k])
        moves[TRANSIENT, k] = 0.0 if is_dead else transient
        moves[KEPT, k] = moves[KEPT, k] / left
    for k in range(size):
        waits = moves[R_SINCE, k] > moves[R_NOW, k]
        output, level = moves[CHANGE, k] - moves[TRANSIENT, k], moves[R_LEVEL, k]
        level = output if (level != level) & (not waits) else level
        leaked = moves[R_LEAK, k] * (moves[R_NOW, k] - moves[R_SINCE, k])
        moves[CHANGE, k] = 0.0 if waits else output - level + leaked
        moves[SLOPE, k], moves[R_LEVEL, k] = moves[SLOPE, k] + moves[R_LEAK, k], level
        moves[R_WAITS, k] = 1.0 if waits else 0.0


@jit
def _skip_noise(
    lanes: Float64Array, names: Int64Array, noise_times: Int64Array, j: int, time: float
) -> None:
    """Forget the noise events of a lane before a time."""
    k, last = names[N_NOISE, j], names[N_LAST_NOISE, j]
    while k < last and noise_times[k] >> 1 < time:
        k += 1
    names[N_NOISE, j] = k
    lanes[L_ARRIVAL, j] = float(noise_times[k] >> 1) if k < last else NEVER


@jit(error_model="numpy")
def _fire(
    lanes: Float64Array,
    names: Int64Array,
    moving: Int64Array,
    firing: Int64Array,
    moves: Float64Array,
    noise_times: Int64Array,
    rules: Rules,
    out: tuple[Uint64Array, Int64Array, int],
) -> int:
    """Write down the events of lanes that fire, reset their pixels, and list them as moving.

    Args:
        lanes: [LANE_ROWS, room].
        names: [4, room].
        moving: [m] the lanes that moved; on return those that fire come first.
        firing: [f] which of them fire.
        moves: [MOVE_ROWS, room].
        noise_times: as for `move`.
        rules: see `Rules`.
        out: events as key and lane, [2, room], how many of each lane, and how many there are.

    Returns:
        How many events there are now.
    """
    refractory_us, resets_by_noise, first, low, _, duration_us = rules
    events, count, made = out
    for n in range(firing.size):
        k = firing[n]
        j = moving[k]
        crossing, arrival = moves[R_NOW, k] + moves[WAIT, k], lanes[L_ARRIVAL, j]
        event, by_noise, is_on = min(crossing, arrival), arrival <= crossing, moves[RISES, k] > 0
        leaked = lanes[L_LEAK, j] * (event - lanes[L_SINCE, j])
        is_noise = by_noise | (is_on & (leaked >= LEAK_SHARE * lanes[L_ON, j]))
        after = math.floor(event)
        if by_noise:
            is_on = noise_times[names[N_NOISE, j]] & 1 == 1
            names[N_NOISE, j] += 1
            _skip_noise(lanes, names, noise_times, j, -NEVER)
        if not by_noise or resets_by_noise:
            lanes[L_LEVEL, j], lanes[L_SINCE, j] = np.nan, float(after + refractory_us)
        lanes[L_NOW, j], moving[n] = event, j
        kind = np.uint64(is_on) << _1 | (_NOISE if is_noise else np.uint64(0))
        pixel = np.uint64(first + names[N_PIXEL, j])
        offset = np.uint64(min(int(after), duration_us - 1))
        events[0, made + n] = offset << np.uint64(low) | pixel << _2 | kind
        events[1, made + n] = names[N_NUMBER, j]
        count[names[N_NUMBER, j]] += 1
    return made + firing.size
