"""Names of files: which are images and videos, and which no file can have."""

from __future__ import annotations

import itertools
import os
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent.errors import HIDDEN, FileFormatError, InputError, few, shown, warn

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


_NUMBER = re.compile(r"((?<![\d.])\d+\.\d+(?!\.?\d)|\d+)")
"""A number in a name; a point counts where it is the only one between digits: 0.15, not 1.2.3."""
LONG_FRACTION = 4
"""Digits after the point of a time; parts of versions are shorter."""


def in_natural_order(paths: Iterable[Path]) -> list[Path]:
    """Files sorted by name as people do: frame2 before frame10, 0.15 before 0.2, -1 before 0.

    Digits after a point are decimals, unless the names count on behind it: 1.9, 1.10.

    Warns:
        TexventWarning: names of more than one pattern, or decimals that may be versions.
    """
    stems = {path: _NUMBER.split(path.stem.lower()) for path in paths}
    fractions: dict[int, list[str]] = {}
    for words in stems.values():
        for place, word in enumerate(words):
            if place % 2 and "." in word:
                fractions.setdefault(place, []).append(word.partition(".")[2])
    doubts = {place: _doubt_about_decimals(found) for place, found in fractions.items()}
    # A hyphen is a sign where other names have a number there without one, or at the beginning.
    before = {(place, text) for words in stems.values() for place, text in _before_numbers(words)}
    signed = {(place, text) for place, text in before if _is_sign(place, text, before)}

    def key(path: Path) -> tuple[Any, ...]:
        parts: list[Any] = []
        words = stems[path]
        for place, text in _before_numbers(words):
            is_signed = (place, text) in signed
            parts.append((1, text[:-1] if is_signed else text))
            parts.append(
                (0, (-1 if is_signed else 1) * _value(words[place + 1], doubts.get(place + 1)))
            )
        return tuple(parts), words[-1], path.suffix.lower(), path.name

    ordered = sorted(stems, key=key)
    _warn_of_order(ordered, stems, UNCLEAR in doubts.values())
    return ordered


def _before_numbers(words: list[str]) -> Iterator[tuple[int, str]]:
    return ((place, words[place]) for place in range(0, len(words) - 1, 2))


def _is_sign(place: int, text: str, before: set[tuple[int, str]]) -> bool:
    is_first = place == 0 and text == "-"
    return text.endswith("-") and (is_first or (place, text[:-1]) in before)


def _value(word: str, doubt: str | None) -> Fraction:
    """A number of a name; of a version its parts as one number."""
    whole, point, fraction = word.partition(".")
    if point and doubt == VERSIONS:
        return int(whole) + Fraction(int(fraction), 10**MAX_NAME_BYTES)
    return Fraction(word)


VERSIONS, UNCLEAR = "versions", "unclear"


def _doubt_about_decimals(fractions: Sequence[str]) -> str:
    """Whether digits after a point count on (9, 10, 11) instead of being decimals; "" if not."""
    if len(set(map(len, fractions))) < 2:
        return ""  # both orders are the same
    has_zeros_before = any(len(one) > 1 and one[0] == "0" for one in fractions)
    if any(len(one) > 1 and one[-1] == "0" for one in fractions):
        return UNCLEAR if has_zeros_before else VERSIONS
    is_long = max(map(len, fractions)) >= LONG_FRACTION
    return "" if has_zeros_before or is_long else UNCLEAR


def _warn_of_order(ordered: list[Path], stems: Mapping[Path, list[str]], is_unclear: bool) -> None:
    is_twice = len({path.stem for path in ordered}) < len(ordered)
    patterns = Counter(
        "#".join(stems[path][::2]).replace("-#", "#") + path.suffix.lower() * is_twice
        for path in ordered
    )
    if is_unclear:
        warn(
            f"{ordered[0].parent}: names such as {ordered[0].name} and {ordered[1].name} are "
            "sorted as decimals (0.15 before 0.2); if they count (1.9, 1.10), write zeros in front"
        )
    if len(patterns) > 1 and any("#" in one for one in patterns):
        shown_ones = few([f"{name} ({count})" for name, count in patterns.most_common()], 3)
        warn(
            f"{ordered[0].parent} holds files of {len(patterns)} patterns of names: {shown_ones}; "
            "they are taken one after the other by name. Keep one series in the folder, or list "
            "its files with their times in images.txt"
        )


def numbering_gap(files: Sequence[Path]) -> str | None:
    """Two numbered files between which one is missing: all steps equal, but a few longer.

    Returns:
        Their names, "a and b".
    """
    numbers = [int(found[-1]) for one in files if (found := re.findall(r"\d+", one.stem))]
    if len(numbers) != len(files):
        return None
    steps = [second - first for first, second in itertools.pairwise(numbers)]
    usual = min(steps, default=0)
    longer = [index for index, step in enumerate(steps) if step != usual]
    is_gap = usual > 0 and all(steps[index] % usual == 0 for index in longer)
    if not longer or not is_gap or len(longer) > len(steps) // 4 + 1:
        return None
    return f"{files[longer[0]].name} and {files[longer[0] + 1].name}"
