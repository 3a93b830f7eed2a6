"""V2CE's U-Net in NumPy float64, slowly: what the torch network is tested against."""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view


def predict(pairs, tensors):
    """Voxel grids [N, 2, 10, H, W] of normalised pairs [N, 2, H, W]."""
    state = {name: np.asarray(tensor, np.float64) for name, tensor in tensors.items()}
    x = convolve(pairs.swapaxes(0, 1).astype(np.float64), state, "UNet.head.conv3d")
    x = np.where(x > 0, x, 0.01 * x)
    beside = []
    for level in range(4):
        beside.append(x)
        x = pass_block(x, state, f"UNet.encoders.{level}", stride=2)
    for block in range(2):
        x = pass_block(x, state, f"UNet.resblocks.{block}")
    for level in range(4):
        skip = beside.pop()
        x = np.concatenate([repeat_pixels(x, skip.shape[2:]), skip])
        x = pass_block(x, state, f"UNet.decoders.{level}")
    out = np.maximum(convolve(x, state, "UNet.pred.conv3d"), 0)
    return out.swapaxes(0, 1).reshape(len(pairs), 2, 10, *pairs.shape[2:])


def pass_block(x, state, name, *, stride=1):
    inner = np.maximum(norm(convolve(x, state, f"{name}.conv1", stride), state, f"{name}.bn1"), 0)
    inner = norm(convolve(inner, state, f"{name}.conv2"), state, f"{name}.bn2")
    around = norm(convolve(x, state, f"{name}.downsample.0", stride), state, f"{name}.downsample.1")
    return np.maximum(inner + around, 0)


def convolve(x, state, name, stride=1):
    """[C, N, H, W] with a kernel of 1 or 3, zeros around; stride in rows and columns."""
    weight = state.get(f"{name}.weight")
    if weight is None:
        weight = spectrally_normalised(state, f"{name}.module.weight")
    side = weight.shape[-1]
    edge = side // 2
    padded = np.pad(x, [(0, 0)] + [(edge, edge)] * 3)
    windows = sliding_window_view(padded, (side,) * 3, axis=(1, 2, 3))[:, :, ::stride, ::stride]
    out = np.einsum("cnhwijk,ocijk->onhw", windows, weight, optimize=True)
    return out + state.get(f"{name}.bias", np.zeros(len(weight)))[:, None, None, None]


def spectrally_normalised(state, name):
    """The weight over its largest singular value, by one power iteration from the stored start."""
    weight = state[f"{name}_bar"]
    matrix = weight.reshape(len(weight), -1)
    right = matrix.T @ state[f"{name}_u"]
    right /= np.linalg.norm(right)
    left = matrix @ right
    left /= np.linalg.norm(left)
    return weight / (left @ matrix @ right)


def norm(x, state, name):
    mean, variance, scale, shift = (
        state[f"{name}.{part}"][:, None, None, None]
        for part in ("running_mean", "running_var", "weight", "bias")
    )
    return (x - mean) / np.sqrt(variance + 1e-5) * scale + shift


def repeat_pixels(x, size):
    """The nearest pixel of a smaller picture, [C, N, h, w] to [C, N, H, W]."""
    height, width = size
    row = np.arange(height) * x.shape[2] // height
    column = np.arange(width) * x.shape[3] // width
    return x[:, :, row][..., column]
