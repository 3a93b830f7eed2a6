"""RVT's backbone, and the checkpoint that holds it. Needs torch to import.

Names of modules as in the published checkpoints; those of evlib's RVT, which `texvent train
detection` trains, are translated.

Source: M. Gehrig, D. Scaramuzza, "Recurrent vision transformers for object detection with event
cameras" (CVPR 2023), and the configurations released with it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import FileFormatError, shown
from texvent.networks import STATE, Tensor, load_strictly, named_tensors, read_mapping

EXTRA = "torch"
"""The texvent extra that brings torch."""
torch: Any = require("torch", extra=EXTRA)
nn: Any = torch.nn
_Module: Any = nn.Module
Features: TypeAlias = NDArray[np.float32]
"""[C, H, W]."""

INPUT_CHANNELS = 20
"""Channels of the stacked histogram: 2 polarities of 10 bins."""
STRIDES = (4, 2, 2, 2)
"""Reduction of the image by each stage."""
RUN_STAGES = 3
"""Stages whose features are compared."""
MLP_RATIO = 4
GATES = 4
"""Gates of the LSTM: forget, input, output, and the new content."""
HEAD_CHANNELS = {32: 32, 48: 24, 64: 32}
"""Channels of the first stage of RVT-T, RVT-S and RVT-B → channels of an attention head."""
PARTITION_PX = 64
"""The image is padded to a multiple of this; attention works on parts of (height / 64,
width / 64) pixels of a feature map, as RVT's configuration chooses them."""
PREFIX, OWN_PREFIX = "mdl.backbone.", "backbone."
"""Before the backbone's names in a checkpoint of the whole detector: published, evlib's."""
FIRST_TENSOR = "stages.0.downsample_cf2cl.conv.weight"
OWN_PARTITION_PX = 32
"""Instead of `PARTITION_PX` in the training of evlib's."""
BINNING, MOST_BINNING = "binning", 4
"""Entry of weights trained here: pixels along each side of a cell that the network saw."""
EVLIB_NAMES = (
    (r"attention_blocks\.(\d+)\.(window|grid)_attn", r"att_blocks.\1.att_\2"),
    (r"\.attn\.", ".self_attn."),
    (r"\.fc1\.", ".net.0.0."),
    (r"\.fc2\.", ".net.2."),
    (r"\.(ls[12])$", r".\1.gamma"),
)
"""Part of a name in evlib → that of the published checkpoints."""


def read_rvt(path: Path, where_from: str) -> RvtBackbone:
    """The backbone of a published checkpoint, or of weights trained here.

    Args:
        path: `rvt-t.ckpt`, `rvt-s.ckpt` or `rvt-b.ckpt`, trained on Gen1 or on 1 Mpx, or the
            `weights.pt` of `texvent train detection`; which one is recognised from its tensors.
        where_from: said in messages, where the published files are.

    Raises:
        FileFormatError: the file is damaged, or a tensor is missing, unknown or of another shape.
    """
    content = read_mapping(path, where_from, extra=EXTRA)
    state = content.get(STATE)
    if not isinstance(state, Mapping):
        raise FileFormatError(f"{path} holds no {STATE}; it is not RVT's: {where_from}")
    is_own = OWN_PREFIX + FIRST_TENSOR in state
    prefix = OWN_PREFIX if is_own else PREFIX
    tensors = {
        name.removeprefix(prefix): tensor
        for name, tensor in named_tensors(state, path, extra=EXTRA).items()
        if name.startswith(prefix)
    }
    width = tensors[FIRST_TENSOR].shape[0] if FIRST_TENSOR in tensors else 0
    if width not in HEAD_CHANNELS:
        raise FileFormatError(
            f"{path} has no tensor {prefix}{FIRST_TENSOR} of {', '.join(map(str, HEAD_CHANNELS))} "
            f"channels; it is not RVT's: {where_from}"
        )
    binning = content.get(BINNING) if is_own else 1
    if type(binning) is not int or not 1 <= binning <= MOST_BINNING:
        raise FileFormatError(
            f"{path} has evlib's names and {shown(binning)} as {BINNING}, 1 to {MOST_BINNING} px; "
            "give the weights.pt of texvent train detection"
        )
    if is_own:
        tensors = {_published_name(name): tensor for name, tensor in tensors.items()}
    with torch.device("meta"):
        backbone = RvtBackbone(width, HEAD_CHANNELS[width], binning=binning, is_own=is_own)
    load_strictly(backbone, tensors, path, where_from)
    return backbone


def _published_name(name: str) -> str:
    for part, published in EVLIB_NAMES:
        name = re.sub(part, published, name)
    return name


