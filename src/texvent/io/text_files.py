"""Text formats: the Event Camera Dataset's rows, E2VID's zip archives of them, and CSV.

Event Camera Dataset (`ecd`): rows `t x y p` (seconds, pixels, 0/1). Times are written with exactly
six decimals: whole µs, read back unchanged. E2VID: one such text in a zip archive, after a line
`width height`; its reader allows one file in it. CSV: a header line `t,x,y,p`, then one event per
line, times in whole µs, polarity 0/1.

Read is every dialect of these, whatever the extension: separated by spaces, tabs, commas or
semicolons; comment lines; a first line of the sensor's size; a line that names the columns, with a
unit or without; polarity in numbers or words (`polarity.py`); columns in any order that the names
or the values make certain. Times with decimals are seconds, whole ones µs.

The rows hold neither the sensor size nor how the events were made, so texvent writes both beside
the file, in `NAME.txt.json`. Any other file needs the size from the caller; it is never guessed
from the largest coordinate.

Source: Mueggler et al., The Event-Camera Dataset and Simulator, IJRR 2017; Rebecq et al., High
Speed and High Dynamic Range Video with an Event Camera, 2019.
"""

from __future__ import annotations

import codecs
import io
import re
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, replace
from decimal import Decimal, InvalidOperation
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, ClassVar, cast

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown, warn
from texvent.io.block_codec import BlockCodec, FileContents, write_records
from texvent.io.block_writer import Columns, FileTarget, FormatLimits, WriteBlock
from texvent.io.byte_blocks import open_complete
from texvent.io.compressed import DAMAGE, unpacker_of
from texvent.io.input_checks import ZIP_DAMAGE, begins_with, check_zip, reporting_damage
from texvent.io.metadata import read_sidecar
from texvent.io.polarity import WORDS, PolarityCode
from texvent.io.reading import (
    MICROSECONDS,
    PER_SECOND,
    ReadOptions,
    TimeUnit,
    check_rate,
    refuse_fractions,
    stated_or_given,
    unit_in_name,
)
from texvent.io.tables import certain_order, find_columns, whole_numbers
from texvent.sensor import SensorSize

BLOCK_BYTES = 16 * 2**20
"""Text parsed at once: about 800,000 events."""
SAMPLE_BYTES = 2**16
STOP_US = 1 << 63
"""Exclusive upper limit of event times, µs."""
EXACT = 2**52
"""Below this float64 keeps a whole number, and a time in seconds its µs if it is 2^20 smaller."""
WORD = re.compile(rb"(?<![^\s,;])([a-z]+|[+-])(?![^\s,;])", re.IGNORECASE)
"""A value that may be a word of polarity."""
SIZE_LINE = rb"\s*(\d{1,9})\s+(\d{1,9})\s*"
COMMENTS = ("#", "%", "//")


def make_rows(columns: Columns) -> bytes:
    """One line per event; times have exactly six decimals: whole µs."""
    lists = [columns[name].tolist() for name in "txyp"]
    return "".join(
        f"{t // MICROSECONDS}.{t % MICROSECONDS:06d} {x} {y} {p}\n"
        for t, x, y, p in zip(*lists, strict=True)
    ).encode()


