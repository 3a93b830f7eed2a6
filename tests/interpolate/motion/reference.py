"""An instant between two frames whose motion is known, as it is defined (float64, slow).

The kernels `layers`, `paths`, `splat` and `draw` compute the same in float32.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.motion import layers as limits
from texvent.interpolate.motion import paths as path_limits
from texvent.interpolate.motion.draw import DIFFERENT, SIMILAR
from texvent.interpolate.motion.splat import LEAST_OVERLAP, SAME_LAYER

Float64s = NDArray[np.float64]
STEPS = ((1, 0), (-1, 0), (0, 1), (0, -1))
"""To the right, left, below and above: (x, y)."""


@dataclass(frozen=True)
class Surface:
    """What a pixel shows of one surface."""

    level: float
    share: float
    """How much of the pixel it covers, 0..1; 1 behind another surface."""
    order: float
    """ln depth."""
    donor: tuple[int, int]
    """(x, y) of the pixel whose path it takes: its own, or a neighbour's."""
    away: tuple[int, int] = (0, 0)
    """Step (x, y) across its contour: it fills the pixel from the other side."""


@dataclass(frozen=True, eq=False)
class View:
    """One frame of a pair: everything is [H, W], vectors and bends [H, W, 2]."""

    levels: Float64s
    order: Float64s
    """ln depth."""
    vectors: Float64s
    """To the other frame, px; NaN where unknown."""
    bend: Float64s | None
    """Second difference of position: forward plus backward vector; None with two frames alone."""

    @cache  # noqa: B019  (a handful of small views, for tests)
    def tolerance(self, x: int, y: int) -> float:
        """How much ln depth may differ within the layer: a constant, and the local slope."""
        slope = 0.0
        for steps in (STEPS[:2], STEPS[2:]):
            sides = [abs(self.order[j, i] - self.order[y, x]) for i, j in self._next(x, y, steps)]
            slope += min(sides) if sides and min(sides) < 0.3 else 0.0
        return float(limits.DEPTH_STEP) + 1.5 * slope

    def _next(
        self, x: int, y: int, steps: Sequence[tuple[int, int]] = STEPS
    ) -> Iterator[tuple[int, int]]:
        height, width = self.order.shape
        for dx, dy in steps:
            if 0 <= x + dx < width and 0 <= y + dy < height:
                yield x + dx, y + dy

    @cache  # noqa: B019
    def surfaces(self, x: int, y: int) -> list[Surface]:
        """The surfaces of a pixel: its own, and at a contour the one beyond it."""
        own = Surface(float(self.levels[y, x]), 1.0, float(self.order[y, x]), (x, y))
        step = self._across(x, y)
        if step is None:
            return [own]
        i, j = x + step[0], y + step[1]
        apart = np.abs(self.vectors[y, x] - self.vectors[j, i]).max()
        if not apart >= limits.JOINT_PX:
            return [own]
        seen = limits.linear(own.level)
        inner = self._inner(x, y, (-step[0], -step[1]))
        other = self._inner(i, j, step)
        light = limits.linear(float(self.levels[j, i])) if other is None else other
        share = 1.0
        if inner is not None and abs(inner - light) > limits.LEAST_CONTRAST:
            share = (seen - light) / (inner - light)
        if not limits.LEAST_SHARE <= share < 1.0:
            share, inner = 1.0, seen
        is_nearer = self.order[y, x] < self.order[j, i]
        if share == 1.0 and not is_nearer:
            return [own]
        colours = limits.gamma_coded(inner or 0.0), limits.gamma_coded(light)
        order, back = float(self.order[j, i]), (-step[0], -step[1])
        return [
            Surface(colours[0], share if is_nearer else 1.0, own.order, (x, y), step),
            Surface(colours[1], 1.0 if is_nearer else 1.0 - share, order, (i, j), back),
        ]

    def _across(self, x: int, y: int) -> tuple[int, int] | None:
        """Step across the highest step in depth next to a pixel, if it has one."""
        best, found = 0.0, None
        for i, j in self._next(x, y):
            height = abs(self.order[j, i] - self.order[y, x])
            if height > max(self.tolerance(x, y), self.tolerance(i, j)) and height > best:
                best, found = height, (i - x, j - y)
        return found

    def _inner(self, x: int, y: int, step: tuple[int, int]) -> float | None:
        """Light of a surface one pixel away from its contour; None if it is too thin."""
        for i, j in self._next(x, y, [step]):
            if abs(self.order[j, i] - self.order[y, x]) < self.tolerance(x, y):
                return limits.linear(float(self.levels[j, i]))
        return None


