"""Pixels side by side: from their block into the lanes of `circuit_walk_cpu`, and back."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulate.physical.kernels.circuit import BLOCK, Pixels, PixelState
from texvent.simulate.physical.kernels.circuit_reference import SETTLED
from texvent.simulate.physical.kernels.crossing_time_cpu import ROWS

Float64Array = NDArray[np.float64]
Int64Array = NDArray[np.int64]
Uint64Array = NDArray[np.uint64]

L_BRIGHT, L_BRIGHT_NOW, L_SLOPE, L_LAG, L_GLOW, L_GROWTH, L_CORNER_FROM = range(7)
"""Rows of lanes, [LANE_ROWS, LANES] float64: the light, see `circuit_reference._Walk`."""
L_PIECES, L_LENGTH = 7, 8
"""Into how many pieces the interval is cut, and how long they are."""
L_ON, L_OFF, L_LEAK, L_LEVEL, L_SINCE, L_ARRIVAL = range(9, 15)
"""The pixel, and its next noise event."""
CARRIED_ROWS = 15
"""Rows up to here go on from piece to piece; the others belong to one."""
L_BEGIN, L_END, L_NOW, L_BASE, L_TILT, L_TRANSIENT, L_CORNER, L_KEPT = range(15, 23)
LANE_ROWS = 23
N_PIXEL, N_NUMBER, N_NOISE, N_LAST_NOISE = range(4)
"""Rows of names, [4, LANES] int64: which pixel a lane is, which lane it was at first, its next
noise event, and where those of the next pixel begin."""
MOVE_ROWS = ROWS + 6
"""Rows of `Work.moves`."""
LANES = 1512
"""Pixels that walk together. Rows a power of two apart would share few lines of the cache."""


class Block(NamedTuple):
    """What is known of the pixels of one block, [BLOCK] each."""

    bright: Float64Array
    corner: Float64Array
    bright_now: Float64Array
    corner_now: Float64Array
    output: Float64Array
    """At the end of the interval, if the pixel is calm."""
    low: Float64Array
    """The outputs stay above it."""
    high: Float64Array
    """The outputs stay below it."""
    decay: Float64Array
    gain: Float64Array
    is_calm: NDArray[np.bool_]
    restless: NDArray[np.int64]


class Work(NamedTuple):
    """Memory for those that walk."""

    lanes: Float64Array
    names: Int64Array
    moves: Float64Array
    solving: Float64Array
    moving: Int64Array
    firing: Int64Array
    events: Int64Array
    """How many events each lane has."""


@jit
def new_block() -> Block:
    """Memory of any content."""
    return Block(
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
def new_work() -> Work:
    """Memory of any content."""
    return Work(
        np.empty((LANE_ROWS, LANES)),
        np.empty((4, LANES), np.int64),
        np.empty((MOVE_ROWS, LANES)),
        np.empty((MOVE_ROWS, LANES)),
        np.empty(LANES + 1, np.int64),
        np.empty(LANES + 1, np.int64),
        np.empty(LANES, np.int64),
    )


@jit
def load_lanes(
    work: Work,
    n: int,
    where: tuple[int, int, int],
    block: Block,
    own: tuple[Pixels, PixelState],
    noise: tuple[Int64Array, Int64Array],
    start_us: int,
) -> None:
    """Put the restless pixels of a block into lanes.

    Args:
        work: the lanes.
        n: how many are taken already.
        where: the block's first pixel, how many are restless, and its first noise event.
        block: what it sees.
        own: its pixels and their state.
        noise: pixels and times, see `move`.
        start_us: of the interval, µs.
    """
    (first, size, k), lanes, names = where, work.lanes, work.names
    (on, off, leak), (output, level, since_us, _) = own
    noise_pixel, noise_times = noise
    bright, bright_now, restless = block.bright, block.bright_now, block.restless
    corner, corner_now = block.corner, block.corner_now
    for j in restless[:size]:
        names[N_PIXEL, n], names[N_NUMBER, n], names[N_NOISE, n] = first + j, n, k
        lanes[L_ARRIVAL, n] = np.inf
        if k < noise_pixel.size and noise_pixel[k] == first + j:
            lanes[L_ARRIVAL, n] = float(noise_times[k] >> 1)
            while k < noise_pixel.size and noise_pixel[k] == first + j:
                k += 1
        names[N_LAST_NOISE, n] = k
        lanes[L_BRIGHT, n], lanes[L_BRIGHT_NOW, n] = bright[j], bright_now[j]
        lanes[L_CORNER_FROM, n], lanes[L_CORNER, n] = corner[j], corner_now[j]
        lanes[L_LAG, n] = bright[j] - output[j]
        lanes[L_ON, n], lanes[L_OFF, n], lanes[L_LEAK, n] = on[j], off[j], leak[j]
        lanes[L_LEVEL, n], lanes[L_SINCE, n] = level[j], float(since_us[j] - start_us)
        n += 1


@jit
def leave_lanes(
    lanes: Float64Array,
    names: Int64Array,
    size: int,
    piece: float,
    state: PixelState,
    start_us: int,
) -> int:
    """Write back the lanes that have no further piece, close up the others; how many those are."""
    output, level, since_us, _ = state
    staying = 0
    for n in range(size):
        if piece < lanes[L_PIECES, n]:
            if staying < n:
                for row in range(CARRIED_ROWS):
                    lanes[row, staying] = lanes[row, n]
                for row in range(4):
                    names[row, staying] = names[row, n]
            staying += 1
            continue
        i, lag = names[N_PIXEL, n], lanes[L_LAG, n]
        output[i] = lanes[L_BRIGHT_NOW, n] - (0.0 if abs(lag) < SETTLED else lag)
        level[i], since_us[i] = lanes[L_LEVEL, n], start_us + int(lanes[L_SINCE, n])
    return staying
