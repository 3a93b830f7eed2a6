"""Light that a lens passes to the sensor: spread around each point, and less off its axis.

The point spread is a Gaussian in image coordinates. Beyond its edges a picture is continued by its
mirror image: what a pixel gives to all others sums to 1, and so do the weights of what it takes. A
uniform field stays as it is, and no light is lost.

Vignetting is natural: the share of the light that a thin lens of a fixed aperture passes, cosθ
times the solid angle of a pixel, as a share of that on the axis. Without distortion it is cos⁴θ.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.threads import run_parts
from texvent_scenes.raycast.records import Record, World
from texvent_scenes.raycast.trace import plane_direction, ray_direction
from texvent_scenes.raycast.vectors import NO_DISTORTION, Vector, dot, pixel_steps, triple
from texvent_scenes.rendered_scene import Float32Array, Float64Array

Mask = NDArray[np.bool_]
REACH = 3.0
"""Standard deviations at which the point spread ends."""
_BAND = 48
"""Rows that are filtered together."""


@dataclass(frozen=True)
class Optics:
    """A lens; without arguments it is perfect."""

    point_spread_px: float = 0.0
    """Standard deviation of the image of a point, pixels."""
    vignetting: bool = False
    """Whether the image darkens off the axis."""

    @property
    def weights(self) -> Float64Array:
        """[2 · reach + 1] shares of the pixels along a row or column, from -reach to reach."""
        reach = math.ceil(REACH * self.point_spread_px)
        steps = np.arange(-reach, reach + 1) / max(self.point_spread_px, 1e-9)
        shares = np.exp(-0.5 * steps**2)
        return np.asarray(shares / shares.sum())

    def touched(self, pixels: Mask) -> Mask:
        """[H, W] the pixels that take light from some others."""
        return widened(pixels, math.ceil(REACH * self.point_spread_px))

    def passed(self, light: Float32Array, world: World, wanted: Mask) -> Float32Array:
        """Light [k, 3] of the wanted pixels.

        Args:
            light: [H, W, 3] linear, without a lens.
            world: the instant that it shows.
            wanted: [H, W] pixels.
        """
        if self == Optics():
            return light[wanted]
        counts = np.count_nonzero(wanted, axis=1)
        starts = np.cumsum(counts) - counts
        result = np.empty((int(counts.sum()), 3), np.float32)
        weights, height = self.weights, len(light)
        rows_of = np.ascontiguousarray(light).reshape(height, -1)

        def filter_band(top: int) -> None:
            rows = top, min(top + _BAND, height)
            args = rows_of, weights, self.vignetting, wanted, starts, result
            pass_rows(world.instant, rows, *args)

        run_parts(filter_band, range(0, height, _BAND))
        return result


PERFECT = Optics()


def widened(pixels: Mask, reach: int) -> Mask:
    """[H, W] the pixels at most `reach` away from some others, along both axes."""
    for axis in (0, 1):
        result = pixels.copy()
        for step in range(1, reach + 1):
            along, back = [slice(None)] * 2, [slice(None)] * 2
            along[axis], back[axis] = slice(step, None), slice(None, -step)
            result[tuple(along)] |= pixels[tuple(back)]
            result[tuple(back)] |= pixels[tuple(along)]
        pixels = result
    return pixels


@jit(error_model="numpy", inner=True)
def _mirrored(index: int, count: int) -> int:
    """Number of the pixel, of a row of `count`, that continues it at `index`."""
    index %= 2 * count
    return min(index, 2 * count - 1 - index)


@jit(error_model="numpy", inner=True)
def _solid_angle(instant: Record, x: float, y: float) -> tuple[float, float]:
    """Solid angle of a pixel around (x, y), steradian, and the cosine of its angle to the axis."""
    direction = ray_direction(instant, x, y)
    right, down = pixel_steps(instant, x, y)
    normal: Vector = (
        right[1] * down[2] - right[2] * down[1],
        right[2] * down[0] - right[0] * down[2],
        right[0] * down[1] - right[1] * down[0],
    )
    cosine = 1.0 / math.sqrt(dot(direction, direction))
    return abs(dot(direction, normal)) * cosine**3, cosine


@jit(error_model="numpy", inner=True)
def _falloff(instant: Record, x: float, y: float) -> float:
    """Share of the light at (x, y), of that on the axis."""
    if instant.distortion == NO_DISTORTION:  # rays of length 1 along the axis: cos⁴
        direction = plane_direction(instant, x, y)
        return 1.0 / dot(direction, direction) ** 2
    right, down = triple(instant.right), triple(instant.down)
    angle, cosine = _solid_angle(instant, x, y)
    share = angle * cosine / math.sqrt(dot(right, right) * dot(down, down))
    return 1.0 if math.isnan(share) else share


@jit(error_model="numpy", inner=True)
def _bounds(wanted: Mask, rows: tuple[int, int]) -> tuple[int, int, int, int]:
    """First row and column with a wanted pixel, and one past the last ones, in some rows."""
    top, bottom, left, right = rows[1], rows[0], wanted.shape[1], 0
    for row in range(rows[0], rows[1]):
        for column in range(wanted.shape[1]):
            if wanted[row, column]:
                top, bottom = min(top, row), row + 1
                left, right = min(left, column), max(right, column + 1)
    return top, bottom, left, right


@jit(error_model="numpy", inner=True)
def _filter_row(
    row: Float32Array, left: int, weights: Float64Array, padded: Float64Array, result: Float64Array
) -> None:
    """Weighted sums along a row of colours, for as many columns from `left` on as `result` holds.

    Args:
        row: [3 · W] of an image.
        left: first column.
        weights: [2 · reach + 1].
        padded: [more] scratch space, for `result` and 2 · reach columns.
        result: [3 · k] is written.
    """
    reach, count = len(weights) // 2, len(result)
    for column in range(count // 3 + 2 * reach):
        at = 3 * _mirrored(left + column - reach, len(row) // 3)
        for channel in range(3):
            padded[3 * column + channel] = row[at + channel]
    result[:] = 0.0
    for step in range(len(weights)):
        weight, shifted = weights[step], padded[3 * step : 3 * step + count]
        for index in range(count):
            result[index] += weight * shifted[index]


@jit(error_model="numpy")
def pass_rows(
    instants: NDArray[Any],
    rows: tuple[int, int],
    light: Float32Array,
    weights: Float64Array,
    vignetting: bool,
    wanted: Mask,
    starts: NDArray[np.int64],
    result: Float32Array,
) -> None:
    """Fill those of `result` that lie in some rows with light that passed a lens.

    Args:
        instants: `World.instant` of the scene.
        rows: first row and one past the last one.
        light: [H, 3 · W] without a lens.
        weights: of `Optics`.
        vignetting: whether the image darkens off the axis.
        wanted: [H, W] pixels.
        starts: [H] wanted pixels in the rows above each row.
        result: [k, 3] of the wanted pixels, row by row, is written.
    """
    reach = len(weights) // 2
    top, bottom, left, right = _bounds(wanted, rows)
    if top >= bottom:
        return
    across = np.empty((bottom - top + 2 * reach, 3 * (right - left)), np.float64)
    padded, total = np.empty(3 * (right - left + 2 * reach)), np.empty(3 * (right - left))
    for line in range(len(across)):
        source = light[_mirrored(top + line - reach, len(light))]
        _filter_row(source, left, weights, padded, across[line])
    for row in range(top, bottom):
        total[:] = 0.0
        for step in range(len(weights)):
            weight, line = weights[step], across[row - top + step]
            for index in range(len(total)):
                total[index] += weight * line[index]
        number = starts[row]
        for column in range(left, right):
            if wanted[row, column]:
                share = _falloff(instants[0], column + 0.5, row + 0.5) if vignetting else 1.0
                for channel in range(3):
                    result[number, channel] = share * total[3 * (column - left) + channel]
                number += 1
