"""Errors of dense predictions: depth and optical flow."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError

FARTHEST_M = 80.0
"""Points beyond this distance count as sky, m."""
RATIO = 1.25
WITHIN_M = (10, 20, 30)
"""Depths up to which the mean error is given as well, m."""


class DepthError:
    """Errors of depth images, each a mean over its valid pixels; the mean of images is given.

    A pixel is valid where the truth is above 0 and below the farthest depth, and inside the mask
    if there is one. Images without a valid pixel are left out.

    Source: J. Hidalgo-Carrió, D. Gehrig, D. Scaramuzza, "Learning monocular dense depth from
        events", 3DV 2020, and its program, `evaluation.py`.
    Deviation: a prediction beyond the farthest depth counts as that depth; the program leaves such
        pixels out.
    """

    def __init__(self) -> None:
        """No image yet."""
        self._rows: list[dict[str, float]] = []

    def update(
        self,
        predicted: NDArray[np.floating],
        true: NDArray[np.floating],
        mask: NDArray[np.bool_] | None = None,
    ) -> None:
        """Add one image.

        Args:
            predicted: depth, m, [H, W], above 0.
            true: the same; NaN where it is not known, inf for the sky.
            mask: [H, W]; pixels where it is False are left out. None: all of them.

        Raises:
            InputError: the shapes differ, or a prediction is not above 0.
        """
        if predicted.shape != true.shape:
            raise InputError(f"depth has shape {predicted.shape} and its truth {true.shape}")
        valid = (true > 0) & (true < FARTHEST_M)
        if mask is not None:
            valid &= mask
        found, sought = (one[valid].astype(np.float64) for one in (predicted, true))
        if not (found > 0).all():
            raise InputError("a predicted depth is not above 0 m")
        if found.size:
            self._rows.append(_errors(np.minimum(found, FARTHEST_M), sought))

    def compute(self) -> dict[str, float]:
        """The errors so far; NaN where no image has a valid pixel.

        Returns:
            abs_rel: |e| / depth. sq_rel: (e / depth)². RMS: of e, m. RMS_log: of the difference of
            logarithms. SILog: their variance. delta1, delta2, delta3: share of pixels whose ratio
            to the truth is below 1.25, 1.25², 1.25³. mean_10m, mean_20m, mean_30m: mean |e| of
            pixels nearer than that, m.
        """
        # Formed of no pixel, the names are those of any image.
        names = self._rows[0] if self._rows else _errors(np.ones(1), np.ones(1))
        return {name: _mean([row[name] for row in self._rows]) for name in names}


def _errors(found: NDArray[np.float64], sought: NDArray[np.float64]) -> dict[str, float]:
    """The errors of one image, from its valid pixels, [n]."""
    error = np.abs(found - sought)
    log_error = np.log(found) - np.log(sought)
    ratio = np.exp(np.abs(log_error))
    return {
        "abs_rel": float((error / sought).mean()),
        "sq_rel": float(((error / sought) ** 2).mean()),
        "RMS": float(np.sqrt((error**2).mean())),
        "RMS_log": float(np.sqrt((log_error**2).mean())),
        "SILog": float(log_error.var()),
        **{f"delta{k}": float((ratio < RATIO**k).mean()) for k in (1, 2, 3)},
        **{f"mean_{limit}m": _mean(error[sought < limit]) for limit in WITHIN_M},
    }


def _mean(values: NDArray[np.float64] | list[float]) -> float:
    """Mean of what is not NaN, or NaN."""
    known = np.asarray(values)[~np.isnan(values)]
    return float(known.mean()) if known.size else float("nan")


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
