"""ET-Net: a U-Net with memory whose middle is a transformer over three scales."""

from __future__ import annotations

import operator
from collections.abc import Mapping
from typing import Any

from texvent.extending import require
from texvent.networks import Shape, Tensor
from texvent_lab.networks import EXTRA
from texvent_lab.networks.layers import ConvLayer, RecurrentLayer, UpsampleLayer
from texvent_lab.reconstruct.recurrent_network import EVREAL, PublishedNetwork
from texvent_lab.reconstruct.recurrent_unet import PUBLISHED_HEAD, RecurrentUNet

_torch: Any = require("torch", extra=EXTRA)
_nn: Any = require("torch.nn", extra=EXTRA)

SCALES = 3
HEADS, DROPOUT, WAVELENGTH = 8, 0.1, 10_000.0
ENCODER_LAYERS, DECODER_LAYERS = 3, 2
"""Layers of the transformer at each scale."""


class EtNet(RecurrentUNet):
    """ET-Net: three encoders, a transformer, three decoders.

    The encoders' outputs become tokens of equal number: one per 8×8 px. Each scale is encoded by
    itself; then the coarsest is decoded from itself, and each finer one from the one before. The
    mean of all six is the middle.

    Source: W. Weng, Y. Zhang, Z. Xiong, "Event-based video reconstruction using transformer", ICCV
        2021, section 3, and its program.
    """

    multiple = 2**SCALES

    def __init__(self, head: Shape = PUBLISHED_HEAD, *, has_norm: bool = False) -> None:
        """Random weights, for a first kernel of that shape and biases or batch normalisation."""
        super().__init__()
        width, self.bins, side, _ = head
        wide, norm = width << SCALES, {"has_norm": has_norm}
        pairs = [(width << number, width << (number + 1)) for number in range(SCALES)]
        self.head = ConvLayer(self.bins, width, side, **norm)
        down = (RecurrentLayer(*pair, side, **norm) for pair in pairs)
        self.DownsampleConv = _nn.ModuleList(down)
        for scale in range(SCALES):
            step = 2**scale
            split = _nn.Conv2d(wide // step, wide, step, stride=step) if scale else _nn.Identity()
            setattr(self, f"split{scale}", split)
            encoder = [_encoder_layer(wide) for _ in range(ENCODER_LAYERS)]
            decoder = [DecoderLayer(wide) for _ in range(DECODER_LAYERS)]
            for kind, layers in (("encoder", encoder), ("decoder", decoder)):
                stack = _nn.ModuleDict({"layers": _nn.ModuleList(layers)})
                setattr(self, f"trans_{kind}{scale}", _nn.ModuleDict({kind: stack}))
        up = (UpsampleLayer(*pair[::-1], side, **norm) for pair in reversed(pairs))
        self.UpsampleConv = _nn.ModuleList(up)
        self.pred = ConvLayer(width, 1, 1, **norm)
        self.reset()

    @classmethod
    def like(cls, found: Mapping[str, Shape], settings: Mapping[str, Any]) -> EtNet:
        """See `RecurrentNetwork`."""
        del settings
        head = found.get("head.conv2d.weight", PUBLISHED_HEAD)
        return cls(head, has_norm="head.norm_layer.weight" in found)

    def _layers(self) -> tuple[Any, Any, Any, Any]:
        return self.head, self.DownsampleConv, self.UpsampleConv, self.pred

    def _middle(self, maps: list[Tensor]) -> Tensor:
        encoded: list[Tensor] = []
        for scale, image in enumerate(reversed(maps)):
            tokens = getattr(self, f"split{scale}")(image).flatten(2).permute(2, 0, 1)
            tokens = tokens + _places(tokens)[:, None]
            for layer in self._stack("encoder", scale):
                tokens = layer(tokens)
            encoded.append(tokens)
        total: Tensor = sum(encoded)
        for scale, tokens in enumerate(encoded):
            for layer in self._stack("decoder", scale):
                tokens = layer(tokens, encoded[max(scale - 1, 0)])
            total = total + tokens
        mean = total / (2 * SCALES)
        return mean.permute(1, 2, 0).unflatten(2, maps[-1].shape[-2:])

    def _stack(self, kind: str, scale: int) -> Any:
        return getattr(self, f"trans_{kind}{scale}")[kind]["layers"]


class DecoderLayer(_nn.TransformerDecoderLayer):
    """torch's layer under the published names, with a normalisation of the memory."""

    multihead_attn, norm2 = (property(operator.attrgetter(one)) for one in ("cross_attn", "norm21"))

    def __init__(self, features: int) -> None:
        super().__init__(features, HEADS, 4 * features, DROPOUT, norm_first=True)
        children = dict(self.named_children())
        self.cross_attn, self.norm21 = children["multihead_attn"], children["norm2"]
        del self.multihead_attn, self.norm2
        self.norm22 = _nn.LayerNorm(features)

    def forward(self, tokens: Tensor, memory: Tensor) -> Tensor:
        """Tokens of the same shape, [tokens, n, features]."""
        return super().forward(tokens, self.norm22(memory))


def _encoder_layer(features: int) -> Any:
    return _nn.TransformerEncoderLayer(features, HEADS, 4 * features, DROPOUT, norm_first=True)


def _places(tokens: Tensor) -> Tensor:
    """Place of each token as sines (even features) and cosines (odd ones), [tokens, features]."""
    count, _, features = tokens.shape
    feature = _torch.arange(features, device=tokens.device)
    angle = WAVELENGTH ** (-2.0 * (feature // 2) / features)
    angle = _torch.arange(count, device=tokens.device)[:, None] * angle
    return _torch.where(feature % 2 == 0, angle.sin(), angle.cos())


ET_NET = PublishedNetwork(
    "et-net", EtNet, f"{EVREAL.format('ET-Net')}, and WarranWeng/ET-Net links to it"
)
