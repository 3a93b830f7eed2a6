"""Names of files: which are images and videos, and which no file can have."""

from __future__ import annotations

import itertools
import os
import re
from collections import Counter
from collections.abc import Iterable, Sequence
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


def file_stem(subject: str) -> str:
    """A name of the first words of a prompt or of a file's name."""
    return "-".join(re.findall(r"[a-z0-9]+", subject.lower())[:8]) or "events"


def inside(folder: Path, place: str) -> Path:
    """The path of a file in a folder, made of words of a file from others.

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


_EXPONENT = r"e[-+]\d{1,3}(?![\da-z])"
_NUMBER = re.compile(
    rf"((?<![\d.])\d+\.\d+{_EXPONENT}|(?<![\d.])\d+\.\d+(?!\.?\d)|(?<![\d.])\d+{_EXPONENT}|\d+)"
)
"""A number in a name; a point counts where it is the only one between digits: 0.15, not 1.2.3."""
_DATE = re.compile(r"(?<!\d)(\d\d?)([-._ ]?)(\d\d?)\2((?:19|20)\d\d)(?!\d)")
"""A date whose year comes last."""
_HOURS = re.compile(
    r"(?<!\d)(0?[1-9]|1[0-2])[-._ ]([0-5]\d)(?:[-._ ]([0-5]\d))?[-_\s]?([ap])\.?m(?![a-z])"
)
_SPLIT_NUMBER = re.compile(r"(.*?)(?<!\d)(\d+)[_p-](\d+)\D*")
"""A name that ends in 0_15 or 0p15, which may be 0.15."""


def in_natural_order(paths: Iterable[Path]) -> list[Path]:
    """Files sorted by name as people do: frame2 before frame10, 0.15 before 0.2, -1 before 0.

    Digits after a point are decimals, unless the names count on behind it: 1.9, 1.10. A hyphen is a
    sign where another name has the same text without it: t-1, t0.

    Warns:
        TexventWarning: names are of more than one pattern, or do not tell the order of time.
    """
    words = {path: _NUMBER.split(_text(path)) for path in paths}
    # Texts and numbers take turns; those after the last number are no sign.
    columns = [*map(set, itertools.zip_longest(*(one[:-1] for one in words.values())))]
    counted = [_counts_behind_point(column) for column in columns]

    def key(path: Path) -> tuple[Any, ...]:
        parts: list[Any] = []
        for place, (text, number) in enumerate(
            zip(words[path][:-1:2], words[path][1::2], strict=True)
        ):
            is_signed = text.endswith("-") and text[:-1] in columns[2 * place]
            value: Any = -Fraction(number) if is_signed else Fraction(number)
            if counted[2 * place + 1]:
                value = [int(one) for one in number.split(".")]
            parts += [text[:-1] if is_signed else text, value]
        return *parts, words[path][-1], path.suffix.lower(), path.name

    ordered = sorted(words, key=key)
    doubt = _order_doubt(ordered)
    if doubt is None:
        _warn_of_patterns(ordered)
    else:
        warn(
            f"{ordered[0].parent}: names of images do not tell their order in time: {doubt}; they "
            f"are taken by their numbers, {few([one.name for one in ordered], 3)}. List the files "
            "with their times in images.txt"
        )
    return ordered


def _text(path: Path) -> str:
    """The name to be read, with decimal commas as points."""
    return path.stem.lower().replace(",", ".")


def _counts_behind_point(numbers: Iterable[str | None]) -> bool:
    """Whether digits after points are whole numbers: decimals of any length end in no zero."""
    behind = [number.partition(".")[2] for number in numbers if number and "." in number]
    if any(number and "e" in number for number in numbers):
        return False
    longer = [digits for digits in behind if len(digits) > 1]
    is_padded = any(digits[0] == "0" for digits in longer)
    is_even = len({len(digits) for digits in behind}) < 2
    return not is_even and not is_padded and any(digits[-1] == "0" for digits in longer)


def _order_doubt(ordered: Sequence[Path]) -> str | None:
    """Why files sorted by the numbers in their names may not be in order of time; None if they are.

    Dates count if the order of names is not theirs.
    """
    texts = [_text(path) for path in ordered]
    if not texts:
        return None
    dates = [found.groups() for text in texts if (found := _DATE.search(text))]
    if len(dates) == len(texts):
        days_and_months = [(int(first), int(second)) for first, _, second, _ in dates]
        for swap in (1, -1):
            days, months = tuple(zip(*(one[::swap] for one in days_and_months), strict=True))
            is_date = 1 <= min(days) <= max(days) <= 31 and 1 <= min(months) <= max(months) <= 12
            read = [*zip((one[3] for one in dates), months, days, strict=True)]
            if is_date and read != sorted(read):
                return "days stand before years"
    hours = [(text[: at.start()], at) for text in texts if (at := _HOURS.search(text))]
    moments = [
        (before, f"{int(at[1]) % 12 + 12 * (at[4] == 'p'):02}", at[2], at[3] or "")
        for before, at in hours
    ]
    if len(hours) == len(texts) and moments != sorted(moments):
        return "hours are those of am and pm"
    if _starts_again(texts):
        return f"numbers may start again behind {ordered[-1].name}, as those of cameras do"
    may_be = "digits behind _, p or - may be counted or decimals"
    return may_be if _may_be_decimals(texts) else None


def _starts_again(texts: Sequence[str]) -> bool:
    """Whether numbers of equal width are the highest and the lowest ones, and few between them."""
    found = [re.findall(r"\d+", text)[-1:] for text in texts]
    if not all(found) or len({len(one[0]) for one in found}) > 1:
        return False
    numbers, full = [int(one[0]) for one in found], 10 ** len(found[0][0])
    gap = max((second - first for first, second in itertools.pairwise(numbers)), default=0)
    return numbers[0] <= 1 and numbers[-1] >= full - 2 and 2 * gap > full


def _may_be_decimals(texts: Sequence[str]) -> bool:
    """Whether numbers behind _, p or - may be counted or decimals, which have another order."""
    found = [one for text in texts if (one := _SPLIT_NUMBER.fullmatch(text))]
    if len(found) < len(texts) or len({one[1] for one in found}) > 1 or len(found) < 2:
        return False
    counted = [(int(one[2]), int(one[3])) for one in found]
    decimals = [Fraction(f"{one[2]}.{one[3]}") for one in found]
    has_round = any(len(one[3]) > 1 and one[3].endswith("0") for one in found)
    is_series = all(
        first[0] != second[0] or second[1] - first[1] == 1
        for first, second in itertools.pairwise(counted)
    )
    if has_round or is_series or decimals == sorted(decimals):
        return False
    even = {second - first for first, second in itertools.pairwise(sorted(decimals))}
    return len(even) == 1 < len(found) - 1 or re.fullmatch(r"[a-z]?[-_]?", found[0][1]) is not None


def _warn_of_patterns(ordered: Sequence[Path]) -> None:
    is_twice = len({path.stem for path in ordered}) < len(ordered)
    patterns = Counter(
        re.sub(r"-?#", "#", _NUMBER.sub("#", _text(path))) + path.suffix.lower() * is_twice
        for path in ordered
    )
    # Single letters, a.png and b.png, tell the order; words, Jan.png and Feb.png, do not.
    differing = sum(len(set(letters)) > 1 for letters in itertools.zip_longest(*patterns))
    if differing > 1 or (differing and any("#" in one for one in patterns)):
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
    has_exponents = any(re.search(rf"\d{_EXPONENT}", one.stem.lower()) for one in files)
    if len(numbers) != len(files) or has_exponents or _order_doubt(files) is not None:
        return None
    steps = [second - first for first, second in itertools.pairwise(numbers)]
    usual = min(steps, default=0)
    longer = [index for index, step in enumerate(steps) if step != usual]
    is_gap = usual > 0 and all(steps[index] % usual == 0 for index in longer)
    if not longer or not is_gap or len(longer) > len(steps) // 4 + 1:
        return None
    return f"{files[longer[0]].name} and {files[longer[0] + 1].name}"
