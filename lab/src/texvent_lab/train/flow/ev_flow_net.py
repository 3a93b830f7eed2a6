"""EV-FlowNet: a U-Net that gives optical flow at four scales."""

from __future__ import annotations

from typing import Any

from texvent.networks.layer_shapes import Shapes, conv_layer, residual_block
from texvent.networks.layers import Layers
from texvent.networks.padding import Padding
from texvent.networks.weight_files import Tensor
from texvent_lab.train.tensor_network import TensorNetwork, initial_tensors

PREFIX = "multires_unet"
ENCODERS = 4
BLOCKS = 2
FLOW_CHANNELS = 2
KERNEL = 3
MULTIPLE = 2**ENCODERS
"""Both sides are padded to multiples of this, px."""


def ev_flow_net_shapes(bins: int, width: int) -> Shapes:
    """Every tensor, by name.

    Args:
        bins: of the voxel grid.
        width: half the channels of the first encoder; the published networks have 32.
    """
    shapes: Shapes = {}
    for number in range(ENCODERS):
        narrow, wide = width << number, width << (number + 1)
        name = f"{PREFIX}.encoders.{number}"
        shapes |= conv_layer(name, wide, narrow if number else bins, KERNEL)
    for number in range(BLOCKS):
        shapes |= residual_block(f"{PREFIX}.resblocks.{number}", width << ENCODERS)
    for number in range(ENCODERS):
        wide = width << (ENCODERS - number)
        before = 2 * wide + (FLOW_CHANNELS if number else 0)
        shapes |= conv_layer(f"{PREFIX}.decoders.{number}", wide // 2, before, KERNEL)
        shapes |= conv_layer(f"{PREFIX}.preds.{number}", FLOW_CHANNELS, wide // 2, 1)
    return shapes


def make_ev_flow_net(bins: int, width: int, seed: int) -> TensorNetwork:
    """EV-FlowNet with random weights.

    It takes voxel grids, [n, bins, H, W], and gives the displacement over each, (x, y) in px: a
    tuple of four [n, 2, H, W], found at an eighth, a quarter, half and the whole of the size.

    Args:
        bins: of the voxel grid.
        width: see `ev_flow_net_shapes`.
        seed: of the weights.

    Source: A. Z. Zhu, L. Yuan, K. Chaney, K. Daniilidis, "EV-FlowNet: self-supervised optical flow
        estimation for event-based cameras", RSS 2018, section IV-B.
    Deviation: the input is a voxel grid, as in their paper of CVPR 2019, in place of images of
        counts and times; flow is the last convolution's output in px, without 256 · tanh; no batch
        normalisation, and bilinear enlargement, as in event_flow and event_cnn_minimal, whose
        width 32 is the published network's 64.
    """
    return TensorNetwork(initial_tensors(ev_flow_net_shapes(bins, width), seed), _compute)


def _compute(network: Any, grids: Tensor) -> tuple[Tensor, ...]:
    layers = Layers(network.tensors)
    torch = layers.torch
    padding = Padding.centred(grids.shape[-2:], MULTIPLE)
    padded = x = padding.around(grids)
    skipped: list[Tensor] = []
    flows: list[Tensor] = []
    for number in range(ENCODERS):
        x = torch.relu(layers.conv_layer(x, f"{PREFIX}.encoders.{number}", stride=2))
        skipped.append(x)
    for number in range(BLOCKS):
        x = layers.residual_block(x, f"{PREFIX}.resblocks.{number}")
    for number in range(ENCODERS):
        x = torch.cat([*flows[-1:], x, skipped.pop()], 1)
        x = layers.upsample_layer(x, f"{PREFIX}.decoders.{number}")
        flows.append(layers.conv_layer(x, f"{PREFIX}.preds.{number}"))
    whole = [
        torch.nn.functional.interpolate(
            flow, size=padded.shape[-2:], mode="bilinear", align_corners=False
        )
        for flow in flows
    ]
    return tuple(padding.off(flow) for flow in whole)
