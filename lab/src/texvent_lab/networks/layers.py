"""Layers of networks, computed from named tensors, and zeros around their inputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import ModuleType

from texvent.extending import require
from texvent.networks.weight_files import Tensor

EXTRA = "torch"
"""The texvent extra that brings torch."""


class Layers:
    """Named tensors of a network, and the layers that can be made of them.

    Images are [n, channels, H, W]; attention takes one alone. The layer's name selects its
    tensors; their shapes say how many channels and how large a kernel.
    """

    def __init__(self, tensors: Mapping[str, Tensor], *, is_training: bool = False) -> None:
        """Layers over tensors whose names and shapes have been checked.

        Args:
            tensors: name → tensor.
            is_training: whether normalisations take the statistics of the batch, and note them.
        """
        self._tensors = dict(tensors)
        self._is_training = is_training

    @property
    def torch(self) -> ModuleType:
        """The module; not kept as an attribute, which could not be copied."""
        return require("torch", extra=EXTRA)

    @property
    def device(self) -> str:
        """Where the tensors are."""
        return str(next(iter(self._tensors.values())).device)

    def __getitem__(self, name: str) -> Tensor:
        """The tensor of that name."""
        return self._tensors[name]

    def has(self, name: str) -> bool:
        """True if there is a tensor of that name."""
        return name in self._tensors

    def convolve(
        self, x: Tensor, name: str, *, stride: int = 1, padding: int | None = None
    ) -> Tensor:
        """A convolution; it keeps the size at stride 1 unless a padding is given."""
        weight, bias = self[f"{name}.weight"], self._tensors.get(f"{name}.bias")
        around = weight.shape[-1] // 2 if padding is None else padding
        return self.torch.nn.functional.conv2d(x, weight, bias, stride=stride, padding=around)

    def normalise(self, x: Tensor, name: str) -> Tensor:
        """Batch normalisation, if the network has it there."""
        if not self.has(f"{name}.running_mean"):
            return x
        parts = ("running_mean", "running_var", "weight", "bias")
        tensors = (self[f"{name}.{part}"] for part in parts)
        return self.torch.nn.functional.batch_norm(x, *tensors, training=self._is_training)

    def conv_layer(self, x: Tensor, name: str, *, stride: int = 1) -> Tensor:
        """Convolution and normalisation, without activation."""
        return self.normalise(
            self.convolve(x, f"{name}.conv2d", stride=stride), f"{name}.norm_layer"
        )

    def upsample_layer(self, x: Tensor, name: str) -> Tensor:
        """Twice the size, then ReLU: bilinear and a convolution, or a transposed convolution."""
        if self.has(f"{name}.transposed_conv2d.weight"):
            x = self._convolve_transposed(x, f"{name}.transposed_conv2d")
            return self.torch.relu(self.normalise(x, f"{name}.norm_layer"))
        return self.torch.relu(self.conv_layer(self.upsample(x), name))

    def upsample(self, x: Tensor) -> Tensor:
        """Twice the size, bilinear."""
        return self.torch.nn.functional.interpolate(
            x, scale_factor=2, mode="bilinear", align_corners=False
        )

    def residual_block(self, x: Tensor, name: str) -> Tensor:
        """Convolution, ReLU, convolution, plus the input, ReLU."""
        relu = self.torch.relu
        inner = relu(self.normalise(self.convolve(x, f"{name}.conv1"), f"{name}.bn1"))
        inner = self.normalise(self.convolve(inner, f"{name}.conv2"), f"{name}.bn2")
        return relu(inner + x)

    def conv_gru(self, x: Tensor, name: str, state: Tensor | None) -> Tensor:
        """New state of a convolutional gated recurrent unit, which is also its output."""
        torch = self.torch
        state = torch.zeros_like(x) if state is None else state
        both = torch.cat([x, state], 1)
        update = torch.sigmoid(self.convolve(both, f"{name}.update_gate"))
        reset = torch.sigmoid(self.convolve(both, f"{name}.reset_gate"))
        gated = torch.cat([x, state * reset], 1)
        return state * (1 - update) + torch.tanh(self.convolve(gated, f"{name}.out_gate")) * update

    def conv_lstm(
        self, x: Tensor, name: str, state: tuple[Tensor, Tensor] | None
    ) -> tuple[Tensor, Tensor]:
        """New output and cell of a convolutional long short-term memory."""
        torch = self.torch
        hidden, cell = (torch.zeros_like(x),) * 2 if state is None else state
        gates = self.convolve(torch.cat([x, hidden], 1), f"{name}.Gates").chunk(4, 1)
        enter, remember, leave = (torch.sigmoid(gate) for gate in gates[:3])
        cell = remember * cell + enter * torch.tanh(gates[3])
        return leave * torch.tanh(cell), cell

    def linear(self, x: Tensor, name: str) -> Tensor:
        """A fully connected layer over the last axis."""
        return self.torch.nn.functional.linear(x, self[f"{name}.weight"], self[f"{name}.bias"])

    def layer_norm(self, x: Tensor, name: str) -> Tensor:
        """Layer normalisation over the last axis."""
        weight, bias = self[f"{name}.weight"], self[f"{name}.bias"]
        return self.torch.nn.functional.layer_norm(x, weight.shape, weight, bias)

    def attention(self, queries: Tensor, memory: Tensor, name: str, *, heads: int) -> Tensor:
        """Multi-head attention of tokens [n, features] to tokens [m, features]."""
        functional = self.torch.nn.functional
        weights = self[f"{name}.in_proj_weight"].chunk(3)
        biases = self[f"{name}.in_proj_bias"].chunk(3)
        # [heads, n, features per head]
        parts = [
            functional.linear(x, weight, bias).unflatten(1, (heads, -1)).transpose(0, 1)
            for x, weight, bias in zip((queries, memory, memory), weights, biases, strict=True)
        ]
        mixed = functional.scaled_dot_product_attention(*(part[None] for part in parts))[0]
        return self.linear(mixed.transpose(0, 1).flatten(1), f"{name}.out_proj")

    def _convolve_transposed(self, x: Tensor, name: str) -> Tensor:
        weight, bias = self[f"{name}.weight"], self._tensors.get(f"{name}.bias")
        around = weight.shape[-1] // 2
        return self.torch.nn.functional.conv_transpose2d(
            x, weight, bias, stride=2, padding=around, output_padding=1
        )


@dataclass(frozen=True)
class Padding:
    """Rows and columns around an image."""

    left: int
    right: int
    top: int
    bottom: int

    @classmethod
    def centred(cls, shape: Sequence[int], multiple: int) -> Padding:
        """All around, one more above and left if odd, as the programs of E2VID and E2Depth do.

        Args:
            shape: (height, width) of the image, px.
            multiple: what both sides become multiples of, px.
        """
        below, right = (-side % multiple for side in shape)
        return cls(right - right // 2, right // 2, below - below // 2, below // 2)

    def around(self, image: Tensor, value: float = 0.0) -> Tensor:
        """The image, [..., H, W], with that value around it."""
        margins = (self.left, self.right, self.top, self.bottom)
        return require("torch", extra=EXTRA).nn.functional.pad(image, margins, value=value)

    def off(self, image: Tensor) -> Tensor:
        """The image, [..., H, W], without what `around` added."""
        height, width = image.shape[-2:]
        return image[..., self.top : height - self.bottom, self.left : width - self.right]
