"""The reconstruction networks in NumPy float64, slowly: what the torch networks are tested against.

Images are [channels, H, W]; `state` is name → array, as in the published files.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from tests.metrics.rvt.rvt_files import sigmoid


def convolve(x, state, name, *, stride=1):
    weight = state[f"{name}.weight"]
    side = weight.shape[-1]
    edge = side // 2
    padded = np.pad(x, ((0, 0), (edge, edge), (edge, edge)))
    windows = sliding_window_view(padded, (side, side), axis=(1, 2))[:, ::stride, ::stride]
    out = np.einsum("chwij,ocij->ohw", windows, weight, optimize=True)
    return out + state.get(f"{name}.bias", np.zeros(len(weight)))[:, None, None]


def norm(x, state, name):
    if f"{name}.running_mean" not in state:
        return x
    mean, variance, scale, shift = (
        state[f"{name}.{part}"][:, None, None]
        for part in ("running_mean", "running_var", "weight", "bias")
    )
    return (x - mean) / np.sqrt(variance + 1e-5) * scale + shift


def layer(x, state, name, *, stride=1):
    return norm(convolve(x, state, f"{name}.conv2d", stride=stride), state, f"{name}.norm_layer")


def relu(x):
    return np.maximum(x, 0)


def block(x, state, name):
    inner = relu(norm(convolve(x, state, f"{name}.conv1"), state, f"{name}.bn1"))
    return relu(norm(convolve(inner, state, f"{name}.conv2"), state, f"{name}.bn2") + x)


def gru(x, state, name, hidden):
    hidden = np.zeros_like(x) if hidden is None else hidden
    both = np.concatenate([x, hidden])
    update = sigmoid(convolve(both, state, f"{name}.update_gate"))
    reset = sigmoid(convolve(both, state, f"{name}.reset_gate"))
    fresh = np.tanh(convolve(np.concatenate([x, hidden * reset]), state, f"{name}.out_gate"))
    return hidden * (1 - update) + fresh * update


def lstm(x, state, name, memory):
    hidden, cell = (np.zeros_like(x), np.zeros_like(x)) if memory is None else memory
    gates = convolve(np.concatenate([x, hidden]), state, f"{name}.Gates")
    enter, remember, leave, fresh = np.split(gates, 4)
    cell = sigmoid(remember) * cell + sigmoid(enter) * np.tanh(fresh)
    return sigmoid(leave) * np.tanh(cell), cell


def resize(x, factor):
    """Bilinear, the centres of corner pixels kept at their place in the scene."""
    for axis in (1, 2):
        length = x.shape[axis]
        place = (np.arange(int(length * factor)) + 0.5) / factor - 0.5
        place = np.clip(place, 0, length - 1)
        low = np.minimum(place.astype(int), max(length - 2, 0))
        high = np.minimum(low + 1, length - 1)
        weight = (place - low).reshape([-1 if one == axis else 1 for one in range(3)])
        x = np.take(x, low, axis) * (1 - weight) + np.take(x, high, axis) * weight
    return x


def up(x, state, name):
    return relu(layer(resize(x, 2), state, name))


def run_firenet(voxels, state, names):
    """Images of a list of voxel grids."""
    memory = [None, None]
    images = []
    for voxel in voxels:
        x = relu(layer(voxel, state, names.head))
        for number in range(2):
            memory[number] = gru(x, state, names.units[number], memory[number])
            x = block(memory[number], state, names.blocks[number])
        images.append(layer(x, state, names.prediction)[0])
    return images


def run_unet(voxels, state, *, has_sigmoid):
    root = "unetrecurrent"
    memory = [None] * 3
    images = []
    for voxel in voxels:
        head = x = relu(layer(voxel, state, f"{root}.head"))
        skipped = []
        for number in range(3):
            name = f"{root}.encoders.{number}"
            x = relu(layer(x, state, f"{name}.conv", stride=2))
            memory[number] = lstm(x, state, f"{name}.recurrent_block", memory[number])
            x = memory[number][0]
            skipped.append(x)
        for number in range(2):
            x = block(x, state, f"{root}.resblocks.{number}")
        for number in range(3):
            x = up(x + skipped.pop(), state, f"{root}.decoders.{number}")
        image = layer(x + head, state, f"{root}.pred")
        images.append((sigmoid(image) if has_sigmoid else image)[0])
    return images
