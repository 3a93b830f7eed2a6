"""Augmentation of training sequences: crops, mirrors, pauses, noise and hot pixels."""

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


def flip_randomly(maps: Maps, chance: np.random.Generator) -> dict[str, Any]:
    """Mirrored along each axis with probability 1/2; displacements turn round with the maps."""
    signs = np.where(chance.random(2) < 0.5, -1, 1)
    flipped = {name: one[..., :: signs[1], :: signs[0]] for name, one in maps.items()}
    if FLOW in flipped:
        flipped[FLOW] = flipped[FLOW] * signs.astype(np.float32)[:, None, None]
    return flipped


Voxels = NDArray[np.float32]
"""[windows, bins, H, W]."""


def draw_pauses(
    count: int, *, begin: float, stay: float, chance: np.random.Generator
) -> NDArray[np.bool_]:
    """Mask of the windows of a sequence that are pauses, [count]; the first is none.

    Args:
        count: windows.
        begin: probability of a pause after a window that is none.
        stay: probability of a pause after a pause.
        chance: of this sequence in this epoch.
    """
    is_pause = np.zeros(count, np.bool_)
    for number, drawn in enumerate(chance.random(count)):
        if number:
            is_pause[number] = drawn < (stay if is_pause[number - 1] else begin)
    return is_pause


def add_noise(voxels: Voxels, *, deviation: float, chance: np.random.Generator) -> Voxels:
    """Normal noise in every voxel but those of the first window."""
    noise = chance.standard_normal(voxels.shape, np.float32) * np.float32(deviation)
    noise[:1] = 0
    return np.asarray(voxels + noise)


def add_hot_pixels(
    voxels: Voxels, *, deviation: float, max_fraction: float, chance: np.random.Generator
) -> Voxels:
    """Some pixels, to which a normal number each is added in all bins of all windows.

    Args:
        voxels: of a sequence.
        deviation: of these numbers.
        max_fraction: the largest share of pixels; the share is uniform from 0 on.
        chance: of this sequence in this epoch.
    """
    height, width = voxels.shape[-2:]
    count = int(chance.uniform(0, max_fraction) * height * width)
    offset = np.zeros((height, width), np.float32)
    places = chance.integers(height, size=count), chance.integers(width, size=count)
    # A pixel that is drawn twice gets the sum.
    np.add.at(offset, places, chance.standard_normal(count, np.float32) * np.float32(deviation))
    return np.asarray(voxels + offset)