def read_text_blocks(file: BinaryIO) -> Iterator[bytes]:
    """A text file in blocks that end with a line.

    Raises:
        FileFormatError: a line is absurdly long.
    """
    rest = b""
    while block := file.read(BLOCK_BYTES):
        cut = block.rfind(b"\n") + 1
        if cut == 0 and len(rest) > BLOCK_BYTES:
            raise FileFormatError("a line longer than 16 MiB: this is not a text event file")
        if cut:
            yield rest + block[:cut]
            rest = block[cut:]
        else:
            rest += block
    if rest:
        yield rest


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
    """How a text writes its rows."""

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

    def parse(self, path: Path, block: bytes) -> Columns:
        """Columns of a block of rows.

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
        whole = {name: whole_numbers(path, values[name]) for name in values if name not in "tp"}
        whole["p"] = self.code.binary(values["p"])
        seconds = np.abs(values["t"]) / PER_SECOND[self.unit]
        if not (seconds <= STOP_US / MICROSECONDS).all():
            raise FileFormatError(f"{path} holds times that are no numbers of {self.unit}")
        scale = MICROSECONDS / PER_SECOND[self.unit]
        if not self.is_stated and scale == 1:
            refuse_fractions(path, values["t"])
        if (np.abs(values["t"]) < EXACT / max(1, scale)).all():
            rounded = np.floor if scale < 1 else np.rint
            return {**whole, "t": rounded(values["t"] * scale).astype(np.int64)}
        place = self.places["t"]  # slow
        exact = {place: partial(_exact_us, unit=self.unit)}
        times = parse(comments=None, dtype=np.int64, usecols=place, converters=exact)
        return {**whole, "t": times[:, 0]}

    def parse_sound(self, path: Path, block: bytes, *, left_out: list[int]) -> Columns:
        """Columns of the rows of a block that are events; the number of others is appended.

        Raises:
            FileFormatError: none is.
        """
        try:
            return self.parse(path, block)
        except FileFormatError:
            rows = [row for row in _without_comments(block).split(b"\n") if row.strip()]
            sound = [row for row in rows if self._is_row(row)]
            if not sound:
                raise
            left_out.append(len(rows) - len(sound))
            return self.parse(path, b"\n".join(sound))

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
    text = b"\n".join([*lines[at : at + SAMPLE_ROWS], *(one[one.find(b"\n") :] for one in later)])
    rows = _sound_rows(path, text, delimiter, None if names is None else len(names))
    places = _places(path, rows, names, options, size, default)
    times, polarities = (
        [row[places[name]] for row in rows if len(row) > places[name]] for name in "tp"
    )
    named = unit_in_name(names[places["t"]])[1] if names else None
    stated = stated_or_given(path, named, options)
    _check_digits(path, times, stated or "us")
    return Dialect(
        delimiter,
        len(names or (rows[0] if rows else words)),
        places,
        stated or ("us" if times and all(map(_is_whole, times)) else "s"),
        stated is not None,
        start,
        size,
        any(word.lower() in WORDS for word in polarities),
        PolarityCode(path, np.array(polarities, dtype=str)),
    )


SAMPLE_ROWS = 2000


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
    return [word.strip().strip("\"'").strip() for word in line.split(delimiter)]


def _plain_values(text: bytes, *, has_words: bool) -> bytes:
    """Rows of numbers without quotes, with words of polarity as numbers."""
    text = text.replace(b'"', b"").replace(b"'", b"") if b'"' in text or b"'" in text else text
    if not has_words:
        return text
    found = partial(_number_of, default=b"nan")
    return WORD.sub(found, text)


def _number_of(match: re.Match[bytes], default: bytes) -> bytes:
    number = WORDS.get(match[1].decode().lower())
    return default if number is None else b"%d" % number


def _as_number(word: str) -> float:
    return float(WORDS.get(word.lower(), "nan")) if not _is_number(word) else float(word)


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
        table = np.array([[_as_number(word) for word in row] for row in rows])
        if table.size and (table.ndim != 2 or table.shape[1] != 4):
            raise FileFormatError(
                f"{path} has rows of {len(rows[0])} values without names; name the columns "
                "(--columns t,x,y,p,_ in the order of the file)"
            )
        known = options.size or (None if size is None else SensorSize(*size))
        order = tuple(certain_order(path, table, known, default)) if table.size else tuple(default)
    return {name: order.index(name) for name in (*"txyp", "label") if name in order}


def _later_samples(file: BinaryIO) -> list[bytes]:
    """Texts of the middle and of the end of a file; none where one can only read on."""
    if not isinstance(file, io.BufferedReader):
        return []
    length = file.seek(0, io.SEEK_END)
    found = []
    for start in (length // 2, length - SAMPLE_BYTES // 4):
        file.seek(max(start, SAMPLE_BYTES))
        text = file.read(SAMPLE_BYTES // 4)
        found.append(text[: text.rfind(b"\n") + 1])
    return found


class TextCodec(BlockCodec):
    """Base of the text formats: one way to read, two ways to write."""

    default: ClassVar[str] = "txyp"
    """Order of columns that are not named, where several are possible."""
    unit: ClassVar[TimeUnit] = "s"
    """Unit of times that are written."""
    has_sidecar: ClassVar[bool] = True
    takes: ClassVar[tuple[str, ...]] = ("time_unit", "columns")

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Size and metadata are in a sidecar file; the beginning says how rows are written."""
        size, metadata = read_sidecar(path)
        with self.open_text(path) as file:
            sample = file.read(SAMPLE_BYTES)
            later = _later_samples(file) if len(sample) == SAMPLE_BYTES else []
        if sample[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE):
            raise FileFormatError(f"{path} is text of UTF-16; save it as UTF-8")
        if b"\0" in sample:
            hint = f"; unpack it (unzip {path.name})" if begins_with(path, b"PK") else ""
            raise FileFormatError(f"{path} is not a text of events; it holds binary data{hint}")
        if b"\r" in sample and b"\n" not in sample:
            raise FileFormatError(
                f"{path} ends its lines by CR alone; rewrite them: tr '\\r' '\\n' < {path.name}"
            )
        if len(sample) == SAMPLE_BYTES:
            sample = sample[: sample.rfind(b"\n") + 1] or sample
        sized = (
            options if options.size or size is None else replace(options, size=SensorSize(*size))
        )
        dialect = find_dialect(path, sample, sized, self.default, later)
        left_out: list[int] = []
        parse = dialect.parse
        if options.repair:
            parse = partial(dialect.parse_sound, left_out=left_out)
        blocks = partial(self._read, path, dialect, parse)
        return FileContents(size or dialect.size, metadata, blocks, left_out=left_out)

    @contextmanager
    def open_text(self, path: Path) -> Iterator[BinaryIO]:
        """The text, open to read to its end; of a compressed file unpacked on the way."""
        unpacker = unpacker_of(path)
        if unpacker is None:
            with open_complete(path) as file:
                yield file
            return
        with reporting_damage(path, "a compressed text", DAMAGE), unpacker(path) as unpacked:
            yield unpacked

    def _read(
        self, path: Path, dialect: Dialect, parse: Callable[[Path, bytes], Columns]
    ) -> Iterator[Columns]:
        first_us = last_us = count = 0
        with self.open_text(path) as file:
            file.read(dialect.start)
            for block in read_text_blocks(file):
                columns = parse(path, block)
                times = columns["t"]
                if len(times):
                    first_us = int(times[0]) if count == 0 else first_us
                    last_us = int(times[-1])
                    count += len(times)
                    if not dialect.is_stated:
                        check_rate(path, count, (first_us, last_us), dialect.unit, is_all=False)
                yield columns
        if not dialect.is_stated and count:
            check_rate(path, count, (first_us, last_us), dialect.unit)


