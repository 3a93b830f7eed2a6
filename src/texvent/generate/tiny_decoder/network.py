"""A tiny video decoder: latents to frames, one at a time, in memory that does not grow.

    decoder = read_tiny_decoder(Path("taew2_1.safetensors"))
    for frame in decoder.frames(latents):      # latents [C, T, h, w] as the model denoises them
        ...                                    # [H, W, 3] float32, 0..1

The latents are those of the diffusion model itself, without the scale and shift that its full
decoder wants. Nothing but the frame before is remembered, in every memory block.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import FileFormatError, InputError
from texvent.generate.tiny_decoder.layout import (
    BLOCKS,
    FIRST,
    OUTPUT,
    STAGES,
    TinyLayout,
    read_layout,
)
from texvent.generate.video_models.weight_files import check_safetensors
from texvent.networks.weight_files import (
    SAFETENSORS,
    Tensor,
    check_finite,
    describe_mismatch,
    named_tensors,
    read_mapping,
    shapes_of,
)

EXTRA = "generate"
PART = "decoder."
"""Tensors of the file that are read; `encoder.` is left out."""
WHERE_FROM = (
    "published tiny decoders are taehv, taehv1_5, taew2_1, taew2_2, taecvx and taeltx of "
    "github.com/madebyollin/taehv"
)
LARGEST_LATENT = 3.0
"""The network takes no values beyond: x becomes 3 tanh(x/3)."""


class TinyDecoder:
    """The network, in float32: half precision would round frames to steps that make events.

    Args:
        layout: which shape.
        tensors: the names of `layout.tensor_shapes()`, float32; they decide the device.
    """

    def __init__(self, layout: TinyLayout, tensors: Mapping[str, Tensor]) -> None:
        self.layout = layout
        self._tensors = dict(tensors)

    def to(self, device: str) -> TinyDecoder:
        """The same decoder on a torch device, such as "cuda"."""
        moved = {name: tensor.to(device) for name, tensor in self._tensors.items()}
        return TinyDecoder(self.layout, moved)

    def frames(self, latents: Any, *, pads_start: bool = False) -> Iterator[NDArray[np.float32]]:
        """Frames in time order, decoded as they are asked for.

        Args:
            latents: [C, T, h, w], NumPy array or torch tensor, as the model denoises them.
            pads_start: True for CogVideoX, whose latents stand for whole groups of frames when
                their number is even. Otherwise the first latent frame gives one frame.

        Yields:
            [H, W, 3] float32 RGB, 0..1.

        Raises:
            InputError: the latents have another number of channels.
        """
        torch = require("torch", extra=EXTRA)
        weight = self._tensors[f"{OUTPUT}.weight"]
        values = torch.as_tensor(latents).to(weight.device, torch.float32)
        if values.ndim != 4 or len(values) != self.layout.latent_channels:
            raise InputError(
                f"the latents have the shape {list(values.shape)}; this decoder takes "
                f"[{self.layout.latent_channels}, T, h, w]"
            )
        is_whole = pads_start and values.shape[1] % 2 == 0
        surplus = 0 if is_whole else self.layout.frames_per_latent - 1
        return self._frames(values, surplus)

    def _frames(self, values: Tensor, surplus: int) -> Iterator[NDArray[np.float32]]:
        torch = require("torch", extra=EXTRA)
        steps = self._decode(values[None, :, index] for index in range(values.shape[1]))
        for number in itertools.count():
            # Around every step, not around the generator: that would switch gradients off in the
            # code that consumes it.
            with torch.no_grad():
                frame = next(steps, None)
            if frame is None:
                return
            if number >= surplus:
                yield frame[0].permute(1, 2, 0).cpu().numpy()

    def _decode(self, latents: Iterable[Tensor]) -> Iterator[Tensor]:
        """Frames [1, 3, H, W], 0..1, of latent frames [1, C, h, w]; each layer is a generator."""
        frames: Iterable[Tensor] = map(self._enter, latents)
        for stage in range(STAGES):
            for number in range(BLOCKS):
                frames = self._remember(frames, f"{self.layout.block(stage, number)}.conv")
            frames = map(functools.partial(self._enlarge, stage=stage), frames)
            frames = self._grow(frames, stage)
            if not self.layout.is_super:
                name = self.layout.widening(stage)
                frames = map(functools.partial(self._convolve, name=name), frames)
        return map(self._leave, frames)

    def _enter(self, latent: Tensor) -> Tensor:
        name = FIRST[self.layout.is_super]
        if self.layout.is_super:
            return self._convolve(latent, name)
        bounded = (latent / LARGEST_LATENT).tanh() * LARGEST_LATENT
        return self._convolve(bounded, name).relu()

    def _remember(self, frames: Iterable[Tensor], name: str) -> Iterator[Tensor]:
        """A memory block: every frame is seen beside the one before, the first beside zeros."""
        torch = require("torch", extra=EXTRA)
        before = None
        for frame in frames:
            both = torch.cat((frame, torch.zeros_like(frame) if before is None else before), 1)
            if self.layout.is_super:
                inner = self._convolve(both, f"{name}.0", groups=both.shape[1])
                inner = self._convolve(inner, f"{name}.1").relu()
                yield self._convolve(inner, f"{name}.3") + frame
            else:
                inner = self._convolve(both, f"{name}.0").relu()
                inner = self._convolve(inner, f"{name}.2").relu()
                yield (self._convolve(inner, f"{name}.4") + frame).relu()
            before = frame

    def _enlarge(self, frame: Tensor, stage: int) -> Tensor:
        """Twice the width and height."""
        functional = require("torch.nn.functional", extra=EXTRA)
        if not self.layout.is_super:
            return functional.interpolate(frame, scale_factor=2)
        wide = self._convolve(frame, self.layout.widening(stage)).relu()
        return functional.pixel_shuffle(wide, 2)

    def _grow(self, frames: Iterable[Tensor], stage: int) -> Iterator[Tensor]:
        """One or two frames of each."""
        for frame in frames:
            grown = self._convolve(frame, self.layout.growth(stage))
            yield from grown.chunk(self.layout.growths[stage], 1)

    def _leave(self, frame: Tensor) -> Tensor:
        functional = require("torch.nn.functional", extra=EXTRA)
        image = self._convolve(frame if self.layout.is_super else frame.relu(), OUTPUT)
        return functional.pixel_shuffle(image, self.layout.patch).clamp(0, 1)

    def _convolve(self, frame: Tensor, name: str, groups: int = 1) -> Tensor:
        functional = require("torch.nn.functional", extra=EXTRA)
        weight = self._tensors[f"{name}.weight"]
        bias = self._tensors.get(f"{name}.bias")
        return functional.conv2d(frame, weight, bias, padding=weight.shape[-1] // 2, groups=groups)


def read_tiny_decoder(path: Path) -> TinyDecoder:
    """A decoder from a published file, on the CPU.

    Args:
        path: `.safetensors`, or the torch state dict `.pth`, of which no code is run.

    Raises:
        FileFormatError: the file is damaged or holds another network.
        MissingDependencyError: torch or safetensors is not installed.
    """
    if path.suffix == SAFETENSORS:
        check_safetensors(path)
    tensors = named_tensors(read_mapping(path, WHERE_FROM, extra=EXTRA), extra=EXTRA)
    inner = {name: tensor for name, tensor in tensors.items() if name.startswith(PART)}
    shapes = shapes_of(inner)
    layout = read_layout(shapes)
    problem = (
        "holds no tiny video decoder"
        if layout is None
        else describe_mismatch(shapes, layout.tensor_shapes())
    )
    if layout is None or problem is not None:
        raise FileFormatError(f"{path} {problem}; {WHERE_FROM}")
    check_finite(inner, path)
    return TinyDecoder(layout, inner)
