"""The U-Nets of V2CE and Super SloMo in NumPy float64, slowly, and tensors for them."""

import numpy as np


def random_state(shapes, seed=0):
    """Name → float32 array of an untrained network whose output is neither 0 nor huge."""
    random = np.random.default_rng(seed)
    state = {}
    for name, shape in shapes.items():
        if len(shape) > 1:
            values = random.normal(0, 1.4 / np.sqrt(np.prod(shape[1:])), shape)
        elif name.endswith(("running_var", "bn1.weight", "bn2.weight", "downsample.1.weight")):
            values = random.uniform(0.5, 1.5, shape)
        else:
            values = random.normal(0, 0.2, shape)
        state[name] = values.astype(np.float32)
    return state


def convolve(x, weight, bias=0.0, stride=(1, 1, 1)):
    """[C, N, H, W] with zeros around."""
    edges = [side // 2 for side in weight.shape[2:]]
    padded = np.pad(x, [(0, 0), *((edge, edge) for edge in edges)])
    windows = np.lib.stride_tricks.sliding_window_view(padded, weight.shape[2:], axis=(1, 2, 3))
    windows = windows[:, :: stride[0], :: stride[1], :: stride[2]]
    out = np.einsum("cnhwijk,ocijk->onhw", windows, weight, optimize=True)
    return out + np.reshape(bias, (-1, 1, 1, 1))


def v2ce(pairs, state):
    """Voxel grids [n, 2, 10, H, W] of normalised pairs [n, 2, H, W]."""

    def normalise(x, name):
        parts = ("running_mean", "running_var", "weight", "bias")
        mean, variance, scale, shift = (
            state[f"{name}.{part}"].reshape(-1, 1, 1, 1).astype(float) for part in parts
        )
        return (x - mean) / np.sqrt(variance + 1e-5) * scale + shift

    def weight_of(name):
        if f"{name}.weight" in state:
            return state[f"{name}.weight"].astype(float)
        weight = state[f"{name}.module.weight_bar"].astype(float)
        matrix = weight.reshape(len(weight), -1)
        right = matrix.T @ state[f"{name}.module.weight_u"]
        left = matrix @ (right / np.linalg.norm(right))
        return weight / np.linalg.norm(left)

    def block(x, name, stride=(1, 1, 1)):
        inner = convolve(x, weight_of(f"{name}.conv1"), stride=stride)
        inner = np.maximum(normalise(inner, f"{name}.bn1"), 0)
        inner = normalise(convolve(inner, weight_of(f"{name}.conv2")), f"{name}.bn2")
        around = f"{name}.downsample.0"
        around = convolve(x, weight_of(around), state[f"{around}.bias"], stride)
        return np.maximum(inner + normalise(around, f"{name}.downsample.1"), 0)

    head, last = "UNet.head.conv3d", "UNet.pred.conv3d"
    x = convolve(pairs.swapaxes(0, 1).astype(float), weight_of(head), state[f"{head}.bias"])
    x = np.where(x > 0, x, 0.01 * x)
    beside = []
    for level in range(4):
        beside.append(x)
        x = block(x, f"UNet.encoders.{level}", (1, 2, 2))
    for number in range(2):
        x = block(x, f"UNet.resblocks.{number}")
    for level in range(4):
        skip = beside.pop()
        row, column = (np.arange(skip.shape[i]) * x.shape[i] // skip.shape[i] for i in (2, 3))
        x = block(np.concatenate([x[:, :, row][..., column], skip]), f"UNet.decoders.{level}")
    grids = np.maximum(convolve(x, weight_of(last), state[f"{last}.bias"]), 0)
    return grids.swapaxes(0, 1).reshape(len(pairs), 2, 10, *pairs.shape[2:])


def double(x):
    """[C, H, W] at twice the size: bilinear from corner to corner."""
    for axis in (1, 2):
        length = x.shape[axis]
        at = np.linspace(0, length - 1, 2 * length)
        low = np.floor(at).astype(int)
        share = (at - low).reshape([-1 if one == axis else 1 for one in range(3)])
        high = np.minimum(low + 1, length - 1)
        x = np.take(x, low, axis) * (1 - share) + np.take(x, high, axis) * share
    return x


def super_slomo(x, state, key):
    """Output of a U-Net of Super SloMo for [C, H, W]."""

    def layer(x, name):
        weight, bias = state[f"{key}.{name}.weight"], state[f"{key}.{name}.bias"]
        x = convolve(x[:, None], weight[:, :, None].astype(float), bias)[:, 0]
        return np.where(x > 0, x, 0.1 * x)

    x = layer(layer(x, "conv1"), "conv2")
    beside = []
    for depth in range(1, 6):
        beside.append(x)
        channels, height, width = x.shape
        x = x.reshape(channels, height // 2, 2, width // 2, 2).mean(axis=(2, 4))
        x = layer(layer(x, f"down{depth}.conv1"), f"down{depth}.conv2")
    for step in range(1, 6):
        x = layer(double(x), f"up{step}.conv1")
        x = layer(np.concatenate([x, beside.pop()]), f"up{step}.conv2")
    return layer(x, "conv3")
