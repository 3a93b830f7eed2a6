"""FireNet and FireNet+: two gated recurrent units and two residual blocks at full size."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from texvent.networks.layer_shapes import Shape, Shapes
from texvent.networks.weight_files import Tensor
from texvent_lab.networks.layer_shapes import conv_gru, conv_layer, residual_block
from texvent_lab.networks.layers import Layers

PUBLISHED_HEAD = (16, 5, 3, 3)
"""Shape of the first kernel: channels, bins, side, side."""


@dataclass(frozen=True)
class FireNetNames:
    """What a file calls the layers, in the order that data passes them."""

    head: str
    units: tuple[str, str]
    blocks: tuple[str, str]
    prediction: str


class FireNet:
    """FireNet as published with its paper.

    Head, unit, block, unit, block, prediction; the image keeps its size throughout, and the
    output has no activation.

    Source: C. Scheerlinck et al., "Fast image reconstruction with an event camera", WACV 2020.
    """

    names: ClassVar[FireNetNames] = FireNetNames(
        "net.head.conv",
        ("net.head.recurrent_block", "net.resblocks.0.recurrent_block"),
        ("net.resblocks.0.conv", "net.resblocks.1"),
        "net.pred",
    )
    multiple: ClassVar[int] = 1

    def __init__(self, tensors: Mapping[str, Tensor], settings: Mapping[str, Any]) -> None:
        """A network that has seen nothing; see `RecurrentNetwork`."""
        del settings
        self._layers = Layers(tensors)
        self.bins: int = tensors[f"{self.names.head}.conv2d.weight"].shape[1]
        self.reset()

    @classmethod
    def tensor_shapes(cls, found: Mapping[str, Shape]) -> Shapes:
        """Every tensor of a network as wide as the one found; see `RecurrentNetwork`."""
        names = cls.names
        width, bins, side, _ = found.get(f"{names.head}.conv2d.weight", PUBLISHED_HEAD)
        shapes = conv_layer(names.head, width, bins, side)
        for unit, block in zip(names.units, names.blocks, strict=True):
            # The units of FireNet+ take the kernel's side from the head; FireNet's are 3 wide.
            shapes |= conv_gru(unit, width, side) | residual_block(block, width)
        return shapes | conv_layer(names.prediction, 1, width, 1)

    def reset(self) -> None:
        """Forget everything seen."""
        self._states: list[Tensor | None] = [None, None]

    def step(self, voxel: Tensor) -> Tensor:
        """The image after one more voxel grid; see `RecurrentNetwork`."""
        layers, names = self._layers, self.names
        x = layers.torch.relu(layers.conv_layer(voxel, names.head))
        for number, (unit, block) in enumerate(zip(names.units, names.blocks, strict=True)):
            x = layers.conv_gru(x, unit, self._states[number])
            self._states[number] = x
            x = layers.residual_block(x, block)
        return layers.conv_layer(x, names.prediction)


class FireNetPlus(FireNet):
    """The same network with other names and weights.

    Source: T. Stoffregen et al., "Reducing the sim-to-real gap for event cameras", ECCV 2020.
    """

    names: ClassVar[FireNetNames] = FireNetNames("head", ("G1", "G2"), ("R1", "R2"), "pred")
