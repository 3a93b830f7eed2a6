"""Intensity → luma → brightness: the logarithm that Eqs. 1, 4 and 5 compare.

Intensity is what a frame holds, on the 0..255 scale; brightness is its balanced natural
logarithm `L = ln(α + I)`. Kernels take brightness, not intensity, because two libraries may
round a logarithm differently in the last bit and an event threshold would show it. Intensities of
frames are checked here too.
"""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, InputError

LUMA_WEIGHTS = (0.299, 0.587, 0.114)
"""Red, green, blue weights of ITU-R BT.601: what OpenCV, v2e and ESIM use for grey input."""
LUMA_ROWS = 16
"""Rows that are converted at a time: what they need stays in the processor's cache."""

Float64Array: TypeAlias = NDArray[np.float64]


def luma_bt601(rgb: NDArray[Any]) -> NDArray[np.float32]:
    """Luma of an RGB image, never rounded to whole levels.

    Args:
        rgb: [H, W, 3], any numeric type.

    Returns:
        [H, W] float32, on the scale of `rgb`.

    Source: ITU-R BT.601, Y' = 0.299 R' + 0.587 G' + 0.114 B'.
    """
    red, green, blue = (np.float32(weight) for weight in LUMA_WEIGHTS)
    result = np.empty(rgb.shape[:-1], np.float32)
    for top in range(0, len(rgb), LUMA_ROWS):
        band = rgb[top : top + LUMA_ROWS]
        luma = band[..., 0] * red
        luma += band[..., 1] * green
        luma += band[..., 2] * blue
        result[top : top + LUMA_ROWS] = luma
    return result


def balanced_log(intensity: NDArray[Any], balance: float) -> Float64Array:
    """Brightness `L(α + I)` of Eq. 5, natural logarithm.

    Args:
        intensity: luma on the 0..255 scale, [H, W], uint8 or float.
        balance: α, on the same scale, above 0.

    Returns:
        [H, W] float64, log units.

    Raises:
        ConfigError: α is not above 0, so black has no logarithm.

    Equation: (5), section 3.2.2; supplement 9.1.
    """
    if balance <= 0:
        raise ConfigError(f"balance is {balance:g}; it must be above 0")
    if intensity.dtype == np.uint8:
        table = np.log(balance + np.arange(256, dtype=np.float64))
        return np.asarray(table[intensity])
    return np.asarray(np.log(intensity + np.float64(balance), dtype=np.float64))


HIGHEST_INTENSITY = 1e9
"""Highest intensity of a frame, on the 0..255 scale: four million times white. Up to here every
model's float32 and float64 arithmetic is finite."""


SYMMETRIC = (
    "they are probably -1..1, while texvent's intensities are 0..255. Give (frames + 1) / 2 and "
    "white_level=1"
)
"""Said of pixels around 0, such as those of diffusion models."""
_OVERSHOT = 1.5
"""Most that pixels of -1..1 reach, with what filters and decoders overshoot."""


def check_intensity(pixels: NDArray[Any], where: str) -> None:
    """Refuse intensities outside 0..`HIGHEST_INTENSITY`, and NaN.

    Raises:
        InputError: there is one; the message counts them.
    """
    if not is_intensity(pixels):
        raise bad_intensity(pixels, where)


def is_intensity(pixels: NDArray[Any]) -> bool:
    """Whether all pixels lie in 0..`HIGHEST_INTENSITY`; integer pixels always do."""
    return pixels.dtype.kind != "f" or bool(pixels.min() >= 0 and pixels.max() <= HIGHEST_INTENSITY)


def bad_intensity(pixels: NDArray[Any], where: str) -> InputError:
    """The error for a frame of which a pixel is not in 0..`HIGHEST_INTENSITY`."""
    bad = pixels[~((pixels >= 0) & (pixels <= HIGHEST_INTENSITY))]
    return InputError(
        f"{where} has {bad.size} pixel(s) that are NaN, infinite or negative, or above "
        f"{HIGHEST_INTENSITY:g} (first: {bad[0]:g}); intensities must be 0..{HIGHEST_INTENSITY:g}, "
        f"where 255 is white; {_remedy(pixels)}"
    )


def _remedy(pixels: NDArray[Any]) -> str:
    lowest, highest = float(pixels.min()), float(pixels.max())
    if not (np.isfinite(lowest) and np.isfinite(highest)):
        return "fill what is not known, such as np.nan_to_num(frames, posinf=255)"
    if highest > HIGHEST_INTENSITY:
        return "give white_level, or divide by what is white"
    if lowest < -0.5 * highest:
        is_symmetric = max(-lowest, highest) <= _OVERSHOT
        return SYMMETRIC if is_symmetric else "add what makes black 0"
    return "cut what filters leave below 0: np.clip(frames, 0, None)"
