"""Samples of an image between its pixels, compiled.

Along an axis, between pixels p1 and p2 with p0 and p3 beside them, a sample is the mean of the
parabolas through p0, p1, p2 and through p1, p2, p3: `p1 + u (p2 − p1) − u (1 − u) s`, with the bend
`s = (p0 − p1 − p2 + p3) / 4`. In two dimensions the bends of both axes, each mixed linearly along
the other one, are taken off the bilinear sample; the result is limited to the range of the four
pixels around the place.

Source: the piecewise parabolic interpolator of Erup, Gardner and Harris (IEEE Transactions on
    Communications 41, 1993) with α = 1/4. The sum of both axes and the limit are ours.

Gathering pixels is what costs time: it takes no vector instructions. So what belongs to a place
is held in words of two float32, and four of them hold the pixels around it and their bends.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import read_only

Floats = NDArray[np.float32]
Numbers = NDArray[np.int32]
Words = NDArray[np.uint64]
"""Two float32 in each, loaded together."""

_0, _QUARTER, _1 = np.float32(0.0), np.float32(0.25), np.float32(1.0)
_ONE = np.uint64(1)


class PixelWords(NamedTuple):
    """A frame, prepared for samples."""

    pixels: Words
    """[(H + 1) · W] each pixel with its right neighbour; the last row is repeated once."""
    bends: Words
    """[H · W · 2] the bend along x of each pixel and of the one below; the bend along y of each
    pixel and of its right neighbour."""


class Samples(NamedTuple):
    """Samples of one of the frames at the places of points; [n]."""

    corner: Numbers
    """Flat index of the pixel up left of the place."""
    nearest: Numbers
    """Flat index of the vector of the pixel nearest to the place."""
    u: Floats
    """Distance of the place to the right of the corner, 0..1."""
    v: Floats
    """Distance below the corner, 0..1."""
    outside: Floats
    """Distance outside the image, px."""
    value: Floats
    """Intensity at the place."""
    flow: Words
    """Of the nearest pixel, px."""


class Corners(NamedTuple):
    """Scratch memory: pixels around the places; [n]."""

    upper: Words
    """Intensity of the corner and its right neighbour."""
    lower: Words
    """The same, a row below."""
    along: Words
    """Bends along x of the corner and of the pixel below."""
    across: Words
    """Bends along y of the corner and of its right neighbour."""


@jit(error_model="numpy", inner=True)
def make_samples(room: int) -> Samples:
    """Room for the samples of `room` points."""
    return Samples(
        np.empty(room, np.int32),
        np.empty(room, np.int32),
        np.empty(room, np.float32),
        np.empty(room, np.float32),
        np.empty(room, np.float32),
        np.empty(room, np.float32),
        np.empty(room, np.uint64),
    )


@jit(error_model="numpy", inner=True)
def make_corners(room: int) -> Corners:
    """Scratch memory for `room` points."""
    return Corners(
        np.empty(room, np.uint64),
        np.empty(room, np.uint64),
        np.empty(room, np.uint64),
        np.empty(room, np.uint64),
    )


def list_words(image: Floats) -> PixelWords:
    """Prepare a frame for samples.

    Args:
        image: [H, W], read-only.
    """
    return PixelWords(read_only(_with_neighbours(image)), read_only(_list_bends(image)))


@jit
def _with_neighbours(image: Floats) -> Words:
    height, width = image.shape
    levels = np.empty((height + 1, 2 * width), np.float32)
    for row in range(height + 1):
        source, target = image[min(row, height - 1)], levels[row]
        for x in range(width - 1):
            target[2 * x], target[2 * x + 1] = source[x], source[x + 1]
        target[2 * width - 2], target[2 * width - 1] = source[width - 1], source[width - 1]
    return levels.reshape(-1).view(np.uint64)


@jit
def _list_bends(image: Floats) -> Words:
    height, width = image.shape
    levels = np.empty((height, 4 * width), np.float32)
    rows = np.zeros((6, width), np.float32)
    turns, along, along_below = rows[0], rows[1], rows[2]
    across, above, below = rows[3], rows[4], rows[5]
    _bend_row(image[0], turns, along_below)
    for row in range(height):
        along, along_below = along_below, along
        if row + 1 < height:
            _bend_row(image[row + 1], turns, along_below)
        above, below = below, above
        _turn(image[row], image[min(row + 1, height - 1)], image[min(row + 2, height - 1)], below)
        if row + 2 >= height:
            below[:] = _0
        for x in range(width):
            across[x] = _QUARTER * (above[x] + below[x])
        target = levels[row]
        for x in range(width - 1):
            target[4 * x], target[4 * x + 1] = along[x], along_below[x]
            target[4 * x + 2], target[4 * x + 3] = across[x], across[x + 1]
        last = target[4 * width - 4 :]
        last[0], last[1], last[2], last[3] = _0, _0, across[width - 1], across[width - 1]
    return levels.reshape(-1).view(np.uint64)


@jit(error_model="numpy", inner=True)
def _bend_row(row: Floats, turns: Floats, bends: Floats) -> None:
    """Bends along x of a row; the last of them is not set. `turns` is scratch memory."""
    _turn(row, row[1:], row[2:], turns[1:])
    turns[-1] = _0
    for x in range(row.size - 1):
        bends[x] = _QUARTER * (turns[x] + turns[x + 1])


@jit(error_model="numpy", inner=True)
def _turn(before: Floats, here: Floats, after: Floats, turns: Floats) -> None:
    """By how much the slope changes at pixels."""
    for x in range(after.size):
        turns[x] = (before[x] - here[x]) + (after[x] - here[x])


@jit(error_model="numpy", inner=True)
def sample(
    words: PixelWords, flows: Words, number: int, width: int, memory: tuple[Samples, Corners]
) -> None:
    """Set intensity and flow of samples whose places are known.

    Args:
        words: the frame.
        flows: [h · w] its flow, px.
        number: of samples.
        width: of the frame, pixels.
        memory: the samples, and scratch memory.
    """
    samples, corners = memory
    _gather(words, samples.corner, number, width, corners)
    _mix_corners(corners, number, samples)
    nearest, flow = samples.nearest, samples.flow
    for k in range(number):
        flow[k] = flows[np.uint64(nearest[k])]


@jit(error_model="numpy", inner=True)
def _gather(words: PixelWords, corner: Numbers, number: int, width: int, out: Corners) -> None:
    (pixels, bends), (upper, lower, along, across) = words, out
    for k in range(number):
        # Unsigned, or Numba allows for negative indices.
        upper[k] = pixels[np.uint64(corner[k])]
        lower[k] = pixels[np.uint64(corner[k] + width)]
    for k in range(number):
        here = np.uint64(corner[k])
        along[k], across[k] = bends[here + here], bends[here + here + _ONE]


@jit(error_model="numpy", inner=True)
def _mix_corners(corners: Corners, number: int, samples: Samples) -> None:
    us, vs, value = samples.u, samples.v, samples.value
    upper, lower = corners.upper.view(np.float32), corners.lower.view(np.float32)
    bend_x, bend_y = corners.along.view(np.float32), corners.across.view(np.float32)
    for k in range(number):
        u, v = us[k], vs[k]
        a, b, c, d = upper[2 * k], upper[2 * k + 1], lower[2 * k], lower[2 * k + 1]
        above, below = a + (b - a) * u, c + (d - c) * u
        straight = above + (below - above) * v
        along = bend_x[2 * k] + (bend_x[2 * k + 1] - bend_x[2 * k]) * v
        across = bend_y[2 * k] + (bend_y[2 * k + 1] - bend_y[2 * k]) * u
        bent = straight - (u * (_1 - u) * along + v * (_1 - v) * across)
        least, most = min(min(a, b), min(c, d)), max(max(a, b), max(c, d))
        value[k] = min(max(bent, least), most)
