"""Files compressed by a general program: texts are unpacked while they are read, others named.

gzip, bzip2 and xz come with Python; Zstandard's comes with Python 3.14.
"""

from __future__ import annotations

import bz2
import gzip
import lzma
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from texvent.io.input_checks import ZIP_DAMAGE, NotReadError, reporting_damage

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
DAMAGE = (*ZIP_DAMAGE, lzma.LZMAError)
"""The modules raise any of these on a damaged file."""


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
        FileFormatError: it is compressed and damaged.
    """
    packing = packing_of(path)
    if packing is None:
        with path.open("rb") as file:
            start = file.read(TEXT_BYTES)
        return b"" if b"\0" in start else start
    start = b"\0"
    if packing.open is not None:
        with reporting_damage(path, "a compressed text", DAMAGE), packing.open(path) as unpacked:
            start = unpacked.read(TEXT_BYTES)
    if b"\0" in start:
        raise NotReadError(
            f"{path} is compressed by {packing.name}; unpack it first ({packing.command} "
            f"{path.name}), then give the file that was in it"
        )
    return start
