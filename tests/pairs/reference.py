"""Motion-compensated mixing of two frames, as it is defined (NumPy, float32 or float64).

Paths through pixels where two surfaces meet, samples of an image between its pixels, and the mix.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.contested_paths import (
    CLEARLY_BETTER,
    CONTESTED_PX2,
    CONTESTED_RELATIVE,
    LEAST_SWEEP_PX2,
    LOST_PX2,
    LOST_RELATIVE,
    MOST_PX2,
    MOST_SWEEP_PX2,
    SWEPT,
    UNSEEN_WEIGHT,
    VISIBLE_PX2,
    VISIBLE_RELATIVE,
)

FloatArray = NDArray[Any]
"""float32; float64 to measure the rounding of float32."""


def find_sweep(forward: FloatArray, backward: FloatArray, shift: int = 0) -> FloatArray:
    """Motion of what passes each pixel between the frames but lies there in neither.

    Every pixel of the earlier frame whose motion the later frame confirms, and that shows something
    else there, notes its flow in the pixels along its path whose own flows differ. The longest
    flow counts.
    Fields are [h, w, 2] px, 0 where nothing passes. `shift` is 0 where a vector stands for a
    pixel, 1 where it stands for 2×2.
    """
    kind, (height, width, _) = forward.dtype.type, forward.shape
    sweep, scale = np.zeros_like(forward), kind(0.5**shift)
    for y, x in np.ndindex(height, width):
        flow = forward[y, x]
        length2 = _squared(flow)
        if not LEAST_SWEEP_PX2 <= length2 <= MOST_SWEEP_PX2 or not _differ(
            backward[y, x], -flow, length2
        ):
            continue
        if not _is_met(forward, backward, x, y, scale):
            continue
        steps = math.ceil(scale * np.abs(flow).max())
        for k in range(1, steps):
            share = scale * (kind(k) / kind(steps))
            along, down = kind(x) + share * flow[0], kind(y) + share * flow[1]
            for i in range(max(math.floor(down), 0), min(math.ceil(down) + 1, height)):
                for j in range(max(math.floor(along), 0), min(math.ceil(along) + 1, width)):
                    is_other = _differ(forward[i, j], flow, length2)
                    is_other = is_other and _differ(backward[i, j], -flow, length2)
                    if is_other and length2 > _squared(sweep[i, j]):
                        sweep[i, j] = flow
    return sweep


def choose_paths(
    forward: FloatArray, backward: FloatArray, position: float, shift: int = 0
) -> FloatArray:
    """The path of every vector at an instant, [h, w, 2] px from the earlier to the later frame."""
    paths, scale = forward - position * (forward + backward), forward.dtype.type(0.5**shift)
    sweep = find_sweep(forward, backward, shift)
    for y, x in np.ndindex(paths.shape[:2]):
        ahead, back = forward[y, x], -backward[y, x]
        longest = max(_squared(ahead), _squared(back))
        is_contested = _differ(ahead, back, longest) and (
            _is_met(forward, backward, x, y, scale) or _is_met(backward, forward, x, y, scale)
        )
        if not (is_contested or sweep[y, x].any()):
            continue
        seen = _confirmed(forward, backward, (x, y), shift, paths[y, x], position)
        most = seen + forward.dtype.type(CLEARLY_BETTER)
        for path in (ahead, back):
            seen = _confirmed(forward, backward, (x, y), shift, path, position)
            if seen > most:
                paths[y, x], most = path, seen
        if sweep[y, x].any():
            # What passes is in front.
            seen = _confirmed(forward, backward, (x, y), shift, sweep[y, x], position)
            if seen > SWEPT:
                paths[y, x] = sweep[y, x]
    return paths


def _confirmed(
    forward: FloatArray,
    backward: FloatArray,
    vector: tuple[int, int],
    shift: int,
    path: FloatArray,
    position: float,
) -> Any:
    """How well the flows at both ends of a path agree with it, 0..2."""
    kind, (height, width, _) = forward.dtype.type, forward.shape
    visible = kind(VISIBLE_RELATIVE) * _squared(path) + kind(VISIBLE_PX2)
    visible = visible * visible
    total = kind(0)
    for flow, sign, share in ((forward, 1, -position), (backward, -1, kind(1) - position)):
        # From the middle of what the vector stands for.
        x, y = (kind((one << shift) + shift / 2) for one in vector)
        column, row = _nearest(x + share * path[0]) >> shift, _nearest(y + share * path[1]) >> shift
        if 0 <= column < width and 0 <= row < height:
            error = _squared(flow[row, column] - sign * path)
            total = total + visible / (visible + error * error)
    return total


def _is_met(flow: FloatArray, other: FloatArray, x: int, y: int, scale: Any) -> bool:
    """Whether a vector leads to one that leads back, within a pixel."""
    kind, (height, width, _) = flow.dtype.type, flow.shape
    here = flow[y, x]
    length2 = _squared(here)
    if not length2 < MOST_PX2:
        return False
    column, row = _nearest(kind(x) + scale * here[0]), _nearest(kind(y) + scale * here[1])
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


def sample_along(
    image: FloatArray, flow: FloatArray, shift: FloatArray
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Samples of an image at displaced places; places outside take its nearest edge.

    `texvent.pairs.sampling` has the formula. Beyond its edges an image goes on straight.

    `flow` has as many rows and columns, or half as many; `shift` is that of each pixel's place, px.
    Returns the image there, the flow of the nearest pixel, and whether the place lies inside the
    image, whose pixels reach half a pixel past their centres.

    Source: the piecewise parabolic interpolator of Erup, Gardner and Harris (IEEE Transactions on
        Communications 41, 1993) with α = 1/4, which gives parabolas exactly. The sum of both axes
        and the limit are ours.
    """
    height, width = image.shape
    row, column = np.mgrid[:height, :width]
    kind = image.dtype
    x = np.clip(shift[..., 0], (-column).astype(kind), (width - 1 - column).astype(kind))
    y = np.clip(shift[..., 1], (-row).astype(kind), (height - 1 - row).astype(kind))
    outside = np.maximum(np.abs(shift[..., 0] - x), np.abs(shift[..., 1] - y))
    left, top = np.floor(x), np.floor(y)
    u, v = x - left, y - top
    left, top = column + left.astype(np.intp), row + top.astype(np.intp)
    right, bottom = np.minimum(left + 1, width - 1), np.minimum(top + 1, height - 1)
    corners = image[top, left], image[top, right], image[bottom, left], image[bottom, right]
    upper = corners[0] + (corners[1] - corners[0]) * u
    lower = corners[2] + (corners[3] - corners[2]) * u
    straight = upper + (lower - upper) * v
    bend_x, bend_y = find_bends(image)
    along = bend_x[top, left] + (bend_x[bottom, left] - bend_x[top, left]) * v
    across = bend_y[top, left] + (bend_y[top, right] - bend_y[top, left]) * u
    sample = straight - (u * (1 - u) * along + v * (1 - v) * across)
    # Pixels that it does not lie between do not count.
    right, bottom = np.where(u > 0, right, left), np.where(v > 0, bottom, top)
    corners = image[top, left], image[top, right], image[bottom, left], image[bottom, right]
    sample = np.clip(sample, np.minimum.reduce(corners), np.maximum.reduce(corners))
    nearest = np.where(v >= 0.5, bottom, top), np.where(u >= 0.5, right, left)
    side = -(-height // len(flow))
    return sample, flow[nearest[0] // side, nearest[1] // side], outside <= 0.5


def find_bends(image: FloatArray) -> tuple[FloatArray, FloatArray]:
    """How far brightness bends between each pixel and its right, and its lower neighbour."""
    return _find_bends_along(image), _find_bends_along(image.T).T


def _find_bends_along(image: FloatArray) -> FloatArray:
    first, last = image[:, :1], image[:, -1:]
    before = first + (first - image[:, 1:2]) if image.shape[1] > 1 else first
    after = last + (last - image[:, -2:-1]) if image.shape[1] > 1 else last
    wide = np.concatenate([before, image, after, after], axis=1)
    return np.asarray(
        0.25 * ((wide[:, :-3] - wide[:, 1:-2]) + (wide[:, 3:] - wide[:, 2:-1])), image.dtype
    )


def warp_between(
    first: FloatArray,
    second: FloatArray,
    forward: FloatArray,
    backward: FloatArray,
    position: float,
) -> FloatArray:
    """The frame at `position` between two frames whose motion is known.

    Everything is computed in the type of the frames; in float32, the order of the operations is
    part of the definition.

    Where both flows agree, the path is (1 − τ) times the one minus τ times the other.

    Source: flows to the intermediate frame as in Jiang et al., Super SloMo (CVPR 2018), eq. 4,
        which are −τ and 1 − τ times the path below; the weights are ours: see `contested_paths`.
    """
    position = first.dtype.type(position)
    rest = first.dtype.type(1.0) - position
    shift, (height, width) = int(len(forward) < len(first)), first.shape
    paths = choose_paths(forward, backward, position, shift)
    path = paths.repeat(1 << shift, axis=0).repeat(1 << shift, axis=1)[:height, :width]
    length2 = np.minimum(_lengths2(path), MOST_PX2)

    a, path_first, is_in_first = sample_along(first, forward, -position * path)
    b, path_second, is_in_second = sample_along(second, backward, rest * path)
    error_first = np.minimum(_lengths2(path_first - path), MOST_PX2)
    error_second = np.minimum(_lengths2(path_second + path), MOST_PX2)

    # A frame's weight is its share of the time, times (how well it sees the point + UNSEEN_WEIGHT
    # times how little the other is trusted); both over one denominator, which cancels.
    visible = _squared_number(VISIBLE_RELATIVE * length2 + VISIBLE_PX2)
    doubt_first = visible + error_first * error_first
    doubt_second = visible + error_second * error_second
    # Outside its view a frame shows nothing.
    trust_first = np.where(is_in_first, visible / doubt_first, 0)
    trust_second = np.where(is_in_second, visible / doubt_second, 0)
    unseen_first, unseen_second = UNSEEN_WEIGHT * doubt_first, UNSEEN_WEIGHT * doubt_second
    seen_first = np.where(is_in_first, visible, 0) + unseen_first * (1 - trust_second)
    seen_second = np.where(is_in_second, visible, 0) + unseen_second * (1 - trust_first)
    weight_first = rest * (seen_first * doubt_second)
    weight_second = position * (seen_second * doubt_first)
    warped = a + (b - a) * (weight_second / (weight_first + weight_second))

    lost = _squared_number(LOST_RELATIVE * length2 + LOST_PX2)
    confidence = lost / (lost + _squared_number(np.minimum(error_first, error_second)))
    blended = first + (second - first) * position
    return np.asarray(blended + (warped - blended) * confidence)


def _lengths2(vectors: FloatArray) -> FloatArray:
    return np.asarray(vectors[..., 0] * vectors[..., 0] + vectors[..., 1] * vectors[..., 1])


def _squared_number(number: FloatArray) -> FloatArray:
    return number * number
