"""Names of files: which are images and videos, and which no file can have."""

from __future__ import annotations

import os
import re
from pathlib import Path

from texvent.errors import HIDDEN, FileFormatError, InputError, shown

MAX_NAME_BYTES, MAX_PATH_BYTES = 255, 4095
"""Bytes of one name and of a whole path on Linux."""
NOT_IN_NAMES = '\\:*?"<>|' if os.name == "nt" else "\\"
"""Characters that no name of a file has."""


IMAGE_EXTENSIONS = frozenset(
    (
        *(".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".webp", ".jp2"),
        *(".pgm", ".ppm", ".pnm", ".exr", ".hdr"),
    )
)
"""Files of these names are the frames of an image folder."""
CLIPS = (".avi", ".gif", ".m4v", ".mkv", ".mov", ".mp4", ".mpeg", ".mpg", ".webm", ".wmv")
STREAMS = (".3gp", ".flv", ".m2ts", ".mts", ".ogv", ".ts", ".y4m")
VIDEO_EXTENSIONS = frozenset((*CLIPS, *STREAMS))
"""Files of these names are videos."""


def usable_path(path: str | Path) -> Path:
    """A path that the system can be asked for.

    Raises:
        InputError: it is no path, holds a NUL byte or is too long; every function of the system
            would refuse it in words of its own.
    """
    if not isinstance(path, str | bytes | os.PathLike):
        raise InputError(f"{shown(path)} is no path; give a text or a Path")
    content = os.fsencode(os.fspath(path))
    if not content.strip():
        raise InputError("the path is empty; give the name of a file or folder")
    if b"\0" in content:
        raise InputError(f"{shown(str(path))} is no file name: it holds a NUL byte")
    longest = max(map(len, content.split(b"/")))
    if longest > MAX_NAME_BYTES or len(content) > MAX_PATH_BYTES:
        raise InputError(
            f"{shown(str(path))} is no file name: it is longer than {MAX_NAME_BYTES} bytes"
        )
    return Path(path)


def inside(folder: Path, place: str) -> Path:
    """The path of a file in a folder, made of words of a file that somebody may have sent.

    Raises:
        FileFormatError: it would be the folder itself or lie outside, by `..`, by links or as an
            absolute path, or a part of it is no name on some system.
    """
    path = folder / place
    is_name = all(
        part and not part.isspace() and part not in (".", "..") for part in place.split("/")
    )
    if not is_name or HIDDEN.search(place) or set(place) & set(NOT_IN_NAMES):
        raise FileFormatError(f"{shown(place)} names no file inside a folder; nothing is put there")
    usable_path(path)
    if not Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder)):
        raise FileFormatError(f"{path} leads out of {folder}; nothing is put there")
    return path


def natural_key(path: Path) -> tuple[tuple[tuple[int, int | str], ...], str]:
    """Key that sorts names as people do: frame2 before frame10.

    Digits compare as numbers; the name itself settles ties such as 1 and 01.
    """
    parts = re.split(r"(\d+)", path.name.lower())
    return tuple((0, int(part)) if part.isdigit() else (1, part) for part in parts), path.name
