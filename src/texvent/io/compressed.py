"""Files compressed by a general program: texts are unpacked while they are read, others named.

gzip, bzip2 and xz come with Python; Zstandard's with Python 3.14 or the extra `zstd`.
"""

from __future__ import annotations

import bz2
import gzip
import lzma
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from texvent._require import require
from texvent.errors import MissingDependencyError, one_line
from texvent.io.input_checks import ZIP_DAMAGE, NotReadError, reporting_damage

UnpackedFile = Callable[[Path], Any]
DAMAGE = (*ZIP_DAMAGE, lzma.LZMAError)
"""The modules raise any of these on a damaged file."""
STEP_BYTES = 2**13
"""Unpacked at once: so much before damage may be lost."""


class Unpacked:
    """The bytes of a compressed file; those before damage are given before it is raised."""

    def __init__(self, file: Any, damage: tuple[type[Exception], ...]) -> None:
        self._file, self._damage = file, damage
        self._failure: Exception | None = None

    def read(self, count: int) -> bytes:
        """The next bytes, so many unless the file ends before.

        Raises:
            OSError: there are none before the damage.
        """
        parts, left = [b""], count
        while left and self._failure is None:
            try:
                parts.append(self._file.read1(min(left, STEP_BYTES)))
            except self._damage as error:
                self._failure = error
            if not parts[-1]:
                break
            left -= len(parts[-1])
        if self._failure is not None and left == count:
            raise OSError(one_line(self._failure)) from self._failure
        return b"".join(parts)


@contextmanager
def _unpacked(open_file: Callable[[Path], Any], path: Path) -> Iterator[Unpacked]:
    with open_file(path) as file:
        yield Unpacked(file, DAMAGE)


@contextmanager
def _unpacked_zstd(path: Path) -> Iterator[Unpacked]:
    zstd = load_zstd()
    with zstd.open(path) as file:
        yield Unpacked(file, (*DAMAGE, zstd.ZstdError))


def load_zstd() -> ModuleType:
    """The module of Zstandard.

    Raises:
        MissingDependencyError: it is not installed.
    """
    try:
        return require("compression.zstd")
    except MissingDependencyError:
        return require("backports.zstd", extra="zstd")


class Packing(NamedTuple):
    """A kind of compressed file."""

    magic: bytes
    name: str
    command: str
    """Program that unpacks it."""
    open: UnpackedFile | None = None
    """Opens it to read what is in it."""


PACKINGS = (
    Packing(b"\x1f\x8b", "gzip", "gunzip -k", partial(_unpacked, gzip.open)),
    Packing(b"BZh", "bzip2", "bunzip2 -k", partial(_unpacked, bz2.open)),
    Packing(b"\xfd7zXZ\0", "xz", "unxz -k", partial(_unpacked, lzma.open)),
    Packing(b"\x28\xb5\x2f\xfd", "Zstandard", "unzstd", _unpacked_zstd),
    Packing(b"\x04\x22\x4d\x18", "LZ4", "unlz4"),
    Packing(b"7z\xbc\xaf\x27\x1c", "7-Zip", "7z x"),
    Packing(b"Rar!", "RAR", "unrar x"),
)
TEXT_BYTES = 1024


def packing_of(path: Path) -> Packing | None:
    """Compression of a file; None: it has none."""
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
        damaged = reporting_damage(path, "a compressed text", DAMAGE)
        with suppress(MissingDependencyError), damaged, packing.open(path) as unpacked:
            start = unpacked.read(TEXT_BYTES)
    if b"\0" in start:
        raise NotReadError(
            f"{path} is compressed by {packing.name}; unpack it first ({packing.command} "
            f"{path.name}), then give the file that was in it"
        )
    return start
