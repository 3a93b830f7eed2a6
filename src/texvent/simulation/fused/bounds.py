"""Bounds of the luma of a pixel between two frames, and the types of the fused pass.

**Candidates.** A pixel compares its brightness ln(α + I) with a reference ln(A). It fires where the
two differ by θ_on upwards or θ_off downwards: where α + I ≥ A·e^θ_on or α + I ≤ A·e^−θ_off. So two
multiplications decide where a pixel may fire, without a logarithm. `candidates` evaluates the
pixels of one pair of frames at every intermediate instant and lists each place where this is so,
with a margin (`trigger_levels.MARGIN`). The simulator then decides in NumPy, with its own
logarithm. Where the margin leaves open whether a pixel fired, all its later instants are listed.

**Segments.** K intermediate instants divide the time between the two frames into K + 1 segments.

**Bounds.** Every intermediate frame is, pixel by pixel, a mean of samples of both frames, at most
the length of the flow away (`pairs`: the displacement to a frame is τ or 1 − τ times a mean of one
flow and the other reversed). A sample stays in the range of the four pixels around it. So the luma
of a pixel is between the darkest and the brightest that both frames have within that distance.

* Up to 1 px of flow, a sample differs from the pixel itself by less than `|dx|` times the steps to
  its left and right neighbours (in the rows it may touch) plus `|dy|` times those up and down, plus
  the bends of the cubic sampling along x and y times at most `|dx|`, `|dy|` and 1/4. A bend is
  `(p0 − p1 + p3 − p2) / 4`, at most half of the largest step between neighbours.
* Further out, the extremes around the samples at each intermediate instant, for all pixels of a
  vector of the flow at once: their samples are as far away, rounded down, as those of the first.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulation.crossing.trigger_levels import MARGIN

Float32Array: TypeAlias = NDArray[np.float32]
Float64Array: TypeAlias = NDArray[np.float64]
Int64Array: TypeAlias = NDArray[np.int64]


class BoundedPair(NamedTuple):
    """Two frames and the motion between them, with bounds of what their pixels can reach."""

    pair: Any
    """`pairs.warping.WarpPair`."""
    reach: Float32Array
    """[2, h, w] how far along x and y the samples of a vector's pixels may be, px."""
    bounds: Float32Array
    """[2, h, w] darkest and brightest luma of those samples, if their reach is beyond a pixel."""


class ReferenceLevels(NamedTuple):
    """References of the pixels, and the rule by which they move."""

    reference: Float64Array
    """[H, W] A of every pixel at the start, a balanced level; [0, 0]: the earlier frame's own."""
    balance: float
    """α."""
    up: float
    """e^θ_on."""
    down: float
    """e^−θ_off."""
    is_step: bool
    """Whether a reference moves by the thresholds passed; else to the level where it fires."""


class CrossingCandidates(NamedTuple):
    """Places where a pixel may have fired, by pixel, then in time."""

    pixel: Int64Array
    """[n] flat index y · W + x."""
    segment: NDArray[np.int16]
    """[n] which segment, from 0."""
    before: Float32Array
    """[n] luma at the start of the segment."""
    now: Float32Array
    """[n] luma at its end."""

    def take(self, rows: Int64Array | slice) -> CrossingCandidates:
        """Some of the candidates, by number."""
        return CrossingCandidates(
            self.pixel[rows], self.segment[rows], self.before[rows], self.now[rows]
        )


SLACK = 8.0 * MARGIN
"""Relative margin of trigger levels for rounding."""
_QUARTER, _HALF, _1 = np.float32(0.25), np.float32(0.5), np.float32(1.0)
ROUNDING = np.float32(1e-6)
"""Largest excess of a rounded mean over its terms, as a share of the brightest; ten times the
error of mixing float32."""

Rows = tuple[
    NDArray[np.float32],
    NDArray[np.float32],
    NDArray[np.float32],
    NDArray[np.float32],
    NDArray[np.float32],
]
"""A row, in the middle, and the two on each side; at the border of the image the last one again."""


