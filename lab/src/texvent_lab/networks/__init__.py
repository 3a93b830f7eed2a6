"""Layers of published networks, their files, padding of images; this module needs no torch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.networks import Tensor
from texvent.runtime.files.cache_folder import cache_folder

EXTRA = "torch"
"""The texvent extra that brings torch."""


def locate_weights(
    name: str, usual: str | Path, where_from: str, path: Path | None, *, option: str = "weights"
) -> Path:
    """The weights file of a network: `path`, which the user gave with `option`, else the usual one.

    `usual` is a name in the weights folder, or a path elsewhere.

    Raises:
        InputError: there is no such file; the message says where to get and where to put it.
    """
    place = cache_folder("weights") / usual
    chosen = path or place
    if chosen.is_file():
        return chosen
    what = f"there is no weights file {chosen}" if path else f"{name} needs its weights"
    raise InputError(
        f"{what}; texvent neither carries nor downloads them: {where_from}. Pass its path with "
        f"`{option}`, or put it at {place}"
    )


@dataclass(frozen=True)
class Padding:
    """Rows and columns around an image."""

    left: int
    right: int
    top: int
    bottom: int

    @classmethod
    def centred(cls, shape: Sequence[int], multiple: int, least: int = 1) -> Padding:
        """All around, one more above and left if odd, as the program of E2VID does.

        Args:
            shape: (height, width) of the image, px.
            multiple: both sides become multiples of this, px.
            least: both sides become at least this, px.
        """
        below, right = (-(-max(side, least) // multiple) * multiple - side for side in shape)
        return cls(right - right // 2, right // 2, below - below // 2, below // 2)

    def around(self, grid: NDArray[Any], how: Literal["constant", "reflect"]) -> NDArray[Any]:
        """The grid, [channels, H, W], with zeros or its mirror image around it."""
        margins = ((0, 0), (self.top, self.bottom), (self.left, self.right))
        return np.pad(grid, margins, mode=how)

    def off(self, image: Tensor) -> Tensor:
        """The image, [..., H, W], without what `around` added."""
        height, width = image.shape[-2:]
        return image[..., self.top : height - self.bottom, self.left : width - self.right]
