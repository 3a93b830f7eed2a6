"""Banding: gradients that 8 bits draw as stairs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.instants import matching_levels
from texvent.video import UINT16_PER_LEVEL, Frame
from texvent.video_check.blocks import SeenFrame

TILE = 16
MOST_TILES = 1000
"""Of larger images only every second, third ... row of tiles is read."""
RANGE_LEVELS = 2.0, 24.0
"""Levels from a tile's darkest to its brightest pixel, if it is part of a gradient."""
HIGHEST_DETOUR = 1.25
"""Sum of the steps along rows and columns over their net change: 1 where all rise or fall steadily.
Noise, grain and dither are above 2."""
STEP_LEVELS = 0.9, 2.1
"""A stair: one code value of 8 bits. Limited range spreads 219 codes over 255 levels, so some have
two levels."""
LEAST_EQUAL = 0.5
"""Share of neighbours that are equal, where there are stairs."""
GREEN = 1


class Banding:
    """Counts tiles that are smooth gradients, and those of them that are stairs."""

    def __init__(self) -> None:
        self._tiles = self._smooth = self._banded = 0

    def add(self, seen: SeenFrame) -> None:
        """Take one frame."""
        if not seen.is_sampled or min(seen.luma.shape) < TILE:
            return
        smooth, banded = classify_tiles(code_values(seen.frame))
        self._tiles += smooth.size
        self._smooth += int(smooth.sum())
        self._banded += int(banded.sum())

    def measures(self) -> dict[str, float]:
        """`smooth_share`, `banded_share`: of the image's area, 0..1; see `classify_tiles`."""
        tiles = max(self._tiles, 1)
        return {"smooth_share": self._smooth / tiles, "banded_share": self._banded / tiles}


def code_values(frame: Frame) -> NDArray[np.float32]:
    """One channel as it is stored, on the 0..255 scale: grey, or green, the most of luma.

    Luma itself mixes three channels, whose stairs lie in different places. Linear light is coded.
    """
    pixels = frame.pixels
    plane = pixels[..., GREEN] if pixels.ndim == 3 else pixels
    scale = UINT16_PER_LEVEL if pixels.dtype == np.uint16 else 1.0
    levels = np.asarray(plane, dtype=np.float32) / np.float32(scale)
    return np.asarray(matching_levels(levels, frame.transfer), dtype=np.float32)


def classify_tiles(plane: NDArray[np.float32]) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which tiles of 16×16 px are smooth gradients, and which of those are stairs.

    Smooth: it spans 2..24 levels, no step between neighbours exceeds 2.1 levels, and the steps
    along rows and columns add up to at most 1.25 times their net change. Banded: smooth, at least
    half of the neighbours are equal, and every other step is one code value of 8 bits (0.9..2.1
    levels).

    Args:
        plane: [H, W], 0..255 scale; at least one tile.

    Returns:
        Two arrays [rows of tiles read, W // 16].
    """
    rows, columns = plane.shape[0] // TILE, plane.shape[1] // TILE
    tiles = plane[: rows * TILE, : columns * TILE].reshape(rows, TILE, columns, TILE)
    tiles = tiles[:: -(-rows * columns // MOST_TILES)]
    span = tiles.max(axis=(1, 3)) - tiles.min(axis=(1, 3))
    across = np.abs(np.diff(tiles, axis=3))
    down = np.abs(np.diff(tiles, axis=1))
    highest = np.maximum(across.max(axis=(1, 3)), down.max(axis=(1, 3)))
    path = across.sum(axis=(1, 3)) + down.sum(axis=(1, 3))
    net = np.abs(tiles[..., -1] - tiles[..., 0]).sum(axis=1)
    net = net + np.abs(tiles[:, -1] - tiles[:, 0]).sum(axis=2)
    smooth = (span >= RANGE_LEVELS[0]) & (span <= RANGE_LEVELS[1]) & (highest <= STEP_LEVELS[1])
    smooth &= path <= HIGHEST_DETOUR * net
    equal = ((across == 0).mean(axis=(1, 3)) + (down == 0).mean(axis=(1, 3))) / 2
    fine = ((across > 0) & (across < STEP_LEVELS[0])).any(axis=(1, 3))
    fine |= ((down > 0) & (down < STEP_LEVELS[0])).any(axis=(1, 3))
    return smooth, smooth & (equal >= LEAST_EQUAL) & ~fine
