"""E2VID's zip archives: one text file, first line `width height`, then rows `t x y p` (seconds).

Provenance is in a sidecar file, `NAME.zip.json`: E2VID's reader allows one
file in it.

Source: Rebecq et al., High Speed and High Dynamic Range Video with an Event Camera, 2019.
"""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import BinaryIO, ClassVar, cast

from texvent.errors import FileFormatError
from texvent.io.block_codec import BlockCodec, FileContents
from texvent.io.block_writer import FileTarget, FormatLimits, WriteBlock
from texvent.io.input_checks import ZIP_DAMAGE, check_zip, reporting_damage
from texvent.io.metadata import read_sidecar
from texvent.io.protocol import Columns
from texvent.io.text.event_camera_dataset import (
    STOP_US,
    make_rows,
    parse_rows,
    read_text_blocks,
    warn_of_wrong_unit,
)

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
            size = _read_size(file, path)
        _, metadata = read_sidecar(path)
        return FileContents(size, metadata, partial(_read, path))

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


def _read_size(file: BinaryIO, path: Path) -> tuple[int, int]:
    line = file.readline(MAX_FIRST_LINE)
    match = re.fullmatch(rb"\s*(\d{1,9})\s+(\d{1,9})\s*", line)
    if match is None:
        raise FileFormatError(
            f"{path}: its text begins with {line[:40]!r}, not with width and height"
        )
    return int(match[1]), int(match[2])


def _read(path: Path) -> Iterator[Columns]:
    return warn_of_wrong_unit(_read_blocks(path), path)


def _read_blocks(path: Path) -> Iterator[Columns]:
    with _open_text(path) as file:
        _read_size(file, path)
        for block in read_text_blocks(file):
            yield parse_rows(block, path)
