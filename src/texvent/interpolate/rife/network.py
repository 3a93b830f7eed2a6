"""IFNet for inference: from two images and an instant to the flow to both, and a mask."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import ModuleType
from typing import Any

from texvent.interpolate.networks.torch_import import Tensor, import_torch
from texvent.interpolate.networks.torch_warp import warp
from texvent.interpolate.rife.layouts import BODY_LAYERS, FLOW_CHANNELS, RifeLayout

LEAK = 0.2
"""Slope of leaky ReLU below 0."""
MIDDLE = 0.5
"""The instant between two frames that shared motion is estimated at."""


@dataclass(frozen=True, eq=False)
class Motion:
    """Where the pixels of an instant are in both frames, and how the frames mix."""

    flow: Tensor
    """[1, 4, H, W] float32, px: to the first frame (x, y), to the second (x, y)."""
    mask: Tensor
    """[1, 1, H, W] float32: the first frame's weight as a logit."""


@dataclass(frozen=True, eq=False)
class EncodedPair:
    """What all instants of a pair share."""

    images: tuple[Tensor, Tensor]
    """[1, 3, H, W] each, 0..1, sides a multiple of the layout's `pad_to`."""
    encodings: tuple[Tensor, ...]
    """[1, C, H, W] each, for the first and the second; empty without an encoder."""


