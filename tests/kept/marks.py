"""Marks of values: a checksum of what is exact, and sums over the numbers that are not."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence, Set
from dataclasses import fields, is_dataclass
from enum import Enum
from fractions import Fraction
from pathlib import Path
from types import MappingProxyType
from typing import Any
from zlib import crc32

import numpy as np
import pytest
from numpy.typing import NDArray

DEEPEST = 12
"""Levels of what holds itself."""
MOST_PARTS = 200_000
"""Parts of the largest value: lists may hold each other often."""
LARGEST = 2**26
"""Bytes of the largest file that is read."""
DIGITS, WITHIN = 6, 2e-5
"""Of sums over floats, and what they may differ by of their norm: processors round differently."""
Parts = Iterator[bytes | NDArray[np.float64]]


def _items_of(value: Any) -> Iterable[Any]:
    """What a value holds; of a type that is not known here, nothing."""
    match value:
        case BaseException():
            return [str(value)]
        case pytest.ExceptionInfo():
            return [value.value]
        case pytest.WarningsRecorder():
            return [one.message for one in value.list]
        case dict() | MappingProxyType():
            return [each for pair in value.items() for each in pair]
        case list() | tuple():
            return value
    if is_dataclass(value) and not isinstance(value, type):
        return [getattr(value, field.name, None) for field in fields(value)]
    torch = sys.modules.get("torch")
    if torch and isinstance(value, torch.Tensor):
        return [value.detach().cpu().double().numpy(), str(value.dtype)]
    return ()


def parts_of(value: Any, folder: str, depth: int = 0) -> Parts:
    """Bytes of what is exact in a value, and arrays of its floats, in order.

    Args:
        value: of a type that is not known here it counts as that type.
        folder: left out of texts and paths, as each run has another.
        depth: of the value in another one.
    """
    yield type(value).__name__.encode()
    match value:
        case str() | Path():
            yield str(value).replace(folder, "").encode(errors="backslashreplace")
        case bytes() | bytearray():
            yield bytes(value)
        case float() | np.floating():
            yield np.array([value], np.float64)
        case bool() | int() | np.generic() | Enum() | Fraction() | slice():
            yield str(value).encode()
        case np.ndarray():
            yield from _parts_of_array(value, folder, depth)
        case Set():
            yield b"".join(sorted(checked_mark(one, folder).encode() for one in value))
        case _ if depth < DEEPEST:
            for one in _items_of(value):
                yield from parts_of(one, folder, depth + 1)


def _parts_of_array(value: NDArray[Any], folder: str, depth: int) -> Parts:
    yield f"{value.dtype}{value.shape}".encode()
    if value.dtype.names:
        for name in value.dtype.names:
            yield from _parts_of_array(value[name], folder, depth)
    elif value.dtype.kind == "f":
        yield value.ravel().astype(np.float64)
    elif value.dtype.kind == "O":
        yield from parts_of(value.tolist(), folder, depth + 1)
    else:
        yield value.tobytes()


UNKNOWN = "?"
"""Mark of what cannot be looked at, or what two runs made differently: it is that of no value."""


def mark(value: Any, folder: str) -> str:
    """As `checked_mark`; of what cannot be looked at, such as a closed file, `UNKNOWN`."""
    try:
        with np.errstate(all="ignore"):
            return checked_mark(value, folder)
    except Exception:  # noqa: BLE001
        return UNKNOWN


def checked_mark(value: Any, folder: str) -> str:
    """The checksum of a value's exact parts and how many floats it has, and, if it has any, their
    norm and their sum, in which each has a weight of its own."""
    checksum, found = 0, [np.zeros(0)]
    for number, part in enumerate(parts_of(value, folder)):
        if number > MOST_PARTS:
            raise OverflowError("a value that is larger than what is read of any")
        if isinstance(part, bytes):
            checksum = crc32(part, crc32(b"%d " % len(part), checksum))
        else:
            found.append(part)
    numbers = np.concatenate(found)
    checksum = crc32(b"%d" % len(numbers), checksum)
    exact = f"{checksum & 0xFFFFF:05x}"
    if not len(numbers):
        return exact
    odd = ~np.isfinite(numbers)
    exact = f"{crc32(odd.tobytes(), checksum) & 0xFFFFF:05x}"
    numbers = np.where(odd, 0.0, numbers)
    weighted = numbers * (np.modf(np.arange(1, len(numbers) + 1) * 0.618034)[0] - 0.55)
    sums = float(np.linalg.norm(weighted)), float(weighted.sum())
    return " ".join([exact, *(f"{one:.{DIGITS}g}" for one in sums)])


def joined(marks: Sequence[str]) -> str:
    """One mark of several values in order."""
    if UNKNOWN in marks:
        return UNKNOWN
    sums = [one.split(" ")[1:] for one in marks if " " in one]
    checksum = crc32(" ".join(one.partition(" ")[0] for one in marks).encode()) & 0xFFFFF
    if not sums:
        return f"{checksum:05x}"
    norms, weighted = np.array(sums, np.float64).T
    weights = 1.0 + np.modf(np.arange(len(sums)) * 0.618034)[0]
    together = float(np.hypot.reduce(norms)), float(weights @ weighted)
    return " ".join([f"{checksum:05x}", *(f"{one:.{DIGITS}g}" for one in together)])


def is_same(found: str, kept: str) -> bool:
    """Whether two marks are of one value, but for the last digits of its floats."""
    if UNKNOWN in (found, kept):
        return True
    (exact, *sums), (kept_exact, *kept_sums) = found.split(" "), kept.split(" ")
    if exact != kept_exact or len(sums) != len(kept_sums):
        return False
    before = [*map(float, kept_sums)]
    within = WITHIN * before[0] + 1e-12 if before else 0.0
    return all(abs(float(one) - other) <= within for one, other in zip(sums, before, strict=True))


def marks_of_files(folder: Path) -> dict[str, str]:
    """File below a folder → its mark, in which the folder's own path does not count."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.is_symlink() and path.stat().st_size < LARGEST:
            content = path.read_bytes().replace(str(folder).encode(), b"")
            found[path.relative_to(folder).as_posix()] = mark(content, "")
    return found
