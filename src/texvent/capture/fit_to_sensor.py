"""Frames fitted to a sensor's size, in float32, so that no intensity is rounded."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.capture.intensity_scale import float_levels
from texvent.frames import MotionVectors, PixelArray
from texvent.sensor import SensorSize


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


def fit_motion(motion: MotionVectors, size: SensorSize, fit: str) -> MotionVectors:
    """Motion of a frame that `fit_pixels` fits: arguments as there.

    Returns:
        Vectors in pixels of the fitted frame. Each of its pixels takes the vector, depth and id at
        its centre, without mixing surfaces; black bars stand still, infinitely far, with id 0.
    """
    fields = (motion.forward, motion.backward, motion.depth, motion.instance)
    old = next((SensorSize(one.shape[1], one.shape[0]) for one in fields if one is not None), size)
    if old == size:
        return motion
    scale = fit_place(old, size, fit)[0].astype(np.float32)

    def fitted(field: NDArray[Any] | None, bar: float) -> Any:
        return None if field is None else _fit_nearest(field, old, size, fit, bar)

    def moved(field: NDArray[np.float32] | None) -> NDArray[np.float32] | None:
        return None if field is None else np.asarray(fitted(field, 0.0) * scale, dtype=np.float32)

    return MotionVectors(
        moved(motion.forward),
        moved(motion.backward),
        fitted(motion.depth, np.inf),
        fitted(motion.instance, 0),
    )


def fit_place(
    old: SensorSize, size: SensorSize, fit: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Map from points of a frame to the fitted one: `point · scale + shift`, (x, y) px each.

    Example:
        >>> [part.tolist() for part in fit_place(SensorSize(8, 4), SensorSize(2, 2), "cover")]
        [[0.5, 0.5], [-1.0, 0.0]]
    """
    left, top, before, after = 0, 0, old, size
    if fit == "cover":
        left, top, before = _cover_window(old, size)
    elif fit == "contain":
        after = _inside(old, size)
    scale = np.array(after, np.float64) / np.array(before)
    bars = (np.array(size) - np.array(after)) // 2
    return scale, bars - np.array([left, top]) * scale


def _fit_nearest(
    field: NDArray[Any], old: SensorSize, size: SensorSize, fit: str, bar: float
) -> NDArray[Any]:
    """As `fit_pixels`, but every new pixel takes the old one at its centre."""
    left, top, before = _cover_window(old, size) if fit == "cover" else (0, 0, old)
    after = _inside(old, size) if fit == "contain" else size
    columns = left + ((np.arange(after.width) + 0.5) * before.width / after.width).astype(np.intp)
    rows = top + ((np.arange(after.height) + 0.5) * before.height / after.height).astype(np.intp)
    inner = field[rows[:, None], columns]
    if after == size:
        return inner
    left, top = (size.width - after.width) // 2, (size.height - after.height) // 2
    result = np.full((*size.shape, *field.shape[2:]), bar, field.dtype)
    result[top : top + after.height, left : left + after.width] = inner
    return result


def _cover_window(old: SensorSize, size: SensorSize) -> tuple[int, int, SensorSize]:
    """Left, top and size of the largest centred part with the aspect of `size`, whole pixels."""
    scale = min(old.width / size.width, old.height / size.height)
    width = min(old.width, max(1, round(size.width * scale)))
    height = min(old.height, max(1, round(size.height * scale)))
    return (old.width - width) // 2, (old.height - height) // 2, SensorSize(width, height)


def _crop(pixels: NDArray[np.float32], size: SensorSize) -> NDArray[np.float32]:
    """The largest centred part with the aspect of `size`, to the nearest pixel."""
    height, width = pixels.shape[:2]
    left, top, part = _cover_window(SensorSize(width, height), size)
    return pixels[top : top + part.height, left : left + part.width]


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
