"""Trigger levels: the two intensities at which each pixel would fire, so a scan needs no logarithm.

A pixel whose brightness is L(I) and whose reference is R fires if L(I) − R reaches a threshold. As
L rises with I, that is a comparison of I with two levels. They are kept a little narrower than they
are, so that rounding hides no event: who is outside *may* fire, and only there the model computes.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.levels import Luma, load_find_outside, load_narrow
from texvent.simulate.streaming import IntensityArray

Float64Array = NDArray[np.float64]
Int64Array = NDArray[np.int64]


class TriggerLevels:
    """The levels of every pixel, and the luma that it saw last, in the type of the frames."""

    def __init__(self, luma: IntensityArray, *, scale: float, offset: float, backend: str) -> None:
        """Look at the first frame; every pixel has to be looked at until its levels are set.

        Args:
            luma: 0..255 scale, [H, W], uint8 or float32; copied.
            scale: a pixel of brightness v has the intensity `scale · e^v + offset`.
            offset: see `scale`.
            backend: which kernels scan; all find the same.
        """
        self._curve = scale, offset
        self._backend = backend
        self._seen: Luma = luma.reshape(-1).copy()
        self._low = np.full(self._seen.size, 255, self._seen.dtype)
        self._high = np.zeros(self._seen.size, self._seen.dtype)

    def find_outside(self, luma: IntensityArray) -> tuple[Int64Array, Luma, Luma]:
        """Pixels that may fire at a frame, which from now on is the last one seen.

        Args:
            luma: [H, W].

        Returns:
            Their flat index, ascending, and their luma in the frame before and in this one; [n].
        """
        now: Luma = luma.reshape(-1)
        if now.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen, now = self._as_float(self._seen), self._as_float(now)
            self._low, self._high = self._as_float(self._low), self._as_float(self._high)
        pixel = load_find_outside(now.dtype, self._backend)(now, self._low, self._high)
        before, after = self._seen[pixel], now[pixel]
        self._seen[:] = now
        return pixel, before, after

    def set(self, pixel: Int64Array, low: Float64Array, high: Float64Array) -> None:
        """Say at what brightness some pixels fire.

        Args:
            pixel: flat index, [n].
            low: brightness at and below which each fires OFF, [n].
            high: brightness at and above which it fires ON, [n].
        """
        narrow = load_narrow(self._seen.dtype, self._backend)
        narrow(pixel, (low, high), self._curve, self._low, self._high)

    @staticmethod
    def _as_float(luma: NDArray[Any]) -> Luma:
        return luma.astype(np.float32, copy=False)
