"""Text files of frame times: one per line, a file name may follow (as in ECD's images.txt)."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from texvent.capture.times import FrameTimes, check_increasing
from texvent.errors import FileFormatError, InputError

PER_SECOND = {"s": 1, "ms": 1_000, "us": 1_000_000, "ns": 1_000_000_000}
"""How many of a unit are a second."""


@dataclass(frozen=True)
class Timestamps:
    """What a timestamp file says."""

    times: FrameTimes
    names: tuple[str, ...] | None
    """File name of each frame, or None where the file has times only."""


def read_timestamps(path: Path, unit: str) -> Timestamps:
    """Read a file with a time per line; blank lines and lines that start with `#` do not count.

    Args:
        path: the file; columns are separated by spaces, tabs or commas.
        unit: unit of the times: s, ms, us or ns.

    Returns:
        Times rounded to whole µs from the exact decimal number, and the names if all lines have
        one. The times are kept as they are: they share a clock with whatever was recorded beside
        the frames.

    Raises:
        InputError: the file does not exist, or its times do not strictly increase.
        FileFormatError: a line does not begin with a number, or only some lines have a name.

    Source: `images.txt` of the Event-Camera Dataset (Mueggler et al. 2017).
    """
    times_us: list[int] = []
    names: list[str] = []
    for number, line in enumerate(_lines(path), start=1):
        words = line.replace(",", " ").split(maxsplit=1)
        if not words or words[0].startswith("#"):
            continue
        times_us.append(_microseconds(words[0], unit, f"{path}, line {number}"))
        names.extend(word.strip() for word in words[1:])
    if not times_us:
        raise FileFormatError(f"{path} has no times; it needs one per frame")
    if names and len(names) != len(times_us):
        raise FileFormatError(
            f"{path}: {len(names)} of {len(times_us)} lines name a file; name all of them or none"
        )
    hint = f" (times are read as {unit}; another unit: --timestamps-unit)"
    check_increasing(times_us, str(path), hint)
    times = FrameTimes(listed_us=times_us, origin=path.name)
    return Timestamps(times, tuple(names) if names else None)


def _lines(path: Path) -> list[str]:
    try:
        return path.read_text(encoding="utf-8").splitlines()
    except FileNotFoundError:
        raise InputError(f"timestamp file {path} does not exist; check --timestamps") from None
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(
            f"timestamp file {path} cannot be read ({error}); it must be plain text"
        ) from error


def _microseconds(text: str, unit: str, where: str) -> int:
    """Exact: a float64 of a Unix time in ns would be off by up to 128 ns."""
    try:
        return round(Fraction(text) * 1_000_000 / PER_SECOND[unit])
    except (ValueError, ZeroDivisionError):
        raise FileFormatError(
            f"{where} begins with {text!r}; each line must begin with a time in {unit}, "
            "optionally followed by a file name"
        ) from None
