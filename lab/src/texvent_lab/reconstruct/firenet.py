"""FireNet and FireNet+: two gated recurrent units and two residual blocks at full size."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from texvent.extending import require
from texvent.networks import Shape, Tensor
from texvent_lab.networks import EXTRA
from texvent_lab.networks.layers import ConvGru, ConvLayer, ResidualBlock
from texvent_lab.reconstruct.recurrent_network import EVREAL, PublishedNetwork, RecurrentNetwork

_nn: Any = require("torch.nn", extra=EXTRA)

PUBLISHED_HEAD = (16, 5, 3, 3)
"""Shape of the first kernel: channels, bins, side, side."""


class FireNet(RecurrentNetwork):
    """FireNet as published with its paper.

    Head, unit, block, unit, block, prediction; the image keeps its size throughout, and the
    output has no activation.

    Source: C. Scheerlinck et al., "Fast image reconstruction with an event camera", WACV 2020.
    """

    head_name: ClassVar[str] = "net.head.conv"

    def __init__(self, width: int, bins: int, side: int) -> None:
        """Random weights; the kernels of head and prediction are `side` and 1 px wide."""
        super().__init__()
        self.bins = bins
        self._add_layers(width, side)
        self.reset()

    @classmethod
    def like(cls, found: Mapping[str, Shape], settings: Mapping[str, Any]) -> FireNet:
        """See `RecurrentNetwork`."""
        del settings
        width, bins, side, _ = found.get(f"{cls.head_name}.conv2d.weight", PUBLISHED_HEAD)
        return cls(width, bins, side)

    def _add_layers(self, width: int, side: int) -> None:
        head = {"conv": ConvLayer(self.bins, width, side), "recurrent_block": ConvGru(width, side)}
        middle = {"conv": ResidualBlock(width), "recurrent_block": ConvGru(width, side)}
        self.net = _nn.ModuleDict(
            {
                "head": _nn.ModuleDict(head),
                "resblocks": _nn.ModuleList([_nn.ModuleDict(middle), ResidualBlock(width)]),
                "pred": ConvLayer(width, 1, 1),
            }
        )

    def _layers(self) -> tuple[Any, ...]:
        """Layers in the order that data passes them."""
        head, (middle, last) = self.net["head"], self.net["resblocks"]
        units = head["recurrent_block"], middle["recurrent_block"]
        return head["conv"], units[0], middle["conv"], units[1], last, self.net["pred"]

    def reset(self) -> None:
        """See `RecurrentNetwork`."""
        self._states: tuple[Tensor | None, Tensor | None] = (None, None)

    def step(self, voxel: Tensor) -> Tensor:
        """See `RecurrentNetwork`."""
        head, unit1, block1, unit2, block2, prediction = self._layers()
        first = unit1(head(voxel).relu(), self._states[0])
        second = unit2(block1(first), self._states[1])
        self._states = first, second
        return prediction(block2(second))


class FireNetPlus(FireNet):
    """The same network with other names and weights.

    Source: T. Stoffregen et al., "Reducing the sim-to-real gap for event cameras", ECCV 2020.
    """

    head_name = "head"

    def _add_layers(self, width: int, side: int) -> None:
        self.head = ConvLayer(self.bins, width, side)
        self.G1, self.R1 = ConvGru(width, side), ResidualBlock(width)
        self.G2, self.R2 = ConvGru(width, side), ResidualBlock(width)
        self.pred = ConvLayer(width, 1, 1)

    def _layers(self) -> tuple[Any, ...]:
        return self.head, self.G1, self.R1, self.G2, self.R2, self.pred


FIRENET = PublishedNetwork("firenet", FireNet, EVREAL.format("FireNet"), is_normalised=True)
FIRENET_PLUS = PublishedNetwork("firenet+", FireNetPlus, EVREAL.format("FireNet+"))
