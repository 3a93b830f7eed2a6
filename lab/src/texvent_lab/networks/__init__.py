"""Layers of published networks, and padding of images; this module needs no torch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from texvent.extending import require
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

    def around(self, image: Tensor, value: float = 0.0) -> Tensor:
        """The image, [..., H, W], with that value around it."""
        margins = (self.left, self.right, self.top, self.bottom)
        return require("torch", extra=EXTRA).nn.functional.pad(image, margins, value=value)

    def off(self, image: Tensor) -> Tensor:
        """The image, [..., H, W], without what `around` added."""
        height, width = image.shape[-2:]
        return image[..., self.top : height - self.bottom, self.left : width - self.right]
