"""Input and state of the pixel circuits of the `physical` model.

Pixels are numbered y · W + x, every array is flat, and times are µs. A pixel remembers the output
of its photoreceptor at its last reset; every event resets it, whatever its cause.

The photoreceptor is a first-order low-pass of the brightness ln(α + I) whose cutoff frequency is
proportional to α + I, as photocurrent and dark current charge its capacitance. Its response to a
straight line is known in closed form, so the frame rate decides only how well straight lines fit
the scene.

Source: v2e (Hu, Liu and Delbruck, CVPRW 2021), section 4.2, which follows the proportionality of
    photocurrent and bandwidth (Lichtsteiner et al., JSSC 2008).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.frames import MICROSECONDS
from texvent.simulation.kernels.elementary import exponential, natural_log
from texvent.simulation.streaming import IntensityArray

Float64Array: TypeAlias = NDArray[np.float64]
Int64Array: TypeAlias = NDArray[np.int64]
Luma: TypeAlias = NDArray[Any]
"""[n] 0..255 scale, uint8 or float32."""

WHITE = 255.0
ALMOST_BLACK = 1e-25
"""Added to luma before the logarithm that makes it linear; too small to change any but black."""
BLOCK = 256
"""Pixels that a fast kernel looks at together, and skips together if nothing happens to them."""


class PhotoreceptorConstants(NamedTuple):
    """Constants that turn luma into brightness and bandwidth."""

    gamma: float
    """Exponent that makes the luma linear; 1 if it is already."""
    balance: float
    """α, linear levels, above 0: the dark current."""
    cutoff_per_level: float
    """Cutoff frequency ω of a photoreceptor per linear level, dark current included, 1/µs; 0 is
    unlimited."""
    most_current: float
    """α + I from which on the cutoff frequency grows no further, linear levels."""


class PhotoreceptorInput(NamedTuple):
    """Luma at both ends of an interval; brightness is a straight line in time between them."""

    before: Luma
    """[n] luma at the start; a kernel overwrites it with `now`."""
    brightness: Float64Array
    """[n] brightness at the start, log units; the compiled kernel overwrites it too."""
    cutoff: Float64Array
    """[n] cutoff frequency at the start, 1/µs; likewise."""
    now: Luma
    """[n] luma at the end, of the same type."""
    optics: PhotoreceptorConstants
    table: tuple[Float64Array, Float64Array] | None
    """`brightness_and_cutoff` of all levels of 8-bit luma, which saves logarithms; else None."""
    shape: tuple[int, int]
    """(height, width) of the sensor."""


class CircuitState(NamedTuple):
    """State of the pixels; a kernel changes it in place.

    The change that fires a pixel is `output − level + leak · (t − since)`.
    """

    output: Float64Array
    """[n] output of the photoreceptor, which follows the brightness, log units."""
    level: Float64Array
    """[n] that output when the pixel was last reset; NaN while the pixel is held in reset."""
    since_us: Int64Array
    """[n] when the pixel was last reset, or will be released if it is held, µs."""
    quiescent_until_us: Int64Array
    """[blocks] time up to which no pixel of a block fires if its luma does not change; only the
    fast kernel reads it."""


class NoiseEvents(NamedTuple):
    """Noise of one interval, by pixel and then by time."""

    pixel: Int64Array
    """[m] flat index."""
    t: Int64Array
    """[m] µs, in the interval."""
    p: NDArray[np.uint8]
    """[m] 1 = ON, 0 = OFF."""


def brightness_and_cutoff(
    luma: Float64Array, optics: PhotoreceptorConstants
) -> tuple[Float64Array, Float64Array]:
    """Brightness and cutoff frequency of the photoreceptor.

    Args:
        luma: 0..255 scale, any shape.
        optics: the constants.

    Returns:
        `L = ln(α + I)`, log units, and `ω = cutoff_per_level · min(α + I, most_current)`, 1/µs,
        with the linear intensity `I = 255 · (luma / 255)^gamma`.
    """
    current = optics.balance + linearize(luma, optics.gamma)
    cutoff = optics.cutoff_per_level * np.minimum(current, optics.most_current)
    return natural_log(current), cutoff


def linearize(luma: Float64Array, gamma: float) -> Float64Array:
    """Linear intensity of gamma-coded luma.

    Args:
        luma: 0..255 scale, any shape.
        gamma: exponent; 1 leaves the luma as it is.

    Returns:
        `255 · (luma / 255)^gamma`.

    Example:
        >>> linearize(np.array([0.0, 128.0, 255.0]), 2.2).round(2).tolist()
        [0.0, 55.98, 255.0]
    """
    if gamma == 1.0:
        return luma
    exponent = gamma * natural_log((luma + ALMOST_BLACK) / WHITE)
    return np.asarray(WHITE * exponential(exponent))


def new_state(output: Float64Array, level: Float64Array, first_us: int) -> CircuitState:
    """The state of pixels that start at the first frame.

    Args:
        output: of the photoreceptors, [n], log units.
        level: at the last reset, [n], log units.
        first_us: time of the frame, µs.
    """
    blocks = -(-output.size // BLOCK)
    since = np.full(output.size, first_us, np.int64)
    return CircuitState(output, level, since, np.full(blocks, first_us, np.int64))


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
        self._optics = PhotoreceptorConstants(gamma, balance, cutoff_per_level, most_current)
        self._table = brightness_and_cutoff(np.arange(256.0), self._optics)
        self._seen: Luma = luma.reshape(-1).copy()
        self.brightness, self._cutoff = brightness_and_cutoff(
            self._seen.astype(np.float64), self._optics
        )
        """`ln(α + I)` of the last frame, [n], log units."""

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
            self._seen,
            self.brightness,
            self._cutoff,
            np.ascontiguousarray(now),
            self._optics,
            table,
            luma.shape,
        )

    def intensity(self, luma: NDArray[np.generic]) -> Float64Array:
        """Linear intensity of some luma, of the same shape."""
        return linearize(luma.astype(np.float64), self._optics.gamma)
