"""Pixel values → the 0..255 intensity scale, when their own type does not say the scale."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, shown
from texvent.frames import UINT16_PER_LEVEL, PixelArray
from texvent.options.arrays import as_array, usable_pixels

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


def caller_pixels(image: Any, where: str) -> PixelArray:
    """An image of a caller: an array, a tensor, nested lists, or an image of Pillow.

    Args:
        image: [H, W], [H, W, 1] or [H, W, 3]; of Pillow, any mode that means light.
        where: what to call it in messages.

    Returns:
        [H, W] or [H, W, 3], as `usable_pixels`; a view of the caller's where that is possible.

    Raises:
        InputError: another shape, type or mode, or masked values.
    """
    if image is None:
        raise InputError(f"{where} is None, no frame; did the reader fail or end?")
    if isinstance(image, (str, bytes, Path)):
        raise InputError(
            f"{where} is the name {shown(image)}; a list holds images, not their names: give the "
            "folder of the files, or open them one by one"
        )
    pixels = as_array(image, where)
    if pixels.dtype == object and pixels.ndim == 0:
        raise InputError(
            f"{where} is of type {type(image).__name__}, which is no array; make one of it, such "
            "as frame.to_ndarray(format='rgb24') of PyAV, image.get()[..., ::-1] of OpenCV's UMat"
        )
    if pixels.ndim == 3 and pixels.shape[-1] == 1:
        pixels = pixels[..., 0]
    shape = pixels.shape
    if not (len(shape) == 2 or (len(shape) == 3 and shape[-1] == 3)) or 0 in shape:
        raise InputError(
            f"{where} must be [H, W] or [H, W, 3]; got shape {list(shape)}{shape_hint(shape)}"
        )
    return usable_pixels(pixels, where)


def shape_hint(shape: tuple[int, ...]) -> str:
    """Advice for an image of another shape; what it says also holds for a stack of them."""
    if len(shape) != 3 or 0 in shape:
        return ""
    if shape[-1] in (2, 4):
        channels = "0" if shape[-1] == 2 else ":3"
        return f". Drop the alpha channel: frames[..., {channels}]"
    if shape[0] in (1, 3, 4):
        return ". Channels come last: np.moveaxis(frames, -3, -1)"
    return ". One axis too many: give images one by one, such as frames[0]"
