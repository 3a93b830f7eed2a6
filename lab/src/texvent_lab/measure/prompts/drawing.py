"""Strips and pages as images."""

from __future__ import annotations

import textwrap
import unicodedata
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, OutputError
from texvent.io.atomic import atomic_file
from texvent_lab.measure.prompts.measure import SIZE, STILLS

GAP_PX = 2
LINE_PX, LETTERS = 15, 158
"""Height of a line of text, and its letters at most."""
MOST_LINES = 9
COLUMNS = 2
TILE, LABEL_PX, TILES_PER_ROW = (86, 65), 12, 8
"""Size of a still in the mosaic, height of its label, px, and prompts in a row."""
WIDTH = STILLS * SIZE.width + (STILLS - 1) * GAP_PX
_FONT, _SCALE = cv2.FONT_HERSHEY_SIMPLEX, 0.38
_PLAIN = {"→": "->", "’": "'", "‘": "'", "“": '"', "”": '"', "–": "-", "—": "-"}

Image = NDArray[np.uint8]


def draw_strip(stills: Sequence[Image], caption: Sequence[str]) -> Image:
    """Stills [H, W, 3] in a row, black where there are none, with lines of text below."""
    lines = [part for line in caption for part in textwrap.wrap(_ascii(line), LETTERS)]
    if len(lines) > MOST_LINES:
        lines = [*lines[: MOST_LINES - 1], f"... {len(lines) - MOST_LINES + 1} more lines"]
    image = np.full((SIZE.height + LINE_PX * (len(lines) + 1), WIDTH, 3), 255, np.uint8)
    image[: SIZE.height] = 0
    for number, still in enumerate(stills):
        left = number * (SIZE.width + GAP_PX)
        image[: SIZE.height, left : left + SIZE.width] = still
    for number, line in enumerate(lines):
        colour = (0, 0, 0) if number == 0 else (70, 70, 70)
        place = (3, SIZE.height + LINE_PX * (number + 1))
        cv2.putText(image, line, place, _FONT, _SCALE, colour, 1, cv2.LINE_AA)
    return image


def draw_page(strips: Sequence[Image]) -> Image:
    """Strips in two columns, row by row, each row as high as its higher strip."""
    rows = []
    for start in range(0, len(strips), COLUMNS):
        row = strips[start : start + COLUMNS]
        height = max(strip.shape[0] for strip in row)
        band = np.full((height + 8, COLUMNS * WIDTH + 10, 3), 255, np.uint8)
        for number, strip in enumerate(row):
            left = number * (WIDTH + 10)
            band[: strip.shape[0], left : left + strip.shape[1]] = strip
        rows.append(band)
    return np.concatenate(rows)


def draw_tile(strip: Image, name: str) -> Image:
    """The second and the last but one still of a strip, small, with the name of the prompt."""
    stills = []
    for number in (1, STILLS - 2):
        left = number * (SIZE.width + GAP_PX)
        still = strip[: SIZE.height, left : left + SIZE.width]
        stills.append(cv2.resize(still, TILE, interpolation=cv2.INTER_AREA))
    label = np.full((LABEL_PX, 2 * TILE[0], 3), 255, np.uint8)
    cv2.putText(label, _ascii(name), (2, LABEL_PX - 3), _FONT, 0.3, (0, 0, 0), 1, cv2.LINE_AA)
    return np.concatenate([np.concatenate(stills, axis=1), label])


def draw_grid(tiles: Sequence[Image]) -> Image:
    """Tiles of one size, in rows of `TILES_PER_ROW`."""
    blank = np.full_like(tiles[0], 255)
    filled = [*tiles, *[blank] * (-len(tiles) % TILES_PER_ROW)]
    rows = [
        np.concatenate(filled[start : start + TILES_PER_ROW], axis=1)
        for start in range(0, len(filled), TILES_PER_ROW)
    ]
    return np.concatenate(rows)


def write_image(path: Path, image: Image) -> None:
    """Write RGB as PNG or JPEG, by the name, whole or not at all."""
    is_made, data = cv2.imencode(path.suffix, image[..., ::-1])
    if not is_made:
        raise OutputError(f"cannot encode {path}")
    with atomic_file(path, overwrite=True) as part:
        part.write_bytes(data.tobytes())


def read_image(path: Path) -> Image:
    """The RGB image of a file."""
    image = cv2.imdecode(np.frombuffer(path.read_bytes(), np.uint8), cv2.IMREAD_COLOR)
    if image is None:
        raise InputError(f"{path} is no image; run with --again")
    return np.asarray(image[..., ::-1], np.uint8)


def _ascii(text: str) -> str:
    """The text in the letters that the font has."""
    for letter, plain in _PLAIN.items():
        text = text.replace(letter, plain)
    return unicodedata.normalize("NFKD", text).encode("ascii", "replace").decode()
