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
from texvent_scenes.raycast.trace import ray_direction
from texvent_scenes.raycast.vectors import Vector, dot, pixel_steps, triple
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
        result = np.empty_like(light)
        weights, height = self.weights, len(light)

        def filter_band(top: int) -> None:
            rows = top, min(top + _BAND, height)
            pass_rows(world.instant, rows, light, weights, self.vignetting, wanted, result)

        run_parts(filter_band, range(0, height, _BAND))
        return result[wanted]


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
    right, down = triple(instant.right), triple(instant.down)
    angle, cosine = _solid_angle(instant, x, y)
    share = angle * cosine / math.sqrt(dot(right, right) * dot(down, down))
    return 1.0 if math.isnan(share) else share


@jit(error_model="numpy")
def pass_rows(
    instants: NDArray[Any],
    rows: tuple[int, int],
    light: Float32Array,
    weights: Float64Array,
    vignetting: bool,
    wanted: Mask,
    result: Float32Array,
) -> None:
    """Fill the wanted pixels in some rows of `result` with light that passed a lens.

    Args:
        instants: `World.instant` of the scene.
        rows: first row and one past the last one.
        light: [H, W, 3] without a lens.
        weights: of `Optics`.
        vignetting: whether the image darkens off the axis.
        wanted: [H, W] pixels.
        result: [H, W, 3] is written.
    """
    height, width = wanted.shape
    reach = len(weights) // 2
    across = np.empty((rows[1] - rows[0] + 2 * reach, 3), np.float64)
    for column in range(width):
        first, last = rows[1], rows[0]
        for row in range(rows[0], rows[1]):
            if wanted[row, column]:
                first, last = min(first, row), row + 1
        for row in range(first - reach, last + reach if last > first else first - reach):
            source = _mirrored(row, height)
            red, green, blue = 0.0, 0.0, 0.0
            for step in range(-reach, reach + 1):
                at, weight = _mirrored(column + step, width), weights[step + reach]
                red += weight * light[source, at, 0]
                green += weight * light[source, at, 1]
                blue += weight * light[source, at, 2]
            line = row - rows[0] + reach
            across[line, 0], across[line, 1], across[line, 2] = red, green, blue
        for row in range(first, last):
            if not wanted[row, column]:
                continue
            share = _falloff(instants[0], column + 0.5, row + 0.5) if vignetting else 1.0
            for channel in range(3):
                total = 0.0
                for step in range(2 * reach + 1):
                    total += weights[step] * across[row - rows[0] + step, channel]
                result[row, column, channel] = share * total