class RifeNetwork:
    """A chain of blocks, coarse to fine; each sees both images as warped so far.

    Deviation: the released 4.0 doubles all scales when the second block finds more than 32 px in
        both directions; here the scales stay, so that a pair's result is continuous in its pixels.
        The optional refinement networks of 4.0 are left out, as in the release's fast mode.
    """

    def __init__(self, layout: RifeLayout, tensors: Mapping[str, Tensor]) -> None:
        """A network from its tensors; they decide device and precision.

        Args:
            layout: which shape.
            tensors: the names of `layout.tensor_shapes()`.
        """
        self._layout = layout
        self._tensors = dict(tensors)

    @property
    def _torch(self) -> ModuleType:
        # Not kept as an attribute: a module cannot be copied, an interpolator can.
        return import_torch()

    def encode(self, first: Tensor, second: Tensor) -> EncodedPair:
        """Prepare what does not depend on the instant.

        Args:
            first: the earlier image, [1, 3, H, W], 0..1, sides a multiple of `pad_to`.
            second: the later image, alike.
        """
        encodings: tuple[Tensor, ...] = ()
        if self._layout.encoded_channels:
            encodings = (self._encode(first), self._encode(second))
        return EncodedPair((first, second), encodings)

    def estimate(self, pair: EncodedPair, position: Tensor) -> Motion:
        """The motion at one instant.

        Args:
            pair: from `encode`.
            position: τ, 0 = first image, 1 = second, as a tensor of one number.
        """
        torch = self._torch
        first, second = pair.images
        instant = position.to(first).expand(1, 1, *first.shape[-2:])
        flow: Tensor = None
        mask: Tensor = None
        features: Tensor = None
        moved = (*pair.images, *pair.encodings)
        for block, scale in enumerate(self._layout.scales):
            if flow is None:
                flow, mask, features = self._block(block, (*moved, instant), None, scale)
                flow, mask = flow.float(), mask.float()
            else:
                inputs = (*moved, instant, mask.to(first.dtype), features)
                step, logit, features = self._block(block, inputs, flow, scale)
                flow = flow + step.float()
                mask = logit.float() if self._layout.replaces_mask else mask + logit.float()
            both = (
                torch.cat((first, *pair.encodings[:1]), 1),
                torch.cat((second, *pair.encodings[1:]), 1),
            )
            moved = self._warped(both, flow)
        return Motion(flow, mask)

    def _warped(self, both: tuple[Tensor, Tensor], flow: Tensor) -> tuple[Tensor, ...]:
        """Both images, then both encodings, all warped; an image and its encoding move together."""
        first, second = warp(both[0], flow[:, :2]), warp(both[1], flow[:, 2:])
        if not self._layout.encoded_channels:
            return first, second
        return first[:, :3], second[:, :3], first[:, 3:], second[:, 3:]

    def _block(
        self, block: int, inputs: tuple[Tensor, ...], flow: Tensor | None, scale: int
    ) -> tuple[Tensor, Tensor, Tensor]:
        """Flow step (px), mask and features of one block, at the images' size."""
        x = self._resize(self._torch.cat(inputs, 1), 1 / scale)
        if flow is not None:
            reduced = self._resize(flow, 1 / scale) / scale
            x = self._torch.cat((x, reduced.to(x.dtype)), 1)
        name = f"block{block}"
        x = self._body(self._reduce(x, name), name)
        if self._layout.shuffles:
            x = self._convolve_up(x, f"{name}.lastconv.0")
            x = self._torch.nn.functional.pixel_shuffle(x, 2)
            grown = scale
        else:
            x = self._convolve_up(x, f"{name}.lastconv")
            grown = 2 * scale
        x = self._resize(x, grown)
        end = FLOW_CHANNELS + 1
        kept = x[:, end : end + self._layout.features]
        return x[:, :FLOW_CHANNELS].float() * grown, x[:, FLOW_CHANNELS:end], kept

    def _reduce(self, x: Tensor, name: str) -> Tensor:
        """A quarter of the size, in two steps."""
        for layer in (0, 1):
            at = f"{name}.conv0.{layer}"
            x = self._activate(self._convolve(x, f"{at}.0", stride=2), f"{at}.1.weight")
        return x

    def _body(self, x: Tensor, name: str) -> Tensor:
        start = x
        for layer in range(BODY_LAYERS):
            at = f"{name}.convblock.{layer}"
            if self._layout.learned_slopes:
                x = self._activate(self._convolve(x, f"{at}.0"), f"{at}.1.weight")
            else:
                step = self._convolve(x, f"{at}.conv") * self._tensors[f"{at}.beta"]
                x = self._leak(step + x)
        return x + start if self._layout.learned_slopes else x

    def _encode(self, image: Tensor) -> Tensor:
        x = self._leak(self._convolve(image, "encode.cnn0", stride=2))
        for layer in (1, 2):
            x = self._leak(self._convolve(x, f"encode.cnn{layer}"))
        return self._convolve_up(x, "encode.cnn3")

    def _activate(self, x: Tensor, slope: str) -> Tensor:
        if self._layout.learned_slopes:
            return self._torch.nn.functional.prelu(x, self._tensors[slope])
        return self._leak(x)

    def _leak(self, x: Tensor) -> Tensor:
        return self._torch.nn.functional.leaky_relu(x, LEAK)

    def _convolve(self, x: Tensor, name: str, *, stride: int = 1) -> Tensor:
        weight, bias = self._tensors[f"{name}.weight"], self._tensors[f"{name}.bias"]
        return self._torch.nn.functional.conv2d(x, weight, bias, stride=stride, padding=1)

    def _convolve_up(self, x: Tensor, name: str) -> Tensor:
        weight, bias = self._tensors[f"{name}.weight"], self._tensors[f"{name}.bias"]
        convolve = self._torch.nn.functional.conv_transpose2d
        return convolve(x, weight, bias, stride=2, padding=1)

    def _resize(self, x: Tensor, factor: Any) -> Tensor:
        if factor == 1:
            return x
        return self._torch.nn.functional.interpolate(
            x, scale_factor=float(factor), mode="bilinear", align_corners=False
        )


def move_motion(middle: Motion, position: float) -> Motion:
    """The motion at an instant, from that at the middle, if points move straight and evenly.

    A point that is at x at the instant was at x − (τ − 1/2)·V at the middle, where its path
    V = flow to the second − flow to the first; its flows there are scaled by the time left. The
    path is looked up at x, which is the point's own unless a border passes between. The frames'
    weights shift towards the nearer one.

    Args:
        middle: the motion at τ = 1/2.
        position: τ, 0..1, both excluded.

    Source: the linear motion model of Jiang et al., Super SloMo (CVPR 2018), section 3.2, with the
        flow looked up where the point was instead of in place.
    """
    path = middle.flow[:, 2:] - middle.flow[:, :2]
    back = path * (MIDDLE - position)
    flow = warp(middle.flow, back)
    flow[:, :2] *= position / MIDDLE
    flow[:, 2:] *= (1.0 - position) / MIDDLE
    return Motion(flow, warp(middle.mask, back) + math.log((1.0 - position) / position))
