"""IFNet, RIFE's network: from two images and an instant to the flow to both, and a mask.

A chain of blocks, coarse to fine; each refines the flow from the wanted instant to both frames and
a mask that mixes them. Modules have the names of the published tensors. Needs torch to import.

On a GPU the network runs in float16, all of its launches recorded once per size and then replayed:
at the sizes of video it waits for launches, not for arithmetic. Runs in several threads may share a
network: they take turns.

Source: Huang et al., Real-Time Intermediate Flow Estimation for Video Frame Interpolation (ECCV
2022), as released in Practical-RIFE 4.0, 4.6 and 4.25.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from texvent._require import require
from texvent.networks import Tensor
from texvent.runtime.devices import to_device

_one_records = threading.Lock()
"""Before it records, torch waits for the device, which CUDA refuses during another recording."""
WARM_UPS = 3
"""Runs before recording, in which libraries choose and set up what they need."""


class _Recording(NamedTuple):
    graph: Any
    images: tuple[Tensor, Tensor]
    """Read by the graph."""
    motion: IntermediateFlow
    """Written by it."""


def estimate_in_half(network: RifeNetwork, first: Tensor, second: Tensor, *at: Tensor) -> Any:
    """The motion of a pair by arithmetic in float16; arguments as of `RifeNetwork.forward`.

    Deviation: the flows differ from the float32 network's by the rounding of float16;
        `tests/interpolate/rife/test_half.py` bounds what that does to events.
    """
    # Without the cache: casts of the weights that lived on outside would not be replayed.
    with torch.autocast(first.device.type, torch.float16, cache_enabled=False):
        return network(first, second, *at)


class RecordedNetwork:
    """The network at the middle of pairs of one size after the other; float16, flows float32."""

    def __init__(self, network: RifeNetwork) -> None:
        self._network = network
        self._recording: _Recording | None = None
        self._turn = threading.Lock()

    def __call__(self, first: Tensor, second: Tensor) -> IntermediateFlow:
        """The motion at the middle of a pair; arguments as of `RifeNetwork.forward`."""
        with self._turn, torch.cuda.device(first.device):
            recording = self._recording
            if recording is None or recording.images[0].shape != first.shape:
                self._recording = None  # frees the memory of the other size first
                recording = self._recording = self._record(first, second)
            for kept, image in zip(recording.images, (first, second), strict=True):
                kept.copy_(image)
            recording.graph.replay()
            # The next pair overwrites what the graph wrote.
            return IntermediateFlow(recording.motion.flow.clone(), recording.motion.mask.clone())

    def _record(self, first: Tensor, second: Tensor) -> _Recording:
        images = first.contiguous().clone(), second.contiguous().clone()
        aside = torch.cuda.Stream()
        aside.wait_stream(torch.cuda.current_stream())
        with torch.cuda.stream(aside):
            for _ in range(WARM_UPS):
                estimate_in_half(self._network, *images)
        torch.cuda.current_stream().wait_stream(aside)
        graph = torch.cuda.CUDAGraph()
        # Other threads go on: only this thread's calls must be ones that can be recorded.
        with _one_records, torch.cuda.graph(graph, capture_error_mode="thread_local"):
            motion = estimate_in_half(self._network, *images)
        return _Recording(graph, images, motion)


torch: Any = require("torch", extra="rife")
nn: Any = torch.nn
_Module: Any = nn.Module

BODY_LAYERS = 8
"""Convolutions in the middle of a block."""
FLOW_CHANNELS = 4
"""x and y from the instant to the first frame, x and y to the second."""
ENCODER_CHANNELS = 16
LEAK = 0.2
"""Slope of leaky ReLU below 0."""
MIDDLE = 0.5
"""The instant between two frames at which their motion is estimated."""


@dataclass(frozen=True)
class RifeLayout:
    """One published shape of the network."""

    name: str
    """The release that introduced it."""
    scales: tuple[int, ...]
    """Reduction of the images for each block."""
    widths: tuple[int, ...]
    """Channels inside each block, as published; a file may have others."""
    head_channels: int
    """Channels that come out of a block's last layer, before the pixels are rearranged."""
    shuffles: bool
    """True if that layer is followed by a rearrangement of channels into 2×2 pixels."""
    learned_slopes: bool
    """True for PReLU and one bridge over the whole body; else leaky ReLU and a bridge per layer."""
    encoded_channels: int = 0
    """Channels of the encoder that all blocks see; 0 without one."""
    features: int = 0
    """Channels that each block passes to the next, beside flow and mask."""
    replaces_mask: bool = False
    """True if each block replaces the mask; else it adds to the one before."""

    @property
    def pad_to(self) -> int:
        """Sides are padded to a multiple of this, px: the coarsest block halves twice."""
        return 4 * max(self.scales)

    def input_channels(self, block: int) -> int:
        """Channels that go into a block."""
        seen = 2 * (3 + self.encoded_channels) + 1
        return seen if block == 0 else seen + 1 + self.features + FLOW_CHANNELS


