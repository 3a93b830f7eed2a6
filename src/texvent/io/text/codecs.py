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
import zipfile
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import BinaryIO, ClassVar, cast

import numpy as np

from texvent.errors import FileFormatError, warn
from texvent.io.block_codec import BlockCodec, FileContents, write_records
from texvent.io.block_writer import Columns, FileTarget, FormatLimits, WriteBlock
from texvent.io.compressed import DAMAGE, Unpacked, unpacker_of
from texvent.io.input_checks import ZIP_DAMAGE, begins_with, check_zip, reporting_damage
from texvent.io.metadata import read_sidecar
from texvent.io.reading import (
    MICROSECONDS,
    ReadOptions,
    TimeUnit,
    check_rate,
    sample_of,
)
from texvent.io.text.dialect import STOP_US, Dialect, find_dialect
from texvent.sensor import SensorSize

BLOCK_BYTES = 16 * 2**20
"""Text parsed at once: about 800,000 events."""
SAMPLE_BYTES = 2**16


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
        # Zeros in a text, as a crash leaves them, are damage, which is found when they are read.
        if b"\0" in sample.partition(b"\n")[0]:
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
        if size is not None:
            dialect = replace(dialect, is_stated=True)  # texvent's own
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
            with path.open("rb") as file:
                yield file
            return
        with reporting_damage(path, "a compressed text", DAMAGE), unpacker(path) as unpacked:
            yield unpacked

    def _read(
        self, path: Path, dialect: Dialect, parse: Callable[[Path, bytes], Columns]
    ) -> Iterator[Columns]:
        count, zeros, samples = 0, 0, []
        with self.open_text(path) as file:
            file.read(dialect.start)
            for block in read_text_blocks(file):
                columns = parse(path, block)
                zeros += block.count(b"\0")
                count += len(columns["t"])
                samples.append(sample_of(columns["t"], len(columns["t"])))
                if not dialect.is_stated and len(samples) == 1:
                    check_rate(path, count, samples[0], dialect.unit, is_all=False)
                yield columns
        if zeros:
            warn(f"{path} holds {zeros:,} bytes of zeros instead of text; a part of it was lost")
        if not dialect.is_stated and samples:
            check_rate(path, count, np.concatenate(samples), dialect.unit)


class EcdCodec(TextCodec):
    """Event Camera Dataset text."""

    name: ClassVar[str] = "ecd"
    extensions: ClassVar[tuple[str, ...]] = (".txt",)
    limits: ClassVar[FormatLimits] = FormatLimits("ECD text", 1 << 16, STOP_US)

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Rows begin at once."""
        return write_records(part, b"", make_rows)


LEVEL = 1
"""Level of zip's compression: text shrinks to a fourth even so."""
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
                yield cast("BinaryIO", Unpacked(file, ZIP_DAMAGE))

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
