"""What falls on the photoreceptors: frame after frame, in the type that they come in.

The photoreceptor is a first-order low-pass of the brightness ln(α + I) whose corner frequency is
proportional to intensity, as the photocurrent charges its capacitance. Its answer to a straight
line is known exactly, so the frame rate decides only how well straight lines fit the scene.

Source: v2e (Hu, Liu and Delbruck, CVPRW 2021), section 4.2, which follows the proportionality of
    photocurrent and bandwidth (Lichtsteiner et al., JSSC 2008).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.physical.kernels.circuit import (
    DARK_OFFSET,
    WHITE,
    Light,
    Luma,
    Optics,
    light_of,
    linearize,
)
from texvent.simulate.streaming import IntensityArray
from texvent.video import MICROSECONDS

Float64Array = NDArray[np.float64]


class Sight:
    """The frame that the pixels saw last, and what they see of the next one."""

    def __init__(
        self, luma: IntensityArray, *, gamma: float, balance: float, cutoff_hz: float
    ) -> None:
        """Look at the first frame.

        Args:
            luma: 0..255 scale, [H, W], uint8 or float; copied.
            gamma: exponent that makes it linear; 1 if it is already.
            balance: α, linear levels, above 0.
            cutoff_hz: bandwidth at white; 0 is unlimited. It is `cutoff · (I + 20) / 275`.
        """
        corner_per_level = 2.0 * math.pi * cutoff_hz / (WHITE + DARK_OFFSET) / MICROSECONDS
        self._optics = Optics(gamma, balance, corner_per_level)
        self._table = light_of(np.arange(256.0), self._optics)
        self._seen: Luma = luma.reshape(-1).copy()

    def brightness(self) -> Float64Array:
        """`ln(α + I)` of the last frame, [n], log units."""
        return light_of(self._seen.astype(np.float64), self._optics)[0]

    def towards(self, luma: IntensityArray) -> Light:
        """What is seen from the last frame to this one; a kernel makes this one the last.

        Args:
            luma: [H, W].
        """
        now: Luma = luma.reshape(-1)
        if now.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen, now = self._seen.astype(np.float32), now.astype(np.float32)
        table = self._table if now.dtype == np.uint8 else None
        return Light(self._seen, np.ascontiguousarray(now), self._optics, table, luma.shape)

    def intensity(self, luma: NDArray[np.generic]) -> Float64Array:
        """Linear intensity of some luma, of the same shape."""
        return linearize(luma.astype(np.float64), self._optics.gamma)
