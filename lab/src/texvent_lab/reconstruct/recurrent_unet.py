"""E2VID and its kin: a U-Net whose encoders remember."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from texvent.networks.layer_shapes import Shape, Shapes
from texvent.networks.weight_files import Tensor
from texvent_lab.networks.layer_shapes import (
    batch_norm,
    conv_gru,
    conv_layer,
    conv_lstm,
    convolution,
    count_blocks,
    residual_block,
)
from texvent_lab.networks.layers import Layers

ATOMS = 6
"""Kernels per pixel, of which every output channel takes its own mixture."""
BASES_PER_SCALE = 6
"""Fourier-Bessel patterns per kernel side 3, 5, ...; every atom is a mixture of all of them."""
CONTEXT_CHANNELS, HIDDEN_CHANNELS = 32, 64
CONTEXT_SCALE = 0.25
"""The decoder's output has a quarter of the sensor's sides, and so has its context."""


def dynamic_decoder_shapes(
    name: str, channels_out: int, channels_in: int, *, side: int, bins: int
) -> Shapes:
    """Every tensor of the decoder; the patterns are stored with the weights."""
    atoms, inner = f"{name}.dynamic_atom_generation", f"{name}.dynamic_conv"
    bases = BASES_PER_SCALE * (side // 2)
    return {
        **convolution(f"{name}.context_fusion.conv", CONTEXT_CHANNELS, bins + 1, 3),
        f"{atoms}.bases": (bases, side * side),
        **convolution(f"{atoms}.bases_net.0", HIDDEN_CHANNELS, CONTEXT_CHANNELS, 3),
        **batch_norm(f"{atoms}.bases_net.1", HIDDEN_CHANNELS),
        **convolution(f"{atoms}.bases_net.3", ATOMS * bases, HIDDEN_CHANNELS, 3),
        **batch_norm(f"{atoms}.bases_net.4", ATOMS * bases),
        f"{inner}.compositional_coefficients": (channels_out, channels_in * ATOMS, 1, 1),
        f"{inner}.bias": (channels_out,),
    }


def decode_dynamically(layers: Layers, x: Tensor, name: str, *, context: Tensor) -> Tensor:
    """Twice the size, by kernels made from the context, then ReLU.

    Args:
        layers: tensors of the network.
        x: [1, channels, H/8, W/8].
        name: of the decoder.
        context: voxel grid and the image before, [1, bins + 1, H, W].

    Returns:
        [1, fewer channels, H/4, W/4].

    Source: B. Ercan et al., "HyperE2VID", TIP 2024, section III-B.
    """
    torch = layers.torch
    x = layers.upsample(x)
    atoms = _make_atoms(layers, name, context)
    side = round(atoms.shape[1] ** 0.5)
    height, width = x.shape[-2:]
    margin = side // 2
    padded = torch.nn.functional.pad(x[0], (margin,) * 4)
    # One kernel position after the other: all of them at once would take side² times the memory.
    mixed = x.new_zeros(x.shape[1], len(atoms), height, width)
    for position in range(side * side):
        row, column = divmod(position, side)
        shifted = padded[:, row : row + height, column : column + width]
        mixed.addcmul_(shifted[:, None], atoms[None, :, position])
    weight = layers[f"{name}.dynamic_conv.compositional_coefficients"]
    bias = layers[f"{name}.dynamic_conv.bias"]
    return torch.relu(torch.nn.functional.conv2d(mixed.flatten(0, 1)[None], weight, bias))


def _make_atoms(layers: Layers, name: str, context: Tensor) -> Tensor:
    """Kernels of every pixel, [atoms, side², H/4, W/4]."""
    torch, inner = layers.torch, f"{name}.dynamic_atom_generation"
    context = torch.nn.functional.interpolate(
        context, scale_factor=CONTEXT_SCALE, mode="bilinear", align_corners=False
    )
    x = layers.convolve(context, f"{name}.context_fusion.conv")
    for conv, norm in (("0", "1"), ("3", "4")):
        x = layers.convolve(x, f"{inner}.bases_net.{conv}")
        x = torch.tanh(layers.normalise(x, f"{inner}.bases_net.{norm}"))
    coefficients = x[0].unflatten(0, (ATOMS, -1))
    return torch.einsum("abhw,bp->aphw", coefficients, layers[f"{inner}.bases"])


PREFIX = "unetrecurrent"
HEAD = f"{PREFIX}.head"
ENCODERS = f"{PREFIX}.encoders"
BLOCKS = f"{PREFIX}.resblocks"
DECODERS = f"{PREFIX}.decoders"
PREDICTION = f"{PREFIX}.pred"
PUBLISHED_HEAD = (32, 5, 5, 5)
"""Shape of the first kernel: channels, bins, side, side."""
PUBLISHED_ENCODERS = 3
PUBLISHED_BLOCKS = 2


@dataclass(frozen=True)
class UNetVariant:
    """Where files of the family differ; all of it can be read from the names and shapes."""

    width: int
    bins: int
    side: int
    encoders: int
    blocks: int
    has_norm: bool
    """Batch normalisation in place of biases."""
    is_gru: bool
    """Gated recurrent units instead of long short-term memories."""
    is_transposed: bool
    """Decoders are transposed convolutions instead of bilinear ones."""

    @classmethod
    def of(cls, found: Mapping[str, Shape]) -> UNetVariant:
        """The variant that tensors are of, the published one where they do not say."""
        width, bins, side, _ = found.get(f"{HEAD}.conv2d.weight", PUBLISHED_HEAD)
        return cls(
            width=width,
            bins=bins,
            side=side,
            encoders=count_blocks(found, ENCODERS) or PUBLISHED_ENCODERS,
            blocks=count_blocks(found, BLOCKS) or PUBLISHED_BLOCKS,
            has_norm=f"{ENCODERS}.0.conv.norm_layer.weight" in found,
            is_gru=f"{ENCODERS}.0.recurrent_block.reset_gate.weight" in found,
            is_transposed=f"{DECODERS}.1.transposed_conv2d.weight" in found,
        )

    def tensor_shapes(self, *, is_dynamic: bool) -> Shapes:
        """Every tensor, with a dynamic first decoder or without."""
        shapes = conv_layer(HEAD, self.width, self.bins, self.side)
        for number in range(self.encoders):
            narrow, wide = self.width << number, self.width << (number + 1)
            name = f"{ENCODERS}.{number}"
            unit = f"{name}.recurrent_block"
            shapes |= conv_layer(f"{name}.conv", wide, narrow, self.side, has_norm=self.has_norm)
            shapes |= conv_gru(unit, wide, 3) if self.is_gru else conv_lstm(unit, wide)
        for number in range(self.blocks):
            widest = self.width << self.encoders
            shapes |= residual_block(f"{BLOCKS}.{number}", widest, has_norm=self.has_norm)
        for number in range(self.encoders):
            shapes |= self._decoder_shapes(number, is_dynamic=is_dynamic and number == 0)
        return shapes | conv_layer(PREDICTION, 1, self.width, 1, has_norm=self.has_norm)

    def _decoder_shapes(self, number: int, *, is_dynamic: bool) -> Shapes:
        name, wide = f"{DECODERS}.{number}", self.width << (self.encoders - number)
        if is_dynamic:
            return dynamic_decoder_shapes(name, wide // 2, wide, side=self.side, bins=self.bins)
        shapes = conv_layer(name, wide // 2, wide, self.side, has_norm=self.has_norm)
        if self.is_transposed:
            del shapes[f"{name}.conv2d.weight"]
            shapes[f"{name}.transposed_conv2d.weight"] = (wide, wide // 2, self.side, self.side)
            if not self.has_norm:
                shapes[f"{name}.transposed_conv2d.bias"] = shapes.pop(f"{name}.conv2d.bias")
        return shapes


class E2vid:
    """E2VID: head, three encoders with memory, two residual blocks, three decoders, prediction.

    Each decoder and the prediction add what the encoder of their size, or the head, gave. The
    output passes a sigmoid.

    Source: H. Rebecq et al., "High speed and high dynamic range video with an event camera", TPAMI
        2021, section 3.3.
    """

    is_dynamic: ClassVar[bool] = False
    default_activation: ClassVar[str] = "sigmoid"

    def __init__(self, tensors: Mapping[str, Tensor], settings: Mapping[str, Any]) -> None:
        """A network that has seen nothing; see `RecurrentNetwork`."""
        self._layers = Layers(tensors)
        shapes = {name: tuple(tensor.shape) for name, tensor in tensors.items()}
        self._variant = UNetVariant.of(shapes)
        self.bins = self._variant.bins
        self.multiple = 2**self._variant.encoders
        self._has_sigmoid = self._final_activation(settings) == "sigmoid"
        self.reset()

    @classmethod
    def tensor_shapes(cls, found: Mapping[str, Shape]) -> Shapes:
        """Every tensor of the variant that was found; see `RecurrentNetwork`."""
        return UNetVariant.of(found).tensor_shapes(is_dynamic=cls.is_dynamic)

    def reset(self) -> None:
        """Forget everything seen."""
        self._states: list[Any] = [None] * self._variant.encoders
        self._image: Tensor | None = None

    def step(self, voxel: Tensor) -> Tensor:
        """The image after one more voxel grid; see `RecurrentNetwork`."""
        layers, torch = self._layers, self._layers.torch
        head = x = torch.relu(layers.conv_layer(voxel, HEAD))
        skipped = []
        for number in range(self._variant.encoders):
            x = self._encode(x, number)
            skipped.append(x)
        for number in range(self._variant.blocks):
            x = layers.residual_block(x, f"{BLOCKS}.{number}")
        for number in range(self._variant.encoders):
            x, name = x + skipped.pop(), f"{DECODERS}.{number}"
            if self.is_dynamic and number == 0:
                seen = torch.zeros_like(voxel[:, :1]) if self._image is None else self._image
                x = decode_dynamically(layers, x, name, context=torch.cat([voxel, seen], 1))
            else:
                x = layers.upsample_layer(x, name)
        image = layers.conv_layer(x + head, PREDICTION)
        self._image = torch.sigmoid(image) if self._has_sigmoid else image
        return self._image

    def _encode(self, x: Tensor, number: int) -> Tensor:
        """Half the size and twice the channels, with the memory of that encoder."""
        layers, name = self._layers, f"{ENCODERS}.{number}"
        x = layers.torch.relu(layers.conv_layer(x, f"{name}.conv", stride=2))
        unit, state = f"{name}.recurrent_block", self._states[number]
        if self._variant.is_gru:
            self._states[number] = x = layers.conv_gru(x, unit, state)
            return x
        self._states[number] = layers.conv_lstm(x, unit, state)
        return self._states[number][0]

    def _final_activation(self, settings: Mapping[str, Any]) -> str:
        del settings
        return self.default_activation


class E2vidPlus(E2vid):
    """E2VID trained on events with more thresholds; its file says which activation comes last.

    Source: T. Stoffregen et al., "Reducing the sim-to-real gap for event cameras", ECCV 2020.
    """

    default_activation: ClassVar[str] = ""

    def _final_activation(self, settings: Mapping[str, Any]) -> str:
        return str(settings.get("final_activation", self.default_activation))


class HyperE2vid(E2vidPlus):
    """HyperE2VID: the first decoder's kernels differ from pixel to pixel.

    They are made from the events and from the image before.

    Source: B. Ercan et al., "HyperE2VID: improving event-based video reconstruction via
        hypernetworks", TIP 2024, section III.
    """

    is_dynamic: ClassVar[bool] = True
