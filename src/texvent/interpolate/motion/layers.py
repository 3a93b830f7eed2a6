"""Layers of one frame: order in depth of its surfaces, and their coverage at contours.

A pixel at a contour shows two surfaces. Its centre sees one of them; how much of it that one covers
follows from the brightness on both sides (matting). So the contour can move by parts of a pixel.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit

Floats = NDArray[np.float32]
Numbers = NDArray[np.int32]

DEPTH_STEP = np.float32(0.01)
"""ln depth: surfaces closer together than this are one layer, beside their slope."""
FURTHEST = np.float32(30.0)
"""ln depth of what has no surface, such as the sky."""
NOTHING = np.float32(1e9)
"""Depth of a second surface where there is none."""
LEAST_SHARE = np.float32(0.3)
"""A surface that the centre of a pixel sees covers at least this much of it."""
LEAST_CONTRAST = 0.004
"""Linear light: below this the two sides of a contour are too alike to measure shares."""
JOINT_PX = np.float32(0.02)
"""Two surfaces whose vectors differ by less move as one: their contour stays as it is."""
GAMMA = 2.2
"""Levels to linear light, in which shares of a pixel add up."""
WHITE = 255.0
SPEED_ORDER = np.float32(0.02)
"""Without depth, of two surfaces the faster is taken to be nearer: this much per pixel."""

_POLE = np.float32(math.sqrt(3.0) - 2.0)
_FIRST_TERMS = 12


class Layers(NamedTuple):
    """A frame as the kernels read it."""

    value: Floats
    """[H, W] level of the surface that the pixel's centre sees."""
    share: Floats
    """[H, W] how much of the pixel that surface covers, 0..1."""
    order: Floats
    """[H, W] its ln depth: smaller is nearer."""
    tolerance: Floats
    """[H, W] how much ln depth may differ within its layer, from pixel to pixel."""
    other_value: Floats
    """[H, W] level of the second surface in the pixel."""
    other_share: Floats
    """[H, W] how much it covers; 1 behind the first surface, which hides part of it."""
    other_order: Floats
    """[H, W] its ln depth; `NOTHING` where there is none."""
    other_pixel: Numbers
    """[H, W] flat index of the neighbour that shows it, whose path it takes; -1 for none."""
    spline: Floats
    """[H, W] coefficients of the cubic B-spline through the levels."""
    lowest: Floats
    """[H, W] lowest level of the 4x4 pixels around the square from here to (x + 1, y + 1): beside a
    contour, the spline would swing beyond."""
    highest: Floats
    """[H, W] highest level of them."""
    is_plain: NDArray[np.bool_]
    """[H, W] whether the 4x4 pixels around the square from here to (x + 1, y + 1) are one layer."""


@jit
def linear(level: float) -> float:
    """Linear light of a level, 0..1."""
    return float((max(level, 0.0) / WHITE) ** GAMMA)


@jit
def gamma_coded(light: float) -> float:
    """Level of linear light, 0..255."""
    return float(WHITE * max(light, 0.0) ** (1.0 / GAMMA))


@jit
def find_tolerance(order: Floats) -> Floats:
    """`DEPTH_STEP` and the local slope of ln depth: on each axis the smaller of both sides."""
    height, width = order.shape
    tolerance = np.empty((height, width), np.float32)
    for y in range(height):
        for x in range(width):
            slope = np.float32(0.0)
            for axis in range(2):
                step_x, step_y = 1 - axis, axis
                least = NOTHING
                for sign in (-1, 1):
                    column, row = x + sign * step_x, y + sign * step_y
                    if 0 <= column < width and 0 <= row < height:
                        least = min(least, abs(order[row, column] - order[y, x]))
                if least < np.float32(0.3):
                    slope += least
            tolerance[y, x] = DEPTH_STEP + np.float32(1.5) * slope
    return tolerance


@jit
def make_layers(image: Floats, order: Floats, vectors: Floats) -> Layers:
    """Find contours, shares and spline of a frame.

    Args:
        image: [H, W] levels.
        order: [H, W] ln depth.
        vectors: [H, W, 2] to the other frame of the pair, px; NaN where unknown.
    """
    shape = image.shape
    tolerance = find_tolerance(order)
    lowest, highest = window_extremes(image)
    layers = Layers(
        image.copy(),
        np.ones(shape, np.float32),
        order,
        tolerance,
        np.zeros(shape, np.float32),
        np.zeros(shape, np.float32),
        np.full(shape, NOTHING, np.float32),
        np.full(shape, -1, np.int32),
        fit_spline(image),
        lowest,
        highest,
        _find_plain(order, tolerance),
    )
    for y in range(shape[0]):
        for x in range(shape[1]):
            step_x, step_y = _across_contour(order, tolerance, x, y)
            if step_x or step_y:
                _split_contour(image, vectors, layers, (x, y), (step_x, step_y))
    return layers


