"""The published shapes of RIFE's network (IFNet), and which of them a set of tensors has.

All are a chain of blocks, coarse to fine; each refines the flow from the wanted instant to both
frames and a mask that mixes them.

Source: Huang et al., Real-Time Intermediate Flow Estimation for Video Frame Interpolation (ECCV
2022), as released in Practical-RIFE 4.0, 4.6 and 4.25.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from texvent.networks.layer_shapes import Shape, Shapes, convolution

BODY_LAYERS = 8
"""Convolutions in the middle of a block."""
FLOW_CHANNELS = 4
"""x and y from the instant to the first frame, x and y to the second."""
ENCODER_CHANNELS = 16


@dataclass(frozen=True)
class RifeLayout:
    """One shape of the network."""

    name: str
    """The release that introduced it."""
    widths: tuple[int, ...]
    """Channels inside each block."""
    scales: tuple[int, ...]
    """By how much the images are reduced for each block."""
    head_channels: int
    """Channels that come out of a block's last layer, before the pixels are rearranged."""
    shuffles: bool
    """True if that layer is followed by a rearrangement of channels into 2×2 pixels."""
    learned_slopes: bool
    """True for PReLU and one bridge over the whole body; else leaky ReLU and a bridge per layer."""
    encoded_channels: int = 0
    """Channels of the encoder that all blocks see; 0 without one."""
    features: int = 0
    """Channels that each block passes to the next, beside flow and mask."""
    replaces_mask: bool = False
    """True if each block gives the mask anew; else it adds to the one before."""

    @property
    def pad_to(self) -> int:
        """Sides are padded to a multiple of this, px: what the coarsest block halves twice."""
        return 4 * max(self.scales)

    def input_channels(self, block: int) -> int:
        """Channels that go into a block."""
        seen = 2 * (3 + self.encoded_channels) + 1
        return seen if block == 0 else seen + 1 + self.features + FLOW_CHANNELS

    def tensor_shapes(self) -> Shapes:
        """Name → shape of every tensor of the network, as published."""
        shapes = self._encoder_shapes() if self.encoded_channels else {}
        for block in range(len(self.widths)):
            shapes |= self._block_shapes(block)
        return shapes

    def _block_shapes(self, block: int) -> Shapes:
        width, inputs = self.widths[block], self.input_channels(block)
        name, half = f"block{block}", self.widths[block] // 2
        shapes: Shapes = {}
        for layer, (channels_in, channels_out) in enumerate(((inputs, half), (half, width))):
            at = f"{name}.conv0.{layer}"
            shapes |= convolution(f"{at}.0", channels_out, channels_in, 3)
            if self.learned_slopes:
                shapes[f"{at}.1.weight"] = (channels_out,)
        for layer in range(BODY_LAYERS):
            at = f"{name}.convblock.{layer}"
            if self.learned_slopes:
                shapes |= convolution(f"{at}.0", width, width, 3)
                shapes[f"{at}.1.weight"] = (width,)
            else:
                shapes |= convolution(f"{at}.conv", width, width, 3)
                shapes[f"{at}.beta"] = (1, width, 1, 1)
        head = f"{name}.lastconv.0" if self.shuffles else f"{name}.lastconv"
        shapes[f"{head}.weight"] = (width, self.head_channels, 4, 4)
        shapes[f"{head}.bias"] = (self.head_channels,)
        return shapes

    def _encoder_shapes(self) -> Shapes:
        shapes = convolution("encode.cnn0", ENCODER_CHANNELS, 3, 3)
        for layer in (1, 2):
            shapes |= convolution(f"encode.cnn{layer}", ENCODER_CHANNELS, ENCODER_CHANNELS, 3)
        shapes["encode.cnn3.weight"] = (ENCODER_CHANNELS, self.encoded_channels, 4, 4)
        shapes["encode.cnn3.bias"] = (self.encoded_channels,)
        return shapes


RIFE_4_0 = RifeLayout(
    name="4.0",
    widths=(192, 128, 96, 64),
    scales=(8, 4, 2, 1),
    head_channels=5,
    shuffles=False,
    learned_slopes=True,
)
RIFE_4_6 = RifeLayout(
    name="4.6",
    widths=(192, 128, 96, 64),
    scales=(8, 4, 2, 1),
    head_channels=4 * 6,
    shuffles=True,
    learned_slopes=False,
)
RIFE_4_25 = RifeLayout(
    name="4.25",
    widths=(192, 128, 96, 64, 32),
    scales=(16, 8, 4, 2, 1),
    head_channels=4 * 13,
    shuffles=True,
    learned_slopes=False,
    encoded_channels=4,
    features=8,
    replaces_mask=True,
)
LAYOUTS = (RIFE_4_0, RIFE_4_6, RIFE_4_25)


def recognise_layout(shapes: Mapping[str, Shape]) -> RifeLayout | None:
    """The layout of a set of tensors, or None if it is none of `LAYOUTS`.

    Tensors outside the blocks and the encoder (a training teacher, a refinement network) are
    ignored.

    Args:
        shapes: name → shape, names without a `module.` in front.
    """
    inner = {name: shape for name, shape in shapes.items() if is_network_tensor(name)}
    return next((layout for layout in LAYOUTS if layout.tensor_shapes() == inner), None)


def is_network_tensor(name: str) -> bool:
    """True for a tensor of the encoder or of a numbered block."""
    part = name.partition(".")[0]
    return part == "encode" or (part.startswith("block") and part[5:].isdigit())
