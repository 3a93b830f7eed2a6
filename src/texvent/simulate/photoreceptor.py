"""From frames to the signal of a photoreceptor: linear light, and a bandwidth that grows with it.

The photoreceptor is a first-order low-pass of the brightness ln(α + I) whose corner frequency is
proportional to intensity, as the photocurrent charges its capacitance. Its answer to a straight
line is known exactly, so the frame rate decides only how well straight lines fit the scene.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import balanced_log
from texvent.simulate.kernels.circuit import Drive
from texvent.simulate.streaming import IntensityArray
from texvent.video import MICROSECONDS

Float64Array = NDArray[np.float64]

WHITE = 255.0
DARK_OFFSET = 20.0
"""Intensity, linear levels, that stands for what flows in the dark; v2e's value."""
PIECE_ANGLE = 0.25
"""Longest piece of an interval that counts as straight, in time constants 1/ω: crossing times on
it are wrong by (1/4)² / 8 < 1 % of the time constant."""
MOST_PIECES = 1024
"""Of one interval. Only intervals above 0.16 s at 250 Hz need more; their crossing times are wrong
by less than a piece, so a thousandth of the interval, and frames an hour apart take no hour."""


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


class Light(NamedTuple):
    """What a frame shows, as pixels see it."""

    intensity: Float64Array
    """I, linear levels 0..255, [H, W]."""
    brightness: Float64Array
    """L = ln(α + I), [H, W]."""
    balance: float
    """α, linear levels."""


def see(luma: IntensityArray, *, gamma: float, balance: float) -> Light:
    """The light that falls on the pixels.

    Args:
        luma: 0..255 scale, [H, W], uint8 or float.
        gamma: exponent that makes it linear; 1 if it is already.
        balance: α, linear levels, above 0.
    """
    intensity = linearize(luma, gamma)
    return Light(intensity, balanced_log(intensity, balance), balance)


def drive_photoreceptors(before: Light, now: Light, cutoff_hz: float, duration_us: int) -> Drive:
    """How every photoreceptor follows brightness from one frame to the next.

    Its corner frequency is `cutoff · (I + 20) / 275`.

    Args:
        before: light at the start.
        now: light at the end.
        cutoff_hz: bandwidth at white; 0 is unlimited.
        duration_us: length of the interval, µs.

    Returns:
        Flat arrays; see `Drive`.

    Source: v2e (Hu, Liu and Delbruck, CVPRW 2021), section 4.2, which follows the proportionality
        of photocurrent and bandwidth (Lichtsteiner et al., JSSC 2008).
    """
    corner_per_level = 2.0 * math.pi * cutoff_hz / (WHITE + DARK_OFFSET) / MICROSECONDS
    levels = [light.intensity.reshape(-1) + DARK_OFFSET for light in (before, now)]
    turn = corner_per_level * duration_us
    # Many pieces cost time only where a pixel may fire.
    pieces = np.clip(np.ceil(turn * np.maximum(*levels) / PIECE_ANGLE), 1.0, MOST_PIECES)
    rise = (now.brightness - before.brightness).reshape(-1)
    decay, gain = _answer_to_line(turn * (levels[0] + levels[1]) / 2)
    return Drive(
        rise=rise,
        pieces=pieces.astype(np.int64),
        glow=(before.balance + before.intensity).reshape(-1) * np.exp(rise / pieces / 2),
        growth=np.exp(rise / pieces),
        decay=decay,
        gain=gain,
        corner_per_level=corner_per_level,
        corner_level=DARK_OFFSET - before.balance,
    )


def _answer_to_line(angle: Float64Array) -> tuple[Float64Array, Float64Array]:
    """`e^(−a)` and `(1 − e^(−a)) / a`; (0, 0), which is no lag, for an unlimited bandwidth."""
    limited = angle > 0
    decay = np.where(limited, np.exp(-angle), 0.0)
    gain = np.divide(-np.expm1(-angle), angle, out=np.zeros_like(angle), where=limited)
    return decay, gain
