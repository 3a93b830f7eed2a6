"""Frames fitted to a sensor's size, in float32, so that no intensity is rounded."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.capture.intensity_scale import float_levels
from texvent.sensor import SensorSize
from texvent.video import PixelArray


def fit_pixels(pixels: PixelArray, size: SensorSize, fit: str) -> PixelArray:
    """An image of the wanted size.

    Args:
        pixels: [H, W] or [H, W, 3], any type of `Frame.pixels`.
        size: wanted width and height, pixels.
        fit: `cover` cuts what is too much, evenly on both sides; `contain` adds black bars;
            `stretch` distorts.

    Returns:
        `pixels` itself if it has the size; else float32 on the 0..255 scale. Shrinking averages
        over the area of each new pixel, as a sensor does; enlarging is bilinear.
    """
    height, width = pixels.shape[:2]
    if (width, height) == tuple(size):
        return pixels
    levels = float_levels(pixels)
    if fit == "stretch":
        return _resample(levels, size)
    if fit == "cover":
        return _resample(_crop(levels, size), size)
    return _pad(_resample(levels, _inside(SensorSize(width, height), size)), size)


def _crop(pixels: NDArray[np.float32], size: SensorSize) -> NDArray[np.float32]:
    """The largest centred part with the aspect of `size`, to the nearest pixel."""
    height, width = pixels.shape[:2]
    scale = min(width / size.width, height / size.height)
    cut_width = min(width, max(1, round(size.width * scale)))
    cut_height = min(height, max(1, round(size.height * scale)))
    left, top = (width - cut_width) // 2, (height - cut_height) // 2
    return pixels[top : top + cut_height, left : left + cut_width]


def _inside(old: SensorSize, size: SensorSize) -> SensorSize:
    """The largest size with the aspect of `old` that fits inside `size`."""
    scale = min(size.width / old.width, size.height / old.height)
    return SensorSize(
        min(size.width, max(1, round(old.width * scale))),
        min(size.height, max(1, round(old.height * scale))),
    )


def _pad(pixels: NDArray[np.float32], size: SensorSize) -> NDArray[np.float32]:
    height, width = pixels.shape[:2]
    left, top = (size.width - width) // 2, (size.height - height) // 2
    padded = np.zeros((*size.shape, *pixels.shape[2:]), dtype=np.float32)
    padded[top : top + height, left : left + width] = pixels
    return padded


def _resample(pixels: NDArray[np.float32], size: SensorSize) -> NDArray[np.float32]:
    """Shrink by area, then enlarge bilinearly: each side gets the filter that suits it."""
    height, width = pixels.shape[:2]
    shrunk = (min(width, size.width), min(height, size.height))
    if shrunk != (width, height):
        pixels = _resize(pixels, shrunk, cv2.INTER_AREA)
    if shrunk != tuple(size):
        pixels = _resize(pixels, (size.width, size.height), cv2.INTER_LINEAR)
    return pixels


def _resize(pixels: NDArray[np.float32], size: tuple[int, int], method: int) -> NDArray[np.float32]:
    resized = cv2.resize(np.ascontiguousarray(pixels), size, interpolation=method)
    return np.asarray(resized, dtype=np.float32)
