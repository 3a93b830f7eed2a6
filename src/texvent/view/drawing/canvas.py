"""Drawing on RGB images: scaling, text, boxes, PNG. The file that knows OpenCV."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.errors import OutputError
from texvent.view.drawing.palettes import Colour

Image = NDArray[np.uint8]
"""[H, W, 3] RGB, 0..255."""

RIM: Colour = (20, 22, 26)
FONT = cv2.FONT_HERSHEY_SIMPLEX


def blank(width: int, height: int, colour: Colour) -> Image:
    """An image of one colour."""
    return np.full((height, width, 3), colour, dtype=np.uint8)


def enlarge(image: Image, factor: int, *, how: Literal["smooth", "blocks"]) -> Image:
    """The image `factor` times as large: smooth for photographs, blocks for events."""
    if factor == 1:
        return image
    method = cv2.INTER_CUBIC if how == "smooth" else cv2.INTER_NEAREST
    height, width = image.shape[:2]
    return np.asarray(
        cv2.resize(image, (width * factor, height * factor), interpolation=method),
        dtype=np.uint8,
    )


def tile(panels: Sequence[Image], columns: int, colour: Colour, *, gap: int = 0) -> Image:
    """Images of one size in reading order, `gap` pixels of `colour` between them."""
    height, width = panels[0].shape[:2]
    rows = -(-len(panels) // columns)
    sheet = blank(columns * (width + gap) - gap, rows * (height + gap) - gap, colour)
    for index, panel in enumerate(panels):
        top, left = (index // columns) * (height + gap), (index % columns) * (width + gap)
        sheet[top : top + height, left : left + width] = panel
    return sheet


def text_width(text: str, height: int) -> int:
    """Width of a line of text, pixels, for capitals `height` pixels high."""
    scale, thickness = _font_scale(height)
    (width, _), _ = cv2.getTextSize(text, FONT, scale, thickness)
    return int(width)


def draw_text(
    image: Image, text: str, x: int, baseline: int, *, height: int, colour: Colour
) -> None:
    """Write a line of text into the image, its left end at x, capitals `height` pixels high."""
    scale, thickness = _font_scale(height)
    cv2.putText(image, text, (x, baseline), FONT, scale, colour, thickness, cv2.LINE_AA)


def draw_box(image: Image, x: int, y: int, width: int, height: int, colour: Colour) -> None:
    """Fill a rectangle; parts outside the image are left out."""
    image[max(y, 0) : max(y + height, 0), max(x, 0) : max(x + width, 0)] = colour


def draw_frame(image: Image, corners: tuple[int, int, int, int], colour: Colour) -> None:
    """Outline the rectangle x0, y0, x1, y1 (all inside it), with a dark rim to stand out."""
    x0, y0, x1, y1 = corners
    cv2.rectangle(image, (x0, y0), (x1, y1), RIM, 4)
    cv2.rectangle(image, (x0, y0), (x1, y1), colour, 2)


def draw_arrow(
    image: Image, tail: tuple[float, float], tip: tuple[float, float], colour: Colour
) -> None:
    """An arrow with a dark rim; ends are pixels."""
    ends = [(round(float(x)), round(float(y))) for x, y in (tail, tip)]
    for ink, thickness in ((RIM, 4), (colour, 2)):
        cv2.arrowedLine(image, ends[0], ends[1], ink, thickness, cv2.LINE_AA, tipLength=0.3)


def draw_label(
    image: Image, text: str, corner: tuple[int, int], colour: Colour, *, height: int
) -> None:
    """A word on a coloured strip above the corner, or below it at the image's edge."""
    x, y = corner
    strip = 2 * height
    top = y - strip if y >= strip else y
    draw_box(image, x, top, text_width(text, height) + height, strip, colour)
    baseline = top + (strip + height) // 2
    draw_text(image, text, x + height // 2, baseline, height=height, colour=RIM)


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


def png_bytes(image: Image, *, level: int | None = None) -> bytes:
    """The image, RGB or grey [H, W], as a PNG file in memory.

    Args:
        image: uint8 levels.
        level: zlib's, 1..9, 9 for the smallest file; None for OpenCV's own, which is fast.

    Raises:
        OutputError: OpenCV refuses the image.
    """
    is_grey = image.ndim == 2
    options = [] if level is None else [cv2.IMWRITE_PNG_COMPRESSION, level]
    bgr = image if is_grey else cv2.cvtColor(image, cv2.COLOR_RGB2BGR)
    done, data = cv2.imencode(".png", bgr, options)
    if not done:
        raise OutputError(f"an image of shape {image.shape} cannot be written as PNG")
    encoded: Any = data
    return bytes(encoded.tobytes())


def jpeg_bytes(image: Image, *, quality: int) -> bytes:
    """The image as a JPEG file in memory; quality 0..100."""
    _, data = cv2.imencode(
        ".jpg", cv2.cvtColor(image, cv2.COLOR_RGB2BGR), [cv2.IMWRITE_JPEG_QUALITY, quality]
    )
    encoded: Any = data
    return bytes(encoded.tobytes())


def shrink(image: Image, width: int) -> Image:
    """The image made smaller to `width` pixels across; a smaller one stays as it is."""
    height_now, width_now = image.shape[:2]
    if width_now <= width:
        return image
    height = max(1, round(height_now * width / width_now))
    return np.asarray(
        cv2.resize(image, (width, height), interpolation=cv2.INTER_AREA), dtype=np.uint8
    )


def _font_scale(height: int) -> tuple[float, int]:
    """OpenCV's size and thickness for capitals `height` pixels high (21 px at scale 1)."""
    return height / 21.0, max(1, round(height / 14))
