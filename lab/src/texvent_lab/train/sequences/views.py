"""Crops and mirror images of maps by window: voxel grids, frames, flow and depth alike."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Maps = Mapping[str, NDArray[Any]]
"""Name → [..., H, W]; "flow" is [..., 2, H, W], displacement (x, y) in px."""
FLOW = "flow"


def crop_randomly(maps: Maps, side: int | None, chance: np.random.Generator) -> dict[str, Any]:
    """The same random square of every map.

    Args:
        maps: all of one height and width.
        side: of the square, px, at most the shorter side; None: everything.
        chance: of this sample in this epoch.
    """
    if side is None:
        return dict(maps)
    height, width = next(iter(maps.values())).shape[-2:]
    top, left = (int(chance.integers(length - side + 1)) for length in (height, width))
    return {name: one[..., top : top + side, left : left + side] for name, one in maps.items()}


def flip(maps: Maps, *, x: bool, y: bool) -> dict[str, Any]:
    """Every map mirrored along the axes that are chosen; displacements turn round with them."""
    steps = slice(None, None, -1 if y else 1), slice(None, None, -1 if x else 1)
    flipped = {name: one[..., *steps] for name, one in maps.items()}
    if FLOW in flipped:
        signs = np.array([-1 if x else 1, -1 if y else 1], np.float32)
        flipped[FLOW] = flipped[FLOW] * signs[:, None, None]
    return flipped


def flip_randomly(maps: Maps, chance: np.random.Generator) -> dict[str, Any]:
    """Mirrored along each axis with probability 1/2."""
    x, y = chance.random(2) < 0.5
    return flip(maps, x=bool(x), y=bool(y))
