"""The two networks that LPIPS was published with, layer by layer."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from texvent.networks.layer_shapes import Shapes

LpipsNet: TypeAlias = Literal["alex", "vgg"]

COLOURS = 3


@dataclass(frozen=True, kw_only=True)
class Convolution:
    """One convolution and the ReLU after it."""

    channels: int
    """Channels that come out."""
    kernel: int = 3
    """Side of the kernel, px."""
    stride: int = 1
    padding: int = 1
    """Zeros around the map, px."""
    pools: int = 0
    """Side of the maximum that is taken before, every second pixel; 0 for none."""
    is_compared: bool = False
    """True if the distance looks at what comes out."""


@dataclass(frozen=True)
class LpipsLayout:
    """A network and its heads: one weight per channel that is compared."""

    name: LpipsNet
    published_name: str
    """Key of the convolutions in the published file."""
    convolutions: tuple[Convolution, ...]

    def array_shapes(self) -> Shapes:
        """Name → shape of every array: kernels are [rows, columns, channels in, channels out]."""
        shapes: Shapes = {}
        channels_in = COLOURS
        for number, layer in enumerate(self.convolutions):
            shapes[f"kernel{number}"] = (layer.kernel, layer.kernel, channels_in, layer.channels)
            shapes[f"bias{number}"] = (layer.channels,)
            channels_in = layer.channels
        compared = [layer for layer in self.convolutions if layer.is_compared]
        shapes.update({f"head{n}": (layer.channels,) for n, layer in enumerate(compared)})
        return shapes

    @property
    def least_side(self) -> int:
        """Images with a shorter side leave nothing for the last layer, px."""
        side = 1
        for layer in reversed(self.convolutions):
            side = max((side - 1) * layer.stride + layer.kernel - 2 * layer.padding, 1)
            if layer.pools:
                side = (side - 1) * 2 + layer.pools
        return side


def _vgg_block(channels: int, count: int, *, pools: int = 2) -> tuple[Convolution, ...]:
    """Convolutions of one width; the first halves the map, the last is compared."""
    return tuple(
        Convolution(
            channels=channels,
            pools=pools if number == 0 else 0,
            is_compared=number == count - 1,
        )
        for number in range(count)
    )


ALEX = LpipsLayout(
    "alex",
    "AlexNet_0",
    (
        Convolution(channels=64, kernel=11, stride=4, padding=2, is_compared=True),
        Convolution(channels=192, kernel=5, padding=2, pools=3, is_compared=True),
        Convolution(channels=384, pools=3, is_compared=True),
        Convolution(channels=256, is_compared=True),
        Convolution(channels=256, is_compared=True),
    ),
)
VGG = LpipsLayout(
    "vgg",
    "VGG16_0",
    (
        *_vgg_block(64, 2, pools=0),
        *_vgg_block(128, 2),
        *_vgg_block(256, 3),
        *_vgg_block(512, 3),
        *_vgg_block(512, 3),
    ),
)
LAYOUTS: tuple[LpipsLayout, ...] = (ALEX, VGG)