def place_at(view: View, other: View, x: int, y: int, s: float) -> Float64s | None:
    """Where the surface of a pixel is at `s` of its path to the other frame, (x, y), px.

    Everett's formula through four positions, straight where the two frames' bends disagree.
    None where the vector is not known.
    """
    vector = view.vectors[y, x]
    if not np.isfinite(vector).all():
        return None
    if np.abs(vector).max() < path_limits.LEAST_MOTION_PX:
        vector = np.zeros(2)
    path = s * vector
    here = None if view.bend is None else view.bend[y, x]
    if here is not None and np.abs(here).max() > path_limits.LEAST_BEND_PX:
        met = _met(view, other, x, y)
        there = None if met is None or other.bend is None else other.bend[met[1], met[0]]
        bends = _agreed(here, there, math.hypot(*vector))
        path = path - s * (1 - s) * ((2 - s) * bends[0] + (1 + s) * bends[1]) / 6
    return np.asarray(np.array([x, y]) + path)


def _met(view: View, other: View, x: int, y: int) -> tuple[int, int] | None:
    """The pixel of the other frame that shows the same surface, if one does."""
    height, width = view.order.shape
    i, j = (math.floor(one + 0.5) for one in np.array([x, y]) + view.vectors[y, x])
    if not (0 <= i < width and 0 <= j < height):
        return None
    is_near = abs(other.order[j, i] - view.order[y, x]) < path_limits.SAME_DEPTH + view.tolerance(
        x, y
    )
    return (i, j) if is_near else None


def _agreed(here: Float64s, there: Float64s | None, length: float) -> tuple[Float64s, Float64s]:
    """Both frames' bends as far as they agree: none, or at most twice the other."""
    nothing = np.zeros(2), np.zeros(2)
    size = math.hypot(*here)
    if there is None:
        return (here, here) if size <= path_limits.CURVE_LIMIT * length else nothing
    if float(here @ there) <= 0:
        return nothing
    other = math.hypot(*there)
    most = float(path_limits.AGREEMENT)
    return here * min(1.0, most * other / size), there * min(1.0, most * size / other)


@dataclass(frozen=True, eq=False)
class Piece:
    """A surface of a pixel at an instant."""

    order: float
    depth_now: float
    tolerance: float
    shift: Float64s
    weight: float
    """How much it overlaps the pixel in question."""


def pieces_over(view: View, other: View, s: float, x: int, y: int) -> list[Piece]:
    """The pieces of a frame that reach a pixel of the new image."""
    found = []
    height, width = view.order.shape
    for row in range(height):
        for column in range(width):
            for surface in view.surfaces(column, row):
                i, j = surface.donor
                place = place_at(view, other, i, j, s)
                if place is None:
                    continue
                shift = place - [i, j]
                overlap = _overlap(view, (i, j), s, np.array([column, row]) + shift, (x, y))
                if overlap > LEAST_OVERLAP:
                    met = _met(view, other, i, j)
                    change = 0.0 if met is None else other.order[met[1], met[0]] - view.order[j, i]
                    now = surface.order + s * change
                    limit = view.tolerance(i, j)
                    found.append(Piece(surface.order, now, limit, shift, overlap))
    return found


def _overlap(
    view: View, donor: tuple[int, int], s: float, place: Float64s, pixel: tuple[int, int]
) -> float:
    """Area of a pixel that the rectangle around a stretched pixel covers."""
    stretch = np.eye(2) + s * _stretch(view, *donor)
    sides = np.maximum(np.abs(stretch).sum(axis=1), 1.0) / 2
    low = np.maximum(place - sides, np.array(pixel) - 0.5)
    high = np.minimum(place + sides, np.array(pixel) + 0.5)
    return float(np.prod(np.maximum(high - low, 0.0)))


