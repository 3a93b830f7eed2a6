"""Times of frames that are given: by a frame rate, a list of times, or a text file of them."""

from __future__ import annotations

import contextlib
import csv
import math
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from texvent.errors import ConfigError, FileFormatError, InputError, few, one_line, shown, warn
from texvent.frames import MICROSECONDS, frame_time_us
from texvent.options.arrays import HOW_TO_ROUND, whole_numbers
from texvent.options.values import parse_fraction
from texvent.runtime.files.file_names import IMAGE_EXTENSIONS, usable_path

PER_SECOND = {"s": 1, "ms": 1_000, "us": 1_000_000, "ns": 1_000_000_000}
"""Units in a second."""
TO_US = {
    "s": "multiply them by 1,000,000",
    "ms": "multiply them by 1000",
    "ns": "divide them by 1000",
}
LONGEST_STEP_S, LONGEST_WHOLE_S = 60, 5
"""Frames that are further apart, or as far in whole numbers, are hardly meant in seconds."""
HEADER = re.compile(r"time|stamp|^\W*(t|ts|sec\w*)\b", re.IGNORECASE)
"""Names of a column of times."""
DATE = re.compile(r"\d{4}\W\d\d\W\d\d|\d\d:\d\d|(19|20)\d{6}[_T ]?\d{6}|(19|20)\d{12}")
DATES_TO_US = "np.array(dates, 'datetime64[us]').astype(np.int64)"
HIGHEST_FPS = 20_000
"""Times that give more frames per second have another unit."""


@dataclass(frozen=True)
class FrameTimes:
    """Times the user gave, by frame index; exactly one of `fps` and `listed_us` is set."""

    fps: Fraction | None = None
    """Frames per second."""
    listed_us: Sequence[int] | None = None
    """One time per frame, µs, strictly increasing."""
    origin: str = "fps"
    """Name of the times in messages, such as `images.txt`."""

    def __call__(self, index: int) -> int:
        """Time of frame `index`, µs.

        Raises:
            InputError: there are more frames than times.
        """
        if self.listed_us is None:
            return frame_time_us(index, self._rate())
        if index >= len(self.listed_us):
            raise InputError(
                f"{self.origin} has {len(self.listed_us)} times, but there are more frames; "
                "give one time per frame"
            )
        return int(self.listed_us[index])

    def of(self, frames: int) -> Sequence[int]:
        """All listed times, or those of so many frames, µs; errors as `check_count`."""
        self.check_count(frames)
        return self.listed_us or [self(index) for index in range(frames)]

    def check_count(self, frames: int) -> None:
        """Refuse a list of another length than there are frames.

        Raises:
            InputError: with both numbers.
        """
        if self.listed_us is not None and len(self.listed_us) != frames:
            raise InputError(
                f"{self.origin} has {len(self.listed_us)} times for {frames} frames; "
                "give one time per frame"
            )

    def _rate(self) -> Fraction:
        if self.fps is None:
            raise ConfigError("frame times need fps or a list of times; give one of them")
        return self.fps


@dataclass(frozen=True)
class Timestamps:
    """Content of a timestamp file."""

    times: FrameTimes
    names: tuple[str, ...] | None
    """File name of each frame, or None where the file has times only."""


def listed_times(t_us: Any, origin: str = "t_us") -> FrameTimes:
    """Frame times from a list of integer µs.

    Args:
        t_us: [N] integers, µs.
        origin: what to call them in messages.

    Raises:
        InputError: they are not integers, not one-dimensional, or do not strictly increase.

    Warns:
        TexventWarning: as `warn_of_unit`.
    """
    times = whole_numbers(t_us, origin, f"whole microseconds ({HOW_TO_ROUND}; {DATES_TO_US})")
    if times.ndim != 1 or times.dtype.kind == "b":
        raise InputError(
            f"{origin} must be one-dimensional whole microseconds; got {times.dtype} of shape "
            f"{list(times.shape)}. For seconds: {HOW_TO_ROUND}"
        )
    check_increasing([int(time) for time in times], origin)
    warn_of_unit(times, origin)
    return FrameTimes(listed_us=[int(time) for time in times], origin=origin)


