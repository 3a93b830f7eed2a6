"""Dense inverse search as it is defined (NumPy, float32)."""

from __future__ import annotations

import numpy as np

from texvent.interpolate.dis_flow.definitions import (
    AGAINST,
    ALIKE,
    BETWEEN,
    CHANGED,
    LEAST_DETERMINANT,
    LEAST_DIFFERENCE,
    LEAST_FLOW2,
    LEAST_SPREAD,
    MARGIN,
    MOST_DRIFT,
    MOST_STEPS,
    NOISE_COST,
    PATCH,
    REPEATED,
    SAME_FLOW,
    SAME_FLOW2,
    SAME_PX2,
    SAME_RELATIVE,
    SEARCH_COST,
    SEARCH_RADIUS,
    SHORTER2,
    SMALL_STEP2,
    SPARSE,
    STEP,
    UNEXPLAINED,
    Floats,
    Mask,
    size_of,
)
from texvent.interpolate.dis_flow.refine_reference import change_along, refine

__all__ = [
    "change_along",
    "double",
    "halve",
    "join",
    "make_level",
    "refine",
    "search",
    "take_nearest",
    "try_vectors",
    "unconfirmed",
]

AREA = np.float32(PATCH * PATCH)


def halve(image: Floats) -> Floats:
    """Means of 2×2 pixels; an odd last row or column counts twice."""
    height, width = image.shape
    even = np.pad(image, ((0, height % 2), (0, width % 2)), mode="edge")
    columns = even[::2] + even[1::2]
    return (columns[:, ::2] + columns[:, 1::2]) * np.float32(0.25)


def make_level(image: Floats) -> Floats:
    """The image with its edges repeated, and its slopes; see `definitions`."""
    level = np.zeros((3, *(side + 2 * MARGIN for side in image.shape)), np.float32)
    level[0] = np.pad(image, MARGIN, mode="edge")
    near = level[0, MARGIN - 1 : 1 - MARGIN, MARGIN - 1 : 1 - MARGIN]
    inner = slice(MARGIN, -MARGIN), slice(MARGIN, -MARGIN)
    for axis, turned in enumerate((near, near.T)):
        left, right = turned[:, :-2], turned[:, 2:]
        outer = (right[:-2] - left[:-2]) + (right[2:] - left[2:])
        slope = (outer + 2 * (right[1:-1] - left[1:-1])) / np.float32(8.0)
        level[(axis + 1, *inner)] = slope if axis == 0 else slope.T
    return level


def double(flow: Floats, shape: tuple[int, int]) -> Floats:
    """The flow of an image of twice the size: bilinear, between the centres of pixels."""
    # Half of the factors is the mean, the other half the scale.
    high = _between(flow, 1, np.float32(1.5), np.float32(0.5))[:, : shape[0]]
    return _between(high, 2, np.float32(0.75), np.float32(0.25))[:, :, : shape[1]]


def _between(flow: Floats, axis: int, near: np.float32, far: np.float32) -> Floats:
    flow = np.moveaxis(flow, axis, 0)
    doubled = np.empty((2 * len(flow), *flow.shape[1:]), np.float32)
    doubled[::2] = near * flow + far * np.concatenate([flow[:1], flow[:-1]])
    doubled[1::2] = near * flow + far * np.concatenate([flow[1:], flow[-1:]])
    return np.moveaxis(doubled, 0, axis)


