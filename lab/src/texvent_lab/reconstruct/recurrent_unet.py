"""E2VID and its kin: a U-Net whose encoders remember."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from texvent.extending import require
from texvent.networks import Shape, Tensor
from texvent_lab.networks import EXTRA
from texvent_lab.networks.layers import (
    ConvLayer,
    RecurrentLayer,
    ResidualBlock,
    UpsampleLayer,
    count_blocks,
)
from texvent_lab.reconstruct.recurrent_network import EVREAL, PublishedNetwork, RecurrentNetwork

_nn: Any = require("torch.nn", extra=EXTRA)

PREFIX = "unetrecurrent"
PUBLISHED_HEAD = (32, 5, 5, 5)
"""Shape of the first kernel: channels, bins, side, side."""


@dataclass(frozen=True)
class UNetVariant:
    """Differences between files of the family; the defaults are the published network."""

    width: int = 32
    bins: int = 5
    side: int = 5
    encoders: int = 3
    blocks: int = 2
    has_norm: bool = False
    """Batch normalisation in place of biases."""

    @classmethod
    def of(cls, found: Mapping[str, Shape]) -> UNetVariant:
        """The variant that tensors are of, the published one where they do not say."""
        width, bins, side, _ = found.get(f"{PREFIX}.head.conv2d.weight", PUBLISHED_HEAD)
        first = f"{PREFIX}.encoders.0"
        return cls(
            width=width,
            bins=bins,
            side=side,
            encoders=count_blocks(found, f"{PREFIX}.encoders") or cls.encoders,
            blocks=count_blocks(found, f"{PREFIX}.resblocks") or cls.blocks,
            has_norm=f"{first}.conv.norm_layer.weight" in found,
        )


class RecurrentUNet(RecurrentNetwork):
    """Head, encoders with memory, a middle, decoders, prediction.

    Each decoder and the prediction add what the encoder of their size, or the head, gave.
    """

    has_sigmoid: bool = True
    """Whether the output passes a sigmoid."""

    def _layers(self) -> tuple[Any, Any, Any, Any]:
        """Head, encoders, decoders and prediction."""
        raise NotImplementedError

    def _middle(self, maps: list[Tensor]) -> Tensor:
        """Input of the decoders, of the last map's shape, from the encoders' outputs."""
        raise NotImplementedError

    def reset(self) -> None:
        """See `RecurrentNetwork`."""
        self._states: list[Any] = [None] * len(self._layers()[1])

    def step(self, voxel: Tensor) -> Tensor:
        """See `RecurrentNetwork`."""
        first, encoders, decoders, last = self._layers()
        head = x = first(voxel).relu()
        states, maps = [], []
        for encoder, state in zip(encoders, self._states, strict=True):
            states.append(encoder(x, state))
            x = states[-1][0]
            maps.append(x)
        self._states = states
        x = self._middle(maps)
        for decoder in decoders:
            x = decoder(x + maps.pop())
        image = last(x + head)
        return image.sigmoid() if self.has_sigmoid else image


class E2vid(RecurrentUNet):
    """E2VID: three encoders, two residual blocks, three decoders.

    Source: H. Rebecq et al., "High speed and high dynamic range video with an event camera", TPAMI
        2021, section 3.3.
    """

    default_activation: ClassVar[str] = "sigmoid"

    def __init__(
        self, variant: UNetVariant | None = None, final_activation: str | None = None
    ) -> None:
        """Random weights; None: the published variant, and the activation of this class."""
        super().__init__()
        one = variant or UNetVariant()
        self.bins, self.multiple = one.bins, 2**one.encoders
        chosen = self.default_activation if final_activation is None else final_activation
        self.has_sigmoid = chosen == "sigmoid"
        widest = one.width << one.encoders
        blocks = (ResidualBlock(widest, has_norm=one.has_norm) for _ in range(one.blocks))
        self.unetrecurrent = _nn.ModuleDict(
            {
                "head": ConvLayer(one.bins, one.width, one.side),
                "encoders": _nn.ModuleList(self._encoder(one, i) for i in range(one.encoders)),
                "resblocks": _nn.ModuleList(blocks),
                "decoders": _nn.ModuleList(self._decoder(one, i) for i in range(one.encoders)),
                "pred": ConvLayer(one.width, 1, 1, has_norm=one.has_norm),
            }
        )
        self.reset()

    @classmethod
    def like(cls, found: Mapping[str, Shape], settings: Mapping[str, Any]) -> E2vid:
        """See `RecurrentNetwork`."""
        del settings
        return cls(UNetVariant.of(found))

    def _encoder(self, one: UNetVariant, number: int) -> Any:
        narrow = one.width << number
        return RecurrentLayer(narrow, 2 * narrow, one.side, has_norm=one.has_norm)

    def _decoder(self, one: UNetVariant, number: int) -> Any:
        wide = one.width << (one.encoders - number)
        return UpsampleLayer(wide, wide // 2, one.side, has_norm=one.has_norm)

    def _layers(self) -> tuple[Any, Any, Any, Any]:
        net = self.unetrecurrent
        return net["head"], net["encoders"], net["decoders"], net["pred"]

    def _middle(self, maps: list[Tensor]) -> Tensor:
        x = maps[-1]
        for block in self.unetrecurrent["resblocks"]:
            x = block(x)
        return x


class E2vidPlus(E2vid):
    """E2VID trained on events with more thresholds; its file says which activation comes last.

    Source: T. Stoffregen et al., "Reducing the sim-to-real gap for event cameras", ECCV 2020.
    """

    default_activation: ClassVar[str] = ""

    @classmethod
    def like(cls, found: Mapping[str, Shape], settings: Mapping[str, Any]) -> E2vid:
        """See `RecurrentNetwork`."""
        activation = str(settings.get("final_activation", cls.default_activation))
        return cls(UNetVariant.of(found), activation)


E2VID = PublishedNetwork(
    "e2vid",
    E2vid,
    f"{EVREAL.format('E2VID')}, and uzh-rpg/rpg_e2vid links to it",
    is_normalised=True,
    is_stretched=True,
)
E2VID_PLUS = PublishedNetwork("e2vid+", E2vidPlus, EVREAL.format("E2VID+"))
