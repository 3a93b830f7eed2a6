"""The input of the photoreceptors: frame after frame, in the type of the frames.

The photoreceptor is a first-order low-pass of the brightness ln(α + I) whose cutoff frequency is
proportional to α + I, as photocurrent and dark current charge its capacitance. Its response to a
straight line is known in closed form, so the frame rate decides only how well straight lines fit
the scene.

Source: v2e (Hu, Liu and Delbruck, CVPRW 2021), section 4.2, which follows the proportionality of
    photocurrent and bandwidth (Lichtsteiner et al., JSSC 2008).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.physical.circuit import (
    WHITE,
    Luma,
    Optics,
    PhotoreceptorInput,
    brightness_and_cutoff,
    linearize,
)
from texvent.simulate.streaming import IntensityArray
from texvent.video import MICROSECONDS

Float64Array = NDArray[np.float64]


class InputFrames:
    """The last frame that the photoreceptors received, and what they receive until the next."""

    def __init__(
        self,
        luma: IntensityArray,
        *,
        gamma: float,
        balance: float,
        cutoff_hz: float,
        cutoff_limit_hz: float = 0.0,
    ) -> None:
        """Start from the first frame.

        Args:
            luma: 0..255 scale, [H, W], uint8 or float; copied.
            gamma: exponent that makes it linear; 1 if it is already.
            balance: α, linear levels, above 0.
            cutoff_hz: bandwidth at white; 0 is unlimited. It is `cutoff · (α + I) / (α + 255)`, ...
            cutoff_limit_hz: ... and at most this; 0 is unlimited.
        """
        cutoff_per_level = 2.0 * math.pi * cutoff_hz / (balance + WHITE) / MICROSECONDS
        most_current = math.inf
        if cutoff_hz > 0 and cutoff_limit_hz > 0:
            most_current = cutoff_limit_hz / cutoff_hz * (balance + WHITE)
        self._optics = Optics(gamma, balance, cutoff_per_level, most_current)
        self._table = brightness_and_cutoff(np.arange(256.0), self._optics)
        self._seen: Luma = luma.reshape(-1).copy()

    def brightness(self) -> Float64Array:
        """`ln(α + I)` of the last frame, [n], log units."""
        return brightness_and_cutoff(self._seen.astype(np.float64), self._optics)[0]

    def until(self, luma: IntensityArray) -> PhotoreceptorInput:
        """The input from the last frame to this one; a kernel makes this one the last.

        Args:
            luma: [H, W].
        """
        now: Luma = luma.reshape(-1)
        if now.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen, now = self._seen.astype(np.float32), now.astype(np.float32)
        table = self._table if now.dtype == np.uint8 else None
        return PhotoreceptorInput(
            self._seen, np.ascontiguousarray(now), self._optics, table, luma.shape
        )

    def intensity(self, luma: NDArray[np.generic]) -> Float64Array:
        """Linear intensity of some luma, of the same shape."""
        return linearize(luma.astype(np.float64), self._optics.gamma)
