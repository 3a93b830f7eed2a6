"""Names and shapes of the tensors of layers."""

from __future__ import annotations

from collections.abc import Mapping

from texvent.networks.layer_shapes import Shape, Shapes, linear

LSTM_GATES = 4


def convolution(name: str, channels_out: int, channels_in: int, side: int) -> Shapes:
    """A convolution with a bias."""
    return {
        f"{name}.weight": (channels_out, channels_in, side, side),
        f"{name}.bias": (channels_out,),
    }


def batch_norm(name: str, channels: int) -> Shapes:
    """A batch normalisation, its counter left out."""
    parts = ("weight", "bias", "running_mean", "running_var")
    return {f"{name}.{part}": (channels,) for part in parts}


def conv_layer(
    name: str, channels_out: int, channels_in: int, side: int, *, has_norm: bool = False
) -> Shapes:
    """A convolution and, if it has one, the normalisation that takes the place of its bias."""
    shapes = convolution(f"{name}.conv2d", channels_out, channels_in, side)
    if has_norm:
        del shapes[f"{name}.conv2d.bias"]
        shapes |= batch_norm(f"{name}.norm_layer", channels_out)
    return shapes


def conv_gru(name: str, channels: int, side: int) -> Shapes:
    """A convolutional gated recurrent unit."""
    gates = ("reset_gate", "update_gate", "out_gate")
    return {
        key: shape
        for gate in gates
        for key, shape in convolution(f"{name}.{gate}", channels, 2 * channels, side).items()
    }


def conv_lstm(name: str, channels: int) -> Shapes:
    """A convolutional long short-term memory."""
    return convolution(f"{name}.Gates", LSTM_GATES * channels, 2 * channels, 3)


def residual_block(name: str, channels: int, *, has_norm: bool = False) -> Shapes:
    """Two convolutions around which the input is added."""
    shapes: Shapes = {}
    for number in (1, 2):
        shapes |= convolution(f"{name}.conv{number}", channels, channels, 3)
        if has_norm:
            del shapes[f"{name}.conv{number}.bias"]
            shapes |= batch_norm(f"{name}.bn{number}", channels)
    return shapes


def attention(name: str, features: int) -> Shapes:
    """A multi-head attention with queries, keys and values of the same size."""
    return {
        f"{name}.in_proj_weight": (3 * features, features),
        f"{name}.in_proj_bias": (3 * features,),
        **linear(f"{name}.out_proj", features, features),
    }


def count_blocks(shapes: Mapping[str, Shape], prefix: str) -> int:
    """How many numbered blocks `prefix.0.`, `prefix.1.`, ... there are names of."""
    number = 0
    while any(name.startswith(f"{prefix}.{number}.") for name in shapes):
        number += 1
    return number
