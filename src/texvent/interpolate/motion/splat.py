"""Put fragments of surface where their paths lead, compiled by Numba.

For each pixel of the new image this collects which layers are there, and from where in each source
frame they came.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from texvent.interpolate.motion.layers import Floats, Numbers
from texvent.runtime.jit import jit

LEAST_OVERLAP = np.float32(1e-3)
"""Fragments that cover less of a pixel are left out."""
SAME_LAYER = np.float32(1.5)
"""Fragments of a layer differ in ln depth by at most this many tolerances."""
SOURCE = 5
"""Numbers that a pixel collects per frame and layer: weight, and weighted sums of where from (x and
y, px from here), ln depth and its tolerance."""


class NearestLayer(NamedTuple):
    """Samples of the nearest layer, accumulated for the pixels of the new image."""

    nearest: Floats
    """[H, W] ln depth of the nearest fragment."""
    farthest: Floats
    """[H, W] of the farthest one."""
    tolerance: Floats
    """[H, W] of the nearest fragment."""
    places: Floats
    """[H · W, 2 · SOURCE] of the nearest layer in both frames."""
    number: Numbers
    """[H, W] row of `OccludedLayer` for a pixel in which two layers meet; 0 where one layer is."""


class OccludedLayer(NamedTuple):
    """Accumulated samples of the occluded layer, for pixels that two layers overlap.

    Row 0 is unused.
    """

    places: Floats
    """[n, 2 · SOURCE]"""
    nearest: Floats
    """[n] ln depth of its nearest fragment."""


class Fragment(NamedTuple):
    """A fragment of surface at an instant."""

    shift_x: np.float32
    """Displacement from its place in its frame, px."""
    shift_y: np.float32
    order: np.float32
    """ln depth in its frame."""
    change: np.float32
    """Change of it since."""
    tolerance: np.float32
    """Tolerance of ln depth within its layer."""


@jit(inner=True)
def make_nearest_layer(height: int, width: int) -> NearestLayer:
    """The nearest layer of an image in which nothing has been put yet."""
    return NearestLayer(
        np.full((height, width), np.inf, np.float32),
        np.full((height, width), -np.inf, np.float32),
        np.zeros((height, width), np.float32),
        np.zeros((height * width, 2 * SOURCE), np.float32),
        np.zeros((height, width), np.int32),
    )


@jit(error_model="numpy", inner=True)
def splat(fragments: Floats, s: np.float32, index: int, visible: NearestLayer) -> None:
    """Collect all fragments of a frame at `s` of their paths, as if there were one layer.

    Args:
        fragments: [n, FRAGMENT]; see `paths.list_fragments`.
        s: 0 at the frame, 1 at the other frame of the pair.
        index: first column of this frame in `NearestLayer.places`.
        visible: added to.
    """
    height, width = visible.nearest.shape
    nearest, farthest, tolerance = visible.nearest, visible.farthest, visible.tolerance
    places = visible.places
    for k in range(len(fragments)):
        fragment = _fragment_at(fragments, k, s)
        x, y = fragments[k, 0] + fragment.shift_x, fragments[k, 1] + fragment.shift_y
        depth = fragment.order + fragment.change
        left, right, top, bottom = _rectangle(fragments, k, s, x, y)
        for row in range(max(math.floor(top), 0), min(math.ceil(bottom), height)):
            down = min(bottom, np.float32(row + 1)) - max(top, np.float32(row))
            for column in range(max(math.floor(left), 0), min(math.ceil(right), width)):
                across = min(right, np.float32(column + 1)) - max(left, np.float32(column))
                if across * down <= LEAST_OVERLAP:
                    continue
                if depth < nearest[row, column]:
                    nearest[row, column] = depth
                    tolerance[row, column] = fragment.tolerance
                farthest[row, column] = max(farthest[row, column], depth)
                _add(places, row * width + column, index, fragment, across * down)


@jit(error_model="numpy", inner=True)
def number_overlaps(visible: NearestLayer) -> Numbers:
    """Number the pixels that two layers overlap, and clear their samples.

    Returns:
        [n + 1] flat index of the pixel that has each number; the first is not used.
    """
    height, width = visible.number.shape
    pixels = np.zeros(height * width + 1, np.int32)
    count = 0
    for y in range(height):
        for x in range(width):
            if (
                visible.farthest[y, x] - visible.nearest[y, x]
                > np.float32(2.0) * visible.tolerance[y, x]
            ):
                count += 1
                visible.number[y, x] = count
                pixels[count] = y * width + x
                visible.places[pixels[count]] = 0
    return pixels[: count + 1].copy()


@jit(error_model="numpy", inner=True)
def splat_overlaps(
    fragments: Floats,
    chosen: Numbers,
    s: np.float32,
    index: int,
    visible: NearestLayer,
    occluded: OccludedLayer,
    is_far: bool,
) -> None:
    """As `splat`, of some fragments, only where two layers meet, and only the near or the far one.

    The first call, for the nearer layer, also finds how far away the farther one is.
    """
    height, width = visible.nearest.shape
    number = visible.number
    for k in chosen:
        fragment = _fragment_at(fragments, k, s)
        x, y = fragments[k, 0] + fragment.shift_x, fragments[k, 1] + fragment.shift_y
        left, right, top, bottom = _rectangle(fragments, k, s, x, y)
        for row in range(max(math.floor(top), 0), min(math.ceil(bottom), height)):
            down = min(bottom, np.float32(row + 1)) - max(top, np.float32(row))
            for column in range(max(math.floor(left), 0), min(math.ceil(right), width)):
                across = min(right, np.float32(column + 1)) - max(left, np.float32(column))
                overlap = number[row, column]
                if overlap == 0 or across * down <= LEAST_OVERLAP:
                    continue
                depth = fragment.order + fragment.change
                limit = SAME_LAYER * max(fragment.tolerance, visible.tolerance[row, column])
                if depth <= visible.nearest[row, column] + limit:
                    if not is_far:
                        _add(visible.places, row * width + column, index, fragment, across * down)
                elif not is_far:
                    occluded.nearest[overlap] = min(occluded.nearest[overlap], depth)
                elif depth <= occluded.nearest[overlap] + SAME_LAYER * fragment.tolerance:
                    _add(occluded.places, overlap, index, fragment, across * down)


@jit(error_model="numpy", inner=True)
def _fragment_at(fragments: Floats, k: int, s: np.float32) -> Fragment:
    """Fragment `k` at `s` of its path."""
    return Fragment(
        s * (fragments[k, 2] + s * (fragments[k, 4] + s * fragments[k, 6])),
        s * (fragments[k, 3] + s * (fragments[k, 5] + s * fragments[k, 7])),
        fragments[k, 13],
        s * fragments[k, 8],
        fragments[k, 14],
    )


@jit(error_model="numpy", inner=True)
def _rectangle(
    fragments: Floats, k: int, s: np.float32, x: np.float32, y: np.float32
) -> tuple[np.float32, np.float32, np.float32, np.float32]:
    """Left, right, top and bottom of a rectangle around a pixel's square, as it is stretched."""
    half, one = np.float32(0.5), np.float32(1.0)
    wide = half * max(abs(one + s * fragments[k, 9]) + abs(s * fragments[k, 10]), one)
    high = half * max(abs(s * fragments[k, 11]) + abs(one + s * fragments[k, 12]), one)
    return x + half - wide, x + half + wide, y + half - high, y + half + high


