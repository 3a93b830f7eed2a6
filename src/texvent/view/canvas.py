"""Drawing on RGB pictures: scaling, text, boxes, PNG. The file that knows OpenCV."""

from __future__ import annotations

from typing import Any, Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.errors import OutputError
from texvent.view.palettes import Colour

Picture = NDArray[np.uint8]
"""[H, W, 3] RGB, 0..255."""

FONT = cv2.FONT_HERSHEY_SIMPLEX


def blank(width: int, height: int, colour: Colour) -> Picture:
    """A picture of one colour."""
    return np.full((height, width, 3), colour, dtype=np.uint8)


def enlarge(picture: Picture, factor: int, *, how: Literal["smooth", "blocks"]) -> Picture:
    """The picture `factor` times as large: smooth for photographs, blocks for events."""
    if factor == 1:
        return picture
    method = cv2.INTER_CUBIC if how == "smooth" else cv2.INTER_NEAREST
    height, width = picture.shape[:2]
    return np.asarray(
        cv2.resize(picture, (width * factor, height * factor), interpolation=method),
        dtype=np.uint8,
    )


def text_width(text: str, height: int) -> int:
    """Width of a line of text, pixels, for capitals `height` pixels high."""
    scale, thickness = _font_scale(height)
    (width, _), _ = cv2.getTextSize(text, FONT, scale, thickness)
    return int(width)


def draw_text(
    picture: Picture, text: str, x: int, baseline: int, *, height: int, colour: Colour
) -> None:
    """Write a line of text into the picture, its left end at x, capitals `height` pixels high."""
    scale, thickness = _font_scale(height)
    cv2.putText(picture, text, (x, baseline), FONT, scale, colour, thickness, cv2.LINE_AA)


def draw_box(picture: Picture, x: int, y: int, width: int, height: int, colour: Colour) -> None:
    """Fill a rectangle; parts outside the picture are left out."""
    picture[max(y, 0) : max(y + height, 0), max(x, 0) : max(x + width, 0)] = colour


def fit_text(text: str, height: int, width: int) -> str:
    """The text, cut with … if it is wider than `width` pixels; empty if not even that fits."""
    if text_width(text, height) <= width:
        return text
    low, high = 0, len(text)
    while low < high:
        middle = (low + high + 1) // 2
        if text_width(text[:middle].rstrip() + "...", height) <= width:
            low = middle
        else:
            high = middle - 1
    return text[:low].rstrip() + "..." if low else ""


def png_bytes(picture: Picture) -> bytes:
    """The picture as a PNG file in memory.

    Raises:
        OutputError: OpenCV refuses the picture.
    """
    done, data = cv2.imencode(".png", cv2.cvtColor(picture, cv2.COLOR_RGB2BGR))
    if not done:
        raise OutputError(f"a picture of shape {picture.shape} cannot be written as PNG")
    encoded: Any = data
    return bytes(encoded.tobytes())


def _font_scale(height: int) -> tuple[float, int]:
    """OpenCV's size and thickness for capitals `height` pixels high (21 px at scale 1)."""
    return height / 21.0, max(1, round(height / 14))
