"""The published shape of Super SloMo's two U-Nets.

Source: Jiang et al., Super SloMo (CVPR 2018), section 3.3 and Figure 4; tensor names as in the
checkpoint of the open PyTorch implementation that is commonly used.
"""

from __future__ import annotations

from dataclasses import dataclass

from texvent.networks.layer_shapes import Shapes, convolution

DEPTH = 5
"""How often a U-Net halves the image."""
PAD_TO = 2**DEPTH
"""Sides are padded to a multiple of this, px."""
PUBLISHED_WIDTH = 32
"""Channels of the first layers of the published networks."""
GROWTH = (1, 2, 4, 8, 16, 16)
"""Channels at each depth, as multiples of the width."""
FIRST_SIDES = (7, 5, 3, 3, 3, 3)
"""Sides of the convolutions at each depth on the way down."""


@dataclass(frozen=True)
class UNetLayout:
    """One U-Net."""

    key: str
    """Its name in the checkpoint."""
    inputs: int
    outputs: int

    def tensor_shapes(self, width: int = PUBLISHED_WIDTH) -> Shapes:
        """Name → shape of every tensor.

        Args:
            width: channels of the first layers.
        """
        channels = [width * factor for factor in GROWTH]
        side = FIRST_SIDES[0]
        shapes = {
            **convolution("conv1", channels[0], self.inputs, side),
            **convolution("conv2", channels[0], channels[0], side),
        }
        for depth in range(1, DEPTH + 1):
            side, wide = FIRST_SIDES[depth], channels[depth]
            shapes |= convolution(f"down{depth}.conv1", wide, channels[depth - 1], side)
            shapes |= convolution(f"down{depth}.conv2", wide, wide, side)
        for step in range(1, DEPTH + 1):
            wide = channels[DEPTH - step]
            shapes |= convolution(f"up{step}.conv1", wide, channels[DEPTH - step + 1], 3)
            shapes |= convolution(f"up{step}.conv2", wide, 2 * wide, 3)
        return {**shapes, **convolution("conv3", self.outputs, channels[0], 3)}


FLOW_NET = UNetLayout("state_dictFC", inputs=6, outputs=4)
"""Two images → the flow from each to the other."""
REFINE_NET = UNetLayout("state_dictAT", inputs=20, outputs=5)
"""Images, flows, flows at the instant, warped images → corrections of the flows, visibility."""
