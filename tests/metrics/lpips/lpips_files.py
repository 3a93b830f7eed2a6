"""A narrow network of LPIPS's shape, its file as published, and its distance written slowly."""

import pickle
from dataclasses import replace

import numpy as np

from texvent.metrics.lpips import ALEX, PUBLISHED_NAME, array_shapes

NARROW = tuple(replace(layer, channels=2 + number % 2) for number, layer in enumerate(ALEX))


def narrow_weights(seed=0, layers=NARROW):
    rng = np.random.default_rng(seed)
    return {
        name: (np.abs if "head" in name else np.asarray)(
            rng.normal(0, 0.5, shape).astype(np.float32)
        )
        for name, shape in array_shapes(layers).items()
    }


def published(arrays):
    """What the package's file holds: dictionaries of arrays, one per layer."""
    return {
        PUBLISHED_NAME: {
            f"Conv_{n}": {"kernel": arrays[f"kernel{n}"], "bias": arrays[f"bias{n}"]}
            for n in range(len(ALEX))
        },
        **{
            f"NetLinLayer_{n}": {"Conv_0": {"kernel": arrays[f"head{n}"].reshape(1, 1, -1, 1)}}
            for n in range(len(ALEX))
        },
    }


def write_published(weights, path):
    path.write_bytes(pickle.dumps(published(weights), protocol=3))
    return path


def slow_distance(a, b, weights):
    """LPIPS one pixel at a time; a and b are [height, width, 3], 0..1."""
    total = 0.0
    for number, pair in enumerate(
        zip(slow_features(a, weights), slow_features(b, weights), strict=True)
    ):
        one, other = (x / (np.sqrt((x**2).sum(axis=2, keepdims=True)) + 1e-10) for x in pair)
        total += ((one - other) ** 2 @ weights[f"head{number}"]).mean()
    return total


def slow_features(image, weights):
    shift, spread = (-0.030, -0.088, -0.188), (0.458, 0.448, 0.450)
    x, compared = (2 * image - 1 - np.array(shift)) / spread, []
    for number, layer in enumerate(ALEX):
        if layer.pools:
            x = np.array([[at.max(axis=(0, 1)) for at in row] for row in cut(x, layer.pools, 2)])
        kernel = weights[f"kernel{number}"].astype(np.float64)
        padded = np.pad(x, ((layer.padding,) * 2, (layer.padding,) * 2, (0, 0)))
        parts = cut(padded, len(kernel), layer.stride)
        x = np.array([[np.tensordot(at, kernel, 3) for at in row] for row in parts])
        x = np.maximum(x + weights[f"bias{number}"], 0.0)
        compared.append(x)
    return compared


def cut(x, side, stride):
    """Rows of the squares that a kernel sees."""
    rows, columns = (range(0, n - side + 1, stride) for n in x.shape[:2])
    return [[x[r : r + side, c : c + side] for c in columns] for r in rows]
