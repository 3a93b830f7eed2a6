"""Dialects of text: how rows of events are written, found from a sample of them."""

from __future__ import annotations

import io
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown, warn
from texvent.io.block_writer import Columns
from texvent.io.polarity import WORDS, PolarityCode, number_of
from texvent.io.reading import (
    MICROSECONDS,
    PER_SECOND,
    ReadOptions,
    TimeUnit,
    refuse_fractions,
    stated_or_given,
    unit_in_name,
)
from texvent.io.table_search import certain_order
from texvent.io.tables import are_whole, find_columns, spelled, whole_numbers
from texvent.sensor import SensorSize

STOP_US = 1 << 63
"""Exclusive upper limit of event times, µs."""
EXACT = 2**52
"""Below this float64 keeps a whole number, and a time in seconds its µs if it is 2^20 smaller."""
WORD = re.compile(rb"(?<![^\s,;])([a-z]+|[+-])(?![^\s,;])", re.IGNORECASE)
"""A value that may be a word of polarity."""
SIZE_LINE = rb"\s*(\d{1,9})\s+(\d{1,9})\s*"
WHOLE_US = re.compile(r"[-+]?\d+\.\d{6}")
"""A time in seconds as the Event Camera Dataset and E2VID write it: whole µs."""
SAMPLE_ROWS = 2000
COMMENTS = ("#", "%", "//")


def parse_table(
    block: bytes, path: Path, *, rows: str = "text rows of `t x y p`", **options: Any
) -> NDArray[Any]:
    """Numbers of a block of text, [rows, columns], float64 by default; no rows: [0, 0].

    Args:
        block: the text.
        path: the file, for messages.
        rows: expected rows, for messages.
        **options: of `np.loadtxt`, such as `delimiter`.

    Raises:
        FileFormatError: it is not a table of numbers.
    """
    if not block.strip():
        return np.empty((0, 0))
    try:
        text = io.StringIO(block.decode("ascii"))
        return np.loadtxt(text, ndmin=2, **options)
    except (ValueError, OverflowError, MemoryError) as error:
        reason = " ".join(str(error).split("; use")[0].split())[:100]
        raise FileFormatError(f"{path} is not {rows} ({reason})") from error


@dataclass(frozen=True)
class Dialect:
    """Form of the rows of a text."""

    delimiter: str | None
    """Between values; None: spaces or tabs."""
    width: int
    """Values per row."""
    places: Mapping[str, int]
    """t, x, y, p, and label if known → number of the column."""
    unit: TimeUnit
    is_stated: bool
    """Whether file or caller states the unit."""
    start: int
    """Bytes before the first row."""
    size: tuple[int, int] | None
    """Sensor size of a first line `width height`."""
    has_words: bool
    """Whether polarity is written in words."""
    code: PolarityCode

    @property
    def rows(self) -> str:
        """Expected form of a row, for messages."""
        names = {place: name for name, place in self.places.items()}
        order = (self.delimiter or " ").join(names.get(at, "_") for at in range(self.width))
        return f"rows of {self.width} numbers `{order}`, t in {self.unit}, polarity such as 0/1"

    def parse(self, path: Path, block: bytes, left_out: list[int] | None = None) -> Columns:
        """Columns of a block of rows.

        Args:
            path: the file, for messages.
            block: whole rows.
            left_out: in repair; the number of rows of other values than events have is appended.

        Raises:
            FileFormatError: a row is of another form.
        """
        block = _plain_values(_without_comments(block), has_words=self.has_words)
        parse = partial(parse_table, block, path, rows=self.rows, delimiter=self.delimiter)
        table = parse(comments=None)
        if table.size == 0:
            return dict.fromkeys("xytp", np.empty(0, dtype=np.int64))
        if table.shape[1] != self.width:
            raise FileFormatError(f"{path} has rows of {table.shape[1]} values, not {self.rows}")
        values = {name: table[:, place] for name, place in self.places.items()}
        is_sound = np.abs(values["t"]) / PER_SECOND[self.unit] <= STOP_US / MICROSECONDS
        if left_out is None and not is_sound.all():
            raise FileFormatError(f"{path} holds times that are no numbers of {self.unit}")
        if left_out is not None:
            is_sound &= are_whole(values["x"]) & are_whole(values["y"])
            is_sound &= self.code.are_likely(values["p"])
            is_sound |= not is_sound.any()
            left_out.append(len(table) - int(np.count_nonzero(is_sound)))
            values = {name: one[is_sound] for name, one in values.items()}
        whole = {name: whole_numbers(path, values[name]) for name in values if name not in "tp"}
        whole["p"] = self.code.binary(values["p"])
        scale = MICROSECONDS / PER_SECOND[self.unit]
        if not self.is_stated and scale == 1:
            refuse_fractions(path, values["t"])
        if (np.abs(values["t"]) < EXACT / max(1, scale)).all():
            rounded = np.floor if scale < 1 else np.rint
            return {**whole, "t": rounded(values["t"] * scale).astype(np.int64)}
        place = self.places["t"]  # slow
        exact = {place: partial(_exact_us, unit=self.unit)}
        times = parse(comments=None, dtype=np.int64, usecols=place, converters=exact)
        return {**whole, "t": times[is_sound, 0]}

    def parse_sound(self, path: Path, block: bytes, *, left_out: list[int]) -> Columns:
        """Columns of the rows of a block that are events; the number of others is appended.

        Raises:
            FileFormatError: none is.
        """
        try:
            return self.parse(path, block, left_out)
        except FileFormatError:
            rows = [row for row in _without_comments(block).split(b"\n") if row.strip()]
            sound = [row for row in rows if self._is_row(row)]
            if not sound:
                raise
            left_out.append(len(rows) - len(sound))
            return self.parse(path, b"\n".join(sound), left_out)

    def _is_row(self, row: bytes) -> bool:
        words = _words(row.decode("latin-1"), self.delimiter)
        return len(words) == self.width and all(map(_is_value, words))