@jit
def bound_paths(pair: Any) -> tuple[Float32Array, Float32Array]:
    """Reach and bounds of a `BoundedPair`."""
    width = pair.columns
    reach = _find_reach(pair)
    first, second = np.empty_like(reach), np.empty_like(reach)
    bounds = np.empty_like(reach)
    _find_extremes(pair.first, pair.shift, first[0], first[1])
    _find_extremes(pair.second, pair.shift, second[0], second[1])
    words = _with_next(first[0], first[1]), _with_next(second[0], second[1])
    column = np.empty(width, np.int64)
    for y in range(reach.shape[1]):
        along, down, low, high = reach[0, y], reach[1, y], bounds[0, y], bounds[1, y]
        for x in range(width):
            low[x] = min(first[0, y, x], second[0, y, x])
            high[x] = max(first[1, y, x], second[1, y, x])
        number = 0
        for x in range(width):
            column[number] = x
            number += not ((along[x] <= _1) & (down[x] <= _1))
        if number:
            _follow_paths(pair, words, y, column[:number], low, high)
    return reach, bounds


@jit(inner=True)
def _find_reach(pair: Any) -> Float32Array:
    """Largest distance along x and y of a vector's pixels from their samples, [2, h, w] px."""
    width, height = pair.columns, pair.forward.size // pair.columns
    forward, backward = pair.forward.view(np.float32), pair.backward.view(np.float32)
    reach = np.empty((2, height, width), np.float32)
    for y in range(height):
        row = slice(2 * y * width, 2 * (y + 1) * width)
        ahead, back, along, down = forward[row], backward[row], reach[0, y], reach[1, y]
        for x in range(width):
            along[x] = max(abs(ahead[2 * x]), abs(back[2 * x]))
            down[x] = max(abs(ahead[2 * x + 1]), abs(back[2 * x + 1]))
        if pair.sweep.size:
            swept = pair.sweep[y].reshape(-1)
            for x in range(width):
                along[x] = max(along[x], abs(swept[2 * x]))
                down[x] = max(down[x], abs(swept[2 * x + 1]))
    return reach


