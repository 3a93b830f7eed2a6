"""v2e's shot noise: independent events, or Gaussian noise of the photoreceptor."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import Purpose, draw_normals
from texvent.simulate.random.mismatch import NominalThresholds
from texvent.simulate.random.poisson_noise import PoissonNoise

Float64Array = NDArray[np.float64]

DARK_OFFSET, WHITE_LEVEL = 20.0, 275.0
"""Bandwidth and shot noise depend on (I + 20) / 275, which is never 0."""
BRIGHT_SHOT_SHARE = 0.25
"""Shot noise at white, as a share of the noise in the dark."""
NOISE_FIT = (-0.0026, -0.036, -0.1949, 0.321)
"""log10(threshold / noise rms) as a cubic in log10(ON rate / bandwidth): v2e's fit to Graça and
Delbruck, "Unraveling the paradox of intensity-dependent DVS pixel noise", 2021, Fig. 3."""
NOISE_FIT_RANGE = (1e-5, 1.0)
"""ON rate / bandwidth over which that fit was made."""


class ShotNoise:
    """Independent noise events; pixels with low thresholds fire more of them."""

    def __init__(
        self,
        rate_hz: float,
        nominal: NominalThresholds,
        thresholds: tuple[Float64Array, Float64Array],
        *,
        backend: str,
    ) -> None:
        """Set the rate of every pixel.

        Args:
            rate_hz: events per second in the dark, of a pixel with nominal thresholds.
            nominal: the nominal thresholds.
            thresholds: ON and OFF thresholds of every pixel, [H, W] each, log units.
            backend: which kernels draw; all draw the same.
        """
        more_on = nominal.contrast_threshold_on / thresholds[0]
        more_off = nominal.contrast_threshold_off / thresholds[1]
        self._on_fraction = more_on / (more_on + more_off)
        self._noise = PoissonNoise(rate_hz / 2 * (more_on + more_off))
        self._backend = backend

    def draw(self, luma: NDArray[Any], interval: FrameInterval) -> UnsortedEvents:
        """The noise events of one interval.

        Args:
            luma: at the end of it, [H · W], 0..255 scale.
            interval: where in time; its key decides the draws.
        """
        return self._noise.draw(
            interval,
            rate_fraction=lambda pixel: (
                1.0 - (1.0 - BRIGHT_SHOT_SHARE) * np.minimum(relative_intensity(luma[pixel]), 1.0)
            ),
            on_fraction=self._on_fraction,
            backend=self._backend,
        )


def relative_intensity(intensity: NDArray[Any]) -> Float64Array:
    """`(I + 20) / 275`, float64: what bandwidth and shot noise depend on."""
    return np.asarray((intensity + DARK_OFFSET) / WHITE_LEVEL, np.float64)


def next_photoreceptor_noise(
    noise: Float64Array,
    shape: tuple[int, ...],
    interval: FrameInterval,
    *,
    cutoff_hz: float,
    rms: float,
) -> Float64Array:
    """Band-limited Gaussian noise at the end of an interval, [H · W] log units.

    Args:
        noise: that at its start, [H · W].
        shape: (height, width).
        interval: where in time; its key decides the draws.
        cutoff_hz: bandwidth of the noise.
        rms: of the noise, log units.
    """
    y, x = np.ogrid[: shape[0], : shape[1]]
    fresh = draw_normals(interval.key, y, x, Purpose.VOLTAGE.draw()).reshape(-1)
    kept = math.exp(-2 * math.pi * cutoff_hz * interval.duration_s)
    return kept * noise + rms * math.sqrt(1 - kept * kept) * fresh


def photoreceptor_noise_rms(rate_hz: float, cutoff_hz: float, threshold: float) -> float:
    """Rms of the band-limited Gaussian noise that fires `rate_hz` events at a threshold.

    Args:
        rate_hz: noise events per second wanted, ON and OFF together.
        cutoff_hz: bandwidth of the noise.
        threshold: contrast threshold, log units.

    Returns:
        Log units.

    Source: `NOISE_FIT`.
    """
    exponent = float(np.polyval(NOISE_FIT, math.log10(rate_hz / 2 / cutoff_hz)))
    return float(threshold / 10.0**exponent)