def warn_of_unit(times_us: Any, origin: str) -> None:
    """Warn of times that are probably no µs: their steps are too short or too long.

    Args:
        times_us: [N] integers, strictly increasing.
        origin: what to call them in messages.
    """
    step = float(np.median(np.diff(times_us))) if len(times_us) > 1 else math.nan
    if not (0 < step < MICROSECONDS / HIGHEST_FPS or step >= LONGEST_WHOLE_S * MICROSECONDS):
        return
    others = " or ".join(
        f"{unit} ({rate}), {TO_US[unit]}" for unit, rate in _rates(step).items() if unit != "us"
    )
    warn(
        f"{origin}: frames are {step:,.10g} µs apart, {MICROSECONDS / step:,.4g} per second; "
        f"if times are {others or 'of another unit, convert them'}"
    )


def _rates(step: float) -> dict[str, str]:
    """Units in which times so far apart give a usual frame rate, and that rate."""
    return {
        unit: f"{per_second / step:,.4g} frames per second"
        for unit, per_second in PER_SECOND.items()
        if 1 <= per_second / step <= HIGHEST_FPS
    }


def check_increasing(times_us: Sequence[int], origin: str, hint: str = "") -> None:
    """Refuse times that do not strictly increase.

    Raises:
        InputError: with the first offending pair.
    """
    for index in range(1, len(times_us)):
        if times_us[index] <= times_us[index - 1]:
            raise InputError(
                f"{origin}: time {index} ({times_us[index]} µs) is not after time {index - 1} "
                f"({times_us[index - 1]} µs); frame times must strictly increase{hint}"
            )


def read_timestamps(path: Path, unit: str | None) -> Timestamps:
    """Read a text file with a time per line, and a file name after or before it or none.

    Blank lines, comments after `#`, and a header such as `timestamp,filename` do not count.

    Args:
        path: the file; columns are separated by spaces, tabs, commas or semicolons.
        unit: unit of the times: s, ms, us or ns; None: s, if that can be.

    Returns:
        Times rounded to whole µs from the exact decimal number, and the names if all lines have
        one. The times are kept as they are: they share a clock with whatever was recorded beside
        the frames.

    Raises:
        InputError: the file does not exist, its times do not strictly increase, or they cannot be
            meant in seconds.
        FileFormatError: a line has no number or several, or only some lines have a name.

    Warns:
        TexventWarning: an image is named twice, or whole numbers may be of another unit.

    Source: `images.txt` of the Event-Camera Dataset (Mueggler et al. 2017).
    """
    times_us: list[int] = []
    names: list[str] = []
    for number, line in enumerate(_lines(path), start=1):
        fields = _fields(line.strip())
        numbers = [field for field in fields if _is_number(field)]
        is_header = not (times_us or numbers) and HEADER.search(line) is not None
        if not fields or is_header:
            continue
        if len(numbers) != 1 or len(fields) > 2:
            raise FileFormatError(
                f"{path}, line {number} is {shown(line.strip())}; each line must hold one time in "
                f"{unit or 's'} as a number with a decimal point, and a file name or none; a "
                f"header begins with #{_date_advice(line)}"
            )
        times_us.append(_microseconds(numbers[0], unit or "s", f"{path}, line {number}"))
        names += [field for field in fields if field != numbers[0]]
    if not times_us:
        raise FileFormatError(f"{path} has no times; it needs one per frame")
    if names and len(names) != len(times_us):
        raise FileFormatError(
            f"{path}: {len(names)} of {len(times_us)} lines name a file; name all of them or none"
        )
    twice = [name for name, count in Counter(names).items() if count > 1]
    if twice:
        warn(f"{path} names {few(twice)} more than once, so the same image is shown again")
    if unit is None:
        check_seconds(str(path), times_us, "give `timestamps_unit`")
    hint = f" (times are read as {unit or 's'}; another unit: `timestamps_unit`)"
    check_increasing(times_us, str(path), hint)
    times = FrameTimes(listed_us=times_us, origin=path.name)
    return Timestamps(times, tuple(names) if names else None)


