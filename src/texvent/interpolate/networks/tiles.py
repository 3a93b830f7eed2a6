"""Overlapping tiles of an image, and weights that join their results without seams."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError

OVERLAP_PX = 64
"""Least overlap of neighbouring tiles."""


@dataclass(frozen=True)
class Tile:
    """A part of an image."""

    top: int
    left: int
    height: int
    width: int

    @property
    def rows(self) -> slice:
        """Its rows in the image."""
        return slice(self.top, self.top + self.height)

    @property
    def columns(self) -> slice:
        """Its columns in the image."""
        return slice(self.left, self.left + self.width)


def cut_tiles(height: int, width: int, side: int) -> list[Tile]:
    """Tiles of at most `side` × `side` px that cover an image, row by row.

    Neighbours overlap by at least `OVERLAP_PX`. An image that fits is one tile.

    Args:
        height: of the image, px.
        width: of the image, px.
        side: px; 0 for one tile whatever the size.

    Raises:
        ConfigError: the side leaves nothing between two overlaps.

    Example:
        >>> [(tile.left, tile.width) for tile in cut_tiles(100, 500, 256)]
        [(0, 256), (122, 256), (244, 256)]
    """
    if side and side <= 2 * OVERLAP_PX:
        raise ConfigError(
            f"tiles of {side} px are too small; they share {OVERLAP_PX} px on every side, so they "
            f"must be above {2 * OVERLAP_PX} px (0: no tiles)"
        )
    rows, columns = _spread(height, side), _spread(width, side)
    return [
        Tile(top, left, tile_height, tile_width)
        for top, tile_height in rows
        for left, tile_width in columns
    ]


def _spread(length: int, side: int) -> list[tuple[int, int]]:
    """Start and length of the parts along one axis, evenly spread."""
    if side == 0 or length <= side:
        return [(0, length)]
    count = -(-(length - OVERLAP_PX) // (side - OVERLAP_PX))
    return [((length - side) * i // (count - 1), side) for i in range(count)]


def tile_weights(tile: Tile, height: int, width: int) -> NDArray[np.float32]:
    """How much each pixel of a tile counts: 1 inside, falling where a neighbour takes over.

    Args:
        tile: the tile.
        height: of the whole image, px.
        width: of the whole image, px.

    Returns:
        [tile height, tile width] float32, above 0.
    """
    down = _ramp(tile.top, tile.height, height)
    across = _ramp(tile.left, tile.width, width)
    return down[:, None] * across


def _ramp(start: int, length: int, whole: int) -> NDArray[np.float32]:
    weights = np.ones(length, dtype=np.float32)
    ramp = (np.arange(min(OVERLAP_PX, length), dtype=np.float32) + 1) / np.float32(OVERLAP_PX + 1)
    if start > 0:
        weights[: len(ramp)] *= ramp
    if start + length < whole:
        weights[length - len(ramp) :] *= ramp[::-1]
    return weights