@jit(inner=True)
def _find_extremes(image: Float32Array, shift: int, low: Float32Array, high: Float32Array) -> None:
    """Fill in the darkest and brightest luma of the pixels of each vector."""
    height, width = image.shape
    for y in range(0 if shift else height):
        for x in range(width):
            low[y, x], high[y, x] = image[y, x], image[y, x]
    for y in range(len(low) if shift else 0):
        upper, lower = image[2 * y], image[min(2 * y + 1, height - 1)]
        least, most = low[y], high[y]
        for x in range(width // 2):
            a, b, c, d = upper[2 * x], upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]
            least[x], most[x] = min(min(a, b), min(c, d)), max(max(a, b), max(c, d))
        if width % 2:
            a, b = upper[width - 1], lower[width - 1]
            least[width // 2], most[width // 2] = min(a, b), max(a, b)


@jit(inner=True)
def _with_next(low: Float32Array, high: Float32Array) -> NDArray[np.uint64]:
    """Extremes of each vector's pixels and of the next ones to the right and below, [h · w]."""
    height, width = low.shape
    words = np.empty((height, 2 * width), np.float32)
    least, most = np.empty(width, np.float32), np.empty(width, np.float32)
    for y in range(height):
        below = min(y + 1, height - 1)
        for x in range(width):
            least[x], most[x] = min(low[y, x], low[below, x]), max(high[y, x], high[below, x])
        row, last = words[y], width - 1
        for x in range(last):
            row[2 * x] = min(least[x], least[x + 1])
            row[2 * x + 1] = max(most[x], most[x + 1])
        row[2 * last], row[2 * last + 1] = least[last], most[last]
    return words.reshape(-1).view(np.uint64)


@jit(error_model="numpy", inner=True)
def _follow_paths(
    pair: Any,
    words: tuple[NDArray[np.uint64], NDArray[np.uint64]],
    row: int,
    column: Int64Array,
    low: Float32Array,
    high: Float32Array,
) -> None:
    """Extend the extremes of some vectors of a row, [n], by those around their samples."""
    path = np.empty((2, column.size), np.float32)
    place, found = np.empty(column.size, np.int64), np.empty(column.size, np.uint64)
    values = found.view(np.float32)
    for index in range(pair.positions.size):
        _take_paths(pair, row, column, index, path)
        for side in range(2):
            share = -pair.positions[index] if side == 0 else _1 - pair.positions[index]
            _find_places(pair, row, column, (share, path), place)
            for k in range(column.size):
                found[k] = words[side][np.uint64(place[k])]
            for k in range(column.size):
                x = column[k]
                low[x], high[x] = min(low[x], values[2 * k]), max(high[x], values[2 * k + 1])


@jit(error_model="numpy", inner=True)
def _take_paths(pair: Any, row: int, column: Int64Array, index: int, path: Float32Array) -> None:
    """Set the paths of some vectors at an instant, [2, n] px, as `warping` takes them."""
    forward, backward = pair.forward.view(np.float32), pair.backward.view(np.float32)
    position, start = pair.positions[index], row * pair.columns
    for k in range(column.size):
        i = np.uint64(start + column[k])
        for axis in range(2):
            j = i + i + np.uint64(axis)
            path[axis, k] = forward[j] - position * (forward[j] + backward[j])
        if pair.contested.size and pair.contested[i]:
            path[0, k], path[1, k] = pair.chosen[index, pair.contested[i] - 1]


@jit(error_model="numpy", inner=True)
def _find_places(
    pair: Any,
    row: int,
    column: Int64Array,
    shares: tuple[np.float32, Float32Array],
    place: Int64Array,
) -> None:
    """Find the vectors that samples of the first pixels of some are at, as `warping` does."""
    share, (along, down) = shares[0], (shares[1][0], shares[1][1])
    shift, columns, y = pair.shift, pair.columns, np.float32(row << pair.shift)
    last_column, last_row = np.float32(pair.first.shape[1] - 1), np.float32(len(pair.first) - 1)
    for k in range(column.size):
        x = np.float32(column[k] << shift)
        to_x = x + np.floor(min(max(-x, share * along[k]), last_column - x))
        to_y = y + np.floor(min(max(-y, share * down[k]), last_row - y))
        place[k] = (np.int64(to_y) >> shift) * columns + (np.int64(to_x) >> shift)


@jit
def list_active(
    bounded: BoundedPair, levels: ReferenceLevels, row: int, active: NDArray[np.int64]
) -> int:
    """Find the pixels of a row that may fire; the others cannot.

    Args:
        bounded: the pair.
        levels: what the pixels are compared with.
        row: which row.
        active: [W], filled in with their columns.

    Returns:
        How many there are.
    """
    pair, reach, bounds = bounded
    earlier, later, width = pair.first, pair.second, pair.first.shape[1]
    low, high = np.empty(width, np.float32), np.empty(width, np.float32)
    first, second = _rows_around(earlier, row), _rows_around(later, row)
    inside = row >> pair.shift
    _bound_row(first, second, reach[:, inside], bounds[:, inside], low, high)
    level = levels.reference[row] if levels.reference.size else earlier[row] + levels.balance
    marks = np.zeros((width + 7) // 8, np.uint64)
    _mark(low, high, level, levels, marks.view(np.uint8)[:width])
    number = 0
    for word in range(marks.size):
        if marks[word]:
            for x in range(8 * word, min(8 * word + 8, width)):
                active[number] = x
                number += marks.view(np.uint8)[x]
    return number


@jit(inline="always")
def _rows_around(image: NDArray[np.float32], row: int) -> Rows:
    last = len(image) - 1
    above, below = max(row - 1, 0), min(row + 1, last)
    outer = image[max(row - 2, 0)], image[min(row + 2, last)]
    return outer[0], image[above], image[row], image[below], outer[1]


@jit(inner=True)
def _mark(
    low: NDArray[np.float32],
    high: NDArray[np.float32],
    level: NDArray[np.float64],
    levels: ReferenceLevels,
    marks: NDArray[np.uint8],
) -> None:
    """Set 1 where a pixel may fire, else 0."""
    balance, up, down = levels.balance, levels.up * (1.0 - SLACK), levels.down * (1.0 + SLACK)
    for x in range(low.size):
        room = ROUNDING * high[x]
        is_up = high[x] + room + balance >= level[x] * up
        is_down = low[x] - room + balance <= level[x] * down
        marks[x] = is_up | is_down


@jit(inner=True)
def _bound_row(
    first: Rows,
    second: Rows,
    reach: NDArray[np.float32],
    bounds: NDArray[np.float32],
    low: NDArray[np.float32],
    high: NDArray[np.float32],
) -> None:
    """Fill in bounds of a row: near ones where it reaches at most a pixel, else the path's."""
    width = low.size
    work, steps = np.empty((7, width), np.float32), np.zeros((2, width + 3), np.float32)
    dx, dy, least, most = work[0], work[1], work[2], work[3]
    room_first, room_second, memory = work[4], work[5], (work[6], steps)
    _spread(reach[0], dx)
    _spread(reach[1], dy)
    _spread(bounds[0], least)
    _spread(bounds[1], most)
    _find_room(first, dx, dy, memory, room_first)
    _find_room(second, dx, dy, memory, room_second)
    a, b = first[2], second[2]
    for x in range(width):
        is_near = (dx[x] <= _1) & (dy[x] <= _1)
        near = min(a[x] - room_first[x], b[x] - room_second[x])
        far = max(a[x] + room_first[x], b[x] + room_second[x])
        low[x] = near if is_near else least[x]
        high[x] = far if is_near else most[x]


@jit(inner=True)
def _spread(values: NDArray[np.float32], out: NDArray[np.float32]) -> None:
    """Fill in a row with its values, or with each of them twice."""
    if values.size == out.size:
        for x in range(out.size):
            out[x] = values[x]
        return
    for x in range(out.size // 2):
        out[2 * x], out[2 * x + 1] = values[x], values[x]
    out[-1] = values[-1]


@jit(inner=True)
def _find_room(
    rows: Rows,
    dx: NDArray[np.float32],
    dy: NDArray[np.float32],
    memory: tuple[NDArray[np.float32], NDArray[np.float32]],
    room: NDArray[np.float32],
) -> None:
    """Largest difference between a row's pixels and samples at most (dx, dy) away.

    Args:
        rows: rows of the image, [W] each.
        dx: [W] px.
        dy: [W] px.
        memory: scratch memory, [W] and [2, W + 3], 0 at both ends of the latter.
        room: [W], filled in.
    """
    above_2, above, here, below, below_2 = rows
    vertical, steps = memory
    # From each pixel to the next one, the largest of three rows, from index 2 on.
    along, down = steps[0, 2:], steps[1, 1:]
    above_1, here_1, below_1 = above[1:], here[1:], below[1:]
    for x in range(here.size - 1):
        upper, lower = abs(above_1[x] - above[x]), abs(below_1[x] - below[x])
        along[x] = max(max(upper, lower), abs(here_1[x] - here[x]))
    for x in range(here.size):
        vertical[x] = max(abs(above[x] - here[x]), abs(below[x] - here[x]))
        outer = max(abs(above_2[x] - above[x]), abs(below_2[x] - below[x]))
        down[x] = max(vertical[x], outer)
    left_2, left, right, right_2 = steps[0], steps[0, 1:], steps[0, 2:], steps[0, 3:]
    down_left, down_right = steps[1], steps[1, 2:]
    for x in range(room.size):
        aside = max(left[x], right[x])
        # A bend is at most half of the largest step around.
        bend = max(aside, max(left_2[x], right_2[x]))
        bend_2 = max(down[x], max(down_left[x], down_right[x]))
        bent = min(dx[x], _QUARTER) * bend + min(dy[x], _QUARTER) * bend_2
        room[x] = dx[x] * aside + dy[x] * vertical[x] + _HALF * bent
