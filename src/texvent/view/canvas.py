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

RIM: Colour = (20, 22, 26)
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


def draw_frame(picture: Picture, corners: tuple[int, int, int, int], colour: Colour) -> None:
    """Outline the rectangle x0, y0, x1, y1 (all inside it), with a dark rim to stand out."""
    x0, y0, x1, y1 = corners
    cv2.rectangle(picture, (x0, y0), (x1, y1), RIM, 4)
    cv2.rectangle(picture, (x0, y0), (x1, y1), colour, 2)


def draw_arrow(
    picture: Picture, tail: tuple[float, float], tip: tuple[float, float], colour: Colour
) -> None:
    """An arrow with a dark rim; ends are pixels."""
    ends = [(round(float(x)), round(float(y))) for x, y in (tail, tip)]
    for ink, thickness in ((RIM, 4), (colour, 2)):
        cv2.arrowedLine(picture, ends[0], ends[1], ink, thickness, cv2.LINE_AA, tipLength=0.3)


def draw_label(
    picture: Picture, text: str, corner: tuple[int, int], colour: Colour, *, height: int = 10
) -> None:
    """A word on a coloured strip above the corner, or below it at the picture's edge."""
    x, y = corner
    strip = 2 * height
    top = y - strip if y >= strip else y
    draw_box(picture, x, top, text_width(text, height) + height, strip, colour)
    baseline = top + (strip + height) // 2
    draw_text(picture, text, x + height // 2, baseline, height=height, colour=RIM)


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
    """The picture, RGB or grey [H, W], as a PNG file in memory.

    Raises:
        OutputError: OpenCV refuses the picture.
    """
    is_grey = picture.ndim == 2
    done, data = cv2.imencode(
        ".png", picture if is_grey else cv2.cvtColor(picture, cv2.COLOR_RGB2BGR)
    )
    if not done:
        raise OutputError(f"a picture of shape {picture.shape} cannot be written as PNG")
    encoded: Any = data
    return bytes(encoded.tobytes())


def jpeg_bytes(picture: Picture, *, quality: int) -> bytes:
    """The picture as a JPEG file in memory; quality 0..100."""
    _, data = cv2.imencode(
        ".jpg", cv2.cvtColor(picture, cv2.COLOR_RGB2BGR), [cv2.IMWRITE_JPEG_QUALITY, quality]
    )
    encoded: Any = data
    return bytes(encoded.tobytes())


def shrink(picture: Picture, width: int) -> Picture:
    """The picture made smaller to `width` pixels across; a smaller one stays as it is."""
    height_now, width_now = picture.shape[:2]
    if width_now <= width:
        return picture
    height = max(1, round(height_now * width / width_now))
    return np.asarray(
        cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA), dtype=np.uint8
    )


def _font_scale(height: int) -> tuple[float, int]:
    """OpenCV's size and thickness for capitals `height` pixels high (21 px at scale 1)."""
    return height / 21.0, max(1, round(height / 14))
