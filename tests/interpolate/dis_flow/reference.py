"""Dense inverse search as it is defined (NumPy, float32), function by function of the kernels."""

import numpy as np

from texvent.interpolate.dis_flow.definitions import (
    CHANGED,
    DATA,
    EXPLAINED,
    LEAST2,
    LEAST_DETERMINANT,
    LEAST_DIFFERENCE,
    LEAST_SLOPE2,
    MARGIN,
    MOST_DRIFT,
    MOST_STEPS,
    NOISE_COST,
    PATCH,
    RELAXATION,
    SAME_FLOW,
    SAME_PX2,
    SAME_RELATIVE,
    SEARCH_COST,
    SEARCH_RADIUS,
    SMALL_STEP2,
    SMOOTHNESS,
    SWEEPS,
    UNEXPLAINED,
    Floats,
    Mask,
    size_of,
)

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


def search(start: Floats, stop: Floats, flow: Floats, step: int, is_coarsest: bool) -> Floats:
    """Flow of each patch, [rows, columns, 3]: x, y, cost."""
    height, width = size_of(start)
    down, across = 1 + (height - PATCH) // step, 1 + (width - PATCH) // step
    found = np.empty((down, across, 3), np.float32)
    for i, j in np.ndindex(down, across):
        here = i * step, j * step
        own = flow[:, here[0] + PATCH // 2, here[1] + PATCH // 2]
        if is_coarsest:
            own = _search_integer(start, stop, here)
        found[i, j] = *own, _cost(_compare(start, stop, here, own)[0])
        if found[i, j, 2] > EXPLAINED:
            _propagate(start, stop, here, found, (i, j), -1)
            _gauss_newton(start, stop, here, found[i, j], own)
    for i, j in reversed(list(np.ndindex(down, across))):
        here, own = (i * step, j * step), found[i, j, :2].copy()
        if found[i, j, 2] > EXPLAINED and _propagate(start, stop, here, found, (i, j), 1):
            _gauss_newton(start, stop, here, found[i, j], own)
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
    start: Floats,
    stop: Floats,
    here: tuple[int, int],
    found: Floats,
    patch: tuple[int, int],
    way: int,
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
        cost = _cost(_compare(start, stop, here, other)[0])
        if cost < found[i, j, 2]:
            found[i, j] = *other, cost
            is_better = True
    return is_better


def _gauss_newton(
    start: Floats, stop: Floats, here: tuple[int, int], own: Floats, begin: Floats
) -> None:
    """Gauss-Newton steps, as long as they make a patch fit better.

    d is the difference of a patch and its place. The difference of their means does not count: the
    cost is Σd² − (Σd)²/64, and with the slopes g: Σdg − Σd·Σg/64.
    """
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


def try_vectors(start: Floats, stop: Floats, patches: Floats, step: int, vectors: Floats) -> Floats:
    """The patches, each with its vector if that fits no worse than its own flow."""
    found, (height, width) = patches.copy(), size_of(start)
    for i, j in np.ndindex(found.shape[:2]):
        here, own, vector = (i * step, j * step), found[i, j], vectors[i, j]
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
            _gauss_newton(start, stop, here, own, vector)
    return found


def _spread(level: Floats, here: tuple[int, int]) -> np.float32:
    """Mean-free squares of a patch, summed."""
    patch = _patch(level[0], here)
    return _cost((_total(patch), _total(patch * patch)))


def join(start: Floats, stop: Floats, patches: Floats, step: int) -> Floats:
    """Flow of each pixel, [2, H, W], from those of the patches that contain it."""
    height, width = size_of(start)
    sums = np.zeros((3, height, width), np.float32)
    for i, j in np.ndindex(patches.shape[:2]):
        here, flow = (i * step, j * step), patches[i, j, :2]
        difference = np.abs(_sample_patch(stop, here, flow) - _patch(start[0], here))
        weight = 1 / np.maximum(difference, np.float32(LEAST_DIFFERENCE))
        held = sums[:, here[0] : here[0] + PATCH, here[1] : here[1] + PATCH]
        held += np.stack([weight, weight * flow[0], weight * flow[1]])
    # Pixels in no patch, at the right and below, take the flow of the nearest pixel in one.
    rows = np.minimum(np.arange(height), (patches.shape[0] - 1) * step + PATCH - 1)
    columns = np.minimum(np.arange(width), (patches.shape[1] - 1) * step + PATCH - 1)
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


def refine(start: Floats, stop: Floats, flow: Floats) -> Floats:
    """The flow after a few sweeps towards constant brightness and smoothness.

    In each pixel flow w minimises Σ ψ_d (g·(w − w₀) + c)² + Σ ψ_s |w − w_n|² over its neighbours n,
    where w₀ is the flow before, g the slope of brightness and c its change along w₀. The weights ψ
    fall with the error of w₀.
    """
    _, height, width = flow.shape
    (xx, xy, yy), sides = _data_term(start, stop, flow)
    right, below = _smoothness_weights(flow)
    left, above = np.zeros_like(right), np.zeros_like(below)
    left[:, 1:], above[1:] = right[:, :-1], below[:-1]
    coupling = (left + right) + (above + below)
    a, b, c = xx + coupling, xy, yy + coupling
    determinant = a * c - b * b
    a, b, c = c / determinant, -b / determinant, a / determinant
    y, x = np.mgrid[:height, :width]
    now = np.pad(flow, ((0, 0), (1, 1), (1, 1)))
    for turn in range(2 * SWEEPS):
        aside = left * now[:, 1:-1, :-2] + right * now[:, 1:-1, 2:]
        p, q = sides + (aside + (above * now[:, :-2, 1:-1] + below * now[:, 2:, 1:-1]))
        wanted = np.stack([a * p + b * q, b * p + c * q])
        change = np.float32(RELAXATION) * (wanted - now[:, 1:-1, 1:-1])
        now[:, 1:-1, 1:-1] += np.where((x + y) % 2 == turn % 2, change, np.float32(0))
    return now[:, 1:-1, 1:-1]


def _data_term(start: Floats, stop: Floats, flow: Floats) -> tuple[Floats, Floats]:
    """Matrix (xx, xy, yy) and right side (x, y) of each pixel, [3, H, W] and [2, H, W]."""
    here, there = start[0, MARGIN:-MARGIN, MARGIN:-MARGIN], _sample_along(stop, flow)
    middle, change = np.float32(0.5) * (here + there), there - here
    padded = np.pad(middle, 1, mode="edge")
    slope_x = np.float32(0.5) * (padded[1:-1, 2:] - padded[1:-1, :-2])
    slope_y = np.float32(0.5) * (padded[2:, 1:-1] - padded[:-2, 1:-1])
    length2 = slope_x * slope_x + slope_y * slope_y + np.float32(LEAST_SLOPE2)
    error = np.sqrt(change * change / length2 + np.float32(LEAST2))
    weight = np.float32(DATA) / (error * length2)
    wanted = weight * (slope_x * flow[0] + slope_y * flow[1] - change)
    matrix = weight * slope_x * slope_x, weight * slope_x * slope_y, weight * slope_y * slope_y
    return np.stack(matrix), np.stack([slope_x * wanted, slope_y * wanted])


def change_along(start: Floats, stop: Floats, flow: Floats) -> Floats:
    """What brightness changes by along a flow, [H, W], levels."""
    return _sample_along(stop, flow) - start[0, MARGIN:-MARGIN, MARGIN:-MARGIN]


def _sample_along(stop: Floats, flow: Floats) -> Floats:
    """A level at the places of the moved pixels, [H, W], bilinear."""
    height, width = size_of(stop)
    row, column = np.mgrid[:height, :width].astype(np.float32)
    x = np.clip(column + flow[0], np.float32(-PATCH), np.float32(width))
    y = np.clip(row + flow[1], np.float32(-PATCH), np.float32(height))
    left, top = np.floor(x), np.floor(y)
    u, v = x - left, y - top
    i, j = top.astype(np.intp) + MARGIN, left.astype(np.intp) + MARGIN
    upper = stop[0, i, j] + (stop[0, i, j + 1] - stop[0, i, j]) * u
    lower = stop[0, i + 1, j] + (stop[0, i + 1, j + 1] - stop[0, i + 1, j]) * u
    seen: Floats = upper + (lower - upper) * v
    return seen


def _smoothness_weights(flow: Floats) -> tuple[Floats, Floats]:
    """Smoothness weights of each pixel and its right and lower neighbours, [H, W] each."""
    beside = np.diff(flow, axis=2, append=flow[:, :, -1:])
    down = np.diff(flow, axis=1, append=flow[:, -1:])
    slope2 = beside[0] * beside[0] + down[0] * down[0] + beside[1] * beside[1] + down[1] * down[1]
    coupling = np.float32(SMOOTHNESS) / np.sqrt(slope2 + np.float32(LEAST2))
    right, below = coupling.copy(), coupling.copy()
    right[:, -1] = below[-1] = 0.0
    return right, below