RIFE_4_0 = RifeLayout("4.0", (8, 4, 2, 1), (192, 128, 96, 64), 5, False, True)
RIFE_4_6 = RifeLayout("4.6", (8, 4, 2, 1), (192, 128, 96, 64), 4 * 6, True, False)
RIFE_4_25 = RifeLayout(
    "4.25",
    (16, 8, 4, 2, 1),
    (192, 128, 96, 64, 32),
    4 * 13,
    True,
    False,
    encoded_channels=4,
    features=8,
    replaces_mask=True,
)
LAYOUTS = (RIFE_4_0, RIFE_4_6, RIFE_4_25)


def closest_layout(tensors: Mapping[str, Tensor]) -> tuple[RifeLayout, tuple[int, ...]]:
    """The layout whose names a file's tensors have, and the widths of its blocks in the file.

    Args:
        tensors: name → tensor, names without a `module.` in front.
    """
    if "encode.cnn0.weight" in tensors:
        layout = RIFE_4_25
    else:
        layout = RIFE_4_6 if "block0.convblock.0.beta" in tensors else RIFE_4_0
    firsts = (tensors.get(f"block{block}.conv0.1.0.bias") for block in range(len(layout.widths)))
    widths = zip(layout.widths, firsts, strict=True)
    return layout, tuple(usual if one is None else len(one) for usual, one in widths)


@dataclass(frozen=True, eq=False)
class IntermediateFlow:
    """Flow from the pixels of an instant to both frames, and the weights of the frames."""

    flow: Tensor
    """[K, 4, H, W] float32, px: to the first frame (x, y), to the second (x, y)."""
    mask: Tensor
    """[K, 1, H, W] float32: the first frame's weight as a logit."""


class RifeNetwork(_Module):
    """A chain of blocks, coarse to fine; each sees both images as warped so far.

    Deviation: the released 4.0 doubles all scales when the second block finds more than 32 px in
        both directions; here the scales stay, so that a pair's result is continuous in its pixels.
        The optional refinement networks of 4.0 are left out, as in the release's fast mode.
    """

    def __init__(self, layout: RifeLayout, widths: tuple[int, ...] | None = None) -> None:
        """An untrained network.

        Args:
            layout: which shape.
            widths: channels inside each block; those of the layout if not given.
        """
        super().__init__()
        self.layout = layout
        for block, width in enumerate(widths or layout.widths):
            self.add_module(f"block{block}", _Block(layout, layout.input_channels(block), width))
        if layout.encoded_channels:
            self.encode = _Encoder(layout.encoded_channels)

    def forward(
        self, first: Tensor, second: Tensor, position: float | Tensor = MIDDLE
    ) -> IntermediateFlow:
        """The motion at K instants.

        Args:
            first: the earlier image, [K, 3, H, W], 0..1, sides a multiple of `layout.pad_to`.
            second: the later image, alike.
            position: τ, 0 = first image, 1 = second; or one for each, [K, 1, 1, 1] float32.
        """
        images: tuple[Tensor, ...] = (first, second)
        encodings = tuple(map(self.encode, images)) if self.layout.encoded_channels else ()
        both = images
        if encodings:
            both = tuple(torch.cat(parts, 1) for parts in zip(images, encodings, strict=True))
        instant = torch.ones_like(first[:, :1]) * position
        moved = (*images, *encodings)
        flow: Tensor = None
        mask: Tensor = None
        features: Tensor = None
        for number, scale in enumerate(self.layout.scales):
            block = getattr(self, f"block{number}")
            if flow is None:
                flow, mask, features = block((*moved, instant), None, scale)
            else:
                step, logit, features = block((*moved, instant, mask, features), flow, scale)
                flow = flow + step
                mask = logit if self.layout.replaces_mask else mask + logit
            moved = self._warped(both, flow)
        return IntermediateFlow(flow, mask)

    def _warped(self, both: tuple[Tensor, ...], flow: Tensor) -> tuple[Tensor, ...]:
        """Both images, then both encodings, all warped; an image and its encoding move together."""
        first, second = warp(both[0], flow[:, :2]), warp(both[1], flow[:, 2:])
        if not self.layout.encoded_channels:
            return first, second
        return first[:, :3], second[:, :3], first[:, 3:], second[:, 3:]