def search(start: Floats, stop: Floats, flow: Floats, is_coarsest: bool) -> Floats:
    """Flow of each patch, [rows, columns, 3]: x, y, cost."""
    height, width = size_of(start)
    down, across = 1 + (height - PATCH) // STEP, 1 + (width - PATCH) // STEP
    found = np.empty((down, across, 3), np.float32)
    for i, j in np.ndindex(down, across):
        here = i * STEP, j * STEP
        own = flow[:, here[0] + PATCH // 2, here[1] + PATCH // 2]
        if is_coarsest:
            own = _search_integer(start, stop, here)
        found[i, j] = *own, _cost(_compare(start, stop, here, own)[0])
        _propagate(start, stop, found, (i, j), -1)
        _gauss_newton(start, stop, found, (i, j), own)
    for i, j in reversed(list(np.ndindex(down, across))):
        own = found[i, j, :2].copy()
        if _propagate(start, stop, found, (i, j), 1):
            _gauss_newton(start, stop, found, (i, j), own)
    return found


def _search_integer(start: Floats, stop: Floats, here: tuple[int, int]) -> Floats:
    """The best displacement by whole pixels."""
    around = [
        np.array([right, down], np.float32)
        for down in range(-SEARCH_RADIUS, SEARCH_RADIUS + 1)
        for right in range(-SEARCH_RADIUS, SEARCH_RADIUS + 1)
    ]
    costs = [
        _cost(_compare(start, stop, here, one)[0]) + np.float32(SEARCH_COST) * (one * one).sum()
        for one in around
    ]
    return around[int(np.argmin(costs))]


def _propagate(
    start: Floats, stop: Floats, found: Floats, patch: tuple[int, int], way: int
) -> bool:
    """Give a patch the flow of a neighbour, beside it or above or below, if it fits better."""
    i, j = patch
    is_better = False
    for row, column in ((i, j + way), (i + way, j)):
        if not (0 <= row < found.shape[0] and 0 <= column < found.shape[1]):
            continue
        other = found[row, column, :2]
        if np.abs(other - found[i, j, :2]).sum() < np.float32(SAME_FLOW):
            continue
        cost = _cost(_compare(start, stop, (i * STEP, j * STEP), other)[0])
        if cost < found[i, j, 2]:
            found[i, j] = *other, cost
            is_better = True
    return is_better


def _gauss_newton(
    start: Floats, stop: Floats, found: Floats, patch: tuple[int, int], begin: Floats
) -> None:
    """Gauss-Newton steps, as long as they make a patch fit better.

    d is the difference of a patch and its place. The difference of their means does not count: the
    cost is Σd² − (Σd)²/64, and with the slopes g: Σdg − Σd·Σg/64.
    """
    here, own = (patch[0] * STEP, patch[1] * STEP), found[patch]
    x, y = (_patch(level, here) for level in start[1:])
    sum_x, sum_y = _total(x), _total(y)
    xx = _total(x * x) - sum_x * sum_x / AREA + np.float32(LEAST_DETERMINANT)
    xy = _total(x * y) - sum_x * sum_y / AREA
    yy = _total(y * y) - sum_y * sum_y / AREA + np.float32(LEAST_DETERMINANT)
    determinant = xx * yy - xy * xy
    if not determinant > np.float32(LEAST_DETERMINANT):
        return
    (mean, _), difference = _compare(start, stop, here, own[:2])
    for _ in range(MOST_STEPS):
        side_x = _total(difference * x) - mean * sum_x / AREA
        side_y = _total(difference * y) - mean * sum_y / AREA
        du = (yy * side_x - xy * side_y) / determinant
        dv = (xx * side_y - xy * side_x) / determinant
        flow = own[:2] - np.array([du, dv])
        if (np.abs(flow - begin) > MOST_DRIFT).any():
            return
        (mean, square), difference = _compare(start, stop, here, flow)
        cost = _cost((mean, square))
        if not cost < own[2]:
            return
        own[:] = *flow, cost
        if du * du + dv * dv < np.float32(SMALL_STEP2):
            return


def _compare(
    start: Floats, stop: Floats, here: tuple[int, int], flow: Floats
) -> tuple[tuple[np.float32, np.float32], Floats]:
    """Sum, and sum of squares, of a place minus a patch; then that difference, [8, 8]."""
    difference = _sample_patch(stop, here, flow) - _patch(start[0], here)
    return (_total(difference), _total(difference * difference)), difference


def _cost(sums: tuple[np.float32, np.float32]) -> np.float32:
    return np.float32(sums[1] - sums[0] * sums[0] / AREA)


def _sample_patch(stop: Floats, here: tuple[int, int], flow: Floats) -> Floats:
    """A level at the place of a moved patch, [8, 8], bilinear; at most a patch outside."""
    height, width = size_of(stop)
    x = np.clip(np.float32(here[1]) + flow[0], np.float32(-PATCH), np.float32(width))
    y = np.clip(np.float32(here[0]) + flow[1], np.float32(-PATCH), np.float32(height))
    left, top = np.floor(x), np.floor(y)
    u, v = x - left, y - top
    around = stop[0, int(top) + MARGIN :, int(left) + MARGIN :][: PATCH + 1, : PATCH + 1]
    upper = (1 - u) * (1 - v) * around[:-1, :-1] + u * (1 - v) * around[:-1, 1:]
    seen: Floats = upper + ((1 - u) * v * around[1:, :-1] + u * v * around[1:, 1:])
    return seen


def _patch(image: Floats, here: tuple[int, int]) -> Floats:
    return image[here[0] + MARGIN :, here[1] + MARGIN :][:PATCH, :PATCH]


def _total(patch: Floats) -> np.float32:
    """Row by row, then columns four apart, two apart, one apart."""
    columns = patch[0]
    for row in patch[1:]:
        columns = columns + row
    columns = columns[:4] + columns[4:]
    columns = columns[:2] + columns[2:]
    return np.float32(columns[0] + columns[1])


def try_vectors(start: Floats, stop: Floats, patches: Floats, vectors: Floats) -> Floats:
    """The patches, each with its vector if that fits no worse than its own flow."""
    found, (height, width) = patches.copy(), size_of(start)
    for i, j in np.ndindex(found.shape[:2]):
        here, own, vector = (i * STEP, j * STEP), found[i, j], vectors[i, j]
        if np.abs(vector - own[:2]).sum() < np.float32(SAME_FLOW):
            continue
        x, y = np.float32(here[1]) + vector[0], np.float32(here[0]) + vector[1]
        if not (0 <= x <= width - PATCH and 0 <= y <= height - PATCH):
            if own[2] > np.float32(UNEXPLAINED) * _spread(start, here) + np.float32(NOISE_COST):
                own[:] = (*vector, 0)
            continue
        cost = _cost(_compare(start, stop, here, vector)[0])
        if cost < own[2] + np.float32(NOISE_COST):
            own[:] = (*vector, cost)
            _gauss_newton(start, stop, found, (i, j), vector)
    return found


def take_nearest(start: Floats, stop: Floats, patches: Floats) -> Floats:
    """The patches; where texture repeats, each with the shortest flow that fits alike."""
    found, is_reached = patches.copy(), np.zeros(patches.shape[:2], np.bool_)
    half = SPARSE // 2
    for i, j in np.ndindex(found[half::SPARSE, half::SPARSE].shape[:2]):
        patch = half + SPARSE * i, half + SPARSE * j
        here, own = (patch[0] * STEP, patch[1] * STEP), patches[patch]
        spread = _spread(start, here)
        if is_reached[patch] or own[0] * own[0] + own[1] * own[1] < np.float32(LEAST_FLOW2):
            continue
        if spread < np.float32(LEAST_SPREAD) or own[2] > np.float32(REPEATED) * spread:
            continue
        short = _descended(start, stop, patches, patch, _search_integer(start, stop, here))
        if _fits_alike(start, stop, here, own, short):
            found[patch], is_reached[patch] = short, True
            _spread_out(start, stop, patches, found, is_reached, patch)
    return found


def _spread_out(
    start: Floats,
    stop: Floats,
    patches: Floats,
    found: Floats,
    is_reached: Mask,
    first: tuple[int, int],
) -> None:
    """Give the flow of a patch to those around it that it fits too, unless others deny it."""
    reached, against, support = [first], 0, 0
    for one in reached:
        flow = found[one][:2].copy()
        rows, columns = (slice(max(0, at - 1), at + 2) for at in one)
        for i, j in np.ndindex(found[rows, columns].shape[:2]):
            patch = rows.start + i, columns.start + j
            here, own = (patch[0] * STEP, patch[1] * STEP), patches[patch]
            if is_reached[patch]:
                continue
            is_found = own[2] <= np.float32(REPEATED) * _spread(start, here)
            if is_found and _distance2(own, flow) < np.float32(SAME_FLOW2):
                support += 1
            else:
                short = _descended(start, stop, patches, patch, flow)
                if not _fits_alike(start, stop, here, own, short):
                    is_seen = _is_inside(start, here, own) and _is_inside(start, here, short)
                    says_other = is_found and bool(_distance2(own, patches[one]) < 1)
                    against += is_seen and says_other
                    continue
                found[patch] = short
            is_reached[patch] = True
            reached.append(patch)
    if against > support + AGAINST * len(reached):
        for one in reached:
            found[one] = patches[one]


def _descended(
    start: Floats, stop: Floats, patches: Floats, patch: tuple[int, int], begin: Floats
) -> Floats:
    """Flow and cost of a patch after Gauss-Newton steps from a beginning."""
    tried, here = patches.copy(), (patch[0] * STEP, patch[1] * STEP)
    tried[patch] = *begin, _cost(_compare(start, stop, here, begin)[0])
    _gauss_newton(start, stop, tried, patch, begin)
    return np.asarray(tried[patch])


def _fits_alike(
    start: Floats, stop: Floats, here: tuple[int, int], own: Floats, short: Floats
) -> bool:
    """Whether a patch fits a shorter flow as well as its own, but nothing between both."""
    spread, way = _spread(start, here), own[:2] - short[:2]
    if spread < np.float32(LEAST_SPREAD) or short[2] > np.float32(REPEATED) * spread:
        return False
    length2 = short[0] * short[0] + short[1] * short[1]
    if length2 >= np.float32(SHORTER2) * (own[0] * own[0] + own[1] * own[1]):
        return False
    places = (short[:2] + np.float32(share) * way for share in (0.5, 0.25))
    between = max(_cost(_compare(start, stop, here, place)[0]) for place in places)
    most = own[2] + np.float32(NOISE_COST) + np.float32(ALIKE) * between
    return bool(between > np.float32(BETWEEN) * spread and short[2] < most)


def _is_inside(level: Floats, here: tuple[int, int], flow: Floats) -> bool:
    """Whether the place of a patch lies within the image."""
    (height, width), x, y = size_of(level), here[1] + flow[0], here[0] + flow[1]
    return bool(0 <= x <= width - PATCH and 0 <= y <= height - PATCH)


def _distance2(one: Floats, other: Floats) -> np.float32:
    x, y = one[:2] - other[:2]
    return np.float32(x * x + y * y)


def _spread(level: Floats, here: tuple[int, int]) -> np.float32:
    """Mean-free squares of a patch, summed."""
    patch = _patch(level[0], here)
    return _cost((_total(patch), _total(patch * patch)))


def join(start: Floats, stop: Floats, patches: Floats) -> Floats:
    """Flow of each pixel, [2, H, W], from those of the patches that contain it."""
    height, width = size_of(start)
    sums = np.zeros((3, height, width), np.float32)
    for i, j in np.ndindex(patches.shape[:2]):
        here, flow = (i * STEP, j * STEP), patches[i, j, :2]
        difference = np.abs(_sample_patch(stop, here, flow) - _patch(start[0], here))
        weight = 1 / np.maximum(difference, np.float32(LEAST_DIFFERENCE))
        held = sums[:, here[0] : here[0] + PATCH, here[1] : here[1] + PATCH]
        held += np.stack([weight, weight * flow[0], weight * flow[1]])
    # Pixels in no patch, at the right and below, take the flow of the nearest pixel in one.
    rows = np.minimum(np.arange(height), (patches.shape[0] - 1) * STEP + PATCH - 1)
    columns = np.minimum(np.arange(width), (patches.shape[1] - 1) * STEP + PATCH - 1)
    held = sums[:, rows][:, :, columns]
    joined: Floats = held[1:] / held[0]
    return joined


def unconfirmed(start: Floats, stop: Floats, flow: Floats, back: Floats) -> Mask:
    """Pixels whose flow the other direction contradicts, or along which brightness changes."""
    height, width = size_of(start)
    y, x = np.mgrid[:height, :width].astype(np.float32)
    column = np.floor(x + flow[0] + np.float32(0.5)).astype(np.intp)
    row = np.floor(y + flow[1] + np.float32(0.5)).astype(np.intp)
    is_inside = (column >= 0) & (row >= 0) & (column < width) & (row < height)
    met = back[:, np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]
    u, v = flow[0] + met[0], flow[1] + met[1]
    length2 = flow[0] * flow[0] + flow[1] * flow[1]
    contradicts = u * u + v * v > np.float32(SAME_RELATIVE) * length2 + np.float32(SAME_PX2)
    is_changed = np.abs(change_along(start, stop, flow)) > np.float32(CHANGED)
    found: Mask = ~is_inside | contradicts | is_changed
    return found
