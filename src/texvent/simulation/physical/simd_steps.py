"""Steps of SIMD lanes through the segments of an interval, event by event, compiled."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from texvent.events import NOISE
from texvent.runtime.jit import jit
from texvent.simulation.kernels.active_pixels import make_room
from texvent.simulation.kernels.compiled_elementary import decay_and_gain, exponential
from texvent.simulation.physical.circuit import CircuitState, PhotoreceptorConstants
from texvent.simulation.physical.crossing_time import (
    CHANGE,
    CUTOFF,
    DURATION,
    KEPT,
    NEGLIGIBLE,
    NEVER,
    OFF,
    ON,
    RISES,
    ROWS,
    SLOPE,
    TRANSIENT,
    WAIT,
    find_crossings,
)
from texvent.simulation.physical.simd_lanes import (
    L_ARRIVAL,
    L_BASE,
    L_BEGIN,
    L_BRIGHTNESS,
    L_BRIGHTNESS_SLOPE,
    L_BRIGHTNESS_STOP,
    L_CUTOFF,
    L_CUTOFF_START,
    L_END,
    L_GROWTH_RATIO,
    L_KEPT,
    L_LAG,
    L_LEAK,
    L_LEVEL,
    L_NOW,
    L_OFF,
    L_OFFSET_INTENSITY,
    L_ON,
    L_SEGMENT_US,
    L_SEGMENTS,
    L_SINCE,
    L_SLOPE,
    L_TRANSIENT,
    N_FIRST_LANE,
    N_NEXT_NOISE,
    N_NOISE_STOP,
    N_PIXEL,
    Float64Array,
    Int64Array,
    LaneMemory,
    Uint64Array,
    leave_lanes,
)

LEAK_SHARE = 0.5
"""An ON event is noise if leakage made at least this share of its change."""
FEWEST_PER_LOG, MOST_PER_LOG = 2.0, 8.0
"""Linear segments of an interval per log unit of brightness, fewest and most; the cutoff hardly
changes on one. Between these there is a segment per time constant."""
STRAIGHT = 1e-3
"""On a segment that is shorter, in time constants, the output is a straight line."""

R_NOW, R_AGE, R_SINCE, R_LEVEL, R_LEAK, R_WAITS = range(ROWS, ROWS + 6)
"""Rows of steps, besides those of `crossing_time`."""


class EventRules(NamedTuple):
    """Effect of an event on its pixel, and parts of its key."""

    refractory_us: int
    """Refractory period, µs."""
    first_pixel: int
    """Flat index of the first pixel of this part of the sensor."""
    low: int
    """Bits of a key below its time."""
    start_us: int
    """Start of the interval."""
    duration_us: int


_1, _2 = np.uint64(1), np.uint64(2)
_NOISE = np.uint64(NOISE)


@jit(error_model="numpy")
def advance_lanes(
    work: LaneMemory,
    size: int,
    state: CircuitState,
    optics: PhotoreceptorConstants,
    noise_times: Int64Array,
    rules: EventRules,
    events: Uint64Array,
) -> tuple[Uint64Array, int]:
    """Advance all lanes through the interval; their events, and how many there are."""
    lanes, lane_of, steps, solving, stepping, firing, count = work
    duration, made, segment = float(rules.duration_us), 0, 0.0
    count[:size] = 0
    _cut_into_segments(lanes, size, duration, optics.cutoff_per_level > 0)
    while size > 0:
        _enter_segment(lanes, size, segment, duration, optics)
        going = size
        for j in range(size):
            stepping[j] = j
        while going > 0:
            going = _find_next_events(
                lanes, lane_of, stepping[:going], noise_times, steps, solving, firing
            )
            events, out = make_room(events, made + going), (count, made)
            made = _fire(
                lanes, lane_of, stepping, firing[:going], steps, noise_times, rules, (events, *out)
            )
        segment += 1.0
        size = leave_lanes(lanes, lane_of, size, segment, state, rules.start_us)
    return events, made


@jit(error_model="numpy")
def _cut_into_segments(lanes: Float64Array, size: int, duration: float, is_limited: bool) -> None:
    """Cut the interval into segments; on entry L_CUTOFF is the cutoff at the end.

    Args:
        lanes: [LANE_ROWS, room].
        size: how many lanes.
        duration: of the interval, µs.
        is_limited: whether the photoreceptors have a bandwidth.
    """
    for j in range(size):
        rise = lanes[L_BRIGHTNESS_STOP, j] - lanes[L_BRIGHTNESS, j]
        angle, span = max(lanes[L_CUTOFF_START, j], lanes[L_CUTOFF, j]) * duration, abs(rise)
        segments = np.ceil(min(max(angle, FEWEST_PER_LOG * span), MOST_PER_LOG * span + 1.0))
        segments = max(segments, 1.0) if angle > 0 else 1.0
        lanes[L_SEGMENTS, j], lanes[L_SEGMENT_US, j] = segments, duration / segments
    for j in range(size):
        rise = lanes[L_BRIGHTNESS_STOP, j] - lanes[L_BRIGHTNESS, j]
        lanes[L_BRIGHTNESS_SLOPE, j] = rise / duration
        lanes[L_OFFSET_INTENSITY, j] = exponential(lanes[L_BRIGHTNESS, j])
        lanes[L_GROWTH_RATIO, j] = exponential(rise / lanes[L_SEGMENTS, j])
    if is_limited:
        return
    for j in range(size):
        lanes[L_BASE, j], lanes[L_SLOPE, j] = lanes[L_BRIGHTNESS, j], lanes[L_BRIGHTNESS_SLOPE, j]
        lanes[L_TRANSIENT, j], lanes[L_KEPT, j], lanes[L_LAG, j] = 0.0, 1.0, 0.0


@jit(error_model="numpy")
def _enter_segment(
    lanes: Float64Array, size: int, segment: float, duration: float, optics: PhotoreceptorConstants
) -> None:
    """The photoreceptors on the next segment; the tests have its definition."""
    per_level, most = optics.cutoff_per_level, optics.most_current
    for j in range(size):
        segments, length = lanes[L_SEGMENTS, j], lanes[L_SEGMENT_US, j]
        lanes[L_BEGIN, j], lanes[L_NOW, j] = segment * length, segment * length
        lanes[L_END, j] = duration if segment == segments - 1.0 else (segment + 1.0) * length
    if per_level == 0:
        return
    for j in range(size):
        here = lanes[L_OFFSET_INTENSITY, j]
        ahead = here * lanes[L_GROWTH_RATIO, j]
        mean = (here + ahead) * (1 / 6) + math.sqrt(here * ahead) * (2 / 3)
        lanes[L_CUTOFF, j], lanes[L_OFFSET_INTENSITY, j] = per_level * min(mean, most), ahead
    for j in range(size):
        angle = lanes[L_CUTOFF, j] * lanes[L_SEGMENT_US, j]
        lanes[L_KEPT, j], lanes[L_TRANSIENT, j] = decay_and_gain(angle)
    for j in range(size):
        cutoff, length = lanes[L_CUTOFF, j], lanes[L_SEGMENT_US, j]
        cutoff_start, input_slope = lanes[L_CUTOFF_START, j], lanes[L_BRIGHTNESS_SLOPE, j]
        kept, gain, lag = lanes[L_KEPT, j], lanes[L_TRANSIENT, j], lanes[L_LAG, j]
        cutoff_stop = per_level * min(lanes[L_OFFSET_INTENSITY, j], most)
        angle = cutoff * length
        is_straight = angle < STRAIGHT
        bend = (cutoff_stop - cutoff_start) / cutoff * 0.5
        curl = (angle - 2.0 + kept * (angle + 2.0)) / (angle * angle)
        curl = 0.0 if is_straight else curl
        lag_stop = lag * kept + input_slope * length * (gain - bend * curl)
        drop = input_slope - cutoff_start * lag
        divisor = 1.0 if is_straight else angle - 1.0 + kept
        transient = 0.0 if is_straight else (lag_stop - lag - drop * length) / divisor
        drop = (lag_stop - lag) / length if is_straight else drop + cutoff * transient
        slope, begin = input_slope - drop, lanes[L_BEGIN, j]
        at_begin = lanes[L_BRIGHTNESS, j] + input_slope * begin - (lag - transient)
        lanes[L_BASE, j] = at_begin - slope * begin
        lanes[L_SLOPE, j], lanes[L_TRANSIENT, j] = slope, transient
        lanes[L_LAG, j], lanes[L_CUTOFF_START, j] = lag_stop, cutoff_stop


@jit(error_model="numpy")
def _find_next_events(
    lanes: Float64Array,
    lane_of: Int64Array,
    stepping: Int64Array,
    noise_times: Int64Array,
    steps: Float64Array,
    solving: Float64Array,
    lane: Int64Array,
) -> int:
    """Find the next event of some lanes on this segment; list those that have one.

    Args:
        lanes: [LANE_ROWS, room].
        lane_of: [4, room].
        stepping: [m] which lanes.
        noise_times: times of noise events since the start of the interval, µs, times 2, plus p.
        steps: [STEP_ROWS, room]; on return WAIT of each is the time of its event.
        solving: scratch of `find_crossings`.
        lane: [room]; on return which of `stepping` fire.

    Returns:
        How many fire.
    """
    size = stepping.size
    _gather_steps(lanes, lane_of, stepping, noise_times, steps)
    _start_steps(steps, size)
    find_crossings(steps, solving, lane, size)
    found = 0
    for k in range(size):
        j = stepping[k]
        lanes[L_LEVEL, j], lanes[L_NOW, j] = steps[R_LEVEL, k], steps[R_NOW, k]
        event = min(steps[R_NOW, k] + steps[WAIT, k], lanes[L_ARRIVAL, j])
        lane[found] = k
        found += (event <= lanes[L_END, j]) & (steps[R_WAITS, k] == 0)
    return found


@jit
def _gather_steps(
    lanes: Float64Array,
    lane_of: Int64Array,
    stepping: Int64Array,
    noise_times: Int64Array,
    steps: Float64Array,
) -> None:
    """Copy what a step needs from its lanes, which are on the segment or are released there."""
    for k in range(stepping.size):
        j = stepping[k]
        now, since = lanes[L_NOW, j], lanes[L_SINCE, j]
        if since > now and lanes[L_ARRIVAL, j] < since:
            _skip_noise(lanes, lane_of, noise_times, j, since)
        now = since if (since > now) & (since <= lanes[L_END, j]) else now
        steps[R_NOW, k], steps[R_SINCE, k] = now, since
        steps[R_AGE, k], steps[DURATION, k] = now - lanes[L_BEGIN, j], lanes[L_END, j] - now
        steps[CHANGE, k] = lanes[L_BASE, j] + lanes[L_SLOPE, j] * now
        steps[SLOPE, k], steps[R_LEAK, k] = lanes[L_SLOPE, j], lanes[L_LEAK, j]
        steps[TRANSIENT, k], steps[CUTOFF, k] = lanes[L_TRANSIENT, j], lanes[L_CUTOFF, j]
        steps[KEPT, k], steps[R_LEVEL, k] = lanes[L_KEPT, j], lanes[L_LEVEL, j]
        steps[ON, k], steps[OFF, k] = lanes[L_ON, j], lanes[L_OFF, j]


@jit(error_model="numpy")
def _start_steps(steps: Float64Array, size: int) -> None:
    """Set the change of each lane from now on; released lanes get their level."""
    for k in range(size):
        left = exponential(-steps[CUTOFF, k] * steps[R_AGE, k])
        transient = steps[TRANSIENT, k] * left
        is_negligible = abs(transient) <= NEGLIGIBLE * min(steps[ON, k], steps[OFF, k])
        steps[TRANSIENT, k] = 0.0 if is_negligible else transient
        steps[KEPT, k] = steps[KEPT, k] / left
    for k in range(size):
        waits = steps[R_SINCE, k] > steps[R_NOW, k]
        output, level = steps[CHANGE, k] - steps[TRANSIENT, k], steps[R_LEVEL, k]
        level = output if (level != level) & (not waits) else level
        leaked = steps[R_LEAK, k] * (steps[R_NOW, k] - steps[R_SINCE, k])
        steps[CHANGE, k] = 0.0 if waits else output - level + leaked
        steps[SLOPE, k], steps[R_LEVEL, k] = steps[SLOPE, k] + steps[R_LEAK, k], level
        steps[R_WAITS, k] = 1.0 if waits else 0.0


@jit
def _skip_noise(
    lanes: Float64Array, lane_of: Int64Array, noise_times: Int64Array, j: int, time: float
) -> None:
    """Skip the noise events of a lane before a time."""
    k, last = lane_of[N_NEXT_NOISE, j], lane_of[N_NOISE_STOP, j]
    while k < last and noise_times[k] >> 1 < time:
        k += 1
    lane_of[N_NEXT_NOISE, j] = k
    lanes[L_ARRIVAL, j] = float(noise_times[k] >> 1) if k < last else NEVER


@jit(error_model="numpy")
def _fire(
    lanes: Float64Array,
    lane_of: Int64Array,
    stepping: Int64Array,
    firing: Int64Array,
    steps: Float64Array,
    noise_times: Int64Array,
    rules: EventRules,
    out: tuple[Uint64Array, Int64Array, int],
) -> int:
    """Add the events of lanes that fire, reset their pixels, and list them as stepping.

    Args:
        lanes: [LANE_ROWS, room].
        lane_of: [4, room].
        stepping: [m] the lanes that stepped; on return those that fire come first.
        firing: [f] which of them fire.
        steps: [STEP_ROWS, room].
        noise_times: as for `_find_next_events`.
        rules: see `EventRules`.
        out: events as key and lane, [2, room], how many of each lane, and how many there are.

    Returns:
        How many events there are now.
    """
    refractory_us, first, low, _, duration_us = rules
    events, count, made = out
    for n in range(firing.size):
        k = firing[n]
        j = stepping[k]
        crossing, arrival = steps[R_NOW, k] + steps[WAIT, k], lanes[L_ARRIVAL, j]
        event, by_noise, is_on = min(crossing, arrival), arrival <= crossing, steps[RISES, k] > 0
        leaked = lanes[L_LEAK, j] * (event - lanes[L_SINCE, j])
        is_noise = by_noise | (is_on & (leaked >= LEAK_SHARE * lanes[L_ON, j]))
        after = math.floor(event)
        if by_noise:
            is_on = noise_times[lane_of[N_NEXT_NOISE, j]] & 1 == 1
            lane_of[N_NEXT_NOISE, j] += 1
            _skip_noise(lanes, lane_of, noise_times, j, -NEVER)
        # Held in reset for the refractory period.
        lanes[L_LEVEL, j], lanes[L_SINCE, j] = np.nan, float(after + refractory_us)
        lanes[L_NOW, j], stepping[n] = event, j
        kind = np.uint64(is_on) << _1 | (_NOISE if is_noise else np.uint64(0))
        pixel = np.uint64(first + lane_of[N_PIXEL, j])
        offset = np.uint64(min(int(after), duration_us - 1))
        events[0, made + n] = offset << np.uint64(low) | pixel << _2 | kind
        events[1, made + n] = lane_of[N_FIRST_LANE, j]
        count[lane_of[N_FIRST_LANE, j]] += 1
    return made + firing.size
