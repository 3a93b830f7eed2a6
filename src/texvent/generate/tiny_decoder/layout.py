"""The published layouts of tiny video decoders (TAEHV), and which of them a file has.

A decoder takes one latent frame after another through three stages. A stage has three blocks that
see a frame and the one before it, doubles the image's sides, and makes one or two frames of one.

Source: O. Boer Bohan, TAEHV (github.com/madebyollin/taehv, MIT): taehv.py of August 2026.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from texvent.networks.layer_shapes import Shape, Shapes, convolution

STAGES = 3
BLOCKS = 3
"""Memory blocks of a stage."""
COLOURS = 3
OUTPUT = "decoder.22"
"""The last convolution, in both layouts."""
FIRST = {False: "decoder.1", True: "decoder.0"}
"""The first convolution, by `is_super`."""


@dataclass(frozen=True)
class TinyLayout:
    """One shape of the network."""

    latent_channels: int
    widths: tuple[int, ...]
    """Channels inside the three stages, and behind them."""
    growths: tuple[int, ...]
    """Frames that each stage makes of one, 1 or 2."""
    patch: int
    """Pixels of the image, along each side, per pixel of the last stage."""
    is_super: bool
    """True for the larger networks whose files are called `..._super`."""

    @property
    def frames_per_latent(self) -> int:
        """Decoded frames per latent frame; the first latent frame of a video gives one."""
        return math.prod(self.growths)

    @property
    def pixels_per_latent(self) -> int:
        """Decoded pixels per latent pixel, along each side."""
        return int(2**STAGES * self.patch)

    def block(self, stage: int, number: int) -> str:
        """Name of a memory block."""
        return f"decoder.{self._start(stage) + number}"

    def growth(self, stage: int) -> str:
        """Name of the layer that makes frames, one or two of one."""
        return f"decoder.{self._start(stage) + BLOCKS + (3 if self.is_super else 1)}.conv"

    def widening(self, stage: int) -> str:
        """Name of the convolution between two stages."""
        return f"decoder.{self._start(stage) + BLOCKS + (0 if self.is_super else 2)}"

    def tensor_shapes(self) -> Shapes:
        """Name → shape of every tensor of the decoder, as published."""
        first = FIRST[self.is_super]
        side = 1 if self.is_super else 3
        shapes = convolution(first, self.widths[0], self.latent_channels, side)
        if self.is_super:
            del shapes[f"{first}.bias"]
        for stage in range(STAGES):
            shapes |= self._stage_shapes(stage)
        return shapes | convolution(OUTPUT, COLOURS * self.patch**2, self.widths[-1], 3)

    def _stage_shapes(self, stage: int) -> Shapes:
        width, following = self.widths[stage : stage + 2]
        shapes: Shapes = {}
        for number in range(BLOCKS):
            name = f"{self.block(stage, number)}.conv"
            if self.is_super:
                shapes[f"{name}.0.weight"] = (2 * width, 1, 7, 7)
                shapes |= convolution(f"{name}.1", 4 * width, 2 * width, 1)
                shapes[f"{name}.3.weight"] = (width, 4 * width, 1, 1)
            else:
                shapes |= convolution(f"{name}.0", width, 2 * width, 3)
                shapes |= convolution(f"{name}.2", width, width, 3)
                shapes |= convolution(f"{name}.4", width, width, 3)
        grown = following if self.is_super else width
        shapes[f"{self.growth(stage)}.weight"] = (self.growths[stage] * grown, grown, 1, 1)
        if self.is_super:
            return shapes | convolution(self.widening(stage), 4 * following, width, 3)
        shapes[f"{self.widening(stage)}.weight"] = (following, width, 3, 3)
        return shapes

    def _start(self, stage: int) -> int:
        """Index of a stage's first block."""
        return 1 + 7 * stage if self.is_super else 3 + 6 * stage


def read_layout(shapes: Mapping[str, Shape]) -> TinyLayout | None:
    """The layout that the sizes of a few tensors say, or None where they are missing.

    Args:
        shapes: name → shape of the decoder's tensors. The others are for the caller to compare
            with `TinyLayout.tensor_shapes`.
    """
    is_super = f"{FIRST[True]}.weight" in shapes
    draft = TinyLayout(1, (1,) * (STAGES + 1), (1,) * STAGES, 1, is_super)
    try:
        width, channels = shapes[f"{FIRST[is_super]}.weight"][:2]
        grown = [shapes[f"{draft.growth(stage)}.weight"][:2] for stage in range(STAGES)]
        colours, last = shapes[f"{OUTPUT}.weight"][:2]
    except (KeyError, ValueError):
        return None
    inside = [taken for _, taken in grown]
    widths = (width, *inside) if is_super else (*inside, last)
    growths = tuple(made // max(taken, 1) for made, taken in grown)
    return TinyLayout(channels, widths, growths, math.isqrt(colours // COLOURS), is_super)