class _Block(_Module):
    """One scale: reduce to a quarter, convolve, enlarge again."""

    def __init__(self, layout: RifeLayout, inputs: int, width: int) -> None:
        super().__init__()
        self._layout = layout

        def activated(*channels: int, stride: int) -> Any:
            slope = nn.PReLU(channels[1]) if layout.learned_slopes else nn.LeakyReLU(LEAK)
            return nn.Sequential(nn.Conv2d(*channels, 3, stride, 1), slope)

        half = width // 2
        self.conv0 = nn.Sequential(
            activated(inputs, half, stride=2), activated(half, width, stride=2)
        )
        self.convblock = nn.Sequential(
            *(
                activated(width, width, stride=1) if layout.learned_slopes else _Bridged(width)
                for _ in range(BODY_LAYERS)
            )
        )
        head = nn.ConvTranspose2d(width, layout.head_channels, 4, 2, 1)
        self.lastconv = nn.Sequential(head, nn.PixelShuffle(2)) if layout.shuffles else head

    def forward(
        self, inputs: tuple[Tensor, ...], flow: Tensor | None, scale: int
    ) -> tuple[Tensor, Tensor, Tensor]:
        """Flow step (px), mask and features, at the images' size."""
        x = _resize(torch.cat(inputs, 1), 1 / scale)
        if flow is not None:
            x = torch.cat((x, _resize(flow, 1 / scale) / scale), 1)
        x = self.conv0(x)
        x = self.convblock(x) + x if self._layout.learned_slopes else self.convblock(x)
        grown = scale if self._layout.shuffles else 2 * scale
        # Of a network in float16, the flow and its sums are float32.
        x = _resize(self.lastconv(x).float(), grown)
        end = FLOW_CHANNELS + 1
        kept = x[:, end : end + self._layout.features]
        return x[:, :FLOW_CHANNELS] * grown, x[:, FLOW_CHANNELS:end], kept


class _Bridged(_Module):
    """A convolution, scaled by channel, around which its input is added."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.conv = nn.Conv2d(width, width, 3, 1, 1)
        self.beta = nn.Parameter(torch.ones(1, width, 1, 1))

    def forward(self, x: Tensor) -> Tensor:
        return nn.functional.leaky_relu(self.conv(x) * self.beta + x, LEAK)


class _Encoder(_Module):
    """Features of one image that all blocks see."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.cnn0 = nn.Conv2d(3, ENCODER_CHANNELS, 3, 2, 1)
        self.cnn1 = nn.Conv2d(ENCODER_CHANNELS, ENCODER_CHANNELS, 3, 1, 1)
        self.cnn2 = nn.Conv2d(ENCODER_CHANNELS, ENCODER_CHANNELS, 3, 1, 1)
        self.cnn3 = nn.ConvTranspose2d(ENCODER_CHANNELS, channels, 4, 2, 1)

    def forward(self, image: Tensor) -> Tensor:
        x = image
        for layer in (self.cnn0, self.cnn1, self.cnn2):
            x = nn.functional.leaky_relu(layer(x), LEAK)
        return self.cnn3(x)


def _resize(x: Tensor, factor: float) -> Tensor:
    if factor == 1:
        return x
    return nn.functional.interpolate(
        x, scale_factor=float(factor), mode="bilinear", align_corners=False
    )


def warp(image: Tensor, flow: Tensor) -> Tensor:
    """The image that `flow` looks up: bilinear, edges repeated.

    Args:
        image: [N, C, H, W] float32.
        flow: from each pixel to where it is looked up, [N, 2, H, W] as (x, y), px.

    Returns:
        [N, C, H, W].
    """
    height, width = image.shape[-2:]
    columns = torch.arange(width, device=flow.device, dtype=torch.float32)
    rows = torch.arange(height, device=flow.device, dtype=torch.float32)
    # grid_sample wants -1..1 from the first pixel's centre to the last one's.
    x = (flow[:, 0] + columns) * (2.0 / max(width - 1, 1)) - 1.0
    y = (flow[:, 1] + rows[:, None]) * (2.0 / max(height - 1, 1)) - 1.0
    return torch.nn.functional.grid_sample(
        image,
        torch.stack((x, y), dim=-1),
        mode="bilinear",
        padding_mode="border",
        align_corners=True,
    )


def move_motion(middle: IntermediateFlow, positions: Sequence[float]) -> IntermediateFlow:
    """The motion at K instants, from that at the middle, if points move straight and evenly.

    A point that is at x at the instant was at x − (τ − 1/2)·V at the middle, where its path
    V = flow to the second − flow to the first; its flows there are scaled by the time left. The
    path is looked up at x, which is the point's own unless a border passes between. The frames'
    weights shift towards the nearer one.

    Args:
        middle: the motion at τ = 1/2, of one instant.
        positions: τ of each instant, 0..1, both excluded.

    Source: the linear motion model of Jiang et al., Super SloMo (CVPR 2018), section 3.2, with the
        flow looked up where the point was instead of in place.
    """
    path = middle.flow[:, 2:] - middle.flow[:, :2]
    rows = [
        (MIDDLE - at, at / MIDDLE, (1.0 - at) / MIDDLE, math.log((1.0 - at) / at))
        for at in positions
    ]
    columns = to_device(np.array(rows, np.float32).T[..., None, None, None], path.device)
    share, before, after, logit = columns
    back = path * share
    count = len(positions)
    flow = warp(middle.flow.expand(count, -1, -1, -1), back)
    flow[:, :2] *= before
    flow[:, 2:] *= after
    return IntermediateFlow(flow, warp(middle.mask.expand(count, -1, -1, -1), back) + logit)