@cache
def _stretch(view: View, x: int, y: int) -> Float64s:
    """How the displacement changes along x and y within the layer, [[dx/dx, dx/dy], ...]."""
    result = np.zeros((2, 2))
    for axis, steps in enumerate((STEPS[:2], STEPS[2:])):
        changes = [
            (i - x + j - y) * (view.vectors[j, i] - view.vectors[y, x])
            for i, j in view._next(x, y, steps)
            if abs(view.order[j, i] - view.order[y, x]) < view.tolerance(x, y)
            and np.isfinite(view.vectors[j, i]).all()
        ]
        if changes:
            mean = np.mean(changes, axis=0)
            result[:, axis] = np.clip(mean, path_limits.LEAST_STRETCH, path_limits.MOST_STRETCH)
    return result


def level_at(first: View, second: View, position: float, x: int, y: int) -> float:
    """Level of one pixel at τ = `position`."""
    both = (
        pieces_over(first, second, position, x, y),
        pieces_over(second, first, 1.0 - position, x, y),
    )
    every = [piece for pieces in both for piece in pieces]
    held = first.levels[y, x] + position * (second.levels[y, x] - first.levels[y, x])
    if not every:
        return float(held)
    nearest = min(every, key=lambda piece: piece.depth_now)
    spread = max(piece.depth_now for piece in every) - nearest.depth_now
    if spread <= 2.0 * nearest.tolerance:
        level = _mixed(_sights((first, second), both, x, y), position)
        return float(held) if level is None else level
    near, far = _two_layers(both, nearest)
    sights = _sights((first, second), near, x, y)
    front = _mixed(sights, position)
    back = _mixed(_sights((first, second), far, x, y), position)
    if front is None or back is None:
        only = back if front is None else front
        return float(held) if only is None else only
    share = _covered(sights[0][0], sights[1][0], position)
    if share >= 1.0:
        return front
    light = share * limits.linear(front) + (1 - share) * limits.linear(back)
    return limits.gamma_coded(light)


def _two_layers(
    both: tuple[list[Piece], list[Piece]], nearest: Piece
) -> tuple[list[list[Piece]], list[list[Piece]]]:
    """The pieces of each frame that belong to the nearest layer, and to the one behind it."""

    def is_near(piece: Piece) -> bool:
        limit = SAME_LAYER * max(piece.tolerance, nearest.tolerance)
        return bool(piece.depth_now <= nearest.depth_now + limit)

    near = [[piece for piece in pieces if is_near(piece)] for pieces in both]
    rest = [[piece for piece in pieces if not is_near(piece)] for pieces in both]
    depth = min((piece.depth_now for pieces in rest for piece in pieces), default=math.inf)
    far = [
        [one for one in pieces if one.depth_now <= depth + SAME_LAYER * one.tolerance]
        for pieces in rest
    ]
    return near, far


def _sights(
    views: tuple[View, View], both: Sequence[list[Piece]], x: int, y: int
) -> list[tuple[float, float]]:
    """(Share, level) of a layer in both frames; share 0 where a frame does not show it."""
    result = []
    for view, pieces in zip(views, both, strict=True):
        if not pieces:
            result.append((0.0, 0.0))
            continue
        weights = np.array([piece.weight for piece in pieces])
        shift = np.average([piece.shift for piece in pieces], axis=0, weights=weights)
        order = float(np.average([piece.order for piece in pieces], weights=weights))
        limit = float(np.average([piece.tolerance for piece in pieces], weights=weights))
        result.append(_look(view, np.array([x, y]) - shift, order, limit))
    return result


