"""Trigger levels: the two intensities at which each pixel would fire, so a scan needs no logarithm.

A pixel whose brightness is L(I) and whose reference is R fires if L(I) − R reaches a threshold. As
L rises with I, that is a comparison of I with two levels. They are kept a little narrower than they
are, so that rounding hides no event: who is outside *may* fire, and only there the model computes.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.crossing.levels import (
    Curve,
    Float64Array,
    Luma,
    Outside,
    Thresholds,
    load_find_outside,
    load_look_up,
    load_narrow,
)
from texvent.simulate.random.mismatch import (
    NominalThresholds,
    Shape,
    draw_threshold_pair,
    sensor_key,
)
from texvent.simulate.streaming import IntensityArray

Int64Array = NDArray[np.int64]
AT_A_TIME = 1 << 14


class TriggerLevels:
    """The levels of every pixel, and the luma that it saw last, in the type of the frames."""

    def __init__(self, luma: IntensityArray, curve: Curve, *, backend: str) -> None:
        """Look at the first frame; every pixel has to be looked at until its levels are set.

        Args:
            luma: 0..255 scale, [H, W], uint8 or float32; copied.
            curve: brightness and intensity.
            backend: which kernels scan; all find the same.
        """
        self._curve = curve
        self._backend = backend
        self._seen: Luma = luma.reshape(-1).copy()
        self._low = np.full(self._seen.size, 255, self._seen.dtype)
        self._high = np.zeros(self._seen.size, self._seen.dtype)

    def find_outside(self, luma: IntensityArray) -> Outside:
        """Pixels that may fire at a frame, which from now on is the last one seen.

        Args:
            luma: [H, W].
        """
        now: Luma = luma.reshape(-1)
        if now.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen, now = self._as_float(self._seen), self._as_float(now)
            self._low, self._high = self._as_float(self._low), self._as_float(self._high)
        find_outside = load_find_outside(now.dtype, self._backend)
        return find_outside(now, self._seen, self._low, self._high)

    def set(self, pixel: Int64Array, reference: Float64Array, thresholds: Thresholds) -> None:
        """Say at what brightness some pixels fire: at their references ± θ.

        Args:
            pixel: flat index, [n].
            reference: of all pixels, [H · W] log units.
            thresholds: of the chosen pixels.
        """
        narrow = load_narrow(self._seen.dtype, self._backend)
        narrow(pixel, reference, thresholds, self._curve, self._low, self._high)

    def set_all(
        self,
        reference: Float64Array,
        thresholds: Thresholds,
        *,
        of_luma: Float64Array | None = None,
    ) -> None:
        """Say it of all pixels.

        Args:
            reference: [H · W] log units.
            thresholds: of all pixels.
            of_luma: [256] reference by luma, where it is that of the 8-bit luma seen last.
        """
        if of_luma is not None and thresholds.on.size == 1:
            low, high = np.empty(256, np.uint8), np.empty(256, np.uint8)
            narrow = load_narrow(self._seen.dtype, self._backend)
            narrow(np.arange(256), of_luma, thresholds, self._curve, low, high)
            look_up = load_look_up(self._backend)
            self._low, self._high = look_up(low, self._seen), look_up(high, self._seen)
            return
        # Some at a time: one list of all is larger than most frames.
        for first in range(0, self._seen.size, AT_A_TIME):
            pixel = np.arange(first, min(first + AT_A_TIME, self._seen.size))
            self.set(pixel, reference, thresholds_at(pixel, thresholds))

    @staticmethod
    def _as_float(luma: NDArray[Any]) -> Luma:
        return luma.astype(np.float32, copy=False)


def sensor_thresholds(shape: Shape, seed: int, nominal: NominalThresholds) -> Thresholds:
    """Thresholds that differ from pixel to pixel and never change; [1] each if all are alike."""
    if nominal.threshold_sigma == 0:
        on, off = nominal.contrast_threshold_on, nominal.contrast_threshold_off
        return Thresholds(np.array([float(on)]), np.array([float(off)]))
    pair = draw_threshold_pair(shape, sensor_key(seed), nominal)
    return Thresholds(*(one.reshape(-1) for one in pair))


def thresholds_at(pixel: Int64Array, thresholds: Thresholds) -> Thresholds:
    """Those of some pixels, of thresholds of all, [H · W] each, or [1] if all have the same."""
    on, off = (one if one.size == 1 else one[pixel] for one in thresholds)
    return Thresholds(on, off)
