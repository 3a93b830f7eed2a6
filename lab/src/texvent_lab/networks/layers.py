"""Layers that several networks of the laboratory are made of, named as in their published files."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

from texvent.extending import require
from texvent.networks import (
    BATCH_COUNTER,
    Shape,
    Tensor,
    load_strictly,
    state_tensors,
)
from texvent_lab.networks import EXTRA

_torch: Any = require("torch", extra=EXTRA)
_nn: Any = require("torch.nn", extra=EXTRA)
_Module: Any = _nn.Module
Made = TypeVar("Made")


class Network(_Module):
    """A module whose parameters have the names of the published files."""

    @property
    def tensors(self) -> dict[str, Tensor]:
        """Name → parameter or buffer, batch counters left out."""
        state = self.state_dict(keep_vars=True)
        return {name: one for name, one in state.items() if not name.endswith(BATCH_COUNTER)}

    def read(self, content: Mapping[str, Any], path: Path, where_from: str) -> None:
        """Take over the tensors of a checkpoint.

        Args:
            content: of the file; see `state_tensors`.
            path: of the file, for messages.
            where_from: where to get the right file, for messages.

        Raises:
            FileFormatError: a tensor is missing, unknown, of another shape, NaN or infinite.
        """
        found = state_tensors(content, path, where_from, extra=EXTRA)
        load_strictly(self, found, path, where_from)


def make_seeded(make: Callable[[], Made], seed: int) -> Made:
    """A network with torch's initial weights for a seed; other draws of torch are not disturbed."""
    with _torch.random.fork_rng(devices=[]):
        _torch.manual_seed(seed)
        return make()


def count_blocks(shapes: Mapping[str, Shape], prefix: str) -> int:
    """Number of blocks `prefix.0.`, `prefix.1.`, ... among the names of tensors."""
    number = 0
    while any(name.startswith(f"{prefix}.{number}.") for name in shapes):
        number += 1
    return number


class ConvLayer(_Module):
    """A convolution, and a batch normalisation that takes the place of its bias if it has one."""

    def __init__(
        self, narrow: int, wide: int, side: int, *, stride: int = 1, has_norm: bool = False
    ) -> None:
        super().__init__()
        self.conv2d = _nn.Conv2d(
            narrow, wide, side, stride=stride, padding=side // 2, bias=not has_norm
        )
        self.norm_layer = _nn.BatchNorm2d(wide) if has_norm else _nn.Identity()

    def forward(self, x: Tensor) -> Tensor:
        """Without activation."""
        return self.norm_layer(self.conv2d(x))


class UpsampleLayer(ConvLayer):
    """Bilinear interpolation to twice the size, convolution, ReLU."""

    def forward(self, x: Tensor) -> Tensor:
        """Twice the size."""
        x = _nn.functional.interpolate(x, scale_factor=2, mode="bilinear", align_corners=False)
        return super().forward(x).relu()


class ResidualBlock(_Module):
    """Convolution, ReLU, convolution, plus the input, ReLU."""

    def __init__(self, channels: int, *, has_norm: bool = False) -> None:
        super().__init__()
        for number in (1, 2):
            convolution = _nn.Conv2d(channels, channels, 3, padding=1, bias=not has_norm)
            setattr(self, f"conv{number}", convolution)
            setattr(self, f"bn{number}", _nn.BatchNorm2d(channels) if has_norm else _nn.Identity())

    def forward(self, x: Tensor) -> Tensor:
        """The same size and channels."""
        inner = self.bn1(self.conv1(x)).relu()
        return (self.bn2(self.conv2(inner)) + x).relu()


class ConvGru(_Module):
    """Convolutional gated recurrent unit; its state is also its output."""

    def __init__(self, channels: int, side: int = 3) -> None:
        super().__init__()
        for gate in ("reset_gate", "update_gate", "out_gate"):
            setattr(self, gate, _nn.Conv2d(2 * channels, channels, side, padding=side // 2))

    def forward(self, x: Tensor, state: Tensor | None) -> Tensor:
        """The new state; None is the state of a network that has seen nothing."""
        state = _torch.zeros_like(x) if state is None else state
        both = _torch.cat([x, state], 1)
        update, reset = self.update_gate(both).sigmoid(), self.reset_gate(both).sigmoid()
        candidate = self.out_gate(_torch.cat([x, state * reset], 1)).tanh()
        return state * (1 - update) + candidate * update


class ConvLstm(_Module):
    """Convolutional long short-term memory."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.Gates = _nn.Conv2d(2 * channels, 4 * channels, 3, padding=1)

    def forward(self, x: Tensor, state: tuple[Tensor, Tensor] | None) -> tuple[Tensor, Tensor]:
        """The new output and cell."""
        hidden, cell = (_torch.zeros_like(x),) * 2 if state is None else state
        enter, remember, leave, candidate = self.Gates(_torch.cat([x, hidden], 1)).chunk(4, 1)
        cell = remember.sigmoid() * cell + enter.sigmoid() * candidate.tanh()
        return leave.sigmoid() * cell.tanh(), cell


class RecurrentLayer(_Module):
    """Convolution to half the size, ReLU, long short-term memory."""

    def __init__(self, narrow: int, wide: int, side: int, *, has_norm: bool = False) -> None:
        super().__init__()
        self.conv = ConvLayer(narrow, wide, side, stride=2, has_norm=has_norm)
        self.recurrent_block = ConvLstm(wide)

    def forward(self, x: Tensor, state: tuple[Tensor, Tensor] | None) -> tuple[Tensor, Tensor]:
        """The new output and cell."""
        hidden, cell = self.recurrent_block(self.conv(x).relu(), state)
        return hidden, cell
