"""Pictures that surfaces show: files, videos, boards, tags and text, as images in linear light."""

from __future__ import annotations

import math
import re
import threading
from collections import OrderedDict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, shown
from texvent.runtime.files.image_files import decode_image
from texvent_scenes.mesh import SurfaceImage, decode_srgb, light_of, surface_image
from texvent_scenes.models.protocol import Model, ModelPart, Pose
from texvent_scenes.models.shapes import half_extents
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Colour, Shape, Texture
from texvent_scenes.spec.scene import Picture

VIDEO_ENDINGS = frozenset({".mp4", ".m4v", ".mov", ".avi", ".mkv", ".webm", ".gif", ".mpg", ".ts"})
"""Endings of files that play; any other file is read as an image."""
LONGEST_TEXT = 200
"""Characters of a text at most."""
_CHECKS = re.compile(r"(\d{1,3})\s*[x×]\s*(\d{1,3})")
MOST_CHECKS = 64
LAST_TAG = 586
"""Highest id of the AprilTag family 36h11."""


def check_picture(picture: Picture) -> None:
    """Refuse a picture that cannot be shown.

    Raises:
        InputError: its file does not exist or is no image or video, its squares are no such as
            "9x6", its tag has no such id, or its text is empty, too long, or has characters other
            than ASCII.
    """
    if picture.kind == "checkerboard":
        read_checks(picture.value)
    elif picture.kind == "tag":
        read_tag(picture.value)
    elif picture.kind == "text":
        _check_text(picture.value)
    else:
        _check_file(Path(picture.value))


def read_checks(value: str) -> tuple[int, int]:
    """Columns and rows of squares that "9x6" names.

    Raises:
        InputError: it names none, or too few or too many.
    """
    match = _CHECKS.fullmatch(value.strip().lower())
    counts = (int(match[1]), int(match[2])) if match else (0, 0)
    if not 2 <= min(counts) <= max(counts) <= MOST_CHECKS:
        raise InputError(
            f"a checkerboard has columns and rows of squares, such as 9x6, of 2 to "
            f"{MOST_CHECKS} each, but this one has {shown(value)}"
        )
    return counts


def read_tag(value: str) -> int:
    """The id of an AprilTag that "7" names.

    Raises:
        InputError: the family has no such tag.
    """
    if not (value.strip().isdecimal() and int(value) <= LAST_TAG):
        raise InputError(
            f"AprilTags of the family 36h11 have ids from 0 to {LAST_TAG}, but this one has "
            f"{shown(value)}"
        )
    return int(value)


def is_video(path: Path) -> bool:
    """Whether a file plays."""
    return path.suffix.lower() in VIDEO_ENDINGS


def can_show(noun: str) -> bool:
    """Whether a noun of the embedded generator has a face for pictures."""
    return noun in nouns_with("shows a picture")


def _check_text(text: str) -> None:
    if not text.strip() or len(text) > LONGEST_TEXT:
        raise InputError(
            f"the text on a surface has {len(text.strip())} characters; it may have 1 to "
            f"{LONGEST_TEXT}"
        )
    odd = next((letter for letter in text if not (letter.isascii() and letter.isprintable())), None)
    if odd is not None:
        raise InputError(f"text on a surface is drawn with ASCII letters; {odd!r} is none")


def _check_file(path: Path) -> None:
    if not path.is_file():
        raise InputError(f"the picture {path} does not exist; name an image or a video file")
    try:
        with path.open("rb") as file:
            file.read(1)
    except OSError as error:
        raise InputError(f"the picture {path} cannot be read: {error.strerror}") from error
    if not is_video(path) and not cv2.haveImageReader(str(path)):
        raise InputError(
            f"the picture {path} is no image that can be read (PNG, JPEG, TIFF, WebP, BMP) and no "
            f"video ({', '.join(sorted(VIDEO_ENDINGS))})"
        )


CACHED_FRAMES = 4
"""Images that are kept: renderers look at a few neighbouring instants at a time."""


