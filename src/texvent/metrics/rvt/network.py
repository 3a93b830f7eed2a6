"""RVT's backbone for inference: a stacked histogram in, the features of its stages out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import ModuleType
from typing import Any

import numpy as np

from texvent._require import require
from texvent.metrics.rvt.latent_similarity import Features
from texvent.metrics.rvt.layout import ATTENTIONS, STRIDES, RvtLayout, kernel_side
from texvent.metrics.rvt.weights import EXTRA, RvtWeights
from texvent.networks.weight_files import Tensor

PARTITION_PX = 64
"""The image is padded to a multiple of this; attention works on parts of (height / 64,
width / 64) pixels of a feature map, as RVT's configuration chooses them."""
NORM_FLOOR = 1e-5


class RvtBackbone:
    """Four stages of convolution, attention and LSTM; only the first stages may be run.

    Each stage reduces the image, lets the pixels of a window attend to each other (MaxViT's block
    attention), then pixels spread evenly over the image (grid attention), and feeds an LSTM whose
    output is both the stage's features and the next stage's input. The LSTM starts empty at every
    call, so that a window's features do not depend on what was seen before.
    """

    def __init__(self, weights: RvtWeights, *, stages: int = 3) -> None:
        """A backbone with its weights, on the CPU: a score must not depend on the machine.

        Args:
            weights: see `rvt_weights.read_rvt_weights`.
            stages: how many to run, 1..4.
        """
        self._layout: RvtLayout = weights.layout
        self._tensors: Mapping[str, Tensor] = weights.tensors
        self._stages = stages

    @property
    def _torch(self) -> ModuleType:
        # Not kept as an attribute: a module cannot be copied, a metric can.
        return require("torch", extra=EXTRA)

    def __call__(self, histogram: Features) -> Sequence[Features]:
        """Features of every stage.

        The image is padded with zeros to the right and below; features of that padding, which
        would be alike for all events, are cut off.

        Args:
            histogram: [20, H, W] float32.

        Returns:
            [C, ceil(H / s), ceil(W / s)] float32 per stage, s its stride: 4, 8, 16.
        """
        torch = self._torch
        height, width = histogram.shape[1:]
        below, right = -height % PARTITION_PX, -width % PARTITION_PX
        x = torch.from_numpy(np.ascontiguousarray(histogram))[None]
        x = torch.nn.functional.pad(x, (0, right, 0, below))
        partition = (x.shape[2] // PARTITION_PX, x.shape[3] // PARTITION_PX)
        found, stride = [], 1
        with torch.inference_mode():
            for stage in range(self._stages):
                x = self._run_stage(x, stage, partition)
                stride *= STRIDES[stage]
                kept = x[0, :, : -(-height // stride), : -(-width // stride)]
                found.append(np.asarray(kept.numpy(), np.float32))
        return found

    def _run_stage(self, x: Tensor, stage: int, partition: tuple[int, int]) -> Tensor:
        """[1, C, H, W] to [1, C', H / stride, W / stride]."""
        at, stride = f"stages.{stage}", STRIDES[stage]
        x = self._torch.nn.functional.conv2d(
            x,
            self._tensors[f"{at}.downsample_cf2cl.conv.weight"],
            stride=stride,
            padding=kernel_side(stride) // 2,
        )
        x = self._normalise(x.permute(0, 2, 3, 1), f"{at}.downsample_cf2cl.norm")
        for part in ATTENTIONS:
            name = f"{at}.att_blocks.0.{part}"
            inner = x if part == "att_window" else self._normalise(x, f"{name}.norm1")
            attended = self._attend(inner, f"{name}.self_attn", partition, part)
            x = x + self._tensors[f"{name}.ls1.gamma"] * attended
            inner = self._linear(self._normalise(x, f"{name}.norm2"), f"{name}.mlp.net.0.0")
            inner = self._linear(self._torch.nn.functional.gelu(inner), f"{name}.mlp.net.2")
            x = x + self._tensors[f"{name}.ls2.gamma"] * inner
        return self._remember(x.permute(0, 3, 1, 2), f"{at}.lstm.conv1x1")

    def _attend(self, x: Tensor, name: str, partition: tuple[int, int], part: str) -> Tensor:
        """Self-attention within the parts of a map [1, H, W, C]."""
        parts = _split_windows(x, partition) if part == "att_window" else _split_grid(x, partition)
        rows, down, columns, across, channels = parts.shape
        heads = channels // self._layout.head_channels
        # A part's pixels as one axis: [parts, pixels, C].
        flat = parts.permute(0, 2, 1, 3, 4).reshape(rows * columns, down * across, channels)
        mixed = self._linear(flat, f"{name}.qkv").unflatten(2, (heads, -1)).transpose(1, 2)
        query, key, value = mixed.chunk(3, dim=3)
        seen = self._torch.nn.functional.scaled_dot_product_attention(query, key, value)
        out = self._linear(seen.transpose(1, 2).flatten(2), f"{name}.proj")
        out = out.reshape(rows, columns, down, across, channels).permute(0, 2, 1, 3, 4)
        return _join_windows(out) if part == "att_window" else _join_grid(out)

    def _remember(self, x: Tensor, name: str) -> Tensor:
        """The LSTM's output after its first step, from [1, C, H, W]; its state is zero before."""
        torch, channels = self._torch, x.shape[1]
        weight = self._tensors[f"{name}.weight"][:, :channels]
        mixed = torch.nn.functional.conv2d(x, weight, self._tensors[f"{name}.bias"])
        # Nothing is remembered yet, so nothing can be forgotten.
        _, let_in, let_out, content = mixed.chunk(4, dim=1)
        cell = torch.sigmoid(let_in) * torch.tanh(content)
        return torch.sigmoid(let_out) * torch.tanh(cell)

    def _linear(self, x: Tensor, name: str) -> Tensor:
        return self._torch.nn.functional.linear(
            x, self._tensors[f"{name}.weight"], self._tensors[f"{name}.bias"]
        )

    def _normalise(self, x: Tensor, name: str) -> Tensor:
        parts: tuple[Any, ...] = tuple(self._tensors[f"{name}.{one}"] for one in ("weight", "bias"))
        return self._torch.nn.functional.layer_norm(x, x.shape[-1:], *parts, eps=NORM_FLOOR)


def _split_windows(x: Tensor, partition: tuple[int, int]) -> Tensor:
    """[1, H, W, C] to [rows, down, columns, across, C]: parts are neighbouring pixels."""
    _, height, width, channels = x.shape
    down, across = partition
    return x.reshape(height // down, down, width // across, across, channels)


def _join_windows(parts: Tensor) -> Tensor:
    rows, down, columns, across, channels = parts.shape
    return parts.reshape(1, rows * down, columns * across, channels)


def _split_grid(x: Tensor, partition: tuple[int, int]) -> Tensor:
    """[1, H, W, C] to [rows, down, columns, across, C]: parts are spread over the whole map."""
    _, height, width, channels = x.shape
    down, across = partition
    split = x.reshape(down, height // down, across, width // across, channels)
    return split.permute(1, 0, 3, 2, 4)


def _join_grid(parts: Tensor) -> Tensor:
    rows, down, columns, across, channels = parts.shape
    return parts.permute(1, 0, 3, 2, 4).reshape(1, down * rows, across * columns, channels)
