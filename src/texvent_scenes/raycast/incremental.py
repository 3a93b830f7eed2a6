"""Incremental rendering of a scene: only the pixels that can have changed are drawn.

From one frame to the next, these are the tiles that can differ (`changed_tiles`): the frame is
equal to the last bit to one that is drawn whole.

Between two frames, the middle of the interval is drawn first. A block of pixels whose levels there
linear interpolation predicts, and that nothing fast passes, changes evenly: it needs no more
instants in that interval. Both halves of the others are divided again. A pixel that one surface
fills before and after an instant, with some pixels around, shows that surface at the instant too:
only its light is computed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import luma_bt601
from texvent.runtime.jit import jit
from texvent.sensor import SensorSize
from texvent.transfer import encode_srgb
from texvent_scenes.raycast.acceleration import TILE
from texvent_scenes.raycast.adaptive_sampling import UNKNOWN, Codes
from texvent_scenes.raycast.changed_tiles import Mask, changed_tiles
from texvent_scenes.raycast.optics import PERFECT, Optics, widened
from texvent_scenes.raycast.render import Drawn, light_of_rows, world_and_shapes
from texvent_scenes.raycast.swept import is_small, swept_speeds
from texvent_scenes.rendered_scene import Float32Array, RenderedScene

MOST_CHANGED = 0.9
"""Above this share of tiles all are drawn."""
BLOCK = 4
"""Side of the blocks of pixels that share their instants; divides `TILE`."""
EVEN, EVEN_S = 0.03, 0.7e-4
"""Error of a predicted level, as a share of it, up to which the level changes evenly; in long
intervals, where the same error shifts events further, `EVEN_S` over the interval."""
DARK = 30.0
"""Added to levels before they are compared, 0..255 scale."""
FASTEST_PX = 4.0
"""Blocks that something passes by more than this in an interval are drawn in its middle."""
OFTEN = 8.0
"""Intervals, in instants, whose middles and those of longer ones make a quarter of all instants."""
EVEN_BEATS = 8.0
"""Intervals above a period of beating light over this are drawn whole in their middle: the ends and
the middle may all show the same moment of it."""
SURE_PX = 6.0
"""Displacement in an interval up to which its ends predict the surface of a pixel."""


@dataclass(frozen=True, eq=False)
class DrawnInstant:
    """Levels and surfaces at one instant."""

    number: int
    """0 is the frame before, then the instants between, then the frame after."""
    luma: Float32Array
    """[H, W] levels."""
    light: Float32Array
    """[H, W, 3] light that they come from, without a lens."""
    codes: Codes | None
    """[H, W] surfaces that fill whole pixels, as for `render_rows`, where they were drawn."""


class RenderedFrame(NamedTuple):
    """A frame, and what it is made of."""

    pixels: Float32Array
    """[H, W, 3] coded."""
    codes: Codes
    """[H, W] surfaces that fill whole pixels, as for `render_rows`."""
    light: Float32Array
    """[H, W, 3] linear, without a lens."""


class _Span(NamedTuple):
    """The instants from one frame to the next."""

    times_s: Sequence[float]
    speeds: Float32Array
    """[n - 1, rows, columns] of blocks: displacements from instant to instant, px."""
    kept: Mapping[float, Drawn]
    """Instants that are described already."""


class IncrementalRenderer:
    """Renderer of a scene that remembers the last frame, and draws between frames.

    Several threads may use it: what it remembers is read once in a call, and replaced whole.

    Args:
        scene: what is drawn.
        size: of the frames, pixels.
        samples: as for `render`.
        shadows: as for `render`.
        code: makes levels of light (1 is white).
        optics: the camera's lens.
        beat_s: shortest period in which any light goes up and down, s.
    """

    def __init__(
        self, scene: RenderedScene, size: SensorSize, *, samples: int, shadows: bool,
        code: Callable[[NDArray[Any]], Float32Array] = encode_srgb, optics: Optics = PERFECT,
        beat_s: float = math.inf,
    ) -> None:  # fmt: skip
        self._size, self._code, self._optics = size, code, optics
        self._even_s = beat_s / EVEN_BEATS
        self._draw = partial(world_and_shapes, scene, size=size, shadows=shadows, samples=samples)
        self._cast = partial(light_of_rows, rows=(0, size.height), size=size, samples=samples)
        self._last: tuple[Drawn, RenderedFrame] | None = None
        self._kept: Mapping[float, Drawn] = {}

    def render(self, time_s: float) -> RenderedFrame:
        """The frame at an instant: that of `render.render`, to the last bit."""
        size, drawn, last = self._size, self._drawn(time_s), self._last
        tiles = None if last is None else changed_tiles(last[0], drawn)
        wanted: Mask = np.ones(size.shape, dtype=np.bool_)
        codes, light = np.full(size.shape, UNKNOWN), np.empty((*size.shape, 3), np.float32)
        pixels = np.empty_like(light)
        if last is not None and tiles is not None and tiles.mean() <= MOST_CHANGED:
            wanted = _refined(tiles, TILE, size.shape)
            codes, pixels = np.where(wanted, UNKNOWN, last[1].codes), last[1].pixels.copy()
            light = last[1].light.copy()
        self._cast(drawn.world, wanted=wanted, codes=codes, light=light)
        touched = self._optics.touched(wanted)
        pixels[touched] = self._code(self._optics.passed(light, drawn.world, touched))
        kept = pixels.copy()
        kept.flags.writeable = light.flags.writeable = False
        self._last = drawn, RenderedFrame(kept, codes, light)
        return RenderedFrame(pixels, codes, light)

    def render_between(
        self, first: DrawnInstant, last: DrawnInstant, speeds: Float32Array,
        times_s: Sequence[float],
    ) -> Iterator[Float32Array]:  # fmt: skip
        """Luma [H, W] at the inner times, in their order.

        Args:
            first: the frame before.
            last: the frame after.
            speeds: of `block_speeds`.
            times_s: of the frame before, of the instants, of the frame after.
        """
        ends = times_s[0], times_s[(len(times_s) - 1) // 2], times_s[-1]
        kept = {time_s: self._drawn(time_s) for time_s in ends}
        blocks: Mask = np.zeros(speeds.shape, np.bool_)
        for one, other in pairwise(kept.values()):
            tiles = changed_tiles(one, other)
            blocks |= True if tiles is None else _refined(tiles, TILE // BLOCK, speeds.shape)
        speeds = speeds / np.float32(len(times_s) - 1)
        passing = self._find_swept(speeds, times_s, kept)
        self._kept = {time_s: kept[time_s] for time_s in ends}
        span = _Span(times_s, passing, kept)
        return (one.luma for one in self._divide(first, last, blocks, span))

    def _find_swept(
        self, speeds: Float32Array, times_s: Sequence[float], kept: dict[float, Drawn]
    ) -> Float32Array:
        """[n - 1, rows, columns] displacements of the fastest that passes between two instants.

        All instants are described, in `kept`, where something is so fast that many are drawn. Else
        the bounds are those of the frames.
        """
        count = len(times_s)
        usual = np.broadcast_to(speeds, (count - 1, *speeds.shape))
        is_fast = count > 2 and bool((OFTEN * speeds > FASTEST_PX).any())
        if not (is_fast and is_small(kept[times_s[0]], count)):
            return usual
        kept |= {time_s: self._drawn(time_s) for time_s in times_s if time_s not in kept}
        instants, (rows, columns) = [kept[time_s] for time_s in times_s], speeds.shape
        margin_px = 1.0 + 2.0 * self._optics.point_spread_px
        swept = swept_speeds(instants, (rows, columns), BLOCK, margin_px)
        return usual if swept is None else np.minimum(swept, usual)

    def _divide(
        self, before: DrawnInstant, after: DrawnInstant, blocks: Mask, span: _Span
    ) -> Iterator[DrawnInstant]:
        """The instants between two others; only `blocks` do not change evenly there."""
        steps = after.number - before.number
        if steps < 2:
            return
        number = (before.number + after.number) // 2
        times_s = span.times_s
        start, stop = times_s[before.number], times_s[after.number]
        beats = stop - start > self._even_s
        blocks = np.ones_like(blocks) if beats else blocks
        share = np.float32((times_s[number] - start) / (stop - start))
        luma, light = (_mixed(before, after, share, name) for name in ("luma", "light"))
        codes = np.full(self._size.shape, UNKNOWN)
        if blocks.any():
            fastest = span.speeds[before.number : after.number].max(axis=0)
            moved = fastest * np.float32(steps)
            wanted = _refined(blocks, BLOCK, self._size.shape)
            if before.codes is not None and after.codes is not None and not beats:
                predict_surface_ids(before.codes, after.codes, wanted, moved, codes)
            touched = self._optics.touched(wanted)
            drawn = span.kept.get(times_s[number]) or self._draw(time_s=times_s[number])
            exact = self._luma(drawn, (wanted, touched), codes, light)
            uneven = np.zeros(self._size.shape, np.bool_)
            replace_levels(luma, exact, touched, min(EVEN, EVEN_S / (stop - start)), uneven)
            uneven = widened(uneven, round(self._optics.point_spread_px))
            if not beats:
                blocks = blocks & (_any_in_block(uneven) | (moved > FASTEST_PX))
        middle = DrawnInstant(number, luma, light, codes)
        yield from self._divide(before, middle, blocks, span)
        yield middle
        yield from self._divide(middle, after, blocks, span)

    def _drawn(self, time_s: float) -> Drawn:
        return self._kept.get(time_s) or self._draw(time_s=time_s)

    def _luma(
        self, drawn: Drawn, pixels: tuple[Mask, Mask], codes: Codes, light: Float32Array
    ) -> Float32Array:
        """Luma [k] at an instant, of the second of two sets of pixels; the first is drawn.

        `codes` are known ones, and those found; `light` is written where it is drawn.
        """
        wanted, touched = pixels
        self._cast(drawn.world, wanted=wanted, codes=codes, light=light)
        levels = self._code(self._optics.passed(light, drawn.world, touched))
        return np.asarray(luma_bt601(levels[None])[0], dtype=np.float32)


def _mixed(before: DrawnInstant, after: DrawnInstant, share: np.float32, name: str) -> Float32Array:
    first, last = getattr(before, name), getattr(after, name)
    result = np.subtract(last, first)
    result *= share
    result += first
    return np.asarray(result)


def _refined(cells: Mask, side: int, shape: tuple[int, ...]) -> Mask:
    """[rows, columns] of `shape`: cells that are `side` times finer."""
    finer = cells.repeat(side, axis=0).repeat(side, axis=1)
    return np.ascontiguousarray(finer[: shape[0], : shape[1]])


def _any_in_block(pixels: Mask) -> Mask:
    """[rows, columns] of blocks with a true pixel."""
    rows, columns = (np.arange(0, length, BLOCK) for length in pixels.shape)
    upright = np.logical_or.reduceat(pixels, rows, axis=0)
    return np.asarray(np.logical_or.reduceat(upright, columns, axis=1))


def block_speeds(size: SensorSize, *fields: Float32Array | None) -> Float32Array:
    """Displacements between two frames of the fastest that passes each block, px; inf: unknown.

    Args:
        size: of the frames, pixels.
        fields: [H, W, 2] vectors from one frame to the other, px; NaN where unknown.
    """
    height, width = size.shape
    speeds = np.zeros((-(-height // BLOCK), -(-width // BLOCK)), np.float32)
    unknown = np.full((height, width, 2), np.nan, np.float32)
    for vectors in fields:
        spread_speeds(unknown if vectors is None else vectors, speeds)
    return widen_speeds(speeds)


@jit(error_model="numpy")
def replace_levels(
    predicted: Float32Array, exact: Float32Array, pixels: Mask, limit: float, uneven: Mask
) -> None:
    """Replace predicted levels by exact ones, and mark those that differ.

    Args:
        predicted: [H, W] levels, are written.
        exact: [k] levels of `pixels`, row by row.
        pixels: [H, W].
        limit: share of a level, from black at -`DARK`, up to which they count as equal.
        uneven: [H, W] is written.
    """
    share, dark = np.float32(limit), np.float32(DARK)
    number = 0
    for y in range(pixels.shape[0]):
        for x in range(pixels.shape[1]):
            if pixels[y, x]:
                level = exact[number]
                uneven[y, x] = abs(level - predicted[y, x]) > share * (level + dark)
                predicted[y, x] = level
                number += 1


@jit(error_model="numpy")
def spread_speeds(vectors: Float32Array, speeds: Float32Array) -> None:
    """Raise the speed of each block to that of every pixel whose displacement crosses it.

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
def widen_speeds(speeds: Float32Array) -> Float32Array:
    """Speeds of blocks, each raised to those of blocks at most half their displacement away.

    A turning body leaves the straight line between its places by as much.
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
def predict_surface_ids(
    before: Codes, after: Codes, wanted: Mask, moved: Float32Array, codes: Codes
) -> None:
    """Surfaces that fill whole pixels between two instants.

    An edge that moves by `moved` at most, and is nowhere near a pixel at both ends of the interval,
    does not touch the pixel in between.

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
            displacement = moved[y // BLOCK, x // BLOCK]
            if not wanted[y, x] or code == UNKNOWN or not displacement <= SURE_PX:
                continue
            reach = 1 + int(0.5 * displacement)
            is_sure = True
            for row in range(max(y - reach, 0), min(y + reach + 1, height)):
                for column in range(max(x - reach, 0), min(x + reach + 1, width)):
                    is_sure &= before[row, column] == code
                    is_sure &= after[row, column] == code
                if not is_sure:
                    break
            if is_sure:
                codes[y, x] = code
