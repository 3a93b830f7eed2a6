"""Images on surfaces: mip pyramids in linear light, and exactly filtered checkerboards."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent import transfer

Float32Array = NDArray[np.float32]

MOST_LEVELS = 14
"""Levels of a pyramid at most: images up to 8,192 pixels on a side reach a single pixel."""


@dataclass(frozen=True, eq=False)
class SurfaceImage:
    """An image that a surface shows; u runs right and v down over 0..1."""

    levels: tuple[Float32Array, ...] = ()
    """[h, w, 3] linear RGB, each half as large as the one before, down to one pixel; empty for a
    checkerboard."""
    checks: tuple[int, int] | None = None
    """Columns and rows of a checkerboard's squares, with a white margin one square wide around;
    the square at its top left is black. None: the levels are shown."""
    repeats: bool = False
    """Whether it repeats beyond 0..1, as textures of meshes do."""

    @property
    def aspect(self) -> float:
        """Width divided by height."""
        if self.checks is not None:
            return (self.checks[0] + 2) / (self.checks[1] + 2)
        height, width = self.levels[0].shape[:2]
        return float(width / height)


def surface_image(linear: NDArray[np.floating], *, repeats: bool = False) -> SurfaceImage:
    """An image with its pyramid, every level the mean over areas of the one before.

    Args:
        linear: [h, w, 3] linear RGB, 1 = white.
        repeats: as in `SurfaceImage`.
    """
    levels = [np.ascontiguousarray(linear, dtype=np.float32)]
    while max(levels[-1].shape[:2]) > 1 and len(levels) < MOST_LEVELS:
        height, width = levels[-1].shape[:2]
        half = (max(width // 2, 1), max(height // 2, 1))
        smaller = cv2.resize(levels[-1], half, interpolation=cv2.INTER_AREA)
        levels.append(np.asarray(smaller, dtype=np.float32).reshape(half[1], half[0], 3))
    return SurfaceImage(tuple(levels), repeats=repeats)


def decode_srgb(coded: NDArray[np.uint8]) -> Float32Array:
    """Linear light 0..1 of [..., 3] 8-bit values coded with the sRGB curve (IEC 61966-2-1)."""
    return _LINEAR[coded]


_LINEAR = transfer.decode_srgb(np.arange(256) / 255.0)
