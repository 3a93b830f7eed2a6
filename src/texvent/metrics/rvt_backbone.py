"""RVT's backbone: its three published sizes, and the tensors that its checkpoint holds.

Source: M. Gehrig, D. Scaramuzza, "Recurrent vision transformers for object detection with event
cameras" (CVPR 2023), and the configurations released with it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import FileFormatError, InputError
from texvent.networks.layer_shapes import Shapes, layer_norm, linear
from texvent.networks.weight_files import (
    Tensor,
    check_finite,
    describe_mismatch,
    named_tensors,
    read_mapping,
    shapes_of,
)

Features: TypeAlias = NDArray[np.float32]

INPUT_CHANNELS = 20
"""Of the stacked histogram: 2 polarities of 10 bins."""
STRIDES = (4, 2, 2, 2)
"""By how much each stage reduces the image it is given."""
MLP_RATIO = 4
ATTENTIONS = ("att_window", "att_grid")
"""Parts of a stage, in order: attention inside a window, then across the image."""
GATES = 4
"""Of the LSTM: forget, input, output, and the new content."""


@dataclass(frozen=True)
class RvtLayout:
    """One size of the backbone."""

    name: str
    embed_channels: int
    """Channels of the first stage; each later one has twice as many."""
    head_channels: int
    """Channels of one attention head."""

    def channels(self, stage: int) -> int:
        """Channels of a stage, 0..3."""
        return int(self.embed_channels * 2**stage)

    def tensor_shapes(self) -> Shapes:
        """Name → shape of every tensor of the four stages, without the checkpoint's prefix."""
        shapes: Shapes = {}
        channels_in = INPUT_CHANNELS
        for stage, stride in enumerate(STRIDES):
            width, at = self.channels(stage), f"stages.{stage}"
            side = kernel_side(stride)
            shapes[f"{at}.downsample_cf2cl.conv.weight"] = (width, channels_in, side, side)
            shapes |= layer_norm(f"{at}.downsample_cf2cl.norm", width)
            for part in ATTENTIONS:
                shapes |= _attention_shapes(f"{at}.att_blocks.0.{part}", width)
            shapes[f"{at}.lstm.conv1x1.weight"] = (GATES * width, 2 * width, 1, 1)
            shapes[f"{at}.lstm.conv1x1.bias"] = (GATES * width,)
            channels_in = width
        return shapes


def kernel_side(stride: int) -> int:
    """Side of the convolution that reduces by `stride`: neighbours overlap."""
    return 2 * (stride - 1) + 1


def _attention_shapes(at: str, width: int) -> Shapes:
    shapes: Shapes = {}
    if at.endswith("att_grid"):
        # The window's input is normalised already, by the layer before.
        shapes |= layer_norm(f"{at}.norm1", width)
    shapes |= linear(f"{at}.self_attn.qkv", 3 * width, width)
    shapes |= linear(f"{at}.self_attn.proj", width, width)
    shapes[f"{at}.ls1.gamma"] = (width,)
    shapes |= layer_norm(f"{at}.norm2", width)
    shapes |= linear(f"{at}.mlp.net.0.0", MLP_RATIO * width, width)
    shapes |= linear(f"{at}.mlp.net.2", width, MLP_RATIO * width)
    shapes[f"{at}.ls2.gamma"] = (width,)
    return shapes


LAYOUTS: tuple[RvtLayout, ...] = (
    RvtLayout("rvt-t", 32, 32),
    RvtLayout("rvt-s", 48, 24),
    RvtLayout("rvt-b", 64, 32),
)


EXTRA = "torch"
"""The texvent extra that brings torch."""
PREFIX = "mdl.backbone."
"""Before the backbone's names in a checkpoint of the whole detector."""
FIRST_TENSOR = "stages.0.downsample_cf2cl.conv.weight"
WHERE_FROM = (
    "the published files are rvt-t.ckpt, rvt-s.ckpt and rvt-b.ckpt, to which the project "
    "uzh-rpg/RVT on GitHub links"
)


@dataclass(frozen=True, eq=False)
class RvtWeights:
    """The tensors of one backbone."""

    layout: RvtLayout
    tensors: Mapping[str, Tensor]
    """Names of `layout.tensor_shapes()` → tensor, float32, on the CPU."""


def read_rvt_weights(path: Path) -> RvtWeights:
    """The backbone's weights from a published checkpoint.

    Args:
        path: `rvt-t.ckpt`, `rvt-s.ckpt` or `rvt-b.ckpt`, trained on Gen1 or on 1 Mpx; which one is
            recognised from its tensors.

    Raises:
        InputError: there is no such file.
        FileFormatError: the file is damaged, or a tensor is missing, unknown or of another shape.
        MissingDependencyError: torch is not installed.
    """
    if not path.is_file():
        raise InputError(f"there is no weights file {path}; {WHERE_FROM}")
    state = read_mapping(path, WHERE_FROM, extra=EXTRA).get("state_dict")
    if not isinstance(state, Mapping):
        raise FileFormatError(f"{path} holds no state_dict; it is not RVT's: {WHERE_FROM}")
    tensors = {
        name.removeprefix(PREFIX): tensor
        for name, tensor in named_tensors(state, extra=EXTRA).items()
        if name.startswith(PREFIX)
    }
    layout = _recognise_layout(tensors, path)
    problem = describe_mismatch(shapes_of(tensors), layout.tensor_shapes())
    if problem is not None:
        raise FileFormatError(f"{path} is not {layout.name}: {PREFIX[:-1]} {problem}; {WHERE_FROM}")
    check_finite(tensors, path)
    return RvtWeights(layout, tensors)


def _recognise_layout(tensors: Mapping[str, Tensor], path: Path) -> RvtLayout:
    if FIRST_TENSOR not in tensors:
        raise FileFormatError(
            f"{path} has no tensor {PREFIX}{FIRST_TENSOR}; it is not RVT's: {WHERE_FROM}"
        )
    width = tensors[FIRST_TENSOR].shape[0]
    for layout in LAYOUTS:
        if layout.embed_channels == width:
            return layout
    sizes = ", ".join(f"{one.embed_channels} ({one.name})" for one in LAYOUTS)
    raise FileFormatError(
        f"{path} is of a backbone with {width} channels in its first stage; known are {sizes}. "
        f"{WHERE_FROM}"
    )


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
