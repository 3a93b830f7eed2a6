"""LPIPS: how different two images look, by the features of a trained network; NumPy alone."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from texvent.errors import InputError
from texvent.metrics.lpips.layout import COLOURS, Convolution
from texvent.metrics.lpips.weights import LpipsWeights
from texvent.metrics.protocol import UNDEFINED

Float32Array = NDArray[np.float32]

SHIFT = np.array([-0.030, -0.088, -0.188], np.float32)
SPREAD = np.array([0.458, 0.448, 0.450], np.float32)
"""Mean and spread of red, green and blue in training, of values from −1 to 1."""
LEAST_LENGTH = np.float32(1e-10)
"""Added to the length of a feature vector, so that a vector of zeros can be divided by it."""
BLOCK_VALUES = 2**22
"""Values of a map that are laid out for one matrix product: rows are taken in blocks."""


def lpips_distance(a: ArrayLike, b: ArrayLike, weights: LpipsWeights) -> float:
    """Distance of two images as LPIPS version 0.1 measures it.

    Each layer's features are scaled to length 1 at every pixel; the squared differences are
    weighted per channel, averaged over pixels, and added up over the layers.

    Args:
        a: [H, W] grey or [H, W, 3] RGB, 0..1.
        b: alike, of the same height and width.
        weights: see `lpips_weights.read_lpips_weights`.

    Returns:
        0 for equal images, about 1 for unrelated ones; NaN if a side is too short for the
        network (31 px for alex, 16 px for vgg).

    Raises:
        InputError: the shapes differ or are no images, or a value is outside 0..1.

    Source: R. Zhang et al., "The unreasonable effectiveness of deep features as a perceptual
        metric" (CVPR 2018), and the published package, version 0.1.4.
    """
    first, second = _image(a), _image(b)
    if first.shape != second.shape:
        raise InputError(
            f"cannot compare an image of {first.shape[1]}x{first.shape[0]} px with one of "
            f"{second.shape[1]}x{second.shape[0]} px; crop or resize one of them"
        )
    if min(first.shape[:2]) < weights.layout.least_side:
        return UNDEFINED
    total = 0.0
    pairs = zip(_features(first, weights), _features(second, weights), strict=True)
    for number, (one, other) in enumerate(pairs):
        squared = (_unit_length(one) - _unit_length(other)) ** 2
        head = weights.arrays[f"head{number}"]
        total += float((squared @ head).mean(dtype=np.float64))
    return total


def _image(values: ArrayLike) -> Float32Array:
    """[H, W, 3] in the network's unit."""
    pixels = np.asarray(values, np.float32)
    if pixels.ndim == 2:
        pixels = np.repeat(pixels[..., None], COLOURS, axis=2)
    if pixels.ndim != 3 or pixels.shape[2] != COLOURS or not pixels.size:
        raise InputError(
            f"an image has shape {list(np.shape(values))}; it must be [height, width] or "
            "[height, width, 3]"
        )
    low, high = float(pixels.min()), float(pixels.max())
    if not (low >= 0 and high <= 1):
        raise InputError(
            f"an image holds values from {low:g} to {high:g}; they must be from 0 to 1: "
            "divide 8-bit images by 255"
        )
    return np.asarray((2 * pixels - 1 - SHIFT) / SPREAD, np.float32)


def _features(image: Float32Array, weights: LpipsWeights) -> Iterator[Float32Array]:
    """Maps [h, w, channels] of the layers that are compared."""
    x = image
    for number, layer in enumerate(weights.layout.convolutions):
        if layer.pools:
            x = _pool(x, layer.pools)
        x = _convolve(x, layer, weights.arrays[f"kernel{number}"])
        x = np.maximum(x + weights.arrays[f"bias{number}"], 0)
        if layer.is_compared:
            yield x


def _convolve(x: Float32Array, layer: Convolution, kernel: Float32Array) -> Float32Array:
    """[h, w, in] to [h', w', out], a block of rows at a time."""
    padded = np.pad(x, ((layer.padding, layer.padding), (layer.padding, layer.padding), (0, 0)))
    windows = np.lib.stride_tricks.sliding_window_view(
        padded, (layer.kernel, layer.kernel), axis=(0, 1)
    )[:: layer.stride, :: layer.stride]
    # [h', w', in, rows, columns] to the kernel's order; channels last copies fastest.
    windows = windows.transpose(0, 1, 3, 4, 2)
    matrix = kernel.reshape(-1, layer.channels)
    rows = max(BLOCK_VALUES // (windows.shape[1] * len(matrix)), 1)
    return np.concatenate(
        [
            windows[row : row + rows].reshape(-1, windows.shape[1], len(matrix)) @ matrix
            for row in range(0, len(windows), rows)
        ]
    )


def _pool(x: Float32Array, side: int) -> Float32Array:
    """The maximum of every second window; a window that leaves the map is dropped."""
    height, width = ((length - side) // 2 + 1 for length in x.shape[:2])
    shifted = [
        x[row : row + 2 * height : 2, column : column + 2 * width : 2][:height, :width]
        for row in range(side)
        for column in range(side)
    ]
    return np.asarray(np.maximum.reduce(shifted))


def _unit_length(features: Float32Array) -> Float32Array:
    length = np.sqrt((features**2).sum(axis=2, keepdims=True))
    return np.asarray(features / (length + LEAST_LENGTH))
