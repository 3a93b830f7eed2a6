"""Text rows `t x y p`, seconds with six decimals: what ECD text and E2VID archives share."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.io.protocol import Columns

BLOCK_BYTES = 16 * 2**20
"""Text parsed at once: about 800,000 events."""
MICROSECONDS = 1_000_000
MAX_EXACT_S = 2**33
"""Up to here (272 years) float64 seconds keep every µs."""


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


def parse_table(block: bytes, path: Path, *, delimiter: str | None = None) -> NDArray[np.float64]:
    """Numbers of a block of text, [rows, columns] float64; no rows: [0, 0].

    Raises:
        FileFormatError: it is not a table of numbers.
    """
    if not block.strip():
        return np.empty((0, 0))
    try:
        text = io.StringIO(block.decode("ascii"))
        return np.loadtxt(text, dtype=np.float64, ndmin=2, delimiter=delimiter)
    except (ValueError, OverflowError, MemoryError) as error:
        reason = " ".join(str(error).split())[:160]
        raise FileFormatError(f"{path} is not text rows of `t x y p` ({reason})") from error


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
    if not (np.abs(seconds) < MAX_EXACT_S).all():
        raise FileFormatError(f"{path} holds times that are not seconds (first column)")
    whole = whole_numbers(pixels, path)
    times = np.rint(seconds * MICROSECONDS).astype(np.int64)
    return {"t": times, "x": whole[:, 0], "y": whole[:, 1], "p": whole[:, 2]}


def whole_numbers(pixels: NDArray[np.float64], path: Path) -> NDArray[np.int64]:
    """x, y and p as integers.

    Raises:
        FileFormatError: they are no whole numbers.
    """
    if not (np.abs(pixels) < 2**31).all() or (pixels != np.rint(pixels)).any():
        raise FileFormatError(f"{path} holds x, y or p that are not whole numbers")
    return pixels.astype(np.int64)
