"""A small convolutional network for small sensors: 30,000 parameters, trained in minutes."""

from __future__ import annotations

from typing import Any

from texvent.networks.layer_shapes import Shapes, batch_norm
from texvent.networks.layers import Layers
from texvent.networks.weight_files import Tensor
from texvent.train.tensor_network import TensorNetwork, initial_tensors

WIDTHS = (16, 32, 64)


def small_cnn(channels: int, classes: int, seed: int) -> TensorNetwork:
    """Three convolutions of 3×3 with normalisation, two of them halved, a mean, a linear layer.

    Args:
        channels: of the input, [n, channels, H, W].
        classes: scores that come out, [n, classes].
        seed: of the initial weights.
    """
    shapes: Shapes = {}
    for number, width in enumerate(WIDTHS):
        before = WIDTHS[number - 1] if number else channels
        shapes[f"conv{number}.weight"] = (width, before, 3, 3)
        shapes |= batch_norm(f"norm{number}", width)
    shapes |= {"linear.weight": (classes, WIDTHS[-1]), "linear.bias": (classes,)}
    return TensorNetwork(initial_tensors(shapes, seed), _compute)


def _compute(network: Any, images: Tensor) -> Tensor:
    layers = Layers(network.tensors, is_training=network.training)
    torch, x = layers.torch, images
    for number in range(len(WIDTHS)):
        x = torch.relu(layers.normalise(layers.convolve(x, f"conv{number}"), f"norm{number}"))
        if number < len(WIDTHS) - 1:
            x = torch.nn.functional.max_pool2d(x, 2)
    return layers.linear(x.mean(dim=(2, 3)), "linear")
