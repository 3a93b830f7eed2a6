"""ET-Net: a U-Net with memory whose middle is a transformer over three scales."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from texvent.extending import require
from texvent.networks.weight_files import Shape, Tensor
from texvent_lab.networks import EXTRA
from texvent_lab.networks.layers import ConvLayer, ConvLstm, UpsampleLayer, count_blocks
from texvent_lab.reconstruct.recurrent_network import RecurrentNetwork

_torch: Any = require("torch", extra=EXTRA)
_nn: Any = require("torch.nn", extra=EXTRA)
_Module: Any = _nn.Module

SCALES = 3
HEADS = 8
PUBLISHED_HEAD = (32, 5, 5, 5)
"""Shape of the first kernel: channels, bins, side, side."""
PUBLISHED_ENCODER_LAYERS, PUBLISHED_DECODER_LAYERS = 3, 2
FEED_FORWARD = 4
"""Hidden features of a layer, as a multiple of a token's."""
WAVELENGTH = 10_000.0


class EncoderLayer(_Module):
    """Self-attention and feed-forward, both after a normalisation and added to the input."""

    norms: tuple[str, ...] = ("norm1", "norm2")

    def __init__(self, features: int) -> None:
        super().__init__()
        self.self_attn = _nn.MultiheadAttention(features, HEADS)
        for name in self.norms:
            setattr(self, name, _nn.LayerNorm(features))
        self.linear1 = _nn.Linear(features, FEED_FORWARD * features)
        self.linear2 = _nn.Linear(FEED_FORWARD * features, features)

    def forward(self, tokens: Tensor) -> Tensor:
        """Tokens [n, features]."""
        normal = self.norm1(tokens)
        tokens = tokens + _attend(self.self_attn, normal, normal)
        return tokens + self._feed_forward(self.norm2(tokens))

    def _feed_forward(self, tokens: Tensor) -> Tensor:
        return self.linear2(self.linear1(tokens).relu())


class DecoderLayer(EncoderLayer):
    """The same with attention to other tokens in between."""

    norms = ("norm1", "norm21", "norm22", "norm3")

    def __init__(self, features: int) -> None:
        super().__init__(features)
        self.cross_attn = _nn.MultiheadAttention(features, HEADS)

    def forward(self, tokens: Tensor, memory: Tensor | None = None) -> Tensor:
        """Tokens [n, features]; those attended to, [m, features], or themselves."""
        normal = self.norm1(tokens)
        tokens = tokens + _attend(self.self_attn, normal, normal)
        memory = self.norm22(tokens if memory is None else memory)
        tokens = tokens + _attend(self.cross_attn, self.norm21(tokens), memory)
        return tokens + self._feed_forward(self.norm3(tokens))


def _attend(attention: Any, queries: Tensor, memory: Tensor) -> Tensor:
    return attention(queries, memory, memory, need_weights=False)[0]


