"""Layers of published networks, and padding of images; this module needs no torch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from texvent.networks.weight_files import Tensor

EXTRA = "torch"
"""The texvent extra that brings torch."""


@dataclass(frozen=True)
class Padding:
    """Rows and columns around an image."""

    left: int
    right: int
    top: int
    bottom: int

    @classmethod
    def centred(cls, shape: Sequence[int], multiple: int) -> Padding:
        """All around, one more above and left if odd, as the program of E2VID does.

        Args:
            shape: (height, width) of the image, px.
            multiple: both sides become multiples of this, px.
        """
        below, right = (-side % multiple for side in shape)
        return cls(right - right // 2, right // 2, below - below // 2, below // 2)

    def around(self, grid: NDArray[Any], how: Literal["constant", "reflect"]) -> NDArray[Any]:
        """The grid, [channels, H, W], with zeros or its mirror image around it."""
        margins = ((0, 0), (self.top, self.bottom), (self.left, self.right))
        return np.pad(grid, margins, mode=how)

    def off(self, image: Tensor) -> Tensor:
        """The image, [..., H, W], without what `around` added."""
        height, width = image.shape[-2:]
        return image[..., self.top : height - self.bottom, self.left : width - self.right]
