"""What a picture shows at each instant, as images with pyramids in linear light."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.scenes.description import Picture
from texvent.scenes.image import SurfaceImage, decode_srgb, surface_image
from texvent.scenes.models.protocol import Model, ModelPart, Pose
from texvent.scenes.models.shapes import half_extents
from texvent.scenes.models.tables import nouns_with
from texvent.scenes.pictures.checking import check_picture, is_video, read_checks
from texvent.scenes.pictures.video import PlayedVideo
from texvent.scenes.scene import Colour, Shape, Texture

PictureSource = Callable[[float], SurfaceImage]
"""The image shown at an instant, s."""
LARGEST_SIDE = 4096
"""Longest side of an image, pixels: larger ones are made smaller."""
_LETTER_PX = 96
"""Height of capital letters in the image of a text."""
_LINE_PX = 160
_INK, PAPER = 0.03, 0.85
"""Reflectance of printed letters and of the paper."""


def load_picture(picture: Picture) -> PictureSource:
    """What a picture shows at each instant.

    A video plays from the clip's beginning at its own rate, and again when it has ended.

    Raises:
        InputError: as for `check_picture`.
        FileFormatError: the file is damaged.
    """
    check_picture(picture)
    if picture.kind == "file" and is_video(path := Path(picture.value)):
        return PlayedVideo(path).at
    still = _still(picture, _version(picture))
    return lambda time_s: still


def read_image(path: Path) -> NDArray[np.float32]:
    """[h, w, 3] linear RGB of an image file.

    Raises:
        FileFormatError: it cannot be decoded.
    """
    coded = cv2.imdecode(np.fromfile(path, dtype=np.uint8), cv2.IMREAD_COLOR)
    if coded is None:
        raise FileFormatError(f"{path} is no image that can be decoded; it may be damaged")
    return fit_size(decode_srgb(np.asarray(coded[..., ::-1], dtype=np.uint8)))


def fit_size(linear: NDArray[np.float32]) -> NDArray[np.float32]:
    """The image, made smaller if its longest side is above `LARGEST_SIDE`."""
    height, width = linear.shape[:2]
    share = LARGEST_SIDE / max(height, width)
    if share >= 1.0:
        return linear
    size = (max(round(width * share), 1), max(round(height * share), 1))
    return np.asarray(cv2.resize(linear, size, interpolation=cv2.INTER_AREA), dtype=np.float32)


def _version(picture: Picture) -> tuple[float, int]:
    """What changes when the file of a picture is written anew."""
    if picture.kind != "file":
        return 0.0, 0
    status = Path(picture.value).stat()
    return status.st_mtime, status.st_size


@lru_cache(maxsize=16)
def _still(picture: Picture, version: tuple[float, int]) -> SurfaceImage:
    del version
    if picture.kind == "checkerboard":
        return SurfaceImage(checks=read_checks(picture.value))
    if picture.kind == "text":
        return surface_image(draw_text(picture.value))
    return surface_image(read_image(Path(picture.value)))


def draw_text(text: str) -> NDArray[np.float32]:
    """[h, w, 3] linear image of dark letters on white, in as many lines as suit a page."""
    font, thickness = cv2.FONT_HERSHEY_DUPLEX, 9
    scale = cv2.getFontScaleFromHeight(font, _LETTER_PX, thickness)
    lines = _wrapped(text.split())
    widths = [cv2.getTextSize(line, font, scale, thickness)[0][0] for line in lines]
    canvas = np.zeros((_LINE_PX * (len(lines) + 1), max(widths) + _LINE_PX), dtype=np.uint8)
    for row, (line, width) in enumerate(zip(lines, widths, strict=True)):
        foot = (_LINE_PX * (2 * row + 2) + _LETTER_PX) // 2
        left = (canvas.shape[1] - width) // 2
        cv2.putText(canvas, line, (left, foot), font, scale, 255, thickness, cv2.LINE_AA)
    share = canvas.astype(np.float32) / 255.0
    grey = PAPER + share * (_INK - PAPER)
    return np.repeat(grey[..., None], 3, axis=2).astype(np.float32)


def _wrapped(words: list[str]) -> list[str]:
    """Words in lines, about three times as many letters to a line as there are lines."""
    letters = sum(map(len, words)) + len(words) - 1
    widest = max(int((3.0 * letters) ** 0.5), max(map(len, words)))
    lines = [words[0]]
    for word in words[1:]:
        if len(lines[-1]) + 1 + len(word) <= widest:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines


_DISPLAY_GLOW = 0.9
"""Light of a display, as a multiple of the picture's."""
_DARK: Colour = (0.01, 0.01, 0.01)
_FACE = 1
"""The side of the first part that shows the picture, +x; see `data/traits/pictures.toml`."""
_BESIDE = 1.001
"""What reaches farther than this from the middle of a face, in half sides, is no print on it."""


class PicturedModel:
    """A model with a picture where its noun shows one; all else is the model's own.

    What is usually printed on that face is left out.

    Args:
        model: a model of the noun.
        noun: one that shows a picture.
        picture: what it shows.

    Raises:
        InputError: as for `load_picture`.
    """

    def __init__(self, model: Model, noun: str, picture: Picture) -> None:
        self._model = model
        self.length, self.width, self.height = model.length, model.width, model.height
        self._source = load_picture(picture)
        self._margin: Colour | None = None if picture.kind == "file" else (PAPER, PAPER, PAPER)
        self._shines = noun in nouns_with("lit screen")
        if self._shines and self._margin is None:
            self._margin = _DARK

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):  # not yet set, as in a copy that is being made
            raise AttributeError(name)
        return getattr(self._model, name)

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose, the picture on one of them."""
        face, *others = self._model.parts(pose)
        shown = replace(
            face,
            image=self._source(pose.time_s),
            image_face=_FACE,
            texture=Texture.PLAIN,
            colour=face.colour if self._margin is None else self._margin,
            emission=_DISPLAY_GLOW if self._shines else 0.0,
        )
        return [shown, *(part for part in others if not _is_print(part, face, _FACE))]


def _is_print(part: ModelPart, face: ModelPart, number: int) -> bool:
    """Whether a part lies on a face of a box, within its borders."""
    linear = np.linalg.inv(face.to_body[:, :3])
    local = np.column_stack(
        [linear @ part.to_body[:, :3], linear @ (part.to_body[:, 3] - face.to_body[:, 3])]
    )
    shape = Shape.BOX if part.shape is Shape.CONE else part.shape
    low, high = half_extents(shape, local)
    axis, is_high = number // 2, number % 2 == 1
    reach = high[axis] if is_high else -low[axis]
    widest = np.maximum(np.abs(low), np.abs(high))
    return bool(reach > 0.9 and np.delete(widest, axis).max() <= _BESIDE)