class EcdCodec(TextCodec):
    """Event Camera Dataset text."""

    name: ClassVar[str] = "ecd"
    extensions: ClassVar[tuple[str, ...]] = (".txt",)
    limits: ClassVar[FormatLimits] = FormatLimits("ECD text", 1 << 16, STOP_US)

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Rows begin at once."""
        return write_records(part, b"", make_rows)


LEVEL = 1
"""Of zip's compression: text shrinks to a fourth even so."""
ENTRY = "events.txt"


class E2vidZipCodec(TextCodec):
    """Zipped text with the size in its first line."""

    name: ClassVar[str] = "e2vid"
    has_checksums: ClassVar[bool] = True
    extensions: ClassVar[tuple[str, ...]] = (".zip",)
    limits: ClassVar[FormatLimits] = FormatLimits("E2VID zip", 1 << 16, STOP_US)

    def recognises(self, path: Path) -> bool:
        """True if it is a zip archive of one file, which is no array."""
        try:
            with zipfile.ZipFile(path) as archive:
                names = archive.namelist()
        except (OSError, ValueError, NotImplementedError, zipfile.BadZipFile):
            return False
        return len(names) == 1 and not names[0].endswith(".npy")

    @contextmanager
    def open_text(self, path: Path) -> Iterator[BinaryIO]:
        """The archive's one text file; damage found while it is read becomes a FileFormatError."""
        with (
            reporting_damage(path, "a zip archive", ZIP_DAMAGE),
            zipfile.ZipFile(path) as archive,
        ):
            check_zip(path, archive)
            entries = archive.infolist()
            if len(entries) != 1:
                raise FileFormatError(
                    f"{path} holds {len(entries)} files; an E2VID archive holds one text file"
                )
            with archive.open(entries[0]) as file:
                yield cast("BinaryIO", file)

    @contextmanager
    def start(self, target: FileTarget, part: Path) -> Iterator[WriteBlock]:
        """Open the archive's one text file and write its first line."""
        # Its date is 1980, so that the same events give the same archive.
        entry = zipfile.ZipInfo(ENTRY)
        entry.compress_type = zipfile.ZIP_DEFLATED
        with (
            zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED, compresslevel=LEVEL) as archive,
            archive.open(entry, "w", force_zip64=True) as file,
        ):
            file.write(f"{target.size.width} {target.size.height}\n".encode())
            yield lambda columns: file.write(make_rows(columns))


HEADER = b"t,x,y,p\n"


class CsvCodec(TextCodec):
    """Comma-separated text; without names, columns are in the order of Metavision's converter."""

    name: ClassVar[str] = "csv"
    extensions: ClassVar[tuple[str, ...]] = (".csv",)
    default: ClassVar[str] = "xypt"
    unit: ClassVar[TimeUnit] = "us"
    limits: ClassVar[FormatLimits] = FormatLimits("CSV", 1 << 16, STOP_US)

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Write the line that names the columns."""
        return write_records(part, HEADER, _make_csv_rows)


def _make_csv_rows(columns: Columns) -> bytes:
    lists = [columns[name].tolist() for name in "txyp"]
    return "".join(f"{t},{x},{y},{p}\n" for t, x, y, p in zip(*lists, strict=True)).encode()
