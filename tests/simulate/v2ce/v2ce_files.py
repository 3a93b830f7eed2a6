"""Small networks in the published file's layout, and a stand-in for the network."""

import numpy as np

BASE_CHANNELS = 2
"""Instead of 32; every name and relation of shapes stays."""


def random_tensors(base_channels: int = BASE_CHANNELS, seed: int = 0) -> dict[str, np.ndarray]:
    """Name → float32 array of an untrained network whose output is neither 0 nor huge."""
    from texvent.simulate.v2ce.network import V2ceUnet  # needs torch

    random = np.random.default_rng(seed)
    tensors = {}
    for name, tensor in V2ceUnet(base_channels).state_dict().items():
        shape = tuple(tensor.shape)
        if name.endswith("num_batches_tracked"):
            tensors[name] = np.zeros(shape, np.int64)
            continue
        if name.endswith("running_var"):
            values = random.uniform(0.5, 1.5, shape)
        elif len(shape) == 5:
            values = random.normal(0, 1.5 / np.sqrt(np.prod(shape[1:])), shape)
        elif name.endswith(("bn1.weight", "bn2.weight", "downsample.1.weight")):
            values = random.uniform(0.5, 1.5, shape)
        else:
            values = random.normal(0, 0.2, shape)
        tensors[name] = values.astype(np.float32)
    return tensors


class StandInNetwork:
    """Counts that rise with the change of a pair, and with the whole sequence's, as a U-Net's do.

    `seen` keeps the first frame's mean of every pair of every sequence.
    """

    def __init__(self) -> None:
        self.seen: list[list[float]] = []

    def predict(self, pairs: np.ndarray) -> np.ndarray:
        self.seen.append([float(pair[0].mean()) for pair in pairs])
        change = pairs[:, 1] - pairs[:, 0]
        around = np.abs(change).mean()
        nodes = np.linspace(0.2, 1.1, 10)[:, None, None]
        both = np.stack([np.maximum(change, 0), np.maximum(-change, 0)], axis=1)
        return (both[:, :, None] * nodes * (1 + around)).astype(np.float32)
