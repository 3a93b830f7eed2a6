"""Masks of pixels in files: .npy (bool), .png (white where events are left out), .txt (`x y`)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, FileFormatError, InputError, shown, warn
from texvent.io.arrays.npy_file import StoredArray
from texvent.io.input_checks import existing_file
from texvent.runtime.files.image_files import decode_image
from texvent.sensor import SensorSize

EXTENSIONS = (".npy", ".png", ".txt")
USUAL_SHARE = 0.9
"""Largest usual share of pixels left out; above, the mask is perhaps turned into its opposite."""
MAX_TEXT_BYTES = 1 << 26


def read_pixel_mask(path: Path, size: SensorSize) -> NDArray[np.bool_]:
    """The mask of a file, true where events are left out, [H, W].

    In an image, pixels that are not black; in an array, values that are not 0; in a text, one pixel
    `x y` per line, after `#` a comment.

    Raises:
        InputError: no such file, or it is for another sensor.
        ConfigError: another extension.
        FileFormatError: it holds something else.

    Warns:
        TexventWarning: it holds more than two levels, or leaves out nearly all.
    """
    extension = path.suffix.lower()
    if extension not in EXTENSIONS:
        raise ConfigError(
            f"{path} is no name of a mask; masks end in .npy, .png or .txt, which says the format"
        )
    path = existing_file(path)
    if extension == ".txt":
        return _read_text(path, size)
    array: Any = _read_image(path) if extension == ".png" else _read_array(path)
    if array.shape != size.shape:
        raise InputError(
            f"{path} is a mask of shape {array.shape}; for a sensor of {size} it must be "
            f"{size.shape}: rows, columns"
        )
    mask = np.asarray(array != 0)
    levels = np.unique(array)
    if len(levels) > 2:
        warn(f"{path} holds {len(levels)} levels; a mask has two, and all but 0 are left out")
    if mask.mean() > USUAL_SHARE:
        warn(f"{path} leaves out {mask.mean():.0%} of the pixels: those that are not 0, or white")
    return mask


def _read_array(path: Path) -> NDArray[Any]:
    stored = StoredArray(path)
    if stored.ndim != 2 or stored.dtype.kind not in "biu":
        raise FileFormatError(
            f"{path} holds {stored.dtype} of shape {shown(stored.shape)}; a mask is [rows, columns]"
        )
    return stored.rows(0, len(stored))


def _read_image(path: Path) -> NDArray[Any]:
    import cv2  # only images need it

    return decode_image(path, cv2.IMREAD_GRAYSCALE)


def _read_text(path: Path, size: SensorSize) -> NDArray[np.bool_]:
    if path.stat().st_size > MAX_TEXT_BYTES:
        raise FileFormatError(f"{path} is too long for a mask; it has one `x y` per line")
    mask = np.zeros(size.shape, np.bool_)
    for number, line in enumerate(path.read_bytes().splitlines(), start=1):
        words = line.partition(b"#")[0].split()
        if not words:
            continue
        if len(words) != 2 or not all(word.isdigit() and len(word) < 9 for word in words):
            text = shown(line.decode(errors="replace"))
            raise FileFormatError(f"{path}, line {number}: {text} is not a pixel `x y`")
        x, y = (int(word) for word in words)
        if x >= size.width or y >= size.height:
            raise InputError(f"{path}, line {number}: ({x}, {y}) lies outside a sensor of {size}")
        mask[y, x] = True
    return mask
