"""Fréchet distance between patch statistics: for streams of different scenes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.metrics.unpaired.patch_statistics import FEATURES, patch_statistics

CLIP = 5.0
"""Features are clipped to this many standard deviations: one absurd feature must not drown 13."""
RIDGE = 1e-6
"""Added to the diagonal of both covariances, which may be singular."""

Float64Array = NDArray[np.float64]


class FrechetStatistics(Metric):
    """Fréchet distance of the Gaussians fitted to 14 patch statistics of each stream.

    Features are standardised by the reference, so the order of the streams matters. NaN if a
    stream has no more patches than features. Text-to-event has no paired truth: this compares
    with any real recording of the same sensor.
    """

    name = "frechet"
    needs = "any scene"
    range = (0.0, float("inf"))
    blind_to = "what the scene shows, and anything wider than 12 px or 50 ms"

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        """Squared distance, in standard deviations of the reference."""
        return compare_statistics(patch_statistics(predicted), patch_statistics(reference))


def compare_statistics(predicted: Float64Array, reference: Float64Array) -> float:
    """Distance of patch statistics, of one stream or of many together.

    Args:
        predicted: [n, 14], see `patch_statistics`.
        reference: [m, 14].

    Returns:
        Squared distance, in standard deviations of the reference; NaN if either has no more
        patches than features.
    """
    if min(len(predicted), len(reference)) <= len(FEATURES):
        return UNDEFINED
    centre, scale = reference.mean(axis=0), reference.std(axis=0)
    scale[scale == 0] = 1.0
    clipped = (np.clip((one - centre) / scale, -CLIP, CLIP) for one in (predicted, reference))
    return frechet_distance(*clipped)


def frechet_distance(a: Float64Array, b: Float64Array) -> float:
    """`|μa − μb|² + tr(Σa + Σb − 2 (Σa Σb)^½)` of two samples.

    Args:
        a: [n, features], n at least 2.
        b: [m, features], m at least 2.

    Source: D. Dowson, B. Landau, "The Fréchet distance between multivariate normal
        distributions", Journal of Multivariate Analysis 12 (1982).
    """
    ridge = RIDGE * np.eye(a.shape[1])
    cov_a, cov_b = (np.cov(one, rowvar=False) + ridge for one in (a, b))
    values, vectors = np.linalg.eigh(cov_a)
    root = (vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
    # (Σa Σb)^½ has the eigenvalues of the square root of this symmetric product.
    cross = np.linalg.eigvalsh(root @ cov_b @ root)
    trace = np.trace(cov_a) + np.trace(cov_b) - 2 * np.sqrt(np.maximum(cross, 0.0)).sum()
    shift = a.mean(axis=0) - b.mean(axis=0)
    return max(0.0, float(shift @ shift + trace))
