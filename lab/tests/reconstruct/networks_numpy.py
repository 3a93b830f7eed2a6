"""The reconstruction networks in NumPy float64, slowly: what the torch networks are tested against.

Images are [channels, H, W]; `state` is name → array, as in the published files.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from tests.metrics.rvt.rvt_files import sigmoid


def convolve(x, state, name, *, stride=1, edge=None):
    weight = state[f"{name}.weight"]
    side = weight.shape[-1]
    edge = side // 2 if edge is None else edge
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


def run_unet(voxels, state, *, has_sigmoid, is_dynamic=False):
    root = "unetrecurrent"
    memory = [None] * 3
    last = np.zeros_like(voxels[0][:1])
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
            x, name = x + skipped.pop(), f"{root}.decoders.{number}"
            if is_dynamic and number == 0:
                x = decode_dynamically(x, state, name, np.concatenate([voxel, last]))
            else:
                x = up(x, state, name)
        last = layer(x + head, state, f"{root}.pred")
        last = sigmoid(last) if has_sigmoid else last
        images.append(last[0])
    return images


def decode_dynamically(x, state, name, context):
    """Pixel by pixel: a kernel per atom from the context, then a mixture of the atoms' answers."""
    inner = f"{name}.dynamic_atom_generation"
    z = convolve(resize(context, 0.25), state, f"{name}.context_fusion.conv")
    for conv, after in (("0", "1"), ("3", "4")):
        z = convolve(z, state, f"{inner}.bases_net.{conv}")
        z = np.tanh(norm(z, state, f"{inner}.bases_net.{after}"))
    bases = state[f"{inner}.bases"]
    x = resize(x, 2)
    channels, height, width = x.shape
    side = round(bases.shape[1] ** 0.5)
    edge = side // 2
    padded = np.pad(x, ((0, 0), (edge, edge), (edge, edge)))
    mixture = state[f"{name}.dynamic_conv.compositional_coefficients"][:, :, 0, 0]
    out = np.empty((len(mixture), height, width))
    for row in range(height):
        for column in range(width):
            atoms = z[:, row, column].reshape(6, -1) @ bases
            patch = padded[:, row : row + side, column : column + side].reshape(channels, -1)
            answers = patch @ atoms.T  # [channels, atoms]
            out[:, row, column] = mixture @ answers.ravel()
    return relu(out + state[f"{name}.dynamic_conv.bias"][:, None, None])


def run_et_net(voxels, state):
    memory = [None] * 3
    images = []
    for voxel in voxels:
        head = x = relu(layer(voxel, state, "head"))
        skipped = []
        for number in range(3):
            name = f"DownsampleConv.{number}"
            x = relu(layer(x, state, f"{name}.conv", stride=2))
            memory[number] = lstm(x, state, f"{name}.recurrent_block", memory[number])
            x = memory[number][0]
            skipped.append(x)
        x = transform(skipped, state)
        for number in range(3):
            x = up(x + skipped.pop(), state, f"UpsampleConv.{number}")
        images.append(sigmoid(layer(x + head, state, "pred"))[0])
    return images


def transform(maps, state):
    coarsest = maps[-1]
    splits = (
        coarsest,
        convolve(maps[1], state, "split1", stride=2, edge=0),
        convolve(maps[0], state, "split2", stride=4, edge=0),
    )
    encoded = []
    for scale, image in enumerate(splits):
        tokens = image.reshape(len(image), -1).T
        tokens = tokens + places(*tokens.shape)
        for number in range(3):
            name = f"trans_encoder{scale}.encoder.layers.{number}"
            normal = layer_norm(tokens, state, f"{name}.norm1")
            tokens = tokens + attend(normal, normal, state, f"{name}.self_attn")
            tokens = tokens + feed_forward(tokens, state, name, "norm2")
        encoded.append(tokens)
    decoded = []
    for scale in range(3):
        tokens, known = encoded[scale], encoded[max(scale - 1, 0)]
        for number in range(2):
            name = f"trans_decoder{scale}.decoder.layers.{number}"
            normal = layer_norm(tokens, state, f"{name}.norm1")
            tokens = tokens + attend(normal, normal, state, f"{name}.self_attn")
            queries = layer_norm(tokens, state, f"{name}.norm21")
            memory = layer_norm(known, state, f"{name}.norm22")
            tokens = tokens + attend(queries, memory, state, f"{name}.cross_attn")
            tokens = tokens + feed_forward(tokens, state, name, "norm3")
        decoded.append(tokens)
    return (sum(encoded + decoded) / 6).T.reshape(coarsest.shape)


def places(count, features):
    table = np.empty((count, features))
    for place in range(count):
        for feature in range(features):
            angle = place / 10000 ** (2 * (feature // 2) / features)
            table[place, feature] = np.cos(angle) if feature % 2 else np.sin(angle)
    return table


def attend(queries, memory, state, name, heads=8):
    weight, bias = state[f"{name}.in_proj_weight"], state[f"{name}.in_proj_bias"]
    q, k, v = (
        x @ w.T + b
        for x, w, b in zip(
            (queries, memory, memory), np.split(weight, 3), np.split(bias, 3), strict=True
        )
    )
    features = q.shape[1] // heads
    out = []
    for head in range(heads):
        part = slice(head * features, (head + 1) * features)
        scores = q[:, part] @ k[:, part].T / np.sqrt(features)
        scores = np.exp(scores - scores.max(axis=1, keepdims=True))
        out.append(scores / scores.sum(axis=1, keepdims=True) @ v[:, part])
    return linear(np.concatenate(out, axis=1), state, f"{name}.out_proj")


def linear(x, state, name):
    return x @ state[f"{name}.weight"].T + state[f"{name}.bias"]


def layer_norm(x, state, name):
    mean, variance = x.mean(axis=1, keepdims=True), x.var(axis=1, keepdims=True)
    return (x - mean) / np.sqrt(variance + 1e-5) * state[f"{name}.weight"] + state[f"{name}.bias"]


def feed_forward(x, state, name, before):
    hidden = linear(layer_norm(x, state, f"{name}.{before}"), state, f"{name}.linear1")
    return linear(relu(hidden), state, f"{name}.linear2")
