"""Text formats: the Event Camera Dataset's rows, E2VID's zip archives of them, and CSV.

Event Camera Dataset (`ecd`): rows `t x y p` (seconds, pixels, 0/1). Times are written with exactly
six decimals: whole µs, read back unchanged. E2VID: one such text in a zip archive, after a line
`width height`; its reader allows one file in it.

CSV: a header line `t,x,y,p`, then one event per line, times in whole µs, polarity 0/1. Read too:
columns in any order, under the names other programs give them (timestamp, polarity …); and without
a header line in the order x, y, p, t of Metavision's converter.

The rows hold neither the sensor size nor how the events were made, so texvent writes both beside
the file, in `NAME.txt.json`. Any other file needs the size from the caller; it is never guessed
from the largest coordinate.

Source: Mueggler et al., The Event-Camera Dataset and Simulator, IJRR 2017; Rebecq et al., High
Speed and High Dynamic Range Video with an Event Camera, 2019.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from decimal import Decimal
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, ClassVar, cast

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown, warn
from texvent.io.arrays.npz import find_columns
from texvent.io.block_codec import BlockCodec, FileContents, write_records
from texvent.io.block_writer import FileTarget, FormatLimits, WriteBlock
from texvent.io.input_checks import ZIP_DAMAGE, check_zip, reporting_damage
from texvent.io.layouts import MICROSECONDS, whole_numbers
from texvent.io.metadata import read_sidecar
from texvent.io.protocol import Columns

BLOCK_BYTES = 16 * 2**20
"""Text parsed at once: about 800,000 events."""
DAY_S, RAREST_HZ = 86_400, 100
"""Longer recordings with fewer events per second are hardly meant."""
STOP_US = 1 << 63
"""Exclusive upper limit of event times, µs."""
EXACT_S = 2**32
"""Below this (136 years) the nearest float64 of a time in seconds gives back its µs."""


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


def warn_of_wrong_unit(blocks: Iterator[Columns], path: Path) -> Iterator[Columns]:
    """The blocks of a file whose times are seconds; at its end, a warning if they are hardly so.

    Events of 0.1 s or more with times in µs seem to take over a day, and to be rare: a camera
    gives fewer than 100 million events in a second.

    Warns:
        TexventWarning: whole seconds, more than a day, fewer than 100 events per second.
    """
    first_us = last_us = count = 0
    are_whole = True
    for columns in blocks:
        times = columns["t"]
        if len(times):
            first_us = int(times[0]) if count == 0 else first_us
            last_us = int(times[-1])
            count += len(times)
            are_whole = are_whole and not (times % MICROSECONDS).any()
        yield columns
    seconds = (last_us - first_us) / MICROSECONDS
    if are_whole and seconds > DAY_S and count < RAREST_HZ * seconds:
        warn(
            f"{path} spans {seconds / DAY_S:.1f} days with {count:,} events: times in this format "
            "are seconds, and these are probably µs; divide them by 1,000,000, or give the file "
            "as CSV with columns t,x,y,p"
        )


def parse_rows(block: bytes, path: Path) -> dict[str, NDArray[Any]]:
    """Columns x, y, t, p of a block of rows.

    Raises:
        FileFormatError: a row is not `t x y p`.
    """
    table = parse_table(block, path)
    if table.size == 0:
        return dict.fromkeys("xytp", np.empty(0, dtype=np.int64))
    if table.shape[1] != 4:
        raise FileFormatError(
            f"{path} has rows of {table.shape[1]} values; event rows are `t x y p`"
        )
    seconds, pixels = table[:, 0], table[:, 1:]
    if not (np.abs(seconds) <= STOP_US / MICROSECONDS).all():
        raise FileFormatError(f"{path} holds times that are not seconds (first column)")
    whole = whole_numbers(path, pixels)
    if (np.abs(seconds) < EXACT_S).all():
        times = np.rint(seconds * MICROSECONDS).astype(np.int64)
    else:  # slow
        exact = {0: lambda word: round(Decimal(word) * MICROSECONDS)}
        times = parse_table(block, path, dtype=np.int64, usecols=0, converters=exact)[:, 0]
    return {"t": times, "x": whole[:, 0], "y": whole[:, 1], "p": whole[:, 2]}


class EcdCodec(BlockCodec):
    """Event Camera Dataset text."""

    name: ClassVar[str] = "ecd"
    extensions: ClassVar[tuple[str, ...]] = (".txt",)
    limits: ClassVar[FormatLimits] = FormatLimits("ECD text", 1 << 16, STOP_US)
    has_sidecar: ClassVar[bool] = True

    def inspect(self, path: Path) -> FileContents:
        """Size and metadata are in a sidecar file."""
        size, metadata = read_sidecar(path)
        return FileContents(size, metadata, partial(_read, path))

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Rows begin at once."""
        return write_records(part, b"", make_rows)


def _read(path: Path) -> Iterator[Columns]:
    return warn_of_wrong_unit(_read_blocks(path), path)


def _read_blocks(path: Path) -> Iterator[Columns]:
    with path.open("rb") as file:
        for block in read_text_blocks(file):
            yield parse_rows(block, path)


LEVEL = 1
"""Of zip's compression: text shrinks to a fourth even so."""
ENTRY = "events.txt"
MAX_FIRST_LINE = 64


