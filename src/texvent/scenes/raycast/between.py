"""Instants between two frames of a scene: each part of the image is drawn as often as it changes.

The middle of an interval is drawn first. A block of pixels that was foretold there by the frames
before and after it, and that nothing fast passes, changes evenly: it needs no more instants in
that interval. Both halves of the others are divided again. What one surface fills before and after
an instant, with some pixels around, it fills at the instant too: there only its light is computed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from texvent.runtime.jit import jit
from texvent.scenes.raycast.acceleration import TILE
from texvent.scenes.raycast.adaptive_sampling import UNKNOWN, Codes
from texvent.scenes.raycast.render import Drawn, light_of_rows, world_and_shapes
from texvent.scenes.raycast.reuse import Mask, changed_tiles
from texvent.scenes.scene import Float32Array, Float64Array, Scene
from texvent.sensor import SensorSize

BLOCK = 4
"""Side of the blocks of pixels that share their instants; divides `TILE`."""
EVEN, EVEN_S = 0.03, 1.5e-4
"""A level that is foretold to this share of it changes evenly; in long intervals, where the same
error shifts events further, to `EVEN_S` over the interval."""
DARK = 30.0
"""Added to levels before they are compared, 0..255 scale."""
FASTEST_PX = 4.0
"""Blocks that something passes by more than this in an interval are drawn in its middle."""
SURE_PX = 6.0
"""Motion in an interval, up to which what fills a pixel may follow from its ends."""


@dataclass(frozen=True, eq=False)
class Instant:
    """What is known at one instant."""

    number: int
    """0 is the frame before, then the instants between, then the frame after."""
    luma: Float32Array
    """[H, W] levels."""
    codes: Codes | None
    """[H, W] what fills whole pixels, as for `render_rows`, where they were drawn."""


@dataclass(frozen=True, eq=False)
class Between:
    """Draws the instants between two frames of a scene."""

    scene: Scene
    size: SensorSize
    samples: int
    shadows: bool
    luma_of: Callable[[Float64Array], Float32Array]
    """Light [k, 3] (1 is white) → levels [k]."""

    def draw(
        self, first: Instant, last: Instant, speeds: Float32Array, times_s: Sequence[float]
    ) -> Iterator[Float32Array]:
        """Levels [H, W] at the inner times, in their order.

        Args:
            first: the frame before.
            last: the frame after.
            speeds: of `block_speeds`.
            times_s: of the frame before, of the instants, of the frame after.
        """
        speeds = speeds / np.float32(len(times_s) - 1)
        instants = self._divide(first, last, self._changing(times_s), speeds, times_s)
        return (one.luma for one in instants)

    def _divide(
        self,
        before: Instant,
        after: Instant,
        blocks: Mask,
        speeds: Float32Array,
        times_s: Sequence[float],
    ) -> Iterator[Instant]:
        """The instants between two others; only `blocks` do not change evenly there."""
        steps = after.number - before.number
        if steps < 2:
            return
        number = (before.number + after.number) // 2
        start, stop = times_s[before.number], times_s[after.number]
        share = np.float32((times_s[number] - start) / (stop - start))
        luma = before.luma + share * (after.luma - before.luma)
        codes = np.full(self.size.shape, UNKNOWN)
        if blocks.any():
            moved = speeds * np.float32(steps)
            wanted = _pixels(blocks, self.size)
            if before.codes is not None and after.codes is not None:
                foretell_codes(before.codes, after.codes, wanted, moved, codes)
            exact = self._luma(times_s[number], wanted, codes)
            uneven = np.zeros(self.size.shape, np.bool_)
            limit = np.float32(min(EVEN, EVEN_S / (stop - start)))
            uneven[wanted] = np.abs(exact - luma[wanted]) > limit * (exact + np.float32(DARK))
            luma[wanted] = exact
            blocks = blocks & (_any_in_block(uneven) | (moved > FASTEST_PX))
        middle = Instant(number, luma, codes)
        yield from self._divide(before, middle, blocks, speeds, times_s)
        yield middle
        yield from self._divide(middle, after, blocks, speeds, times_s)

    def _luma(self, time_s: float, wanted: Mask, codes: Codes) -> Float32Array:
        """Levels [k] of the wanted pixels at an instant."""
        world, size, samples = self._drawn(time_s).world, self.size, self.samples
        rows = (0, size.height)
        light = light_of_rows(world, rows, size, samples=samples, wanted=wanted, codes=codes)
        return self.luma_of(light[wanted])

    def _drawn(self, time_s: float) -> Drawn:
        size, samples = self.size, self.samples
        return world_and_shapes(self.scene, time_s, size, shadows=self.shadows, samples=samples)

    def _changing(self, times_s: Sequence[float]) -> Mask:
        """[rows, columns] of blocks that may differ between the frames and the middle of them."""
        height, width = self.size.shape
        drawn = [self._drawn(times_s[number]) for number in (0, (len(times_s) - 1) // 2, -1)]
        changed: Mask = np.zeros((-(-height // TILE), -(-width // TILE)), np.bool_)
        for one, other in pairwise(drawn):
            tiles = changed_tiles(one, other)
            changed |= True if tiles is None else tiles
        blocks = changed.repeat(TILE // BLOCK, axis=0).repeat(TILE // BLOCK, axis=1)
        return blocks[: -(-height // BLOCK), : -(-width // BLOCK)]


def _pixels(blocks: Mask, size: SensorSize) -> Mask:
    """[H, W] the pixels of blocks."""
    wide = blocks.repeat(BLOCK, axis=0).repeat(BLOCK, axis=1)
    return np.ascontiguousarray(wide[: size.height, : size.width])


def _any_in_block(pixels: Mask) -> Mask:
    """[rows, columns] of blocks with a true pixel."""
    rows, columns = (np.arange(0, length, BLOCK) for length in pixels.shape)
    upright = np.logical_or.reduceat(pixels, rows, axis=0)
    return np.asarray(np.logical_or.reduceat(upright, columns, axis=1))


def block_speeds(size: SensorSize, *fields: Float32Array | None) -> Float32Array:
    """How far what passes each block moves between two frames, px; inf where that is not known.

    Args:
        size: of the frames, pixels.
        fields: [H, W, 2] vectors from one frame to the other, px; NaN where unknown.
    """
    height, width = size.shape
    speeds = np.zeros((-(-height // BLOCK), -(-width // BLOCK)), np.float32)
    unknown = np.full((height, width, 2), np.nan, np.float32)
    for vectors in fields:
        spread_speeds(unknown if vectors is None else vectors, speeds)
    return widen_ways(speeds)


@jit(error_model="numpy")
def spread_speeds(vectors: Float32Array, speeds: Float32Array) -> None:
    """Raise the speed of each block to that of every pixel whose way leads through it.

    Args:
        vectors: [H, W, 2] px; NaN where unknown.
        speeds: [rows, columns] of blocks, px, are raised.
    """
    height, width = vectors.shape[:2]
    for y in range(height):
        for x in range(width):
            dx, dy = vectors[y, x, 0], vectors[y, x, 1]
            length = math.hypot(dx, dy)
            if not math.isfinite(length):
                speeds[y // BLOCK, x // BLOCK] = math.inf
                continue
            steps = 1 + int(length / BLOCK)
            for step in range(steps + 1):
                column, row = math.floor(x + dx * step / steps), math.floor(y + dy * step / steps)
                if 0 <= column < width and 0 <= row < height:
                    block = row // BLOCK, column // BLOCK
                    speeds[block] = max(speeds[block], length)


@jit(error_model="numpy")
def widen_ways(speeds: Float32Array) -> Float32Array:
    """The speeds of blocks, each raised to those from which it is half a way off.

    What turns leaves the straight line between its places by as much.
    """
    rows, columns = speeds.shape
    result = speeds.copy()
    for row in range(rows):
        for column in range(columns):
            speed = speeds[row, column]
            reach = int(0.5 * speed / BLOCK) if speed < math.inf else 0
            for y in range(max(row - reach, 0), min(row + reach + 1, rows)):
                for x in range(max(column - reach, 0), min(column + reach + 1, columns)):
                    result[y, x] = max(result[y, x], speed)
    return result


@jit(error_model="numpy")
def foretell_codes(
    before: Codes, after: Codes, wanted: Mask, moved: Float32Array, codes: Codes
) -> None:
    """What fills whole pixels between two instants.

    An edge that moves by `moved` at most, and is nowhere near a pixel at both ends of its way, does
    not touch the pixel in between.

    Args:
        before: [H, W] codes at the instant before.
        after: [H, W] codes at the instant after.
        wanted: [H, W] pixels.
        moved: [rows, columns] of blocks, px.
        codes: [H, W] is written where it is certain.
    """
    height, width = codes.shape
    for y in range(height):
        for x in range(width):
            code = before[y, x]
            way = moved[y // BLOCK, x // BLOCK]
            if not wanted[y, x] or code == UNKNOWN or not way <= SURE_PX:
                continue
            reach = 1 + int(0.5 * way)
            is_sure = True
            for row in range(max(y - reach, 0), min(y + reach + 1, height)):
                for column in range(max(x - reach, 0), min(x + reach + 1, width)):
                    is_sure &= before[row, column] == code
                    is_sure &= after[row, column] == code
                if not is_sure:
                    break
            if is_sure:
                codes[y, x] = code
