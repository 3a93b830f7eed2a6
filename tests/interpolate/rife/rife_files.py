"""Untrained networks in the published layouts, narrow, and files of them."""

import numpy as np


def random_tensors(torch, layout, seed=0, width=8):
    """Name → float32 array; layers neither vanish nor explode, flows are a few pixels."""
    from texvent.interpolate.rife.network import RifeNetwork

    random = np.random.default_rng(seed)
    tensors = {}
    with torch.device("meta"):
        network = RifeNetwork(layout, (width,) * len(layout.widths))
    for name, tensor in network.state_dict().items():
        shape = tuple(tensor.shape)
        if name.endswith("beta"):
            values = random.uniform(0.05, 0.2, shape)
        elif name.endswith(".1.weight") and len(shape) == 1:
            values = random.uniform(0.1, 0.4, shape)
        elif len(shape) == 4:
            inputs = shape[0] * 4 if "lastconv" in name or "cnn3" in name else shape[1] * 9
            values = random.normal(0, 1 / np.sqrt(inputs), shape)
        else:
            values = random.normal(0, 0.1, shape)
        tensors[name] = values.astype(np.float32)
    return tensors


def save_published(torch, layout, path):
    """A state dict as training leaves it: a prefix before every name."""
    arrays = random_tensors(torch, layout)
    torch.save({f"module.{name}": torch.from_numpy(one) for name, one in arrays.items()}, path)
    return path