class PlayedVideo:
    """The frames of a video by their own times; its end is followed by its beginning.

    Memory stays flat: times of all frames, and a few decoded images.

    Args:
        path: the file.

    Raises:
        FileFormatError: no frame of it can be decoded.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._lock = threading.Lock()
        self._images: OrderedDict[int, SurfaceImage] = OrderedDict()
        self._frames: Iterator[Any] | None = None
        self._next = 0
        self._times_s, self._duration_s = self._read_times()

    def __reduce__(self) -> tuple[type, tuple[Path]]:
        return PlayedVideo, (self._path,)

    def at(self, time_s: float) -> SurfaceImage:
        """The frame shown at an instant, s from the first one."""
        shown_s = time_s % self._duration_s
        index = max(int(np.searchsorted(self._times_s, shown_s, side="right")) - 1, 0)
        with self._lock:
            if index not in self._images:
                self._images[index] = self._decode(index)
                if len(self._images) > CACHED_FRAMES:
                    self._images.popitem(last=False)
            self._images.move_to_end(index)
            return self._images[index]

    def _read_times(self) -> tuple[np.ndarray, float]:
        """Times of all frames, s from the first, and how long the video lasts, s."""
        times = []
        for frame in self._open():
            times.append(float(frame.pts * frame.time_base) if frame.pts is not None else None)
        if not times:
            raise FileFormatError(f"{self._path} has no frame that can be decoded")
        if any(time is None for time in times):
            times = [index / 25.0 for index in range(len(times))]
        counted = np.array(times, dtype=np.float64)
        counted -= counted[0]
        last = float(np.median(np.diff(counted))) if len(counted) > 1 else 1.0
        return np.maximum.accumulate(counted), float(counted[-1]) + max(last, 1e-3)

    def _open(self) -> Iterator[Any]:
        from av.error import FFmpegError  # most scenes show no video

        from texvent.runtime.files.media_files import open_media_file, raise_scarcity

        try:
            with open_media_file(self._path) as container:
                yield from container.decode(video=0)
        except (FFmpegError, IndexError, OSError) as error:
            raise_scarcity(error, self._path)
            raise FileFormatError(
                f"{self._path} is no video that can be decoded "
                f"({getattr(error, 'strerror', None) or error}); name another file"
            ) from error

    def _decode(self, index: int) -> SurfaceImage:
        """Read on to a frame, from the beginning where it lies behind."""
        if self._frames is None or index < self._next:
            self._frames, self._next = self._open(), 0
        for frame in self._frames:
            self._next += 1
            if self._next == index + 1:
                coded = frame.to_ndarray(format="rgb24")
                return surface_image(decode_srgb(np.asarray(coded, dtype=np.uint8)))
        raise FileFormatError(
            f"{self._path} ends before frame {index}; it changed while it was read"
        )


PictureSource = Callable[[float], SurfaceImage]
"""The image shown at an instant, s."""
_LETTER_PX = 96
"""Height of capital letters in the image of a text."""
_LINE_PX = 160
_LONGEST_BOARD_PX = 2048
"""Longest side of the image of a checkerboard at most."""
_TAG_BITS, _TAG_BIT_PX = 8, 64
"""Bits of an AprilTag per side with its black border, and the side of one in its image, pixels."""
_INK, PAPER = 0.03, 0.85
"""Reflectance of printed letters and of the paper."""


def load_picture(picture: Picture) -> PictureSource:
    """Image that a picture shows at each instant.

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
    coded = decode_image(path, cv2.IMREAD_COLOR)
    return light_of(np.asarray(coded[..., ::-1], dtype=np.uint8))


def _version(picture: Picture) -> tuple[float, int]:
    """Mark of a picture's file that changes when it is written anew."""
    if picture.kind != "file":
        return 0.0, 0
    status = Path(picture.value).stat()
    return status.st_mtime, status.st_size


@lru_cache(maxsize=16)
def _still(picture: Picture, version: tuple[float, int]) -> SurfaceImage:
    del version
    if picture.kind == "checkerboard":
        return surface_image(draw_checks(*read_checks(picture.value)))
    if picture.kind == "tag":
        return surface_image(draw_tag(read_tag(picture.value)))
    if picture.kind == "text":
        return surface_image(draw_text(picture.value))
    return surface_image(read_image(Path(picture.value)))


def draw_checks(columns: int, rows: int) -> NDArray[np.float32]:
    """[h, w, 3] linear image of black and white squares, with a white margin one square wide.

    The square at its top left is black. Its side is a power of two, so that its averages are exact.
    """
    side = 2 ** int(math.log2(_LONGEST_BOARD_PX / (max(columns, rows) + 2)))
    i, j = np.indices((rows, columns))
    share = np.pad((i + j + 1) % 2, 1).repeat(side, axis=0).repeat(side, axis=1)
    return _printed(share)


def draw_tag(number: int) -> NDArray[np.float32]:
    """[h, w, 3] linear image of an AprilTag of the family 36h11, with a margin one bit wide."""
    tags = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    share = np.pad(tags.generateImageMarker(number, _TAG_BITS) == 0, 1)
    return _printed(share.repeat(_TAG_BIT_PX, axis=0).repeat(_TAG_BIT_PX, axis=1))


def _printed(share: NDArray[Any]) -> NDArray[np.float32]:
    """[h, w, 3] of ink on paper, from the share [h, w] of ink."""
    grey = PAPER + share.astype(np.float32) * np.float32(_INK - PAPER)
    return np.repeat(grey[..., None], 3, axis=2).astype(np.float32)


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
    return _printed(canvas / 255.0)


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
_BESIDE = 1.001
"""Farthest reach of a print from the middle of its face, in half sides."""


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
            texture=Texture.PLAIN,
            colour=face.colour if self._margin is None else self._margin,
            emission=_DISPLAY_GLOW if self._shines else 0.0,
        )
        return [shown, *(part for part in others if not _is_print(part, face))]


def _is_print(part: ModelPart, face: ModelPart) -> bool:
    """Whether a part lies on the side +x of a box, within its borders."""
    linear = np.linalg.inv(face.to_body[:, :3])
    local = np.column_stack(
        [linear @ part.to_body[:, :3], linear @ (part.to_body[:, 3] - face.to_body[:, 3])]
    )
    shape = Shape.BOX if part.shape is Shape.CONE else part.shape
    low, high = half_extents(shape, local)
    widest = np.maximum(np.abs(low), np.abs(high))
    return bool(high[0] > 0.9 and widest[1:].max() <= _BESIDE)
