"""Measures of reconstructed images against true ones: MSE, PSNR, SSIM, LPIPS."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from texvent.errors import InputError, MissingDependencyError
from texvent.metrics.image_measures import (
    Float64Array,
    decibels,
    mean_squared_error,
    structural_similarity,
)
from texvent.metrics.lpips import Lpips, find_lpips_weights, lpips_distance, read_lpips_weights
from texvent.metrics.protocol import Better

Compare: TypeAlias = Callable[[Float64Array, Float64Array], float]


@dataclass(frozen=True)
class ImageMeasure:
    """Comparison of two images, 0..1."""

    name: str
    better: Better
    compare: Compare


@dataclass(frozen=True, kw_only=True)
class Measures:
    """Available measures, and reasons for missing ones."""

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
        network = Lpips(read_lpips_weights(find_lpips_weights()))
    except (InputError, MissingDependencyError) as error:
        return Measures(chosen=plain, absent={"lpips": str(error)})
    lpips = ImageMeasure("lpips", "lower", lambda a, b: lpips_distance(a, b, network))
    return Measures(chosen=(*plain, lpips))


def peak_signal_to_noise(a: Float64Array, b: Float64Array) -> float:
    """`−10 log10(MSE)` in dB for images from 0 to 1; infinite for equal ones."""
    return decibels(mean_squared_error(a, b))