class EtNet(RecurrentNetwork):
    """ET-Net: head, three encoders with memory, a transformer, three decoders, prediction.

    The encoders' outputs become tokens of equal number: one per 8×8 px. Each scale is encoded by
    itself; then the coarsest is decoded from itself, and each finer one from the one before. The
    mean of all six takes the place of a U-Net's middle. The output passes a sigmoid.

    Source: W. Weng, Y. Zhang, Z. Xiong, "Event-based video reconstruction using transformer", ICCV
        2021, section 3.
    """

    multiple = 2**SCALES

    def __init__(
        self, width: int, bins: int, side: int, *, has_norm: bool, depths: tuple[int, int]
    ) -> None:
        """Random weights; `depths`: layers of each encoder and decoder of the transformer."""
        super().__init__()
        self.bins = bins
        features = width << SCALES
        self.head = ConvLayer(bins, width, side, has_norm=has_norm)
        self.DownsampleConv, self.UpsampleConv = _nn.ModuleList(), _nn.ModuleList()
        for number in range(SCALES):
            narrow, wide = width << number, width << (number + 1)
            conv = ConvLayer(narrow, wide, side, stride=2, has_norm=has_norm)
            down = {"conv": conv, "recurrent_block": ConvLstm(wide)}
            self.DownsampleConv.append(_nn.ModuleDict(down))
            up = UpsampleLayer(wide, narrow, side, has_norm=has_norm)
            self.UpsampleConv.insert(0, up)
        for scale in range(SCALES):
            if scale:
                split = _nn.Conv2d(features >> scale, features, 2**scale, stride=2**scale)
                setattr(self, f"split{scale}", split)
            for kind, layer, depth in zip(
                ("encoder", "decoder"), (EncoderLayer, DecoderLayer), depths, strict=True
            ):
                layers = _nn.ModuleList(layer(features) for _ in range(depth))
                tree = _nn.ModuleDict({kind: _nn.ModuleDict({"layers": layers})})
                setattr(self, f"trans_{kind}{scale}", tree)
        self.pred = ConvLayer(width, 1, 1, has_norm=has_norm)
        self.reset()

    @classmethod
    def like(cls, found: Mapping[str, Shape], settings: Mapping[str, Any]) -> EtNet:
        """See `RecurrentNetwork`."""
        del settings
        width, bins, side, _ = found.get("head.conv2d.weight", PUBLISHED_HEAD)
        depths = (
            count_blocks(found, "trans_encoder0.encoder.layers") or PUBLISHED_ENCODER_LAYERS,
            count_blocks(found, "trans_decoder0.decoder.layers") or PUBLISHED_DECODER_LAYERS,
        )
        has_norm = "head.norm_layer.weight" in found
        return cls(width, bins, side, has_norm=has_norm, depths=depths)

    def reset(self) -> None:
        """See `RecurrentNetwork`."""
        self._states: list[tuple[Tensor, Tensor] | None] = [None] * SCALES

    def step(self, voxel: Tensor) -> Tensor:
        """See `RecurrentNetwork`."""
        head = x = self.head(voxel).relu()
        skipped, states = [], []
        for down, state in zip(self.DownsampleConv, self._states, strict=True):
            state = down["recurrent_block"](down["conv"](x).relu(), state)
            x = state[0]
            states.append(state)
            skipped.append(x)
        self._states = states
        x = self._transform(skipped)
        for up in self.UpsampleConv:
            x = up(x + skipped.pop())
        return self.pred(x + head).sigmoid()

    def _transform(self, maps: list[Tensor]) -> Tensor:
        """The middle of the network from the encoders' outputs, of the last one's shape."""
        height, width = maps[-1].shape[-2:]
        encoded: list[Tensor] = []
        for scale, image in enumerate(reversed(maps)):
            image = getattr(self, f"split{scale}")(image) if scale else image
            tokens = image[0].flatten(1).T
            tokens = tokens + _encode_positions(tokens)
            for layer in getattr(self, f"trans_encoder{scale}")["encoder"]["layers"]:
                tokens = layer(tokens)
            encoded.append(tokens)
        total = encoded[0] + encoded[1] + encoded[2]
        for scale in range(SCALES):
            tokens, memory = encoded[scale], encoded[max(scale - 1, 0)]
            for layer in getattr(self, f"trans_decoder{scale}")["decoder"]["layers"]:
                tokens = layer(tokens, memory)
            total = total + tokens
        return (total / (2 * SCALES)).T.unflatten(1, (height, width))[None]


def _encode_positions(tokens: Tensor) -> Tensor:
    """Position of each token, as sines (even features) and cosines (odd ones)."""
    count, features = tokens.shape
    feature = np.arange(features)
    rate = WAVELENGTH ** (-2.0 * (feature // 2) / features)
    angle = np.arange(count)[:, None] * rate
    table = np.where(feature % 2 == 0, np.sin(angle), np.cos(angle))
    return _torch.from_numpy(table.astype(np.float32)).to(tokens.device)