def check_seconds(origin: str, times_us: Sequence[int], help: str) -> None:
    """Refuse times that are hardly seconds, and name the units that they may have.

    Steps are judged by their median, since a pause or a jump is another matter.

    Raises:
        InputError: see above.

    Warns:
        TexventWarning: whole numbers, which may be of another unit.
    """
    steps = np.abs(np.diff(np.array(times_us, dtype=object)))
    step = float(np.median(steps.astype(np.float64))) / MICROSECONDS if len(steps) else 0.0
    is_whole = all(time % MICROSECONDS == 0 for time in times_us)
    if not step or (step < LONGEST_WHOLE_S and not is_whole):
        return
    length = float(abs(times_us[-1] - times_us[0])) / MICROSECONDS
    others = " or ".join(
        f"{unit} ({rate}, {length / PER_SECOND[unit]:,.4g} s in all)"
        for unit, rate in _rates(step).items()
        if unit != "s"
    )
    if step > LONGEST_STEP_S or (is_whole and step >= LONGEST_WHOLE_S):
        likely = f"they are probably {others}; " if others else ""
        raise InputError(f"{origin}: its times read as s are {step:,.4g} s apart; {likely}{help}")
    warn(
        f"{origin}: times are read as s, so frames are {step:,.4g} s apart; if they are "
        f"{others or 'of another unit'}, {help}"
    )


def _date_advice(text: str) -> str:
    advice = ". A date is no number: write datetime.timestamp() of it, in s"
    return advice if DATE.search(text) else ""


def _is_number(text: str) -> bool:
    if "_" in text:  # Python groups digits so; a file's are those of a date
        return False
    try:
        parse_fraction(text)
    except (ValueError, ZeroDivisionError):
        return False
    return True


def _fields(line: str) -> list[str]:
    """The columns of a line without their quotes; names may hold spaces, and what separates others.

    The name may come first, as in DVS-Voltmeter's info.txt.
    """
    text, *comment = re.split(r"(?:^|\s)#", line, maxsplit=1)
    if comment and Path(comment[0]).suffix.lower() in IMAGE_EXTENSIONS:
        text = line
    ends = (text.split(",")[0], text.rstrip(", ").split(",")[-1])
    beside_number = "," if any(_is_number(end.strip(' "')) for end in ends) else None
    separator = next((one for one in ";\t" if one in text), beside_number)
    if separator is not None and separator in text:
        fields = text.split(separator)
        with contextlib.suppress(csv.Error):  # such as a byte 0
            fields = next(csv.reader([text], delimiter=separator, skipinitialspace=True))
    elif all(map(_is_number, text.split())):
        fields = text.split()
    else:
        fields = text.split(maxsplit=1)
        fields = fields if _is_number(fields[0].strip('"')) else text.rsplit(maxsplit=1)
    return [field for field in (one.strip(' "') for one in fields) if field]


def _lines(path: Path) -> list[str]:
    try:
        return list(StringIO(usable_path(path).read_text(encoding="utf-8-sig")))
    except FileNotFoundError:
        raise InputError(f"timestamp file {path} does not exist; check `timestamps`") from None
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(
            f"timestamp file {path} cannot be read ({one_line(error)}); save it as UTF-8 text"
        ) from error


def _microseconds(text: str, unit: str, where: str) -> int:
    """Exact: a float64 of a Unix time in ns would be off by up to 128 ns."""
    time_us = round(parse_fraction(text) * 1_000_000 / PER_SECOND[unit])
    if abs(time_us) >= 2**63:
        raise FileFormatError(
            f"{where}: {shown(text)} {unit} is beyond 64 bits of µs, so it is probably of a "
            f"smaller unit, such as ns; give `timestamps_unit`{_date_advice(text)}"
        )
    return time_us
