"""E-RAFT: optical flow from two consecutive slices, refined twelve times."""

from __future__ import annotations

import math
from typing import Any

from texvent.extending import require
from texvent.networks.layer_shapes import Shapes
from texvent.networks.weight_files import Tensor
from texvent_lab.networks.layer_shapes import batch_norm, convolution
from texvent_lab.networks.layers import Layers, Padding
from texvent_lab.train.schedule import EXTRA
from texvent_lab.train.tensor_network import TensorNetwork, initial_tensors


class CorrelationPyramid:
    """Scalar products of the features of two images, at several sizes of the second one.

    Source: Z. Teed, J. Deng, "RAFT: recurrent all-pairs field transforms for optical flow", ECCV
        2020, section 3.2.
    """

    def __init__(self, first: Tensor, second: Tensor, *, levels: int) -> None:
        """Correlate every pixel with every other.

        Args:
            first: features, [n, channels, h, w].
            second: of the other image, of the same shape; h and w at least 2^(levels − 1).
            levels: sizes of the second image, each half of the one before.
        """
        functional = require("torch", extra=EXTRA).nn.functional
        n, channels, height, width = first.shape
        product = first.flatten(2).transpose(1, 2) @ second.flatten(2)
        volume = product.reshape(n * height * width, 1, height, width) / math.sqrt(channels)
        self._levels = [volume]
        for _ in range(levels - 1):
            self._levels.append(functional.avg_pool2d(self._levels[-1], 2))

    def look_up(self, places: Tensor, radius: int) -> Tensor:
        """Correlations around a place in the second image for each pixel of the first.

        Args:
            places: (x, y), px, [n, 2, h, w].
            radius: neighbours up to this distance along both axes, px of each size.

        Returns:
            [n, levels · (2 · radius + 1)², h, w]; sizes from the largest, then columns from the
            left, then rows from above. Bilinear between pixels, 0 outside.
        """
        torch = require("torch", extra=EXTRA)
        n, _, height, width = places.shape
        steps = torch.arange(-radius, radius + 1, dtype=places.dtype, device=places.device)
        # x varies along the first axis: the published weights expect columns before rows.
        around = torch.stack(torch.meshgrid(steps, steps, indexing="ij"), -1)
        centres = places.permute(0, 2, 3, 1).reshape(-1, 1, 1, 2)
        parts = []
        for level, volume in enumerate(self._levels):
            sides = places.new_tensor(volume.shape[:-3:-1])
            # From pixels, whose centres are whole numbers, to −1..1 between the borders.
            grid = (2 * (centres / 2**level + around) + 1) / sides - 1
            found = torch.nn.functional.grid_sample(volume, grid, align_corners=False)
            parts.append(found.reshape(n, height, width, -1))
        return torch.cat(parts, -1).permute(0, 3, 1, 2)


FEATURES, CONTEXT = "fnet", "cnet"
"""The encoder of both grids, and that of the later one alone."""
UPDATE = "update_block"
WIDTHS = (64, 96, 128)
"""Channels of an encoder at half, a quarter and an eighth of the size."""
FEATURE_CHANNELS, HIDDEN, CONTEXT_CHANNELS = 256, 128, 128
LEVELS, RADIUS = 4, 4
"""Sizes at which correlations are looked up, and how far around, px of each size."""
LOOKED_UP = LEVELS * (2 * RADIUS + 1) ** 2
MOTION = 128
"""Channels of the motion features, the flow itself among them."""
ENLARGEMENT = 8
CONVEX = 9 * ENLARGEMENT**2
"""Weights of the neighbours of each of 8×8 fine pixels."""


def e_raft_shapes(bins: int) -> Shapes:
    """Every tensor, batch counters left out.

    Args:
        bins: of the voxel grids; the published network of DSEC has 15.
    """
    shapes = _encoder_shapes(FEATURES, bins, FEATURE_CHANNELS, has_norm=False)
    shapes |= _encoder_shapes(CONTEXT, bins, HIDDEN + CONTEXT_CHANNELS, has_norm=True)
    motion, unit, head = f"{UPDATE}.encoder", f"{UPDATE}.gru", f"{UPDATE}.flow_head"
    shapes |= convolution(f"{motion}.convc1", 256, LOOKED_UP, 1)
    shapes |= convolution(f"{motion}.convc2", 192, 256, 3)
    shapes |= convolution(f"{motion}.convf1", 128, 2, 7)
    shapes |= convolution(f"{motion}.convf2", 64, 128, 3)
    shapes |= convolution(f"{motion}.conv", MOTION - 2, 64 + 192, 3)
    before = HIDDEN + CONTEXT_CHANNELS + MOTION
    for number, sides in ((1, (1, 5)), (2, (5, 1))):
        for gate in "zrq":
            name = f"{unit}.conv{gate}{number}"
            shapes |= {f"{name}.weight": (HIDDEN, before, *sides), f"{name}.bias": (HIDDEN,)}
    shapes |= convolution(f"{head}.conv1", 256, HIDDEN, 3)
    shapes |= convolution(f"{head}.conv2", 2, 256, 3)
    shapes |= convolution(f"{UPDATE}.mask.0", 256, HIDDEN, 3)
    return shapes | convolution(f"{UPDATE}.mask.2", CONVEX, 256, 1)


def _encoder_shapes(name: str, bins: int, channels: int, *, has_norm: bool) -> Shapes:
    """An encoder whose normalisations are those of the batch, or of each image without tensors."""
    shapes = convolution(f"{name}.conv1", WIDTHS[0], bins, 7)
    if has_norm:
        shapes |= batch_norm(f"{name}.norm1", WIDTHS[0])
    for layer, wide in enumerate(WIDTHS, 1):
        narrow = WIDTHS[max(layer - 2, 0)]
        for block, before in ((0, narrow), (1, wide)):
            inner = f"{name}.layer{layer}.{block}"
            shapes |= convolution(f"{inner}.conv1", wide, before, 3)
            shapes |= convolution(f"{inner}.conv2", wide, wide, 3)
            is_smaller = layer > 1 and block == 0
            if is_smaller:
                shapes |= convolution(f"{inner}.downsample.0", wide, before, 1)
            # The program stores the normalisation of the shortcut under two names.
            norms = ("norm1", "norm2", *(("norm3", "downsample.1") if is_smaller else ()))
            for norm in norms if has_norm else ():
                shapes |= batch_norm(f"{inner}.{norm}", wide)
    return shapes | convolution(f"{name}.conv2", channels, WIDTHS[-1], 1)


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
