"""Trigger levels: the two intensities at which a pixel fires, so that a scan needs no logarithm.

Brightness is a logarithm of intensity, L = ln((I − offset) / scale). A pixel with the reference
brightness R fires where L reaches R + θ_on or R − θ_off. As L rises with I, that is

    I ≥ A · e^θ_on + offset   or   I ≤ A · e^−θ_off + offset ,   A = scale · e^R.

`trigger_factors` gives the two factors. Texvent has scale 1 and offset −α: A = α + R's intensity.

**Margin.** A scan rounds, and rounding must hide no event. So each level is moved towards the
reference by `MARGIN`, relative to the level and to the offset. No scan makes more than four float32
roundings, of 6·10⁻⁸ each, on the way to a level: the margin is four times as wide. A pixel
outside its levels *may* fire, and there the model decides with the logarithm in float64. A pixel
inside cannot.

`TriggerLevels` keeps the levels of every pixel for models whose references stay between frames.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel
from texvent.simulate.random.mismatch import Thresholds, thresholds_at
from texvent.simulate.streaming import IntensityArray

Float64Array: TypeAlias = NDArray[np.float64]
Int64Array: TypeAlias = NDArray[np.int64]
Luma: TypeAlias = NDArray[Any]
"""[n] 0..255 scale, uint8 or float32."""

MARGIN = 1e-6
"""By how much trigger levels are moved towards the reference; relative, see above."""
BRIGHTNESS_SLACK = 1e-9
"""Log units by which a brightness must be out of reach, for what is rounded."""
PIXELS_AT_A_TIME = 1 << 14
_BYTE = np.dtype(np.uint8).str


class TriggerFactors(NamedTuple):
    """Factors of A that give the trigger levels."""

    up: float
    """e^θ_on."""
    down: float
    """e^−θ_off."""


def trigger_factors(threshold_on: float, threshold_off: float) -> TriggerFactors:
    """The factors of two thresholds, log units."""
    return TriggerFactors(math.exp(threshold_on), math.exp(-threshold_off))


class OutsidePixels(NamedTuple):
    """Pixels outside their trigger levels, which may fire; the next call overwrites the arrays."""

    pixel: Int64Array
    """[m] flat index, ascending."""
    before: Luma
    """[m] luma in the frame before."""
    now: Luma
    """[m] luma in this frame."""


class BrightnessCurve(NamedTuple):
    """How brightness and intensity belong together."""

    scale: float
    """A pixel of brightness v has the intensity `scale · e^v + offset`."""
    offset: float
    darkest: float = -np.inf
    """No intensity is as dark as a brightness below this, log units."""


FindOutside: TypeAlias = Callable[[Luma, Luma, Luma, Luma], OutsidePixels]
"""`find_outside(luma, seen, low, high)`, see `trigger_levels_reference.find_outside`."""
FIND_OUTSIDE = Kernel[FindOutside](__name__, "find_outside")
SetLevels: TypeAlias = Callable[
    [Int64Array, Float64Array, Thresholds, BrightnessCurve, Luma, Luma], None
]
"""`set_levels(pixel, reference, thresholds, curve, low, high)`, see
`trigger_levels_reference.set_levels`."""
SET_LEVELS = Kernel[SetLevels](__name__, "set_levels")
LookUp: TypeAlias = Callable[[NDArray[Any], NDArray[np.uint8]], NDArray[Any]]
"""`look_up(table, luma)`, see `trigger_levels_reference.look_up`."""
LOOK_UP = Kernel[LookUp](__name__, "look_up")


class TriggerLevels:
    """The trigger levels of every pixel and its last luma, in the type of the frames."""

    def __init__(self, luma: IntensityArray, curve: BrightnessCurve, *, backend: str) -> None:
        """Start from the first frame; every pixel may fire until its levels are set.

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

    def find_outside(self, luma: IntensityArray) -> OutsidePixels:
        """Pixels that may fire at a frame, which becomes the last one seen.

        Args:
            luma: [H, W].
        """
        now: Luma = luma.reshape(-1)
        if now.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen, now = self._as_float(self._seen), self._as_float(now)
            self._low, self._high = self._as_float(self._low), self._as_float(self._high)
        find_outside = FIND_OUTSIDE.load(self._backend)
        return find_outside(now, self._seen, self._low, self._high)

    def set(self, pixel: Int64Array, reference: Float64Array, thresholds: Thresholds) -> None:
        """Set the levels of some pixels from their references.

        Args:
            pixel: flat index, [n].
            reference: of all pixels, [H · W] log units.
            thresholds: of the chosen pixels.
        """
        set_levels = SET_LEVELS.load(self._backend)
        set_levels(pixel, reference, thresholds, self._curve, self._low, self._high)

    def set_all(
        self,
        reference: Float64Array,
        thresholds: Thresholds,
        *,
        of_luma: Float64Array | None = None,
    ) -> None:
        """Set the levels of all pixels.

        Args:
            reference: [H · W] log units.
            thresholds: of all pixels.
            of_luma: [256] reference by luma, where it is that of the 8-bit luma seen last.
        """
        if of_luma is not None and thresholds.on.size == 1:
            low, high = np.empty(256, np.uint8), np.empty(256, np.uint8)
            set_levels = SET_LEVELS.load(self._backend)
            set_levels(np.arange(256), of_luma, thresholds, self._curve, low, high)
            look_up = LOOK_UP.load(self._backend)
            self._low, self._high = look_up(low, self._seen), look_up(high, self._seen)
            return
        # Some at a time: one list of all is larger than most frames.
        for first in range(0, self._seen.size, PIXELS_AT_A_TIME):
            pixel = np.arange(first, min(first + PIXELS_AT_A_TIME, self._seen.size))
            self.set(pixel, reference, thresholds_at(pixel, thresholds))

    @staticmethod
    def _as_float(luma: NDArray[Any]) -> Luma:
        return luma.astype(np.float32, copy=False)
