"""Motion-compensated mixing of two frames, compiled; `tests/pairs/reference.py` defines it.

Some rows at a time, in three stages: find the places (vector instructions), sample both frames
there (`sampling`), mix the samples (vector instructions). The number of threads does not change
the result.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.contested_paths import (
    LOST_PX2,
    LOST_RELATIVE,
    MOST_PX2,
    UNSEEN_WEIGHT,
    VISIBLE_PX2,
    VISIBLE_RELATIVE,
    choose_paths,
    find_sweep,
    list_contested,
    number_contested,
)
from texvent.pairs.sampling import (
    AFTER,
    BEFORE,
    Corners,
    Floats,
    Numbers,
    Samples,
    Words,
    make_corners,
    make_samples,
    sample,
    widen,
)
from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import read_only
from texvent.runtime.threads import count_threads, run_parts, split

POINTS = 3072
"""About how many pixels are warped at a time: their data stays in the nearest caches."""
BAND_ROWS, PARTS_PER_THREAD = 32, 4
"""Fewest rows that a thread takes at a time, and how often it takes some."""
LANES = 64
"""Vector loops are fastest over a multiple of this length."""

# As float32: Numba computes with float64 where a constant is one.
_VISIBLE_RELATIVE, _VISIBLE_PX2 = np.float32(VISIBLE_RELATIVE), np.float32(VISIBLE_PX2)
_LOST_RELATIVE, _LOST_PX2 = np.float32(LOST_RELATIVE), np.float32(LOST_PX2)
_UNSEEN, _MOST = np.float32(UNSEEN_WEIGHT), np.float32(MOST_PX2)
_0, _HALF, _1 = np.float32(0.0), np.float32(0.5), np.float32(1.0)
_ONE = np.uint64(1)


class WarpPair(NamedTuple):
    """Two frames and their motion, in the layout of the kernels."""

    first: Floats
    """[H, W] the earlier frame, intensity."""
    second: Floats
    """[H, W] the later frame."""
    first_wide: Floats
    """`sampling.widen` of the earlier frame."""
    second_wide: Floats
    forward: Words
    """[h · w] flow from first to second, (x, y), px."""
    backward: Words
    """[h · w] flow from second to first."""
    columns: int
    """w: vectors in a row of a flow."""
    shift: int
    """1 where a vector stands for 2×2 px, else 0; see `contested_paths`."""
    sweep: Floats
    """Sweep, from `contested_paths.find_sweep`."""
    contested: Numbers
    """Contested pixels, from `contested_paths.number_contested`."""
    positions: Floats
    """[K] τ of the intermediate frames."""
    chosen: Floats
    """[K, n, 2] path at each of these through the contested pixels, by their number; px."""


class Points(NamedTuple):
    """Pixels and their values that do not depend on the instant; [n], a multiple of `LANES`."""

    vector: Numbers
    """Flat index of its flow."""
    x: Floats
    y: Floats
    forward_x: Floats
    """Forward flow, px."""
    forward_y: Floats
    error_x: Floats
    """Forward plus backward flow, px: 0 where they agree."""
    error_y: Floats
    earlier: Floats
    """Intensity in the earlier frame."""
    later: Floats
    """Intensity in the later frame."""
    contested: Numbers
    """Number of contested points, then their indices; [n + 1]."""


class Room(NamedTuple):
    """Scratch memory for some points."""

    points: Points
    in_first: Samples
    in_second: Samples
    corners: Corners


def prepare_pair(
    first: Floats, second: Floats, forward: Floats, backward: Floats, positions: Sequence[float]
) -> WarpPair:
    """Prepare what the intermediate frames of a pair share.

    Args:
        first: the earlier frame, [H, W] float32, intensity.
        second: the later frame, the same.
        forward: flow from first to second, float32 as (x, y), px: [H, W, 2], or half as many rows
            and columns (rounded up).
        backward: flow from second to first, the same.
        positions: τ of the intermediate frames, 0 = first, 1 = second.
    """
    # Read-only throughout, because Numba compiles for each kind of array again.
    frames = [read_only(first), read_only(second)]
    wide = [read_only(widen(frame)) for frame in frames]
    places = read_only(np.array(positions, np.float32))
    ahead, back = (read_only(np.ascontiguousarray(flow)) for flow in (forward, backward))
    words = [read_only(flow.reshape(-1).view(np.uint64)) for flow in (ahead, back)]
    columns, shift = ahead.shape[1], int(len(ahead) < len(first))
    sweep = read_only(find_sweep(ahead, back, shift))
    contested = read_only(number_contested(ahead, back, sweep, shift))
    chosen = read_only(choose_paths((ahead, back), sweep, shift, contested, places))
    return WarpPair(
        *(frames[0], frames[1], wide[0], wide[1], words[0], words[1]),
        *(columns, shift, sweep, contested, places, chosen),
    )


def warp_pair(pair: WarpPair, start: int, stop: int) -> Floats:
    """Intermediate frames of a pair from number `start` up to `stop`: [n, H, W] intensity.

    Some rows of all of them are computed together, while their data is in the nearest caches.
    """
    height, width = pair.first.shape
    result = np.empty((stop - start, height, width), np.float32)

    def warp(rows: slice) -> None:
        _warp_rows(pair, rows.start, rows.stop, start, result)

    run_parts(warp, split(height, PARTS_PER_THREAD * count_threads(), unit=BAND_ROWS))
    return result


@jit(error_model="numpy")
def _warp_rows(pair: WarpPair, top: int, bottom: int, start: int, result: Floats) -> None:
    width = result.shape[2]
    step = max(POINTS // width, 1)
    room = make_room(min(step, bottom - top) * width)
    for row in range(top, bottom, step):
        end = min(row + step, bottom)
        take_rows(pair, row, end, room.points)
        for k in range(len(result)):
            out = result[k, row:end].reshape(-1)
            warp_points(pair, room, (end - row) * width, start + k, out)


@jit
def make_room(number: int) -> Room:
    """Scratch memory for `number` points; all start as the first pixel, so padding is valid."""
    room = (number + LANES - 1) // LANES * LANES
    points = Points(
        np.zeros(room, np.int32),
        np.zeros(room, np.float32),
        np.zeros(room, np.float32),
        np.zeros(room, np.float32),
        np.zeros(room, np.float32),
        np.zeros(room, np.float32),
        np.zeros(room, np.float32),
        np.zeros(room, np.float32),
        np.zeros(room, np.float32),
        np.zeros(room + 1, np.int32),
    )
    return Room(points, make_samples(room), make_samples(room), make_corners(room))


@jit(inner=True)
def take_rows(pair: WarpPair, top: int, bottom: int, points: Points) -> None:
    """Set the points to all pixels of some rows."""
    vector, x, y, _, _, _, _, earlier, later, _ = points
    shift, width = pair.shift, pair.first.shape[1]
    number = (bottom - top) * width
    # All arrays start at the first of these pixels: Numba allows for negative indices where the
    # loop's index has an offset.
    first, second = pair.first[top:bottom].reshape(-1), pair.second[top:bottom].reshape(-1)
    for row in range(bottom - top):
        inside = slice(row * width, (row + 1) * width)
        columns, rows, vectors = x[inside], y[inside], vector[inside]
        begin = ((top + row) >> shift) * pair.columns
        for k in range(width):
            columns[k], rows[k] = k, top + row
            vectors[k] = begin + (k >> shift)
    for k in range(number):
        earlier[k], later[k] = first[k], second[k]
    _take_flows(pair, number, points)


@jit
def take_points(pair: WarpPair, chosen: NDArray[np.int64], points: Points) -> None:
    """Set the points to some pixels, given by flat index."""
    vector, x, y, _, _, _, _, earlier, later, _ = points
    first, second = pair.first.reshape(-1), pair.second.reshape(-1)
    width, shift = np.uint64(pair.first.shape[1]), np.uint64(pair.shift)
    for k in range(chosen.size):
        i = np.uint64(chosen[k])
        row = i // width
        column = i - row * width
        x[k], y[k] = column, row
        vector[k] = (row >> shift) * np.uint64(pair.columns) + (column >> shift)
        earlier[k], later[k] = first[i], second[i]
    _take_flows(pair, chosen.size, points)


@jit(error_model="numpy", inner=True)
def _take_flows(pair: WarpPair, number: int, points: Points) -> None:
    """Set the flows of the points, and list which of them are contested."""
    vector, _, _, forward_x, forward_y, error_x, error_y, _, _, contested = points
    forward, backward = pair.forward.view(np.float32), pair.backward.view(np.float32)
    for k in range(number):
        i = np.uint64(vector[k])
        j = i + i
        forward_x[k], forward_y[k] = forward[j], forward[j + _ONE]
        error_x[k] = forward[j] + backward[j]
        error_y[k] = forward[j + _ONE] + backward[j + _ONE]
    list_contested(pair.contested, vector, number, contested)


@jit(error_model="numpy", inner=True)
def _take_chosen(pair: WarpPair, points: Points, index: int) -> None:
    """Give contested points the path at this instant, as if both flows agreed on it."""
    for n in range(points.contested[0]):
        k = points.contested[n + 1]
        path = pair.chosen[index, pair.contested[points.vector[k]] - 1]
        points.forward_x[k], points.forward_y[k] = path[0], path[1]
        points.error_x[k], points.error_y[k] = _0, _0


@jit
def warp_points(pair: WarpPair, room: Room, number: int, index: int, out: Floats) -> None:
    """Intensity of the first `number` points in an intermediate frame; fills in out[:number]."""
    points, in_first, in_second, corners = room
    place, shape = pair.positions[index], pair.first.shape
    padded = (number + LANES - 1) // LANES * LANES
    if points.contested[0] > 0:
        _take_chosen(pair, points, index)
    flows = pair.columns, pair.shift
    _locate(points, padded, shape, flows, (place, -place), in_first)
    _locate(points, padded, shape, flows, (place, _1 - place), in_second)
    wide = shape[1] + BEFORE + AFTER
    sample(pair.first_wide, pair.forward, number, wide, (in_first, corners))
    sample(pair.second_wide, pair.backward, number, wide, (in_second, corners))
    _mix(points, in_first, in_second, number, place, out)


@jit(error_model="numpy", inner=True)
def _locate(
    points: Points,
    number: int,
    shape: tuple[int, int],
    flows: tuple[int, int],
    times: tuple[np.float32, np.float32],
    samples: Samples,
) -> None:
    """Find the places of points in a frame: the second of the times along their path."""
    position, share = times
    _, column, row, forward_x, forward_y, error_x, error_y, _, _, _ = points
    corner, nearest, u, v, outside, _, _ = samples
    wide, before = np.int32(shape[1] + BEFORE + AFTER), np.int32(BEFORE)
    columns, shift = np.int32(flows[0]), np.int32(flows[1])
    last_column, last_row = np.float32(shape[1] - 1), np.float32(shape[0] - 1)
    for k in range(number):
        shift_x = share * (forward_x[k] - position * error_x[k])
        shift_y = share * (forward_y[k] - position * error_y[k])
        # In this order a NaN in the flow leads to the edge, not outside the array.
        x = min(max(-column[k], shift_x), last_column - column[k])
        y = min(max(-row[k], shift_y), last_row - row[k])
        outside[k] = max(abs(shift_x - x), abs(shift_y - y))
        left, up = np.floor(x), np.floor(y)
        right, down = x - left, y - up
        u[k], v[k] = right, down
        top, beside = np.int32(row[k] + up), np.int32(column[k] + left)
        corner[k] = (top + before) * wide + beside + before
        top, beside = top + np.int32(down >= _HALF), beside + np.int32(right >= _HALF)
        nearest[k] = (top >> shift) * columns + (beside >> shift)


@jit(error_model="numpy", inner=True)
def _mix(
    points: Points,
    in_first: Samples,
    in_second: Samples,
    number: int,
    position: np.float32,
    out: Floats,
) -> None:
    """Mix the samples of both frames."""
    _, _, _, forward_x, forward_y, error_x, error_y, earlier, later, _ = points
    outside1, outside2 = in_first.outside, in_second.outside
    value1, value2 = in_first.value, in_second.value
    flow1, flow2 = in_first.flow.view(np.float32), in_second.flow.view(np.float32)
    rest = _1 - position
    for k in range(number):
        path_x = forward_x[k] - position * error_x[k]
        path_y = forward_y[k] - position * error_y[k]
        length2 = min(path_x * path_x + path_y * path_y, _MOST)
        x, y = flow1[2 * k] - path_x, flow1[2 * k + 1] - path_y
        error1 = min(x * x + y * y, _MOST)
        x, y = flow2[2 * k] + path_x, flow2[2 * k + 1] + path_y
        error2 = min(x * x + y * y, _MOST)

        visible = _VISIBLE_RELATIVE * length2 + _VISIBLE_PX2
        visible = visible * visible
        doubt1, doubt2 = visible + error1 * error1, visible + error2 * error2
        trust1 = visible / doubt1 if outside1[k] <= _HALF else _0
        trust2 = visible / doubt2 if outside2[k] <= _HALF else _0
        unseen1, unseen2 = _UNSEEN * doubt1, _UNSEEN * doubt2
        seen1 = (visible if outside1[k] <= _HALF else _0) + unseen1 * (_1 - trust2)
        seen2 = (visible if outside2[k] <= _HALF else _0) + unseen2 * (_1 - trust1)
        weight1, weight2 = rest * (seen1 * doubt2), position * (seen2 * doubt1)
        a, b = value1[k], value2[k]
        warped = a + (b - a) * (weight2 / (weight1 + weight2))

        lost = _LOST_RELATIVE * length2 + _LOST_PX2
        lost = lost * lost
        error = min(error1, error2)
        confidence = lost / (lost + error * error)
        blended = earlier[k] + (later[k] - earlier[k]) * position
        out[k] = blended + (warped - blended) * confidence
