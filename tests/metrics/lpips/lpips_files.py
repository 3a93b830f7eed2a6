"""A narrow network of LPIPS's shape, its file as published, and its distance written slowly."""

import math
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
    """LPIPS one number at a time; a and b are [height, width, 3], 0..1."""
    total = 0.0
    for number, (one, other) in enumerate(
        zip(slow_features(a, weights), slow_features(b, weights), strict=True)
    ):
        head, height, width = weights[f"head{number}"], len(one), len(one[0])
        for y in range(height):
            for x in range(width):
                lengths = [
                    math.sqrt(sum(v * v for v in at)) + 1e-10 for at in (one[y][x], other[y][x])
                ]
                total += sum(
                    head[c] * (one[y][x][c] / lengths[0] - other[y][x][c] / lengths[1]) ** 2
                    for c in range(len(head))
                ) / (height * width)
    return total


def slow_features(image, weights):
    shift, spread = (-0.030, -0.088, -0.188), (0.458, 0.448, 0.450)
    x = [
        [[(2 * v - 1 - s) / d for v, s, d in zip(at, shift, spread, strict=True)] for at in row]
        for row in image.tolist()
    ]
    compared = []
    for number, layer in enumerate(ALEX):
        if layer.pools:
            x = slow_pool(x, layer.pools)
        kernel, bias = weights[f"kernel{number}"], weights[f"bias{number}"]
        x = slow_convolution(x, kernel.tolist(), bias.tolist(), layer.stride, layer.padding)
        compared.append(x)
    return compared


def slow_convolution(x, kernel, bias, stride, padding):
    side, height, width = len(kernel), len(x), len(x[0])

    def output(row, column, channel):
        value = bias[channel]
        for i in range(side):
            for j in range(side):
                at_y, at_x = row * stride + i - padding, column * stride + j - padding
                if 0 <= at_y < height and 0 <= at_x < width:
                    value += sum(
                        v * k[channel] for v, k in zip(x[at_y][at_x], kernel[i][j], strict=True)
                    )
        return max(value, 0.0)

    rows, columns = ((n + 2 * padding - side) // stride + 1 for n in (height, width))
    return [
        [[output(r, c, k) for k in range(len(bias))] for c in range(columns)] for r in range(rows)
    ]


def slow_pool(x, side):
    rows, columns = ((n - side) // 2 + 1 for n in (len(x), len(x[0])))
    return [
        [
            [
                max(x[2 * r + i][2 * c + j][k] for i in range(side) for j in range(side))
                for k in range(len(x[0][0]))
            ]
            for c in range(columns)
        ]
        for r in range(rows)
    ]
