"""Files compressed by a general program: texts are unpacked while they are read, others named.

gzip, bzip2 and xz come with Python; Zstandard's comes with Python 3.14.
"""

from __future__ import annotations

import bz2
import gzip
import lzma
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any, NamedTuple, cast

from texvent.io.input_checks import NotReadError

UnpackedFile = Callable[[Path], Any]


class Packing(NamedTuple):
    """A kind of compressed file."""

    magic: bytes
    name: str
    command: str
    """Program that unpacks it."""
    open: UnpackedFile | None = None
    """Opens it to read what is in it."""


PACKINGS = (
    Packing(b"\x1f\x8b", "gzip", "gunzip -k", gzip.open),
    Packing(b"BZh", "bzip2", "bunzip2 -k", bz2.open),
    Packing(b"\xfd7zXZ\0", "xz", "unxz -k", lzma.open),
    Packing(b"\x28\xb5\x2f\xfd", "Zstandard", "unzstd"),
    Packing(b"\x04\x22\x4d\x18", "LZ4", "unlz4"),
    Packing(b"7z\xbc\xaf\x27\x1c", "7-Zip", "7z x"),
    Packing(b"Rar!", "RAR", "unrar x"),
)
TEXT_BYTES = 1024


def packing_of(path: Path) -> Packing | None:
    """How a file is compressed; None: it is not."""
    with path.open("rb") as file:
        start = file.read(8)
    return next((one for one in PACKINGS if start.startswith(one.magic)), None)


def unpacker_of(path: Path) -> UnpackedFile | None:
    """Opens a file that Python can unpack; None of others."""
    packing = packing_of(path)
    return None if packing is None else packing.open


def beginning_of_text(path: Path) -> bytes:
    """The first bytes of a file, unpacked; none if they are no text.

    Raises:
        NotReadError: it is compressed, and what is in it is not read from there.
    """
    packing = packing_of(path)
    opener: UnpackedFile = lambda one: one.open("rb")  # noqa: E731
    try:
        with (opener if packing is None else packing.open or opener)(path) as file:
            start = cast("IO[bytes]", file).read(TEXT_BYTES)
    except (OSError, EOFError, lzma.LZMAError, ValueError):
        start = b"\0"
    if packing is not None and (packing.open is None or b"\0" in start):
        raise NotReadError(
            f"{path} is compressed by {packing.name}; unpack it first ({packing.command} "
            f"{path.name}), then give the file that was in it"
        )
    return b"" if b"\0" in start else start
