"""Black bars: rows and columns at the edges that never show anything, beside a picture."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.video_check.blocks import SeenFrame

BLACK_LEVEL = 24.0
"""No pixel of a bar is ever brighter."""
BAR_RANGE = 10.0
"""Levels that the pixels of a bar differ by at most, in space and time."""
LEAST_SHARE = 0.02
"""Of the side: narrower bars are edges of the codec or the lens."""
PICTURE_SHARE = 0.5
"""What of a row beside a bar is brighter than black in one frame, at least: a picture ends there; a
thing before a dark background is narrower."""


class Borders:
    """Keeps what rows and columns showed so far: their extremes, and how much of them was lit."""

    def __init__(self) -> None:
        self._highest: tuple[NDArray[np.float32], ...] = ()
        self._lowest: tuple[NDArray[np.float32], ...] = ()
        self._lit: tuple[NDArray[np.float32], ...] = ()

    def add(self, seen: SeenFrame) -> None:
        """Take one frame."""
        if not seen.is_sampled:
            return
        highest = tuple(seen.luma.max(axis=axis) for axis in (1, 0))
        lowest = tuple(seen.luma.min(axis=axis) for axis in (1, 0))
        is_lit = seen.luma > BLACK_LEVEL
        lit = tuple(is_lit.mean(axis=axis, dtype=np.float32) for axis in (1, 0))
        if self._highest:
            highest = tuple(map(np.maximum, self._highest, highest))
            lowest = tuple(map(np.minimum, self._lowest, lowest))
            lit = tuple(map(np.maximum, self._lit, lit))
        self._highest, self._lowest, self._lit = highest, lowest, lit

    def measures(self) -> dict[str, float]:
        """By name.

        Returns:
            `bar_share`: of the image's area, 0..1. `bar_top`, `bar_bottom`, `bar_left` and
            `bar_right`: widths, px. All are 0 if the whole image is black.
        """
        widths = list(map(bars, self._highest, self._lowest, self._lit))
        (top, bottom), (left, right) = widths or ((0, 0), (0, 0))
        height, width = (len(one) for one in self._highest) if self._highest else (1, 1)
        inside = (height - top - bottom) * (width - left - right)
        names = ("bar_top", "bar_bottom", "bar_left", "bar_right")
        values = (float(one) for one in (top, bottom, left, right))
        return {"bar_share": 1 - inside / (height * width), **dict(zip(names, values, strict=True))}


def bars(
    highest: NDArray[np.float32], lowest: NDArray[np.float32], lit: NDArray[np.float32]
) -> tuple[int, int]:
    """Widths of the bars at both ends of a side, px.

    Args:
        highest: brightest level of each row (or column), [n].
        lowest: darkest level of each.
        lit: share of its pixels that are brighter than black, in the frame where most are.
    """
    is_black = (highest <= BLACK_LEVEL) & (highest - lowest <= BAR_RANGE)
    shown = np.flatnonzero(~is_black)
    if len(shown) == 0:
        return 0, 0
    ends = int(shown[0]), len(highest) - 1 - int(shown[-1])
    least = max(LEAST_SHARE * len(highest), 1)
    first, last = (
        end if end >= least and inside[end : end + math.ceil(least)].max() >= PICTURE_SHARE else 0
        for end, inside in zip(ends, (lit, lit[::-1]), strict=True)
    )
    return first, last
