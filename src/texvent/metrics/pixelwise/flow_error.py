"""Errors of optical flow, as the DSEC-Flow benchmark defines them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError

OUTLIERS_PX = (1, 2, 3)
"""End-point errors above which a pixel counts for 1PE, 2PE and 3PE."""


class FlowError:
    """Errors of all valid pixels of all images given to `update`.

    A pixel is valid where both components of the truth are finite, and inside the mask if there is
    one. Every such pixel counts the same.

    Source: M. Gehrig et al., "E-RAFT: dense optical flow from event cameras", 3DV 2021, and the
        DSEC-Flow benchmark.
    """

    def __init__(self) -> None:
        """No pixel yet."""
        self._pixels = 0
        self._sums = np.zeros(2 + len(OUTLIERS_PX))

    def update(
        self,
        predicted: NDArray[np.floating],
        true: NDArray[np.floating],
        mask: NDArray[np.bool_] | None = None,
    ) -> None:
        """Add the pixels of one image.

        Args:
            predicted: (x, y) displacement, px, [2, H, W].
            true: the same; NaN where it is not known.
            mask: [H, W]; pixels where it is False are left out. None: all of them.

        Raises:
            InputError: the shapes differ.
        """
        if predicted.shape != true.shape or predicted.shape[0] != 2:
            raise InputError(
                f"flow has shape {predicted.shape} and its truth {true.shape}; both must be "
                "(2, H, W)"
            )
        valid = np.isfinite(true).all(axis=0)
        if mask is not None:
            valid &= mask
        found, sought = (one[:, valid].astype(np.float64) for one in (predicted, true))
        distance = np.hypot(*(found - sought))
        self._pixels += distance.size
        outliers = [(distance > limit).sum() for limit in OUTLIERS_PX]
        self._sums += (distance.sum(), _angles(found, sought).sum(), *outliers)

    def compute(self) -> dict[str, float]:
        """The errors so far; NaN if there was no valid pixel.

        Returns:
            EPE: mean end-point error, px. AE: mean angle between (x, y, 1) of both, degrees. 1PE,
            2PE, 3PE: share of pixels with a larger end-point error than so many pixels, %.
        """
        scale = 1 / self._pixels if self._pixels else np.nan
        epe, angle, *outliers = (self._sums * scale).tolist()
        shares = {f"{n}PE": 100 * share for n, share in zip(OUTLIERS_PX, outliers, strict=True)}
        return {"EPE": epe, "AE": angle, **shares}


def _angles(found: NDArray[np.float64], sought: NDArray[np.float64]) -> NDArray[np.float64]:
    """Degrees between (x, y, 1) of two flows, [n]."""
    # By the cross product: the cosine alone is blind to small angles.
    (x1, y1), (x2, y2) = found, sought
    cross = np.sqrt((y1 - y2) ** 2 + (x2 - x1) ** 2 + (x1 * y2 - y1 * x2) ** 2)
    angles: NDArray[np.float64] = np.degrees(np.arctan2(cross, x1 * x2 + y1 * y2 + 1))
    return angles
