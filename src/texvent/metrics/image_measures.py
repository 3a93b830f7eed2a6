"""Comparison of grey images, 0..1: MSE, PSNR, SSIM."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

SIGMA_PX = 1.5
RADIUS_PX = 5
"""3.5 σ, rounded: an 11×11 window."""
LUMINANCE, CONTRAST = 0.01, 0.03
"""K1 and K2 of the paper."""

Float64Array: TypeAlias = NDArray[np.float64]


def structural_similarity(a: Float64Array, b: Float64Array) -> float:
    """Mean SSIM over all pixels whose 11×11 window is inside the image.

    The same as scikit-image's with `gaussian_weights=True, use_sample_covariance=False`.

    Args:
        a: [H, W].
        b: [H, W].

    Returns:
        −1..1, or NaN if a side is shorter than 11 px.

    Source: Z. Wang et al., "Image quality assessment: from error visibility to structural
        similarity", IEEE Transactions on Image Processing 13 (2004), Eq. 13.
    """
    if min(a.shape) < 2 * RADIUS_PX + 1:
        return float("nan")
    mean_a, mean_b, square_a, square_b, product = _smooth(np.stack([a, b, a * a, b * b, a * b]))
    variance = square_a - mean_a**2 + square_b - mean_b**2
    covariance = product - mean_a * mean_b
    c1, c2 = LUMINANCE**2, CONTRAST**2
    ssim = (2 * mean_a * mean_b + c1) * (2 * covariance + c2)
    ssim /= (mean_a**2 + mean_b**2 + c1) * (variance + c2)
    return float(ssim.mean())


def _smooth(images: Float64Array) -> Float64Array:
    """Gaussian-weighted mean around every pixel that is far enough from the border."""
    weights = gaussian_window()
    for axis in (-1, -2):
        # The windows become the last axis; the product with the weights removes it again.
        windows = np.lib.stride_tricks.sliding_window_view(images, len(weights), axis=axis)
        images = windows @ weights
    return images


def gaussian_window() -> Float64Array:
    """Weights along one axis, [11], with sum 1."""
    offset = np.arange(-RADIUS_PX, RADIUS_PX + 1)
    weights = np.exp(-(offset**2) / (2 * SIGMA_PX**2))
    return np.asarray(weights / weights.sum())


def mean_squared_error(a: Float64Array, b: Float64Array) -> float:
    """Mean squared difference of two images."""
    return float(((a - b) ** 2).mean())


def decibels(mse: float) -> float:
    """`−10 log10(MSE)`, dB; infinite for 0."""
    return math.inf if mse == 0 else -10.0 * math.log10(mse)
