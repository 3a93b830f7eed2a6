"""HyperE2VID's first decoder: a convolution whose kernel is another at every pixel."""

from __future__ import annotations

from texvent.networks.layer_shapes import Shapes, batch_norm, convolution
from texvent.networks.layers import Layers
from texvent.networks.weight_files import Tensor

ATOMS = 6
"""Kernels per pixel, of which every output channel takes its own mixture."""
BASES_PER_SCALE = 6
"""Fourier-Bessel patterns per kernel side 3, 5, ...; every atom is a mixture of all of them."""
CONTEXT_CHANNELS, HIDDEN_CHANNELS = 32, 64
CONTEXT_SCALE = 0.25
"""The decoder's output has a quarter of the sensor's sides, and so has its context."""


def dynamic_decoder_shapes(
    name: str, channels_out: int, channels_in: int, *, side: int, bins: int
) -> Shapes:
    """Every tensor of the decoder; the patterns are stored with the weights."""
    atoms, inner = f"{name}.dynamic_atom_generation", f"{name}.dynamic_conv"
    bases = BASES_PER_SCALE * (side // 2)
    return {
        **convolution(f"{name}.context_fusion.conv", CONTEXT_CHANNELS, bins + 1, 3),
        f"{atoms}.bases": (bases, side * side),
        **convolution(f"{atoms}.bases_net.0", HIDDEN_CHANNELS, CONTEXT_CHANNELS, 3),
        **batch_norm(f"{atoms}.bases_net.1", HIDDEN_CHANNELS),
        **convolution(f"{atoms}.bases_net.3", ATOMS * bases, HIDDEN_CHANNELS, 3),
        **batch_norm(f"{atoms}.bases_net.4", ATOMS * bases),
        f"{inner}.compositional_coefficients": (channels_out, channels_in * ATOMS, 1, 1),
        f"{inner}.bias": (channels_out,),
    }


def decode_dynamically(layers: Layers, x: Tensor, name: str, *, context: Tensor) -> Tensor:
    """Twice the size, by kernels made from the context, then ReLU.

    Args:
        layers: tensors of the network.
        x: [1, channels, H/8, W/8].
        name: of the decoder.
        context: voxel grid and the image before, [1, bins + 1, H, W].

    Returns:
        [1, fewer channels, H/4, W/4].

    Source: B. Ercan et al., "HyperE2VID", TIP 2024, section III-B.
    """
    torch = layers.torch
    x = layers.upsample(x)
    atoms = _make_atoms(layers, name, context)
    side = round(atoms.shape[1] ** 0.5)
    height, width = x.shape[-2:]
    margin = side // 2
    padded = torch.nn.functional.pad(x[0], (margin,) * 4)
    # One kernel position after the other: all of them at once would take side² times the memory.
    mixed = x.new_zeros(x.shape[1], len(atoms), height, width)
    for position in range(side * side):
        row, column = divmod(position, side)
        shifted = padded[:, row : row + height, column : column + width]
        mixed.addcmul_(shifted[:, None], atoms[None, :, position])
    weight = layers[f"{name}.dynamic_conv.compositional_coefficients"]
    bias = layers[f"{name}.dynamic_conv.bias"]
    return torch.relu(torch.nn.functional.conv2d(mixed.flatten(0, 1)[None], weight, bias))


def _make_atoms(layers: Layers, name: str, context: Tensor) -> Tensor:
    """Kernels of every pixel, [atoms, side², H/4, W/4]."""
    torch, inner = layers.torch, f"{name}.dynamic_atom_generation"
    context = torch.nn.functional.interpolate(
        context, scale_factor=CONTEXT_SCALE, mode="bilinear", align_corners=False
    )
    x = layers.convolve(context, f"{name}.context_fusion.conv")
    for conv, norm in (("0", "1"), ("3", "4")):
        x = layers.convolve(x, f"{inner}.bases_net.{conv}")
        x = torch.tanh(layers.normalise(x, f"{inner}.bases_net.{norm}"))
    coefficients = x[0].unflatten(0, (ATOMS, -1))
    return torch.einsum("abhw,bp->aphw", coefficients, layers[f"{inner}.bases"])
