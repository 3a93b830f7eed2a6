"""Whether pixels have the colour that a word says, as a person would name it."""

from __future__ import annotations

import colorsys

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.scene import Colour, Float64Array
from texvent.transfer import WHITE, encode_srgb

HUE_REACH = 30.0
"""Degrees by which the hue of a named colour may be off."""
LEAST_CHROMA, MOST_GREY_CHROMA = 0.10, 0.15
"""Difference of the highest and lowest of R, G, B that a hue needs, and that grey may have."""


def share_like(pixels: Float64Array, rgb: Colour) -> float:
    """Share of pixels [k, 3], sRGB-coded 0..1, that look like a colour in linear light.

    Example:
        >>> share_like(np.array([[0.8, 0.1, 0.1], [0.1, 0.1, 0.8]]), (0.6, 0.01, 0.01))
        0.5
    """
    if not len(pixels):
        return 0.0
    coded = np.asarray(encode_srgb(np.array([rgb], dtype=np.float64)) / WHITE)[0]
    hue, _, value = colorsys.rgb_to_hsv(*(float(level) for level in coded))
    chroma = float(coded.max() - coded.min())
    top, spread = pixels.max(axis=1), np.ptp(pixels, axis=1)
    if chroma < LEAST_CHROMA:
        is_like = (spread < MOST_GREY_CHROMA) & _has_grey_level(top, value)
    else:
        off = np.abs((_hues(pixels) - 360.0 * hue + 180.0) % 360.0 - 180.0)
        is_like = (off <= HUE_REACH) & (spread >= max(LEAST_CHROMA, 0.3 * chroma * value))
        if value < 0.55:
            is_like &= top < 0.75
        else:
            is_like &= top > 0.3
    return float(np.mean(is_like))


def _has_grey_level(top: Float64Array, value: float) -> NDArray[np.bool_]:
    if value > 0.85:
        return np.asarray(top > 0.55)
    if value < 0.2:
        return np.asarray(top < 0.3)
    return np.asarray((top > 0.2) & (top < 0.9))


def _hues(pixels: Float64Array) -> Float64Array:
    """[k] hues, degrees (colour wheel of HSV)."""
    red, green, blue = pixels.T
    return np.asarray(
        np.degrees(np.arctan2(np.sqrt(3.0) * (green - blue), 2.0 * red - green - blue)) % 360.0
    )