@jit(inner=True)
def _split_contour(
    image: Floats, vectors: Floats, layers: Layers, pixel: tuple[int, int], step: tuple[int, int]
) -> None:
    """Tell the two surfaces of a pixel at a contour apart, unless they move as one."""
    order = layers.order
    x, y = pixel
    beyond_x, beyond_y = x + step[0], y + step[1]
    apart = max(
        abs(vectors[y, x, 0] - vectors[beyond_y, beyond_x, 0]),
        abs(vectors[y, x, 1] - vectors[beyond_y, beyond_x, 1]),
    )
    if not apart >= JOINT_PX:  # also where a vector is not known
        return
    seen = linear(image[y, x])
    own = _inner_light(image, layers, pixel, (-step[0], -step[1]))
    other = _inner_light(image, layers, (beyond_x, beyond_y), step)
    share = 1.0
    if own >= 0.0 and abs(own - abs(other)) > LEAST_CONTRAST:
        share = (seen - abs(other)) / (own - abs(other))
    if not LEAST_SHARE <= share <= 1.0:
        share = 1.0
    if share == 1.0:
        own = seen
    is_nearer = order[y, x] < order[beyond_y, beyond_x]
    if not is_nearer and share == 1.0:
        return
    layers.value[y, x] = gamma_coded(own)
    layers.other_value[y, x] = gamma_coded(abs(other))
    layers.other_order[y, x] = order[beyond_y, beyond_x]
    layers.other_pixel[y, x] = beyond_y * image.shape[1] + beyond_x
    # The nearer surface covers its share; the surface behind it goes on below.
    layers.share[y, x] = share if is_nearer else 1.0
    layers.other_share[y, x] = 1.0 if is_nearer else 1.0 - share


@jit(inner=True)
def _across_contour(order: Floats, tolerance: Floats, x: int, y: int) -> tuple[int, int]:
    """Step to the neighbour across the highest step in depth; (0, 0) where there is none."""
    height, width = order.shape
    highest, step_x, step_y = np.float32(0.0), 0, 0
    for index in range(4):
        sign = 1 - 2 * (index % 2)
        dx, dy = (sign, 0) if index < 2 else (0, sign)
        column, row = x + dx, y + dy
        if 0 <= column < width and 0 <= row < height:
            step = abs(order[row, column] - order[y, x])
            if step > max(tolerance[y, x], tolerance[row, column]) and step > highest:
                highest, step_x, step_y = step, dx, dy
    return step_x, step_y


@jit(inner=True)
def _inner_light(
    image: Floats, layers: Layers, pixel: tuple[int, int], step: tuple[int, int]
) -> float:
    """Light of a surface one pixel away from its contour; negative, of the pixel, if too thin."""
    x, y = pixel
    column, row = x + step[0], y + step[1]
    height, width = image.shape
    if 0 <= column < width and 0 <= row < height:
        step_in_depth = abs(layers.order[row, column] - layers.order[y, x])
        if step_in_depth < layers.tolerance[y, x]:
            return linear(image[row, column])
    return -linear(image[y, x])


@jit
def window_extremes(image: Floats) -> tuple[Floats, Floats]:
    """Lowest and highest of the 4x4 pixels around the square from (x, y) to (x + 1, y + 1).

    Pixels outside the image are left out.
    """
    height, width = image.shape
    low, high = image.copy(), image.copy()
    for y in range(height):
        for x in range(width):
            for column in range(max(x - 1, 0), min(x + 3, width)):
                low[y, x] = min(low[y, x], image[y, column])
                high[y, x] = max(high[y, x], image[y, column])
    lowest, highest = low.copy(), high.copy()
    for y in range(height):
        for row in range(max(y - 1, 0), min(y + 3, height)):
            for x in range(width):
                lowest[y, x] = min(lowest[y, x], low[row, x])
                highest[y, x] = max(highest[y, x], high[row, x])
    return lowest, highest


@jit(inner=True)
def _find_plain(order: Floats, tolerance: Floats) -> NDArray[np.bool_]:
    height, width = order.shape
    low, high = window_extremes(order)
    plain = np.zeros((height, width), np.bool_)
    for y in range(1, height - 2):
        for x in range(1, width - 2):
            plain[y, x] = high[y, x] - low[y, x] <= np.float32(4.0) * tolerance[y, x]
    return plain


@jit
def fit_spline(image: Floats) -> Floats:
    """Coefficients of the cubic B-spline that passes through all pixels, mirrored at the edges.

    Source: Unser, Splines: a perfect fit for signal and image processing (1999).
    """
    lines = _filter_down(np.ascontiguousarray(image.T))
    return _filter_down(np.ascontiguousarray(lines.T))


@jit(inner=True)
def _filter_down(lines: Floats) -> Floats:
    """Filter along the first axis, in place."""
    count = len(lines)
    if count < 2:
        return lines
    first, power = lines[0].copy(), np.float32(1.0)
    for k in range(1, min(count, _FIRST_TERMS)):
        power *= _POLE
        first += power * lines[k]
    lines[0] = first
    for k in range(1, count):
        lines[k] += _POLE * lines[k - 1]
    scale = _POLE / (_POLE * _POLE - np.float32(1.0))
    lines[count - 1] = scale * (_POLE * lines[count - 2] + lines[count - 1])
    for k in range(count - 2, -1, -1):
        lines[k] = _POLE * (lines[k + 1] - lines[k])
    lines *= np.float32(6.0)
    return lines