def _exact_us(word: str, *, unit: TimeUnit) -> int:
    value = Decimal(word) * MICROSECONDS / PER_SECOND[unit]
    return int(value) if unit == "ns" else round(value)


def find_dialect(
    path: Path, sample: bytes, options: ReadOptions, default: str, later: Sequence[bytes] = ()
) -> Dialect:
    """The dialect of a text.

    Args:
        path: the file, for messages.
        sample: its beginning, which ends with a whole line.
        options: unit and columns, where the text does not say them.
        default: order of unnamed columns where several are possible.
        later: more samples, from its middle and end, which begin and end somewhere.

    Raises:
        InputError: the order of the columns is not certain.
        FileFormatError: it is not a text of events.
    """
    lines = sample.split(b"\n")
    at, size = 0, None
    start = 3 if sample.startswith(b"\xef\xbb\xbf") else 0
    lines[0] = lines[0][start:]
    while at < len(lines) - 1 and _is_comment(lines[at]):
        start, at = start + len(lines[at]) + 1, at + 1
    match = re.fullmatch(SIZE_LINE, lines[at])
    if match is not None:
        size = int(match[1]), int(match[2])
        start, at = start + len(lines[at]) + 1, at + 1
    line = lines[at].decode("utf-8", errors="replace") if at < len(lines) else ""
    delimiter = next((one for one in ";," if one in line), None)
    words = _words(line, delimiter)
    names = None if any(map(_is_number, words)) or not line.strip() else words
    if names is not None:
        start, at = start + len(lines[at]) + 1, at + 1
    else:
        names = _names_in_comments(lines[:at], len(words))
    text = b"\n".join([*lines[at : at + SAMPLE_ROWS], *(one[one.find(b"\n") :] for one in later)])
    rows = _sound_rows(path, text, delimiter, None if names is None else len(names))
    places = _places(path, rows, names, options, size, default)
    times, polarities = (
        [row[places[name]] for row in rows if len(row) > places[name]] for name in "tp"
    )
    named = unit_in_name(names[places["t"]])[1] if names else None
    stated = stated_or_given(path, named, options)
    _check_digits(path, times, stated or "us")
    if (stated or "s") == "s":
        _check_decimals(path, times)
    label = places.get("label")
    if label is not None and any(len(row) > label and number_of(row[label]) > 1 for row in rows):
        del places["label"]  # classes of another program
    return Dialect(
        delimiter,
        len(names or (rows[0] if rows else words)),
        places,
        stated or ("us" if times and all(map(_is_whole, times)) else "s"),
        stated is not None or _are_seconds(times),
        start,
        size,
        any(word.lower() in WORDS for word in polarities),
        PolarityCode(path, np.array(polarities, dtype=str), is_repaired=options.repair),
    )


def _names_in_comments(lines: Sequence[bytes], width: int) -> list[str] | None:
    """Names of as many columns in the last comment that has nothing else, as `# t x y p`."""
    for line in reversed(lines):
        text = line.decode("utf-8", errors="replace").strip().lstrip("".join(COMMENTS)).strip()
        for mark in (",", ";", None):
            names = _words(text, mark)
            if len(names) == width and {*"txyp"} <= {spelled(name)[0] for name in names}:
                return names
    return None


def _are_seconds(times: Sequence[str]) -> bool:
    """Whether times are written as only seconds are; "%f" gives µs and ms zeros at the end."""
    return all(map(WHOLE_US.fullmatch, times)) and not all(one.endswith("000") for one in times)


def _without_comments(block: bytes) -> bytes:
    """The block without its lines of comments; NumPy would look for them in every row."""
    if not any(mark.encode() in block for mark in COMMENTS):
        return block
    return b"\n".join(line for line in block.split(b"\n") if not _is_comment(line))


def _is_comment(line: bytes) -> bool:
    return not line.strip() or line.lstrip().startswith(tuple(one.encode() for one in COMMENTS))


def _is_value(word: str) -> bool:
    return _is_number(word) or word.lower() in WORDS