def _look(view: View, place: Float64s, order: float, limit: float) -> tuple[float, float]:
    """Share and level of a layer at a place of a frame."""
    height, width = view.order.shape
    from_x, from_y = np.clip(place, 0.0, [width - 1.0, height - 1.0])
    column, row = int(from_x), int(from_y)
    u, v = from_x - column, from_y - row
    nearest = view.order[int(from_y + 0.5), int(from_x + 0.5)]
    if _is_plain(view, column, row) and abs(nearest - order) <= 3 * limit:
        return 1.0, _smooth(view.levels, column, row, u, v)
    share = light = 0.0
    for i, across in ((column, (u, 1.0)), (column + 1, (0.0, u))):
        for j, down in ((row, (v, 1.0)), (row + 1, (0.0, v))):
            part = (across[1] - across[0]) * (down[1] - down[0])
            if part <= 0:
                continue
            for surface in view.surfaces(min(i, width - 1), min(j, height - 1)):
                if abs(surface.order - order) <= SAME_LAYER * limit:
                    part *= _filled(surface, across, down)
                    share += part
                    light += part * surface.level
                    break
    return (share, light / share) if share > 1e-4 else (0.0, 0.0)


def _filled(surface: Surface, across: tuple[float, float], down: tuple[float, float]) -> float:
    """How much of a rectangle in its pixel a surface fills: from one side, up to its share."""
    if surface.share >= 1.0:
        return surface.share
    axis = 0 if surface.away[0] else 1
    start, stop = (across, down)[axis]
    if surface.away[axis] < 0:
        start, stop = 1.0 - stop, 1.0 - start
    return min(max((surface.share - start) / (stop - start), 0.0), 1.0)


def _is_plain(view: View, x: int, y: int) -> bool:
    """Whether the 4x4 pixels around the square from (x, y) to (x + 1, y + 1) are one layer."""
    height, width = view.order.shape
    if not (1 <= x < width - 2 and 1 <= y < height - 2):
        return False
    window = view.order[y - 1 : y + 3, x - 1 : x + 3]
    return bool(window.max() - window.min() <= 4 * view.tolerance(x, y))


def _smooth(levels: Float64s, x: int, y: int, u: float, v: float) -> float:
    """The interpolating cubic B-spline, kept within the levels of the 4x4 pixels around."""
    if u == 0 and v == 0:
        return float(levels[y, x])
    rows = _interpolating(levels.shape[0]) @ levels @ _interpolating(levels.shape[1]).T
    window = slice(y - 1, y + 3), slice(x - 1, x + 3)
    level = _basis(v) @ rows[window] @ _basis(u)
    return float(np.clip(level, levels[window].min(), levels[window].max()))


def _basis(u: float) -> Float64s:
    """The four cubic B-splines that reach a point between two knots."""
    distances = np.abs(np.array([1 + u, u, 1 - u, 2 - u]))
    inner = 2 / 3 - distances**2 + distances**3 / 2
    return np.asarray(np.where(distances < 1, inner, np.maximum(2 - distances, 0) ** 3 / 6))


@cache
def _interpolating(count: int) -> Float64s:
    """[count, count]: levels to the coefficients whose spline passes through them, mirrored."""
    matrix = np.zeros((count, count))
    for k in range(count):
        for neighbour, part in ((k - 1, 1 / 6), (k, 4 / 6), (k + 1, 1 / 6)):
            mirrored = abs(neighbour)
            if mirrored >= count:
                mirrored = 2 * (count - 1) - mirrored
            matrix[k, mirrored] += part
    return np.asarray(np.linalg.inv(matrix))


def _mixed(sights: Sequence[tuple[float, float]], position: float) -> float | None:
    """Level of a layer, mixed by time; None where neither frame shows it."""
    weights = sights[0][0] * (1 - position), sights[1][0] * position
    if sum(weights) <= 0:
        return None
    return (weights[0] * sights[0][1] + weights[1] * sights[1][1]) / sum(weights)


def _covered(share_1: float, share_2: float, position: float) -> float:
    """How much of a pixel the nearer layer covers: mixed by time where both frames see it."""
    mixed = share_1 + position * (share_2 - share_1)
    apart = (abs(share_1 - share_2) - float(SIMILAR)) / float(DIFFERENT - SIMILAR)
    doubt = min(max(apart, 0.0), 1.0)
    return min(mixed + doubt * (max(share_1, share_2) - mixed), 1.0)