class E2vidZipCodec(BlockCodec):
    """Zipped text with the size in its first line."""

    name: ClassVar[str] = "e2vid"
    has_checksums: ClassVar[bool] = True
    extensions: ClassVar[tuple[str, ...]] = (".zip",)
    limits: ClassVar[FormatLimits] = FormatLimits("E2VID zip", 1 << 16, STOP_US)
    has_sidecar: ClassVar[bool] = True

    def inspect(self, path: Path) -> FileContents:
        """The text states the size; metadata is in a sidecar file."""
        with _open_text(path) as file:
            size = _read_zip_size(file, path)
        _, metadata = read_sidecar(path)
        return FileContents(size, metadata, partial(_read_zip, path))

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


@contextmanager
def _open_text(path: Path) -> Iterator[BinaryIO]:
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


def _read_zip_size(file: BinaryIO, path: Path) -> tuple[int, int]:
    line = file.readline(MAX_FIRST_LINE)
    match = re.fullmatch(rb"\s*(\d{1,9})\s+(\d{1,9})\s*", line)
    if match is None:
        raise FileFormatError(
            f"{path}: its text begins with {line[:40]!r}, not with width and height"
        )
    return int(match[1]), int(match[2])


def _read_zip(path: Path) -> Iterator[Columns]:
    return warn_of_wrong_unit(_read_zip_blocks(path), path)


def _read_zip_blocks(path: Path) -> Iterator[Columns]:
    with _open_text(path) as file:
        _read_zip_size(file, path)
        for block in read_text_blocks(file):
            yield parse_rows(block, path)


HEADER = b"t,x,y,p\n"
HEADLESS = ("x", "y", "p", "t")
CSV_STOP_US = 1 << 53
"""Up to here float64, which the parser uses, keeps every µs (285 years)."""
MAX_HEADER = 4096


class CsvCodec(BlockCodec):
    """Comma-separated text."""

    name: ClassVar[str] = "csv"
    extensions: ClassVar[tuple[str, ...]] = (".csv",)
    limits: ClassVar[FormatLimits] = FormatLimits("CSV", 1 << 16, CSV_STOP_US)
    has_sidecar: ClassVar[bool] = True

    def inspect(self, path: Path) -> FileContents:
        """Size and metadata are in a sidecar file; its first line names the columns."""
        size, metadata = read_sidecar(path)
        columns = _read_header(path)
        return FileContents(size, metadata, partial(_read_csv, path, columns))

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Write the line that names the columns."""
        return write_records(part, HEADER, _make_csv_rows)


def _make_csv_rows(columns: Columns) -> bytes:
    lists = [columns[name].tolist() for name in "txyp"]
    return "".join(f"{t},{x},{y},{p}\n" for t, x, y, p in zip(*lists, strict=True)).encode()


@dataclass(frozen=True)
class _Table:
    """Where the columns are, and where the first row begins."""

    names: tuple[str, ...]
    """Column names of the file, in their order."""
    places: Mapping[str, int]
    """t, x, y, p → number of the column."""
    start: int
    has_header: bool

    @property
    def rows(self) -> str:
        """Expected form of a row, for messages."""
        return f"rows of numbers `{','.join(self.names)[:60]}`, polarity 0/1 or -1/+1"


def _read_header(path: Path) -> _Table:
    """The columns that the first line names, or those of a file without such a line."""
    with path.open("rb") as file:
        line = file.readline(MAX_HEADER)
    words = [word.strip().strip('"').lower() for word in line.decode("latin-1").split(",")]
    if words[0][:1].isdecimal() or words == [""]:
        return _Table(HEADLESS, {name: HEADLESS.index(name) for name in "txyp"}, 0, False)
    found = find_columns(path, words)
    places = {name: words.index(found[name]) for name in "txyp"}
    return _Table(tuple(words), places, len(line), True)


def _read_csv(path: Path, columns: _Table) -> Iterator[Columns]:
    with path.open("rb") as file:
        file.seek(columns.start)
        for block in read_text_blocks(file):
            table = parse_table(block, path, delimiter=",", rows=columns.rows)
            if table.size == 0:
                continue
            if table.shape[1] != len(columns.names):
                raise FileFormatError(
                    f"{path} has rows of {table.shape[1]} values, and {len(columns.names)} columns"
                )
            values = {name: table[:, place] for name, place in columns.places.items()}
            _check_values(path, columns, values)
            whole = whole_numbers(path, np.stack([values[name] for name in "xyp"], axis=1))
            t = values["t"].astype(np.int64)
            yield {"t": t, "x": whole[:, 0], "y": whole[:, 1], "p": whole[:, 2]}


def _check_values(path: Path, columns: _Table, values: Mapping[str, NDArray[np.float64]]) -> None:
    """Refuse columns in another order or unit.

    Raises:
        FileFormatError: see above; the message says which are expected.
    """
    t, p = values["t"], values["p"]
    wrong = p[~np.isin(p, (-1, 0, 1))]
    if wrong.size and not columns.has_header:
        raise FileFormatError(
            f"{path} does not name its columns, so they are x, y, p, t; but the third, polarity, "
            f"holds {wrong[0]:g}: put a first line with their names, such as t,x,y,p"
        )
    fractions = t[~((np.abs(t) < CSV_STOP_US) & (t == np.rint(t)))]
    if fractions.size:
        raise FileFormatError(
            f"{path} holds times that are not whole µs, such as {shown(fractions[0])} in column "
            f"{shown(columns.names[columns.places['t']])}; times in CSV are whole µs, not seconds "
            "or ms: multiply and round them first"
        )
