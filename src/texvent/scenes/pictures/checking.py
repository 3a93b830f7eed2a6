"""Whether a picture can be shown, told before anything is drawn."""

from __future__ import annotations

import re
from pathlib import Path

import cv2

from texvent.errors import InputError, shown
from texvent.scenes.description import Picture
from texvent.scenes.models.tables import nouns_with

VIDEO_ENDINGS = frozenset({".mp4", ".m4v", ".mov", ".avi", ".mkv", ".webm", ".gif", ".mpg", ".ts"})
"""Endings of files that play; any other file is read as an image."""
LONGEST_TEXT = 200
"""Characters of a text at most."""
_CHECKS = re.compile(r"(\d{1,3})\s*[x×]\s*(\d{1,3})")
MOST_CHECKS = 64


def check_picture(picture: Picture) -> None:
    """Refuse a picture that cannot be shown.

    Raises:
        InputError: its file does not exist or is no image or video, its squares are no such as
            "9x6", or its text is empty, too long, or has characters other than ASCII.
    """
    if picture.kind == "checkerboard":
        read_checks(picture.value)
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