def _is_number(word: str) -> bool:
    try:
        return Decimal(word).is_finite()
    except InvalidOperation:
        return False


def _is_whole(word: str) -> bool:
    """Whether a time is a whole number: 0.000 is one of seconds, 1.6e9 one of µs."""
    if not _is_number(word) or ("." in word and "e" not in word.lower()):
        return False
    return Decimal(word) == Decimal(word).to_integral_value()


def _words(line: str, delimiter: str | None) -> list[str]:
    line = line.strip().removesuffix(delimiter) if delimiter else line
    return [word.strip().strip("\"'").strip() for word in line.split(delimiter)]


def _plain_values(text: bytes, *, has_words: bool) -> bytes:
    """Rows of numbers without quotes or marks at their ends, words of polarity as numbers."""
    for end in (b",\n", b";\n", b",\r\n", b";\r\n"):
        text = text.replace(end, b"\n")
    text = text.replace(b'"', b"").replace(b"'", b"") if b'"' in text or b"'" in text else text
    if not has_words:
        return text
    found = partial(_number_of, default=b"nan")
    return WORD.sub(found, text)


def _number_of(match: re.Match[bytes], default: bytes) -> bytes:
    number = WORDS.get(match[1].decode().lower())
    return default if number is None else b"%d" % number


def _sound_rows(
    path: Path, text: bytes, delimiter: str | None, width: int | None
) -> list[list[str]]:
    """Values of the rows of a sample that are like most; others are damage, found when read.

    Args:
        path: the file, for messages.
        text: the sample.
        delimiter: between values.
        width: values per row, where known.

    Raises:
        FileFormatError: numbers are written with commas in them.
    """
    lines = _without_comments(text).decode("latin-1").split("\n")
    rows = [_words(line, delimiter) for line in lines if line.strip()]
    with_comma = next((word for row in rows for word in row if "," in word), None)
    if delimiter == ";" and with_comma is not None:
        raise FileFormatError(
            f"{path} writes numbers with commas ({shown(with_comma)}); write them with points, and "
            "without separators of thousands"
        )
    sound = [row for row in rows if all(map(_is_value, row))]
    widths = Counter(map(len, sound)).most_common(1)
    usual = width or (widths[0][0] if widths else 0)
    return [row for row in sound if len(row) == usual] or rows[:1]


def _check_digits(path: Path, times: list[str], unit: TimeUnit) -> None:
    """Warn of times such as 1.6e+09 whose digits do not reach the µs."""
    for word in times:
        digits, _, power = word.lower().partition("e")
        if power and _is_number(word):
            decimals = len(digits.partition(".")[2])
            step_us = Decimal(10) ** (int(power) - decimals) * MICROSECONDS / PER_SECOND[unit]
            if 1 < step_us < STOP_US and Decimal(digits):
                warn(
                    f"{path}: its times, such as {shown(word)}, have steps of {step_us:g} µs; "
                    "write all their digits"
                )
                return


def _check_decimals(path: Path, times: list[str]) -> None:
    """Warn of seconds such as 1700.01 that were cut: most are those of three events or more."""
    plain = [word for word in times if _is_number(word) and "e" not in word.lower()]
    after = max((len(word.partition(".")[2]) for word in plain), default=0)
    found, counts = np.unique(np.array(plain, dtype=np.float64), return_counts=True)
    step_us = 10 ** (6 - after)
    if not 0 < after < 6 or len(found) < 2 or np.median(counts) < 3:
        return
    if np.median(np.diff(found)) * MICROSECONDS < 1.5 * step_us:
        warn(
            f"{path}: its times, such as {shown(times[-1])}, have steps of {step_us:,} µs; "
            "write all their digits"
        )


def _places(
    path: Path,
    rows: list[list[str]],
    names: list[str] | None,
    options: ReadOptions,
    size: tuple[int, int] | None,
    default: str,
) -> dict[str, int]:
    """Column → its number: as the options or the first line name it, or as the values make sure."""
    if names is not None and options.order is None:
        found = options.names or find_columns(path, names)
        missing = [name for name in found.values() if name not in names]
        if missing:
            raise FileFormatError(f"{path} has no column {missing[0]!r}; it has {', '.join(names)}")
        places = {column: names.index(name) for column, name in found.items()}
        return places | ({"label": names.index("label")} if "label" in names else {})
    if options.names:
        raise FileFormatError(f"{path} does not name its columns; give their order (t,x,y,p)")
    order = options.order
    if order is None:
        table = np.array([[number_of(word) for word in row] for row in rows])
        if table.size and (table.ndim != 2 or table.shape[1] != 4):
            raise FileFormatError(
                f"{path} has rows of {len(rows[0])} values without names; name the columns "
                "(--columns t,x,y,p,_ in the order of the file)"
            )
        known = options.size or (None if size is None else SensorSize(*size))
        order = tuple(certain_order(path, table, known, default)) if table.size else tuple(default)
    return {name: order.index(name) for name in (*"txyp", "label") if name in order}
