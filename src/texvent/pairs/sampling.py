"""Samples of an image between its pixels, compiled.

Along an axis, between pixels p1 and p2 with p0 and p3 beside them, a sample is the mean of the
parabolas through p0, p1, p2 and through p1, p2, p3: `p1 + u (p2 − p1) − u (1 − u) s`, with the bend
`s = (p0 − p1 − p2 + p3) / 4`. In two dimensions the bends of both axes, each mixed linearly along
the other one, are taken off the bilinear sample; the result is limited to the range of the four
pixels around the place, or two on a line between them. Beyond its edges an image goes on straight.

Source: the piecewise parabolic interpolator of Erup, Gardner and Harris (IEEE Transactions on
    Communications 41, 1993) with α = 1/4. The sum of both axes and the limit are ours.

Gathering pixels is what costs time, so neighbours are copied together.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir
from numba.core import types
from numpy.typing import NDArray

from texvent.runtime.jit import intrinsic, jit

Floats = NDArray[np.float32]
Numbers = NDArray[np.int32]
Words = NDArray[np.uint64]
"""Two float32 in each, loaded together."""

BEFORE, AFTER = 1, 2
"""Pixels that a widened image has before the first and after the last one, along each axis."""
_0, _QUARTER, _1 = np.float32(0.0), np.float32(0.25), np.float32(1.0)
_ONE, _FOUR = np.uint64(1), np.uint64(4)


class Samples(NamedTuple):
    """Samples of one of the frames at the places of points; [n]."""

    corner: Numbers
    """Flat index, in the widened image, of the pixel up left of the place."""
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
    """Flow of the nearest pixel, px."""


class Corners(NamedTuple):
    """Scratch memory: pixels p1 and p2, or p0 to p3, of four rows around the places; flat."""

    above: Floats
    """[2 · n]"""
    upper: Floats
    """[4 · n]"""
    lower: Floats
    """[4 · n]"""
    below: Floats
    """[2 · n]"""


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
        np.empty(2 * room, np.float32),
        np.empty(4 * room, np.float32),
        np.empty(4 * room, np.float32),
        np.empty(2 * room, np.float32),
    )


@jit
def widen(image: Floats) -> Floats:
    """An image [H, W] with `BEFORE` and `AFTER` more pixels at its edges, straight on; flat."""
    height, width = image.shape
    wide = np.empty((height + BEFORE + AFTER, width + BEFORE + AFTER), np.float32)
    for row in range(height):
        source, target = image[row], wide[row + BEFORE]
        inner = target[BEFORE:]
        for x in range(width):
            inner[x] = source[x]
        last = width - 1
        target[0] = source[0] + (source[0] - source[min(1, last)])
        inner[width] = source[last] + (source[last] - source[max(last - 1, 0)])
        inner[width + 1] = inner[width]
    first, final = wide[BEFORE], wide[height]
    second, before = wide[min(2, height)], wide[max(height - 1, 1)]
    for x in range(wide.shape[1]):
        wide[0, x] = first[x] + (first[x] - second[x])
        wide[height + 1, x] = final[x] + (final[x] - before[x])
        wide[height + 2, x] = wide[height + 1, x]
    return wide.reshape(-1)


def _copier(count: int) -> Any:
    """A function for other compiled kernels that copies `count` neighbours at once."""

    def copy(typing_context: Any, image: Any, index: Any, out: Any, place: Any) -> Any:
        del typing_context

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            kind = ir.VectorType(ir.FloatType(), count).as_pointer()
            start, stop = (
                builder.bitcast(builder.gep(array.data, [arguments[k + 1]]), kind)
                for k in (0, 2)
                for array in [context.make_array(signature.args[k])(context, builder, arguments[k])]
            )
            row = builder.load(start)
            row.align = 4
            builder.store(row, stop).align = 4
            return context.get_dummy_value()

        return types.void(image, index, out, place), generate

    def copy_slices(image: Floats, index: Any, out: Floats, place: Any) -> None:
        out[int(place) : int(place) + count] = image[int(index) : int(index) + count]

    return intrinsic(copy, copy_slices)


copy_two, copy_four = _copier(2), _copier(4)


@jit(error_model="numpy", inner=True)
def sample(
    image: Floats, flows: Words, number: int, width: int, memory: tuple[Samples, Corners]
) -> None:
    """Set intensity and flow of samples whose places are known.

    Args:
        image: the frame, `widen`ed.
        flows: [h · w] its flow, px.
        number: of samples.
        width: of a row of the image.
        memory: the samples, and scratch memory.
    """
    samples, corners = memory
    _gather(image, samples.corner, number, width, corners)
    _mix_corners(corners, number, samples)
    nearest, flow = samples.nearest, samples.flow
    for k in range(number):
        flow[k] = flows[np.uint64(nearest[k])]


@jit(error_model="numpy", inner=True)
def _gather(image: Floats, corner: Numbers, number: int, width: int, out: Corners) -> None:
    above, upper, lower, below = out
    wide = np.uint64(width)
    for k in range(number):
        # Unsigned, or Numba allows for negative indices.
        here, first = np.uint64(corner[k]), np.uint64(k)
        copy_two(image, here - wide, above, first + first)
        copy_four(image, here - _ONE, upper, _FOUR * first)
        here += wide
        copy_four(image, here - _ONE, lower, _FOUR * first)
        copy_two(image, here + wide, below, first + first)


@jit(error_model="numpy", inner=True)
def _mix_corners(corners: Corners, number: int, samples: Samples) -> None:
    us, vs, value = samples.u, samples.v, samples.value
    above, upper, lower, below = corners
    for k in range(number):
        u, v = us[k], vs[k]
        a, b, c, d = upper[4 * k + 1], upper[4 * k + 2], lower[4 * k + 1], lower[4 * k + 2]
        over, under = a + (b - a) * u, c + (d - c) * u
        straight = over + (under - over) * v
        top = _QUARTER * ((upper[4 * k] - a) + (upper[4 * k + 3] - b))
        bottom = _QUARTER * ((lower[4 * k] - c) + (lower[4 * k + 3] - d))
        left = _QUARTER * ((above[2 * k] - a) + (below[2 * k] - c))
        right = _QUARTER * ((above[2 * k + 1] - b) + (below[2 * k + 1] - d))
        along, across = top + (bottom - top) * v, left + (right - left) * u
        bent = straight - (u * (_1 - u) * along + v * (_1 - v) * across)
        is_right, is_below = u > _0, v > _0
        b, d = b if is_right else a, d if is_right else c
        c, d = c if is_below else a, d if is_below else b
        least, most = min(min(a, b), min(c, d)), max(max(a, b), max(c, d))
        value[k] = min(max(bent, least), most)
