"""The networks that classify: a small one for small sensors, and N-ImageNet's ResNet-34."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from texvent.networks.layer_shapes import Shapes, batch_norm, linear
from texvent.networks.layers import Layers
from texvent.networks.resnet34 import BLOCKS, WIDTH, resnet_scores, resnet_shapes
from texvent.networks.weight_files import Tensor
from texvent_lab.train.tensor_network import TensorNetwork, initial_tensors

SMALL_WIDTH, STAGES = 16, 3
LAST_LAYERS = ("linear.weight", "linear.bias", "fc.weight", "fc.bias")
"""Tensors whose shapes depend on the number of classes."""


def small_cnn(channels: int, classes: int, seed: int, *, width: int | None = None) -> TensorNetwork:
    """Three convolutions of 3×3 with normalisation, two of them halved, a mean, a linear layer.

    Args:
        channels: of the input, [n, channels, H, W].
        classes: scores that come out, [n, classes].
        seed: of the initial weights.
        width: channels after the first convolution; None: 16, which makes 24,000 parameters.
    """
    shapes: Shapes = {}
    before = channels
    for number in range(STAGES):
        after = (width or SMALL_WIDTH) * 2**number
        shapes[f"conv{number}.weight"] = (after, before, 3, 3)
        shapes |= batch_norm(f"norm{number}", after)
        before = after
    shapes |= linear("linear", classes, before)
    return TensorNetwork(initial_tensors(shapes, seed), _small_scores)


def resnet34(channels: int, classes: int, seed: int, *, width: int | None = None) -> TensorNetwork:
    """See `texvent.networks.resnet34`; arguments as for `small_cnn`, `width` is 64.

    Kernels begin as K. He et al., "Delving deep into rectifiers", ICCV 2015, for outputs; the
    first and the last layer as torch's own, because N-ImageNet's program replaces them.
    """
    shapes = resnet_shapes(channels, classes, width=width or WIDTH)
    tensors = initial_tensors(shapes, seed, normal="layer")
    return TensorNetwork(tensors, _resnet_scores)


NETWORKS: Mapping[str, Callable[..., TensorNetwork]] = {
    "small-cnn": small_cnn,
    "resnet34": resnet34,
}


def _small_scores(network: Any, images: Tensor) -> Tensor:
    layers = Layers(network.tensors, is_training=network.training)
    torch, x = layers.torch, images
    for number in range(STAGES):
        x = torch.relu(layers.normalise(layers.convolve(x, f"conv{number}"), f"norm{number}"))
        if number < STAGES - 1:
            x = torch.nn.functional.max_pool2d(x, 2)
    return layers.linear(x.mean(dim=(2, 3)), "linear")


def _resnet_scores(network: Any, images: Tensor) -> Tensor:
    layers = Layers(network.tensors, is_training=network.training)
    return resnet_scores(layers, BLOCKS, images)
