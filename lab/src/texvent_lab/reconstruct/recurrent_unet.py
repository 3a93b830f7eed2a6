"""E2VID and its kin: a U-Net whose encoders remember."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from texvent.extending import require
from texvent.networks.weight_files import Shape, Tensor
from texvent_lab.networks import EXTRA
from texvent_lab.networks.layers import (
    ConvLayer,
    ConvLstm,
    ResidualBlock,
    TransposedLayer,
    UpsampleLayer,
    count_blocks,
    upsample,
)
from texvent_lab.reconstruct.recurrent_network import RecurrentNetwork

_torch: Any = require("torch", extra=EXTRA)
_nn: Any = require("torch.nn", extra=EXTRA)
_Module: Any = _nn.Module

ATOMS = 6
"""Kernels per pixel, of which every output channel takes its own mixture."""
BASES_PER_SCALE = 6
"""Fourier-Bessel patterns per kernel side 3, 5, ...; every atom is a mixture of all of them."""
CONTEXT_CHANNELS, HIDDEN_CHANNELS = 32, 64
CONTEXT_SCALE = 0.25
"""The decoder's output has a quarter of the sensor's sides, and so has its context."""


class AtomGeneration(_Module):
    """Kernels of every pixel from its context: mixtures of patterns stored with the weights."""

    def __init__(self, side: int) -> None:
        super().__init__()
        bases = BASES_PER_SCALE * (side // 2)
        self.bases = _nn.Parameter(_torch.zeros(bases, side * side))
        self.bases_net = _nn.Sequential(
            _nn.Conv2d(CONTEXT_CHANNELS, HIDDEN_CHANNELS, 3, padding=1),
            _nn.BatchNorm2d(HIDDEN_CHANNELS),
            _nn.Tanh(),
            _nn.Conv2d(HIDDEN_CHANNELS, ATOMS * bases, 3, padding=1),
            _nn.BatchNorm2d(ATOMS * bases),
            _nn.Tanh(),
        )

    def forward(self, context: Tensor) -> Tensor:
        """[atoms, side², H/4, W/4] of features [1, channels, H/4, W/4]."""
        coefficients = self.bases_net(context)[0].unflatten(0, (ATOMS, -1))
        return _torch.einsum("abhw,bp->aphw", coefficients, self.bases)


class DynamicDecoder(_Module):
    """Twice the size, by kernels made from the context, then ReLU.

    Source: B. Ercan et al., "HyperE2VID", TIP 2024, section III-B.
    """

    def __init__(self, narrow: int, wide: int, side: int, bins: int) -> None:
        super().__init__()
        fusion = _nn.Conv2d(bins + 1, CONTEXT_CHANNELS, 3, padding=1)
        self.context_fusion = _nn.ModuleDict({"conv": fusion})
        self.dynamic_atom_generation = AtomGeneration(side)
        mixtures = _torch.zeros(wide, narrow * ATOMS, 1, 1)
        self.dynamic_conv = _nn.ParameterDict(
            {"compositional_coefficients": mixtures, "bias": _torch.zeros(wide)}
        )

    def forward(self, x: Tensor, context: Tensor) -> Tensor:
        """[1, fewer channels, H/4, W/4].

        Args:
            x: [1, channels, H/8, W/8].
            context: voxel grid and the image before, [1, bins + 1, H, W].
        """
        x = upsample(x)
        context = _nn.functional.interpolate(
            context, scale_factor=CONTEXT_SCALE, mode="bilinear", align_corners=False
        )
        atoms = self.dynamic_atom_generation(self.context_fusion["conv"](context))
        side = round(atoms.shape[1] ** 0.5)
        height, width = x.shape[-2:]
        padded = _nn.functional.pad(x[0], (side // 2,) * 4)
        # One kernel position after the other: all at once would take side² times the memory.
        mixed = x.new_zeros(x.shape[1], len(atoms), height, width)
        for position in range(side * side):
            row, column = divmod(position, side)
            shifted = padded[:, row : row + height, column : column + width]
            mixed.addcmul_(shifted[:, None], atoms[None, :, position])
        weight, bias = self.dynamic_conv["compositional_coefficients"], self.dynamic_conv["bias"]
        return _nn.functional.conv2d(mixed.flatten(0, 1)[None], weight, bias).relu()


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
    is_transposed: bool = False
    """Decoders are transposed convolutions instead of bilinear ones."""

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
            is_transposed=f"{PREFIX}.decoders.1.transposed_conv2d.weight" in found,
        )


class E2vid(RecurrentNetwork):
    """E2VID: head, three encoders with memory, two residual blocks, three decoders, prediction.

    Each decoder and the prediction add what the encoder of their size, or the head, gave. The
    output passes a sigmoid.

    Source: H. Rebecq et al., "High speed and high dynamic range video with an event camera", TPAMI
        2021, section 3.3.
    """

    is_dynamic: ClassVar[bool] = False
    default_activation: ClassVar[str] = "sigmoid"

    def __init__(
        self, variant: UNetVariant | None = None, final_activation: str | None = None
    ) -> None:
        """Random weights; None: the published variant, and the activation of this class."""
        super().__init__()
        one = variant or UNetVariant()
        self.bins, self.multiple = one.bins, 2**one.encoders
        chosen = self.default_activation if final_activation is None else final_activation
        self._has_sigmoid = chosen == "sigmoid"
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
        narrow, wide = one.width << number, one.width << (number + 1)
        layer = ConvLayer(narrow, wide, one.side, stride=2, has_norm=one.has_norm)
        return _nn.ModuleDict({"conv": layer, "recurrent_block": ConvLstm(wide)})

    def _decoder(self, one: UNetVariant, number: int) -> Any:
        wide = one.width << (one.encoders - number)
        if self.is_dynamic and number == 0:
            return DynamicDecoder(wide, wide // 2, one.side, one.bins)
        layer = TransposedLayer if one.is_transposed else UpsampleLayer
        return layer(wide, wide // 2, one.side, has_norm=one.has_norm)

    def reset(self) -> None:
        """See `RecurrentNetwork`."""
        self._states: list[Any] = [None] * len(self.unetrecurrent["encoders"])
        self._image: Tensor | None = None

    def step(self, voxel: Tensor) -> Tensor:
        """See `RecurrentNetwork`."""
        net = self.unetrecurrent
        head = x = net["head"](voxel).relu()
        skipped, states = [], []
        for encoder, state in zip(net["encoders"], self._states, strict=True):
            state = encoder["recurrent_block"](encoder["conv"](x).relu(), state)
            x = state[0]
            states.append(state)
            skipped.append(x)
        self._states = states
        for block in net["resblocks"]:
            x = block(x)
        for number, decoder in enumerate(net["decoders"]):
            x = x + skipped.pop()
            if self.is_dynamic and number == 0:
                seen = _torch.zeros_like(voxel[:, :1]) if self._image is None else self._image
                x = decoder(x, _torch.cat([voxel, seen], 1))
            else:
                x = decoder(x)
        image = net["pred"](x + head)
        self._image = image.sigmoid() if self._has_sigmoid else image
        return self._image


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


class HyperE2vid(E2vidPlus):
    """HyperE2VID: the first decoder's kernels differ from pixel to pixel.

    They are made from the events and from the image before.

    Source: B. Ercan et al., "HyperE2VID: improving event-based video reconstruction via
        hypernetworks", TIP 2024, section III.
    """

    is_dynamic: ClassVar[bool] = True
