"""ET-Net: a U-Net with memory whose middle is a transformer over three scales."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from texvent.networks.layer_shapes import Shape, Shapes, layer_norm, linear
from texvent.networks.weight_files import Tensor
from texvent_lab.networks.layer_shapes import (
    attention,
    conv_layer,
    conv_lstm,
    convolution,
    count_blocks,
)
from texvent_lab.networks.layers import Layers

SCALES = 3
HEADS = 8
DOWN, UP = "DownsampleConv", "UpsampleConv"
PUBLISHED_HEAD = (32, 5, 5, 5)
"""Shape of the first kernel: channels, bins, side, side."""
PUBLISHED_ENCODER_LAYERS, PUBLISHED_DECODER_LAYERS = 3, 2
FEED_FORWARD = 4
"""Hidden features of a layer, as a multiple of a token's."""
WAVELENGTH = 10_000.0


class EtNet:
    """ET-Net: head, three encoders with memory, a transformer, three decoders, prediction.

    The encoders' outputs become tokens of equal number: one per 8×8 px. Each scale is encoded by
    itself; then the coarsest is decoded from itself, and each finer one from the one before. The
    mean of all six takes the place of a U-Net's middle. The output passes a sigmoid.

    Source: W. Weng, Y. Zhang, Z. Xiong, "Event-based video reconstruction using transformer", ICCV
        2021, section 3.
    """

    multiple: ClassVar[int] = 2**SCALES

    def __init__(self, tensors: Mapping[str, Tensor], settings: Mapping[str, Any]) -> None:
        """A network that has seen nothing; see `RecurrentNetwork`."""
        del settings
        self._layers = Layers(tensors)
        shapes = {name: tuple(tensor.shape) for name, tensor in tensors.items()}
        self._depths = _count_layers(shapes)
        self.bins: int = shapes["head.conv2d.weight"][1]
        self.reset()

    @classmethod
    def tensor_shapes(cls, found: Mapping[str, Shape]) -> Shapes:
        """Every tensor of a network as wide as the one found; see `RecurrentNetwork`."""
        width, bins, side, _ = found.get("head.conv2d.weight", PUBLISHED_HEAD)
        has_norm = "head.norm_layer.weight" in found
        shapes = conv_layer("head", width, bins, side, has_norm=has_norm)
        for number in range(SCALES):
            narrow, wide = width << number, width << (number + 1)
            down, up = f"{DOWN}.{number}", f"{UP}.{SCALES - 1 - number}"
            shapes |= conv_layer(f"{down}.conv", wide, narrow, side, has_norm=has_norm)
            shapes |= conv_lstm(f"{down}.recurrent_block", wide)
            shapes |= conv_layer(up, narrow, wide, side, has_norm=has_norm)
        features = width << SCALES
        for scale in range(1, SCALES):
            shapes |= convolution(f"split{scale}", features, features >> scale, 2**scale)
        for scale in range(SCALES):
            shapes |= _transformer_shapes(scale, features, _count_layers(found))
        return shapes | conv_layer("pred", 1, width, 1, has_norm=has_norm)

    def reset(self) -> None:
        """Forget everything seen."""
        self._states: list[tuple[Tensor, Tensor] | None] = [None] * SCALES

    def step(self, voxel: Tensor) -> Tensor:
        """The image after one more voxel grid; see `RecurrentNetwork`."""
        layers, torch = self._layers, self._layers.torch
        head = x = torch.relu(layers.conv_layer(voxel, "head"))
        skipped = []
        for number in range(SCALES):
            name = f"{DOWN}.{number}"
            x = torch.relu(layers.conv_layer(x, f"{name}.conv", stride=2))
            state = layers.conv_lstm(x, f"{name}.recurrent_block", self._states[number])
            self._states[number], x = state, state[0]
            skipped.append(x)
        x = self._transform(skipped)
        for number in range(SCALES):
            x = layers.upsample_layer(x + skipped.pop(), f"{UP}.{number}")
        return torch.sigmoid(layers.conv_layer(x + head, "pred"))

    def _transform(self, maps: list[Tensor]) -> Tensor:
        """The middle of the network from the encoders' outputs, of the last one's shape."""
        layers, coarsest = self._layers, maps[-1]
        height, width = coarsest.shape[-2:]
        encoded: list[Tensor] = []
        for scale, image in enumerate(reversed(maps)):
            if scale:
                image = layers.convolve(image, f"split{scale}", stride=2**scale, padding=0)
            tokens = image[0].flatten(1).T
            encoded.append(self._encode(tokens + self._places(tokens), scale))
        total = encoded[0] + encoded[1] + encoded[2]
        for scale in range(SCALES):
            total = total + self._decode(encoded[scale], encoded[max(scale - 1, 0)], scale)
        return (total / (2 * SCALES)).T.unflatten(1, (height, width))[None]

    def _encode(self, tokens: Tensor, scale: int) -> Tensor:
        for number in range(self._depths[0]):
            name = f"trans_encoder{scale}.encoder.layers.{number}"
            normal = self._layers.layer_norm(tokens, f"{name}.norm1")
            tokens = tokens + self._attend(normal, normal, f"{name}.self_attn")
            tokens = tokens + self._feed_forward(tokens, name, "norm2")
        return tokens

    def _decode(self, tokens: Tensor, memory: Tensor, scale: int) -> Tensor:
        layers = self._layers
        for number in range(self._depths[1]):
            name = f"trans_decoder{scale}.decoder.layers.{number}"
            normal = layers.layer_norm(tokens, f"{name}.norm1")
            tokens = tokens + self._attend(normal, normal, f"{name}.self_attn")
            queries = layers.layer_norm(tokens, f"{name}.norm21")
            known = layers.layer_norm(memory, f"{name}.norm22")
            tokens = tokens + self._attend(queries, known, f"{name}.cross_attn")
            tokens = tokens + self._feed_forward(tokens, name, "norm3")
        return tokens

    def _attend(self, queries: Tensor, memory: Tensor, name: str) -> Tensor:
        return self._layers.attention(queries, memory, name, heads=HEADS)

    def _feed_forward(self, tokens: Tensor, name: str, norm: str) -> Tensor:
        layers = self._layers
        hidden = layers.linear(layers.layer_norm(tokens, f"{name}.{norm}"), f"{name}.linear1")
        return layers.linear(layers.torch.relu(hidden), f"{name}.linear2")

    def _places(self, tokens: Tensor) -> Tensor:
        """Where each token lies, as sines (even features) and cosines (odd ones)."""
        count, features = tokens.shape
        feature = np.arange(features)
        rate = WAVELENGTH ** (-2.0 * (feature // 2) / features)
        angle = np.arange(count)[:, None] * rate
        table = np.where(feature % 2 == 0, np.sin(angle), np.cos(angle))
        return self._layers.torch.from_numpy(table.astype(np.float32)).to(tokens.device)


def _count_layers(found: Mapping[str, Shape]) -> tuple[int, int]:
    """How many layers each encoder and each decoder of the transformer has."""
    return (
        count_blocks(found, "trans_encoder0.encoder.layers") or PUBLISHED_ENCODER_LAYERS,
        count_blocks(found, "trans_decoder0.decoder.layers") or PUBLISHED_DECODER_LAYERS,
    )


def _transformer_shapes(scale: int, features: int, depths: tuple[int, int]) -> Shapes:
    shapes: Shapes = {}
    kinds = (
        (f"trans_encoder{scale}.encoder.layers", depths[0], ("self_attn",), ("norm1", "norm2")),
        (
            f"trans_decoder{scale}.decoder.layers",
            depths[1],
            ("self_attn", "cross_attn"),
            ("norm1", "norm21", "norm22", "norm3"),
        ),
    )
    for prefix, depth, attentions, norms in kinds:
        for number in range(depth):
            name = f"{prefix}.{number}"
            for one in attentions:
                shapes |= attention(f"{name}.{one}", features)
            for one in norms:
                shapes |= layer_norm(f"{name}.{one}", features)
            shapes |= linear(f"{name}.linear1", FEED_FORWARD * features, features)
            shapes |= linear(f"{name}.linear2", features, FEED_FORWARD * features)
    return shapes
