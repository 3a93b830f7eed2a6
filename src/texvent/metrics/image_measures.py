"""How two grey images, 0..1, are compared: MSE, PSNR, SSIM, LPIPS."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.metrics.lpips.distance import lpips_distance
from texvent.metrics.lpips.weights import find_lpips_weights, read_lpips_weights
from texvent.metrics.protocol import Better
from texvent.metrics.structural_similarity import structural_similarity

Float64Array: TypeAlias = NDArray[np.float64]
Compare: TypeAlias = Callable[[Float64Array, Float64Array], float]


@dataclass(frozen=True)
class ImageMeasure:
    """How two images, 0..1, are compared."""

    name: str
    better: Better
    compare: Compare


@dataclass(frozen=True, kw_only=True)
class Measures:
    """What is measured here, and what cannot be."""

    chosen: tuple[ImageMeasure, ...]
    absent: Mapping[str, str] = field(default_factory=dict)
    """Name of a measure → why it is left out."""


def load_measures() -> Measures:
    """All measures; LPIPS only where its weights were pulled.

    Source: EVREAL (Ercan et al., CVPRW 2023) reports MSE, SSIM and LPIPS (AlexNet); the paper adds
        PSNR in its Table 3.
    """
    plain = (
        ImageMeasure("mse", "lower", mean_squared_error),
        ImageMeasure("psnr", "higher", peak_signal_to_noise),
        ImageMeasure("ssim", "higher", structural_similarity),
    )
    try:
        weights = read_lpips_weights(find_lpips_weights())
    except InputError as error:
        return Measures(chosen=plain, absent={"lpips": str(error)})
    lpips = ImageMeasure("lpips", "lower", lambda a, b: lpips_distance(a, b, weights))
    return Measures(chosen=(*plain, lpips))


def mean_squared_error(a: Float64Array, b: Float64Array) -> float:
    """Mean squared difference of two images."""
    return float(((a - b) ** 2).mean())


def peak_signal_to_noise(a: Float64Array, b: Float64Array) -> float:
    """`−10 log10(MSE)` in dB for images from 0 to 1; infinite for equal ones."""
    mse = mean_squared_error(a, b)
    return math.inf if mse == 0 else -10.0 * math.log10(mse)
