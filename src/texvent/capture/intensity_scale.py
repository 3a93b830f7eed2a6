"""Pixel values → the 0..255 intensity scale, when their own type does not say the scale."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, warn
from texvent.video import UINT16_PER_LEVEL, PixelArray

FULL_SCALE = 255.0
"""Intensity of white."""


def scale_to_levels(pixels: PixelArray, white_level: float) -> NDArray[np.float32]:
    """Intensity on the 0..255 scale, never rounded to whole levels.

    Args:
        pixels: [H, W] or [H, W, 3], any type of `Frame.pixels`.
        white_level: the value in `pixels` that means white.

    Returns:
        The same shape, float32: `pixels · 255 / white_level`.
    """
    return np.asarray(pixels * np.float32(FULL_SCALE / white_level), dtype=np.float32)


def float_levels(pixels: PixelArray) -> NDArray[np.float32]:
    """Pixels as float32 on the 0..255 scale; uint16 is full scale (65535 is white).

    Args:
        pixels: [H, W] or [H, W, 3], any type of `Frame.pixels`.
    """
    if pixels.dtype == np.uint16:
        return scale_to_levels(pixels, FULL_SCALE * UINT16_PER_LEVEL)
    return np.asarray(pixels, dtype=np.float32)


def usable_pixels(pixels: NDArray[Any], where: str) -> PixelArray:
    """Pixels of a type that `Frame` takes, without loss, or a clear refusal.

    Args:
        pixels: [..., H, W] or [..., H, W, 3] of any type.
        where: what to call them in messages.

    Returns:
        uint8, uint16, float32 and float64 as they are; bool as uint8 0 and 255; float16 as
        float32.

    Raises:
        InputError: another type. Wide and signed integers are refused because they may mean
            0..255 or 0..65535, and guessing wrong gives dark frames and hardly any event.
    """
    if pixels.dtype in (np.uint8, np.uint16, np.float32, np.float64):
        return pixels
    if pixels.dtype == np.bool_:
        return pixels.astype(np.uint8) * np.uint8(255)
    if pixels.dtype == np.float16:
        return pixels.astype(np.float32)
    raise InputError(
        f"{where} has pixels of type {pixels.dtype}; allowed: uint8 (0..255), uint16 (0..65535), "
        "float (0..255 unless white_level says otherwise), bool. Convert with "
        ".astype(np.uint8) or .astype(np.uint16)"
    )


def warn_of_few_bits(pixels: PixelArray, where: str) -> None:
    """Warn of 16-bit pixels that probably have 10 or 12: they would be nearly black.

    Warns:
        TexventWarning: no value is above 4095, and one is above 255.
    """
    if pixels.dtype != np.uint16:
        return
    highest = int(pixels.max(initial=0))
    bits = next((bits for bits in (10, 12) if 255 < highest < 1 << bits), None)
    if bits is not None:
        white = (1 << bits) - 1
        warn(
            f"{where} holds 16-bit frames up to {highest}, so they probably have {bits} bits; give "
            f"white_level={white}, or white_level=65535 if they really are that dark"
        )


def refuse_unit_range(highest: float, where: str) -> None:
    """Refuse float pixels that never exceed 1: they are most likely 0..1, which would be black.

    Raises:
        InputError: the highest value lies in (0, 1].
    """
    if 0.0 < highest <= 1.0:
        raise InputError(
            f"{where} holds floats that never exceed {highest:g}, so they are probably 0..1, while "
            "texvent's intensities are 0..255. Give white_level=1 if 1 means white, or "
            "white_level=255 if the images really are that dark"
        )