class RvtBackbone(_Module):
    """Four stages of convolution, attention and LSTM, of which the first three are run.

    Each stage reduces the image, lets the pixels of a window attend to each other (MaxViT's block
    attention), then pixels spread evenly over the image (grid attention), and feeds an LSTM whose
    output is both the stage's features and the next stage's input. The LSTM starts empty at every
    call, so that a window's features do not depend on what was seen before. It runs on the CPU: a
    score must not depend on the machine.
    """

    def __init__(
        self, width: int, head_channels: int, *, binning: int = 1, is_own: bool = False
    ) -> None:
        """Random weights.

        Args:
            width: channels of the first stage; each later one has twice as many.
            head_channels: channels of one attention head.
            binning: pixels along each side of a cell, whose counts are added.
            is_own: whether it is trained by `texvent train detection`.
        """
        super().__init__()
        self.binning, self.is_own = binning, is_own
        narrow = [INPUT_CHANNELS, *(width << stage for stage in range(len(STRIDES) - 1))]
        self.stages = nn.ModuleList(
            _Stage(channels, width << stage, stride, head_channels)
            for stage, (channels, stride) in enumerate(zip(narrow, STRIDES, strict=True))
        )

    def forward(self, histogram: Features) -> Sequence[Features]:
        """Features of the first three stages.

        The image is padded with zeros to the right and below; features of that padding, which
        would be alike for all events, are cut off.

        Args:
            histogram: [20, H, W] float32.

        Returns:
            [C, ceil(H / s), ceil(W / s)] float32 per stage, s its stride: 4, 8, 16 cells.
        """
        x = torch.from_numpy(np.ascontiguousarray(histogram))[None]
        if self.binning > 1:
            side = self.binning
            x = nn.functional.avg_pool2d(x, side, side, ceil_mode=True, divisor_override=1)
        height, width = x.shape[2:]
        part = OWN_PARTITION_PX if self.is_own else PARTITION_PX
        x = nn.functional.pad(x, (0, -width % part, 0, -height % part))
        partition = (x.shape[2] // part, x.shape[3] // part)
        found, stride = [], 1
        with torch.inference_mode():
            for stage, factor in zip(self.stages[:RUN_STAGES], STRIDES, strict=False):
                x = stage(x, partition)
                stride *= factor
                kept = x[0, :, : -(-height // stride), : -(-width // stride)]
                found.append(kept.numpy())
        return found


class _Stage(_Module):
    """Convolution, both attentions, LSTM."""

    def __init__(self, narrow: int, width: int, stride: int, head_channels: int) -> None:
        super().__init__()
        side = 2 * (stride - 1) + 1  # neighbours overlap
        convolution = nn.Conv2d(narrow, width, side, stride, side // 2, bias=False)
        norm = nn.LayerNorm(width)
        self.downsample_cf2cl = nn.ModuleDict({"conv": convolution, "norm": norm})
        parts = {
            "att_window": _Attention(width, head_channels, is_grid=False),
            "att_grid": _Attention(width, head_channels, is_grid=True),
        }
        self.att_blocks = nn.ModuleList([nn.ModuleDict(parts)])
        self.lstm = nn.ModuleDict({"conv1x1": nn.Conv2d(2 * width, GATES * width, 1)})

    def forward(self, x: Tensor, partition: tuple[int, int]) -> Tensor:
        """[1, C, H, W] to [1, C', H / s, W / s]."""
        x = self.downsample_cf2cl["conv"](x).permute(0, 2, 3, 1)
        x = self.downsample_cf2cl["norm"](x)
        for part in self.att_blocks[0].values():
            x = part(x, partition)
        return self._remember(x.permute(0, 3, 1, 2))

    def _remember(self, x: Tensor) -> Tensor:
        """The LSTM's output after its first step, from [1, C, H, W]; its state is zero before."""
        gates = self.lstm["conv1x1"]
        mixed = nn.functional.conv2d(x, gates.weight[:, : x.shape[1]], gates.bias)
        # Nothing is remembered yet, so nothing can be forgotten.
        _, let_in, let_out, content = mixed.chunk(4, dim=1)
        return let_out.sigmoid() * (let_in.sigmoid() * content.tanh()).tanh()


class _Scale(_Module):
    def __init__(self, width: int) -> None:
        super().__init__()
        self.gamma = nn.Parameter(torch.ones(width))


class _Attention(_Module):
    """Self-attention of the pixels of a part and a perceptron, both scaled and added."""

    def __init__(self, width: int, head_channels: int, *, is_grid: bool) -> None:
        super().__init__()
        self._is_grid, self._heads = is_grid, width // head_channels
        # The window's input is normalised already, by the layer before.
        self.norm1 = nn.LayerNorm(width) if is_grid else nn.Identity()
        layers = {"qkv": nn.Linear(width, 3 * width), "proj": nn.Linear(width, width)}
        self.self_attn = nn.ModuleDict(layers)
        self.ls1, self.ls2 = _Scale(width), _Scale(width)
        self.norm2 = nn.LayerNorm(width)
        inner = nn.Sequential(nn.Linear(width, MLP_RATIO * width), nn.GELU())
        outer = nn.Linear(MLP_RATIO * width, width)
        self.mlp = nn.ModuleDict({"net": nn.Sequential(inner, nn.Identity(), outer)})

    def forward(self, x: Tensor, partition: tuple[int, int]) -> Tensor:
        """[1, H, W, C] to the same shape."""
        x = x + self.ls1.gamma * self._attend(self.norm1(x), partition)
        return x + self.ls2.gamma * self.mlp["net"](self.norm2(x))

    def _attend(self, x: Tensor, partition: tuple[int, int]) -> Tensor:
        """Parts are neighbouring pixels, or pixels spread over the whole map with equal gaps."""
        _, height, width, channels = x.shape
        down, across = partition
        if self._is_grid:
            parts = x.reshape(down, height // down, across, width // across, channels)
            order = (1, 3, 0, 2, 4)
        else:
            parts = x.reshape(height // down, down, width // across, across, channels)
            order = (0, 2, 1, 3, 4)
        # A part's pixels as one axis: [parts, pixels, C].
        split = parts.permute(order)
        flat = split.flatten(2, 3).flatten(0, 1)
        mixed = self.self_attn["qkv"](flat).unflatten(2, (self._heads, -1)).transpose(1, 2)
        query, key, value = mixed.chunk(3, dim=3)
        seen = nn.functional.scaled_dot_product_attention(query, key, value)
        out = self.self_attn["proj"](seen.transpose(1, 2).flatten(2)).reshape(split.shape)
        back = [order.index(axis) for axis in range(len(order))]
        return out.permute(back).reshape(x.shape)
