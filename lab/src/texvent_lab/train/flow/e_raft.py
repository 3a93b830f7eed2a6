"""E-RAFT: optical flow from two consecutive slices, refined twelve times."""

from __future__ import annotations

from typing import Any

from texvent.networks.layers import Layers
from texvent.networks.padding import Padding
from texvent.networks.weight_files import Tensor
from texvent_lab.train.flow.correlation import CorrelationPyramid
from texvent_lab.train.flow.e_raft_shapes import (
    CONTEXT,
    ENLARGEMENT,
    FEATURES,
    HIDDEN,
    LEVELS,
    RADIUS,
    UPDATE,
    WIDTHS,
    e_raft_shapes,
)
from texvent_lab.train.tensor_network import TensorNetwork, initial_tensors

ITERATIONS = 12
MULTIPLE = 32
LEAST_SIDE = ENLARGEMENT << (LEVELS - 1)
"""Below, px, the smallest size of the correlations would have no pixel."""


def make_e_raft(bins: int, seed: int = 0) -> TensorNetwork:
    """E-RAFT with random weights, to be read from its published file; it is not trained here.

    It takes the voxel grids of two consecutive slices, [n, bins, H, W] each, and gives the
    displacement over the second one, (x, y) in px, [n, 2, H, W].

    Args:
        bins: of the voxel grids; the published networks have 15, or 5 for MVSEC at 45 Hz.
        seed: of the weights.

    Source: M. Gehrig, M. Millhäusler, D. Gehrig, D. Scaramuzza, "E-RAFT: dense optical flow from
        event cameras", 3DV 2021, section 3, and its program.
    Deviation: inputs below 64 px are padded to 64 px; the program fails. No warm start.
    """
    return TensorNetwork(initial_tensors(e_raft_shapes(bins), seed), _compute)


def _compute(network: Any, before: Tensor, voxel: Tensor) -> Tensor:
    layers = Layers(network.tensors)
    torch = layers.torch
    padding = _padding(*voxel.shape[-2:])
    before, voxel = padding.around(before), padding.around(voxel)
    features = _encode(layers, torch.cat([before, voxel]), FEATURES)
    pyramid = CorrelationPyramid(*features.chunk(2), levels=LEVELS)
    hidden, context = _encode(layers, voxel, CONTEXT).split(HIDDEN, 1)
    hidden, context = torch.tanh(hidden), torch.relu(context)
    rows, columns = (torch.arange(n, dtype=voxel.dtype) for n in hidden.shape[-2:])
    grid = torch.stack(torch.meshgrid(columns, rows, indexing="xy"))[None].to(voxel.device)
    flow = torch.zeros_like(grid.expand(len(voxel), -1, -1, -1))
    for _ in range(ITERATIONS):
        looked_up = pyramid.look_up(grid + flow, RADIUS)
        motion = _motion_features(layers, flow, looked_up)
        hidden = _remember(layers, hidden, torch.cat([context, motion], 1))
        flow = flow + _two(layers, hidden, f"{UPDATE}.flow_head.conv1", f"{UPDATE}.flow_head.conv2")
    weights = 0.25 * _two(layers, hidden, f"{UPDATE}.mask.0", f"{UPDATE}.mask.2")
    return padding.off(_enlarge(layers, flow, weights))


def _padding(height: int, width: int) -> Padding:
    """Zeros left and above, up to a multiple of 32 px."""
    missing = [max(-(-side // MULTIPLE) * MULTIPLE, LEAST_SIDE) - side for side in (width, height)]
    return Padding(left=missing[0], right=0, top=missing[1], bottom=0)


def _encode(layers: Layers, x: Tensor, name: str) -> Tensor:
    """Features at an eighth of the size."""
    relu = layers.torch.relu
    x = relu(_normalise(layers, layers.convolve(x, f"{name}.conv1", stride=2), f"{name}.norm1"))
    for layer in range(1, len(WIDTHS) + 1):
        for block in range(2):
            inner = f"{name}.layer{layer}.{block}"
            stride = 2 if layer > 1 and block == 0 else 1
            y = layers.convolve(x, f"{inner}.conv1", stride=stride)
            y = relu(_normalise(layers, y, f"{inner}.norm1"))
            y = relu(_normalise(layers, layers.convolve(y, f"{inner}.conv2"), f"{inner}.norm2"))
            if stride == 2:
                x = layers.convolve(x, f"{inner}.downsample.0", stride=stride)
                x = _normalise(layers, x, f"{inner}.downsample.1")
            x = relu(x + y)
    return layers.convolve(x, f"{name}.conv2")


def _normalise(layers: Layers, x: Tensor, name: str) -> Tensor:
    """By stored statistics where there are any, by those of each image elsewhere."""
    if layers.has(f"{name}.running_mean"):
        return layers.normalise(x, name)
    return layers.torch.nn.functional.instance_norm(x)


def _motion_features(layers: Layers, flow: Tensor, looked_up: Tensor) -> Tensor:
    torch, name = layers.torch, f"{UPDATE}.encoder"
    seen = torch.relu(_two(layers, looked_up, f"{name}.convc1", f"{name}.convc2"))
    moved = torch.relu(_two(layers, flow, f"{name}.convf1", f"{name}.convf2"))
    both = torch.relu(layers.convolve(torch.cat([seen, moved], 1), f"{name}.conv"))
    return torch.cat([both, flow], 1)


def _remember(layers: Layers, hidden: Tensor, x: Tensor) -> Tensor:
    """A gated recurrent unit along rows, then one along columns."""
    torch = layers.torch
    for number, padding in ((1, (0, 2)), (2, (2, 0))):

        def gate(letter: str, of: Tensor, number: int = number, padding: Any = padding) -> Tensor:
            name = f"{UPDATE}.gru.conv{letter}{number}"
            return torch.nn.functional.conv2d(
                of, layers[f"{name}.weight"], layers[f"{name}.bias"], padding=padding
            )

        both = torch.cat([hidden, x], 1)
        update, reset = torch.sigmoid(gate("z", both)), torch.sigmoid(gate("r", both))
        candidate = torch.tanh(gate("q", torch.cat([reset * hidden, x], 1)))
        hidden = (1 - update) * hidden + update * candidate
    return hidden


def _two(layers: Layers, x: Tensor, first: str, second: str) -> Tensor:
    """Two convolutions with ReLU between them."""
    return layers.convolve(layers.torch.relu(layers.convolve(x, first)), second)


def _enlarge(layers: Layers, flow: Tensor, weights: Tensor) -> Tensor:
    """Flow at eight times the size: each pixel a mixture of the nine coarse ones around it.

    Args:
        layers: for torch.
        flow: px of the coarse size, [n, 2, h, w].
        weights: of the mixtures, before their softmax, [n, 9 · 8 · 8, h, w].

    Returns:
        px, [n, 2, 8 · h, 8 · w].
    """
    functional = layers.torch.nn.functional
    n, _, height, width = flow.shape
    side = ENLARGEMENT
    shares = weights.reshape(n, 1, 9, side, side, height, width).softmax(dim=2)
    around = functional.unfold(side * flow, 3, padding=1).reshape(n, 2, 9, 1, 1, height, width)
    fine = (shares * around).sum(dim=2).permute(0, 1, 4, 2, 5, 3)
    return fine.reshape(n, 2, side * height, side * width)