@jit(error_model="numpy", inner=True)
def _add(places: Floats, row: int, index: int, fragment: Fragment, weight: np.float32) -> None:
    places[row, index] += weight
    places[row, index + 1] -= weight * fragment.shift_x
    places[row, index + 2] -= weight * fragment.shift_y
    places[row, index + 3] += weight * fragment.order
    places[row, index + 4] += weight * fragment.tolerance


@jit(error_model="numpy", inner=True)
def find_overlapping_fragments(fragments: Floats, s: np.float32, number: Numbers) -> Numbers:
    """Indices of the fragments that may reach a pixel in which two layers meet."""
    height, width = number.shape
    near = np.zeros((height, width), np.bool_)
    for y in range(height):
        for x in range(width):
            if number[y, x]:
                near[max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2] = True
    half = np.float32(0.5)
    chosen = np.empty(len(fragments), np.int32)
    count = 0
    for k in range(len(fragments)):
        fragment = _fragment_at(fragments, k, s)
        x, y = fragments[k, 0] + fragment.shift_x, fragments[k, 1] + fragment.shift_y
        if not (-1 < x < width and -1 < y < height):
            continue
        column, row = min(int(x + half), width - 1), min(int(y + half), height - 1)
        if near[row, column]:
            chosen[count] = k
            count += 1
    return chosen[:count]
