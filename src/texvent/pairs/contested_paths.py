"""Paths through pixels where two surfaces meet, and how far flows are trusted; compiled.

At an instant, a pixel shows what is there then, not what is there in either frame. Where both flows
at a pixel agree, both say what passes. Where they do not, and the other frame confirms at least one
of them, one surface is there in the earlier frame and another in the later one; and a small fast
thing may pass that is there in neither (the sweep). Of all these motions the path takes the one
that the flows at its own two ends confirm best.

How far two flows may disagree before they are no longer trusted:
The error of a flow is the distance between the path it claims (from the earlier to the later
frame) and the path that the flow of the other direction claims for the same point. Squared, e, and
with a squared tolerance T, the flow is trusted by T² / (T² + e²): 1 for no error, 1/2 at the
tolerance, falling to 0 with the fourth power of the error.

A flow [h, w, 2] holds a vector, px, for each pixel, or for each 2×2: `shift` is 0 or 1, and that of
pixel (y, x) is `flow[y >> shift, x >> shift]`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit

VISIBLE_RELATIVE = 0.01
VISIBLE_PX2 = 0.1
"""A point counts as seen in a frame if its squared error is below
`VISIBLE_RELATIVE · |path|² + VISIBLE_PX2`, px²: a third of a pixel plus a tenth of the path. This
is the usual occlusion test (Sundaram, Brox and Keutzer 2010), made gradual."""

UNSEEN_WEIGHT = 0.2
"""Weight of a frame at a point that it seems not to show, as far as the other frame is not trusted
either."""

LOST_RELATIVE = 0.5
LOST_PX2 = 2.0
"""The motion counts as lost if, in both frames, the squared error is above
`LOST_RELATIVE · |path|² + LOST_PX2`, px²: an error of 0.7 of the path says nothing about motion.
There the two frames are blended where they are."""

CONTESTED_RELATIVE, CONTESTED_PX2 = 0.1, 16.0
"""Limit of the difference of the two flows at a pixel: this share of the longer one, squared, plus
this, px². Above it two surfaces meet there, and the path is chosen among theirs."""

CLEARLY_BETTER = 0.3
"""Least gain in agreement of the flows (0..2) for which a path takes the place of the mean."""

SWEPT = 1.5
"""Least agreement of the flows on a surface that passes in front, 0..2."""

LEAST_SWEEP_PX2, MOST_SWEEP_PX2 = 9.0, 2304.0
"""A surface that moves less, squared, covers each pixel of its path in one of the frames. One that
moves more is not followed along its path, which would take too long."""

MOST_PX2 = 1e9
"""Squares of longer paths and larger errors count as this, so that float32 can hold the products
of the weights."""

Floats = NDArray[np.float32]
Numbers = NDArray[np.int32]
Vector = tuple[np.float32, np.float32]

# As float32: Numba computes with float64 where a constant is one.
_VISIBLE_RELATIVE, _VISIBLE_PX2 = np.float32(VISIBLE_RELATIVE), np.float32(VISIBLE_PX2)
_RELATIVE, _CONTESTED = np.float32(CONTESTED_RELATIVE), np.float32(CONTESTED_PX2)
_LEAST_SWEEP, _MOST_SWEEP = np.float32(LEAST_SWEEP_PX2), np.float32(MOST_SWEEP_PX2)
_MOST = np.float32(MOST_PX2)
_BETTER, _SWEPT = np.float32(CLEARLY_BETTER), np.float32(SWEPT)
_0, _HALF, _1 = np.float32(0.0), np.float32(0.5), np.float32(1.0)


@jit(error_model="numpy")
def find_sweep(forward: Floats, backward: Floats, shift: int) -> Floats:
    """Motion of surfaces that pass a pixel between the frames but are there in neither.

    Args:
        forward: [h, w, 2] px.
        backward: [h, w, 2] px.
        shift: see above.

    Returns:
        [h, w, 2] px, 0 where nothing does so; [0, 0, 2] where nothing does anywhere.
    """
    height, width, _ = forward.shape
    scale = _vectors_per_px(shift)
    sweep, apart = np.empty((0, 0, 2), np.float32), np.empty(width, np.int64)
    for y in range(height):
        for x in apart[: _list_apart(forward[y], backward[y], apart)]:
            u, v = forward[y, x, 0], forward[y, x, 1]
            length2 = u * u + v * v
            # Also false for a flow that is no number.
            if not (length2 >= _LEAST_SWEEP and length2 <= _MOST_SWEEP):
                continue
            limit = _RELATIVE * length2 + _CONTESTED
            if _apart2(backward, x, y, (-u, -v)) <= limit:
                continue
            if not _is_met(forward, backward, x, y, scale):
                continue
            if sweep.size == 0:
                sweep = np.zeros((height, width, 2), np.float32)
            steps = math.ceil(scale * max(abs(u), abs(v)))
            for k in range(1, steps):
                share = scale * (np.float32(k) / np.float32(steps))
                place = np.float32(y) + share * v, np.float32(x) + share * u
                _write_sweep(sweep, forward, backward, place, (u, v))
    return sweep


@jit(error_model="numpy", inner=True)
def _list_apart(forward: Floats, backward: Floats, apart: NDArray[np.int64]) -> int:
    """List the columns of a row at which the flows may be those of two surfaces; how many."""
    ahead, back, width = forward.reshape(-1), backward.reshape(-1), len(forward)
    marks, is_any = np.empty(width, np.uint8), np.uint8(0)
    for x in range(width):
        u, v = ahead[2 * x] + back[2 * x], ahead[2 * x + 1] + back[2 * x + 1]
        marks[x] = not u * u + v * v <= _CONTESTED
        is_any |= marks[x]
    number = 0
    if is_any:
        for x in range(width):
            apart[number] = x
            number += marks[x]
    return number


@jit(error_model="numpy", inner=True)
def _is_met(flow: Floats, other: Floats, x: int, y: int, scale: np.float32) -> bool:
    """Whether a vector leads to one that leads back, within a pixel."""
    height, width, _ = flow.shape
    u, v = flow[y, x, 0], flow[y, x, 1]
    length2 = u * u + v * v
    if not length2 < _MOST:
        return False
    column, row = _nearest(np.float32(x) + scale * u), _nearest(np.float32(y) + scale * v)
    if column < 0 or row < 0 or column >= width or row >= height:
        return False
    return bool(_apart2(other, column, row, (-u, -v)) <= _VISIBLE_RELATIVE * length2 + _1)


@jit(error_model="numpy", inner=True)
def _write_sweep(
    sweep: Floats, forward: Floats, backward: Floats, place: Vector, path: Vector
) -> None:
    """Note a path around a place, (row, column) of the flows, where these differ from it."""
    u, v = path
    length2 = u * u + v * v
    limit = _RELATIVE * length2 + _CONTESTED
    top, left = int(np.floor(place[0])), int(np.floor(place[1]))
    bottom, right = int(np.ceil(place[0])), int(np.ceil(place[1]))
    height, width, _ = forward.shape
    for i in range(max(top, 0), min(bottom + 1, height)):
        for j in range(max(left, 0), min(right + 1, width)):
            held = sweep[i, j]
            if held[0] * held[0] + held[1] * held[1] >= length2:
                continue
            nearest = min(_apart2(forward, j, i, (u, v)), _apart2(backward, j, i, (-u, -v)))
            if nearest > limit:
                held[0], held[1] = u, v


@jit(inner=True)
def _vectors_per_px(shift: int) -> np.float32:
    return _HALF if shift else _1


@jit(inner=True)
def _nearest(place: np.float32) -> int:
    return int(np.floor(place + _HALF))


@jit(error_model="numpy", inner=True)
def _apart2(flow: Floats, x: int, y: int, other: Vector) -> np.float32:
    """Squared distance of the flow at a pixel from another one."""
    u, v = flow[y, x, 0] - other[0], flow[y, x, 1] - other[1]
    return min(u * u + v * v, _MOST)


@jit(error_model="numpy")
def number_contested(forward: Floats, backward: Floats, sweep: Floats, shift: int) -> Numbers:
    """Numbers, from 1, of the vectors whose pixels' path has to be chosen; 0 elsewhere.

    Returns:
        [h · w]; empty if there are none.
    """
    height, width, _ = forward.shape
    scale = _vectors_per_px(shift)
    numbers, apart = np.zeros(height * width, np.int32), np.empty(width, np.int64)
    swept, count = sweep.reshape(-1), 0
    for i in range(swept.size // 2):
        if (swept[2 * i] != _0) | (swept[2 * i + 1] != _0):
            count += 1
            numbers[i] = count
    for y in range(height):
        for x in apart[: _list_apart(forward[y], backward[y], apart)]:
            u, v = forward[y, x, 0], forward[y, x, 1]
            p, q = backward[y, x, 0], backward[y, x, 1]
            limit = _RELATIVE * min(max(u * u + v * v, p * p + q * q), _MOST) + _CONTESTED
            if numbers[y * width + x] or _apart2(backward, x, y, (-u, -v)) <= limit:
                continue
            if _is_met(forward, backward, x, y, scale) or _is_met(backward, forward, x, y, scale):
                count += 1
                numbers[y * width + x] = count
    return numbers if count else numbers[:0]


@jit(inner=True)
def list_contested(numbers: Numbers, vector: Numbers, number: int, contested: Numbers) -> None:
    """Fill in how many of some points are contested, then which.

    Args:
        numbers: of `number_contested`.
        vector: [n] flat index of each point's.
        number: how many points there are.
        contested: [n + 1].
    """
    contested[0] = 0
    if numbers.size == 0:
        return
    count = 0
    for k in range(number):
        contested[count + 1] = k
        count += numbers[np.uint64(vector[k])] > 0
    contested[0] = count


@jit(error_model="numpy")
def choose_paths(
    flows: tuple[Floats, Floats], sweep: Floats, shift: int, numbers: Numbers, positions: Floats
) -> Floats:
    """The path through contested pixels that both flows confirm best.

    Args:
        flows: forward and backward, [h, w, 2] px.
        sweep: of `find_sweep`.
        shift: see above; one path is chosen for the middle of what a vector stands for.
        numbers: of `number_contested`.
        positions: [K] τ of the instants.

    Returns:
        [K, n, 2] px from the earlier to the later frame, by number.
    """
    width, count = flows[0].shape[1], 0
    for i in range(numbers.size):
        count = max(count, numbers[i])
    chosen = np.empty((positions.size, count, 2), np.float32)
    for i in range(numbers.size):
        if numbers[i]:
            cell = i % width, i // width
            for k in range(positions.size):
                path = _choose_path(flows, sweep, shift, cell, positions[k])
                chosen[k, numbers[i] - 1, 0], chosen[k, numbers[i] - 1, 1] = path
    return chosen


@jit(error_model="numpy", inner=True)
def _choose_path(
    flows: tuple[Floats, Floats],
    sweep: Floats,
    shift: int,
    cell: tuple[int, int],
    position: np.float32,
) -> Vector:
    (x, y), (forward, backward) = cell, flows
    middle = _HALF * np.float32(shift)
    pixel = np.float32(x << shift) + middle, np.float32(y << shift) + middle
    u, v = forward[y, x, 0], forward[y, x, 1]
    p, q = backward[y, x, 0], backward[y, x, 1]
    best = u - position * (u + p), v - position * (v + q)
    most = _confirmed(flows, shift, pixel, best, position) + _BETTER
    for k in range(3):
        if k == 0:
            path = u, v
        elif k == 1:
            path = -p, -q
        elif sweep.size > 0 and (sweep[y, x, 0] != _0 or sweep[y, x, 1] != _0):
            path = sweep[y, x, 0], sweep[y, x, 1]
            most = _SWEPT  # what passes is in front
        else:
            break
        seen = _confirmed(flows, shift, pixel, path, position)
        if seen > most:
            best, most = path, seen
    return best


@jit(error_model="numpy", inner=True)
def _confirmed(
    flows: tuple[Floats, Floats], shift: int, pixel: Vector, path: Vector, position: np.float32
) -> np.float32:
    """Agreement of the flows at both ends of a path with it, 0..2."""
    length2 = min(path[0] * path[0] + path[1] * path[1], _MOST)
    visible = _VISIBLE_RELATIVE * length2 + _VISIBLE_PX2
    visible = visible * visible
    rest, total = _1 - position, _0
    forward, backward = flows
    height, width, _ = forward.shape
    column = _nearest(pixel[0] - position * path[0]) >> shift
    row = _nearest(pixel[1] - position * path[1]) >> shift
    if 0 <= column < width and 0 <= row < height:
        error = _apart2(forward, column, row, path)
        total += visible / (visible + error * error)
    column = _nearest(pixel[0] + rest * path[0]) >> shift
    row = _nearest(pixel[1] + rest * path[1]) >> shift
    if 0 <= column < width and 0 <= row < height:
        error = _apart2(backward, column, row, (-path[0], -path[1]))
        total += visible / (visible + error * error)
    return total
