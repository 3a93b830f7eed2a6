"""Paths through pixels where two surfaces meet, as they are defined (NumPy).

At an instant, a pixel shows what is there then, not what is there in either frame. Where both flows
at a pixel agree, both say what passes. Where they do not, and the other frame confirms at least one
of them, one surface is there in the earlier frame and another in the later one; and a small fast
thing may pass that is there in neither (the sweep). Of all these motions the path takes the one
that the flows at its own two ends confirm best.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.warp_tolerance import (
    CLEARLY_BETTER,
    CONTESTED_PX2,
    CONTESTED_RELATIVE,
    LEAST_SWEEP_PX2,
    MOST_PX2,
    MOST_SWEEP_PX2,
    SWEPT,
    VISIBLE_PX2,
    VISIBLE_RELATIVE,
)

FloatArray = NDArray[Any]


def find_sweep(forward: FloatArray, backward: FloatArray) -> FloatArray:
    """Motion of what passes each pixel between the frames but lies there in neither.

    Every pixel of the earlier frame whose motion the later frame confirms, and that shows something
    else there, notes its flow in the pixels along its path whose own flows differ. The longest
    flow counts.

    Args:
        forward: [H, W, 2] px.
        backward: [H, W, 2] px.

    Returns:
        [H, W, 2] px, 0 where nothing does so.
    """
    kind, (height, width, _) = forward.dtype.type, forward.shape
    sweep = np.zeros_like(forward)
    for y, x in np.ndindex(height, width):
        flow = forward[y, x]
        length2 = _squared(flow)
        if not LEAST_SWEEP_PX2 <= length2 <= MOST_SWEEP_PX2 or not _differ(
            backward[y, x], -flow, length2
        ):
            continue
        if not _is_met(forward, backward, x, y):
            continue
        steps = math.ceil(np.abs(flow).max())
        for k in range(1, steps):
            share = kind(k) / kind(steps)
            along, down = kind(x) + share * flow[0], kind(y) + share * flow[1]
            for i in range(max(math.floor(down), 0), min(math.ceil(down) + 1, height)):
                for j in range(max(math.floor(along), 0), min(math.ceil(along) + 1, width)):
                    is_other = _differ(forward[i, j], flow, length2)
                    is_other = is_other and _differ(backward[i, j], -flow, length2)
                    if is_other and length2 > _squared(sweep[i, j]):
                        sweep[i, j] = flow
    return sweep


def choose_paths(forward: FloatArray, backward: FloatArray, position: float) -> FloatArray:
    """The path through every pixel at an instant, [H, W, 2] px from the earlier to the later frame.

    Args:
        forward: flow from first to second, [H, W, 2] px.
        backward: flow from second to first, [H, W, 2] px.
        position: τ, 0 = first, 1 = second, of the flows' type.
    """
    paths = forward - position * (forward + backward)
    sweep = find_sweep(forward, backward)
    for y, x in np.ndindex(paths.shape[:2]):
        ahead, back = forward[y, x], -backward[y, x]
        longest = max(_squared(ahead), _squared(back))
        is_contested = _differ(ahead, back, longest) and (
            _is_met(forward, backward, x, y) or _is_met(backward, forward, x, y)
        )
        if not (is_contested or sweep[y, x].any()):
            continue
        seen = _confirmed(forward, backward, (x, y), paths[y, x], position)
        most = seen + forward.dtype.type(CLEARLY_BETTER)
        for path in (ahead, back):
            seen = _confirmed(forward, backward, (x, y), path, position)
            if seen > most:
                paths[y, x], most = path, seen
        if sweep[y, x].any():
            # What passes is in front.
            seen = _confirmed(forward, backward, (x, y), sweep[y, x], position)
            if seen > SWEPT:
                paths[y, x] = sweep[y, x]
    return paths


def _confirmed(
    forward: FloatArray,
    backward: FloatArray,
    pixel: tuple[int, int],
    path: FloatArray,
    position: float,
) -> Any:
    """How well the flows at both ends of a path agree with it, 0..2."""
    kind, (height, width, _) = forward.dtype.type, forward.shape
    visible = kind(VISIBLE_RELATIVE) * _squared(path) + kind(VISIBLE_PX2)
    visible = visible * visible
    total = kind(0)
    for flow, sign, share in ((forward, 1, -position), (backward, -1, kind(1) - position)):
        column = _nearest(kind(pixel[0]) + share * path[0])
        row = _nearest(kind(pixel[1]) + share * path[1])
        if 0 <= column < width and 0 <= row < height:
            error = _squared(flow[row, column] - sign * path)
            total = total + visible / (visible + error * error)
    return total


def _is_met(flow: FloatArray, other: FloatArray, x: int, y: int) -> bool:
    """Whether the flow of a pixel leads to one whose flow leads back, within a pixel."""
    kind, (height, width, _) = flow.dtype.type, flow.shape
    here = flow[y, x]
    length2 = _squared(here)
    if not length2 < MOST_PX2:
        return False
    column, row = _nearest(kind(x) + here[0]), _nearest(kind(y) + here[1])
    if not (0 <= column < width and 0 <= row < height):
        return False
    return bool(_squared(other[row, column] + here) <= kind(VISIBLE_RELATIVE) * length2 + kind(1))


def _differ(one: FloatArray, other: FloatArray, length2: Any) -> bool:
    """Whether two flows are those of two surfaces."""
    limit = one.dtype.type(CONTESTED_RELATIVE) * length2 + one.dtype.type(CONTESTED_PX2)
    return bool(_squared(one - other) > limit)


def _squared(vector: FloatArray) -> Any:
    length2 = vector[0] * vector[0] + vector[1] * vector[1]
    return min(length2, vector.dtype.type(MOST_PX2))


def _nearest(place: Any) -> int:
    return int(np.floor(place + type(place)(0.5)))
