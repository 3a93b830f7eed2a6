"""From frames to the signal of a photoreceptor: linear light, and a bandwidth that grows with it.

The photoreceptor is a first-order low-pass of the brightness ln(α + I) whose corner frequency is
proportional to intensity, as the photocurrent charges its capacitance. Its answer to a straight
line is known exactly, so the frame rate decides only how well straight lines fit the scene.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.circuit import Drive
from texvent.simulate.streaming import IntensityArray

Float64Array = NDArray[np.float64]

WHITE = 255.0
DARK_OFFSET = 20.0
"""Intensity, linear levels, that stands for what flows in the dark; v2e's value."""
PIECE_ANGLE = 0.25
"""Longest piece of an interval that counts as straight, in time constants 1/ω: crossing times on
it are wrong by (1/4)² / 8 < 1 % of the time constant."""


def linearize(luma: IntensityArray, gamma: float) -> Float64Array:
    """Linear intensity of gamma-coded luma.

    Args:
        luma: 0..255 scale, [H, W], uint8 or float.
        gamma: exponent; 1 leaves the luma as it is.

    Returns:
        `255 · (luma / 255)^gamma`, [H, W] float64.

    Example:
        >>> linearize(np.array([[0, 128, 255]], np.uint8), 2.2).round(2).tolist()
        [[0.0, 55.98, 255.0]]
    """
    if gamma == 1.0:
        return luma.astype(np.float64)
    if luma.dtype == np.uint8:
        return np.asarray(linearize(np.arange(256.0), gamma)[luma])
    return np.asarray(WHITE * np.power(luma / np.float64(WHITE), gamma))


def corner_frequency(intensity: Float64Array, cutoff_hz: float) -> Float64Array:
    """Bandwidth `cutoff · (I + 20) / 275`, Hz, [H, W].

    Args:
        intensity: linear, 0..255 scale, [H, W].
        cutoff_hz: bandwidth at white.

    Source: v2e (Hu, Liu and Delbruck, CVPRW 2021), section 4.2, which follows the proportionality
        of photocurrent and bandwidth (Lichtsteiner et al., JSSC 2008).
    """
    return cutoff_hz * ((intensity + DARK_OFFSET) / (WHITE + DARK_OFFSET))


def drive_photoreceptors(rise: Float64Array, corner_hz: Float64Array, duration_s: float) -> Drive:
    """How every photoreceptor follows a straight line of brightness over one interval.

    Args:
        rise: change of brightness over the interval, any shape.
        corner_hz: bandwidth of each pixel, of the same shape; 0 is unlimited.
        duration_s: length of the interval, s.

    Returns:
        Flat arrays; see `Drive`.
    """
    angle = 2.0 * math.pi * duration_s * corner_hz.reshape(-1)
    # Many pieces cost time only where a pixel may fire.
    pieces = np.maximum(np.ceil(angle / PIECE_ANGLE), 1.0)
    piece_decay, piece_gain = _answer_to_line(angle / pieces)
    decay, gain = _answer_to_line(angle)
    return Drive(rise.reshape(-1), pieces.astype(np.int64), piece_decay, piece_gain, decay, gain)


def _answer_to_line(angle: Float64Array) -> tuple[Float64Array, Float64Array]:
    """`e^(−a)` and `(1 − e^(−a)) / a`; (0, 0), which is no lag, for an unlimited bandwidth."""
    limited = angle > 0
    decay = np.where(limited, np.exp(-angle), 0.0)
    gain = np.divide(-np.expm1(-angle), angle, out=np.zeros_like(angle), where=limited)
    return decay, gain
