"""Pixels that may fire, in SIMD lanes, through the segments of an interval, compiled.

Lanes are the columns of one array; its rows are the variables of a pixel, and one array because
Numba counts the references to each array that is passed on. Loops over lanes fill vector registers.
All lanes advance together: segment by segment, and on each of them event by event.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulation.physical.circuit import BLOCK, CircuitState
from texvent.simulation.physical.crossing_time import ROWS
from texvent.simulation.random.mismatch import PixelMismatch

Float64Array = NDArray[np.float64]
Int64Array = NDArray[np.int64]
Uint64Array = NDArray[np.uint64]

SETTLED = 2.0**-40
"""A lag below this, log units, is none, so that a static pixel settles."""
(
    L_BRIGHTNESS,
    L_BRIGHTNESS_STOP,
    L_BRIGHTNESS_SLOPE,
    L_LAG,
    L_OFFSET_INTENSITY,
    L_GROWTH_RATIO,
    L_CUTOFF_START,
) = range(7)
"""Rows of lanes, [LANE_ROWS, LANES] float64: the input, at the start of a segment."""
L_SEGMENTS, L_SEGMENT_US = 7, 8
"""Number of segments of the interval, and their duration."""
L_ON, L_OFF, L_LEAK, L_LEVEL, L_SINCE, L_ARRIVAL = range(9, 15)
"""The pixel, and its next noise event."""
CARRIED_ROWS = 15
"""Rows up to here are carried from segment to segment; the others belong to one."""
L_BEGIN, L_END, L_NOW, L_BASE, L_SLOPE, L_TRANSIENT, L_CUTOFF, L_KEPT = range(15, 23)
LANE_ROWS = 23
N_PIXEL, N_FIRST_LANE, N_NEXT_NOISE, N_NOISE_STOP = range(4)
"""Rows of lane_of, [4, LANES] int64: the pixel in each lane, the lane it had at first, its next
noise event, and where those of the next pixel begin."""
STEP_ROWS = ROWS + 6
"""Rows of `Work.steps`."""
LANES = 1512
"""Lanes advanced together. Rows a power of two apart would share few lines of the cache."""


class PixelBlock(NamedTuple):
    """The pixels of one block, [BLOCK] each."""

    brightness: Float64Array
    cutoff: Float64Array
    brightness_stop: Float64Array
    cutoff_stop: Float64Array
    output: Float64Array
    """At the end of the interval, if the pixel does not fire."""
    low: Float64Array
    """Lower bound of the output."""
    high: Float64Array
    """Upper bound of the output."""
    decay: Float64Array
    gain: Float64Array
    cannot_fire: NDArray[np.bool_]
    active: NDArray[np.int64]


class LaneMemory(NamedTuple):
    """Memory for the lanes."""

    lanes: Float64Array
    lane_of: Int64Array
    steps: Float64Array
    """Each lane up to its next event."""
    solving: Float64Array
    stepping: Int64Array
    firing: Int64Array
    events: Int64Array
    """Number of events of each lane."""


@jit
def new_block() -> PixelBlock:
    """Uninitialised memory."""
    return PixelBlock(
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK, np.bool_),
        np.empty(BLOCK, np.int64),
    )


@jit
def new_work() -> LaneMemory:
    """Uninitialised memory."""
    return LaneMemory(
        np.empty((LANE_ROWS, LANES)),
        np.empty((4, LANES), np.int64),
        np.empty((STEP_ROWS, LANES)),
        np.empty((STEP_ROWS, LANES)),
        np.empty(LANES + 1, np.int64),
        np.empty(LANES + 1, np.int64),
        np.empty(LANES, np.int64),
    )


@jit
def load_lanes(
    work: LaneMemory,
    n: int,
    where: tuple[int, int, int],
    block: PixelBlock,
    own: tuple[PixelMismatch, CircuitState],
    noise: tuple[Int64Array, Int64Array],
    start_us: int,
) -> None:
    """Put the active pixels of a block into lanes.

    Args:
        work: the lanes.
        n: how many are taken already.
        where: the block's first pixel, how many are active, and its first noise event.
        block: its input.
        own: its pixels and their state.
        noise: pixels and times, see `_find_next_events`.
        start_us: of the interval, µs.
    """
    (first, size, k), lanes, lane_of = where, work.lanes, work.lane_of
    (on, off, leak), (output, level, since_us, _) = own
    noise_pixel, noise_times = noise
    brightness, brightness_stop, active = block.brightness, block.brightness_stop, block.active
    cutoff, cutoff_stop = block.cutoff, block.cutoff_stop
    for j in active[:size]:
        lane_of[N_PIXEL, n], lane_of[N_FIRST_LANE, n], lane_of[N_NEXT_NOISE, n] = first + j, n, k
        lanes[L_ARRIVAL, n] = np.inf
        if k < noise_pixel.size and noise_pixel[k] == first + j:
            lanes[L_ARRIVAL, n] = float(noise_times[k] >> 1)
            while k < noise_pixel.size and noise_pixel[k] == first + j:
                k += 1
        lane_of[N_NOISE_STOP, n] = k
        lanes[L_BRIGHTNESS, n], lanes[L_BRIGHTNESS_STOP, n] = brightness[j], brightness_stop[j]
        lanes[L_CUTOFF_START, n], lanes[L_CUTOFF, n] = cutoff[j], cutoff_stop[j]
        lanes[L_LAG, n] = brightness[j] - output[j]
        lanes[L_ON, n], lanes[L_OFF, n], lanes[L_LEAK, n] = on[j], off[j], leak[j]
        lanes[L_LEVEL, n], lanes[L_SINCE, n] = level[j], float(since_us[j] - start_us)
        n += 1


@jit
def leave_lanes(
    lanes: Float64Array,
    lane_of: Int64Array,
    size: int,
    segment: float,
    state: CircuitState,
    start_us: int,
) -> int:
    """Write back the lanes without a further segment, close up the others; how many are left."""
    output, level, since_us, _ = state
    staying = 0
    for n in range(size):
        if segment < lanes[L_SEGMENTS, n]:
            if staying < n:
                for row in range(CARRIED_ROWS):
                    lanes[row, staying] = lanes[row, n]
                for row in range(4):
                    lane_of[row, staying] = lane_of[row, n]
            staying += 1
            continue
        i, lag = lane_of[N_PIXEL, n], lanes[L_LAG, n]
        output[i] = lanes[L_BRIGHTNESS_STOP, n] - (0.0 if abs(lag) < SETTLED else lag)
        level[i], since_us[i] = lanes[L_LEVEL, n], start_us + int(lanes[L_SINCE, n])
    return staying
