"""Text rows `t x y p` (seconds, pixels, 0/1): the Event Camera Dataset's events.txt.

The rows hold neither the sensor size nor how the events were made, so texvent writes both into
`NAME.txt.json` beside the text, and reads the size from there. Any other file needs the size
from the caller; it is never guessed from the largest coordinate.

Times are written with exactly six decimals: whole µs, read back unchanged.

Source: Mueggler et al., The Event-Camera Dataset and Simulator, IJRR 2017.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import AbstractContextManager
from decimal import Decimal
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, warn
from texvent.io.block_codec import BlockCodec, FileContents, write_records
from texvent.io.block_writer import FileTarget, FormatLimits, WriteBlock
from texvent.io.metadata import read_sidecar
from texvent.io.protocol import Columns

BLOCK_BYTES = 16 * 2**20
"""Text parsed at once: about 800,000 events."""
MICROSECONDS = 1_000_000
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
    whole = whole_numbers(pixels, path)
    if (np.abs(seconds) < EXACT_S).all():
        times = np.rint(seconds * MICROSECONDS).astype(np.int64)
    else:  # slow
        exact = {0: lambda word: round(Decimal(word) * MICROSECONDS)}
        times = parse_table(block, path, dtype=np.int64, usecols=0, converters=exact)[:, 0]
    return {"t": times, "x": whole[:, 0], "y": whole[:, 1], "p": whole[:, 2]}


def whole_numbers(pixels: NDArray[np.float64], path: Path) -> NDArray[np.int64]:
    """x, y and p as integers.

    Raises:
        FileFormatError: they are no whole numbers.
    """
    if not (np.abs(pixels) < 2**31).all() or (pixels != np.rint(pixels)).any():
        raise FileFormatError(f"{path} holds x, y or p that are not whole numbers")
    return pixels.astype(np.int64)


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
