"""E2VID's zip archives: one text file, first line `width height`, then rows `t x y p` (seconds).

How the events were made lies beside the archive, in `NAME.zip.json`: E2VID's reader allows one
file in it.

Source: Rebecq et al., High Speed and High Dynamic Range Video with an Event Camera, 2019.
"""

from __future__ import annotations

import re
import struct
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, ClassVar, cast

from texvent.errors import FileFormatError, InputError
from texvent.event_packets import EventPackets
from texvent.io.arrays.archives import check_archive
from texvent.io.block_stream import BlockPackets, BlockWriter, Columns, FileTarget
from texvent.io.columns import existing_file, stored_or_given_size
from texvent.io.limits import FormatLimits
from texvent.io.sidecar import read_sidecar
from texvent.io.text.rows import MAX_EXACT_S, MICROSECONDS, make_rows, parse_rows, read_text_blocks
from texvent.sensor import SensorSize

LEVEL = 1
"""Of zip's compression: text shrinks to a fourth even so."""
ENTRY = "events.txt"
MAX_FIRST_LINE = 64
_DAMAGE = (
    OSError,
    ValueError,
    EOFError,
    MemoryError,
    NotImplementedError,
    RuntimeError,
    struct.error,
    zipfile.BadZipFile,
    zlib.error,
)
"""zipfile raises any of these on a damaged archive."""


class E2vidCodec:
    """Zipped text with the size in its first line."""

    name: ClassVar[str] = "e2vid"
    extensions: ClassVar[tuple[str, ...]] = (".zip",)
    limits: ClassVar[FormatLimits] = FormatLimits("E2VID zip", 1 << 16, MAX_EXACT_S * MICROSECONDS)

    def read(self, path: Path, *, size: SensorSize | None = None) -> EventPackets:
        """Events of an archive, block by block.

        Raises:
            InputError: no such file.
            FileFormatError: it is damaged or holds something else.
        """
        path = existing_file(path)
        with _open_text(path) as file:
            stored = _read_size(file, path)
        final_size = stored_or_given_size(path, stored, size)
        _, metadata = read_sidecar(path)
        blocks = partial(_read_blocks, path)
        return EventPackets(BlockPackets(path, blocks, final_size, metadata), final_size, metadata)

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> BlockWriter:
        """Start an archive; see `EventCodec.open_writer`."""
        target = FileTarget(path, size, metadata, overwrite)
        return BlockWriter(target, partial(E2vidSink, size=size), limits=self.limits, sidecar=True)


class E2vidSink:
    """Writes the archive's one text file."""

    def __init__(self, part: Path, stack: ExitStack, *, size: SensorSize) -> None:
        archive = stack.enter_context(
            zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED, compresslevel=LEVEL)
        )
        # Its date is 1980, so that the same events give the same archive.
        entry = zipfile.ZipInfo(ENTRY)
        entry.compress_type = zipfile.ZIP_DEFLATED
        self._file = stack.enter_context(archive.open(entry, "w", force_zip64=True))
        self._file.write(f"{size.width} {size.height}\n".encode())

    def write(self, columns: Columns) -> None:
        """Add events."""
        self._file.write(make_rows(columns).encode())

    def finish(self) -> None:
        """Nothing follows the last row."""


@contextmanager
def _open_text(path: Path) -> Iterator[BinaryIO]:
    """The archive's one text file; damage found while it is read becomes a FileFormatError."""
    try:
        with zipfile.ZipFile(path) as archive:
            check_archive(path, archive)
            entries = archive.infolist()
            if len(entries) != 1:
                raise FileFormatError(
                    f"{path} holds {len(entries)} files; an E2VID archive holds one text file"
                )
            with archive.open(entries[0]) as file:
                yield cast("BinaryIO", file)
    except InputError:
        raise
    except _DAMAGE as error:
        reason = " ".join(str(error).split())[:200]
        raise FileFormatError(f"{path} is damaged or not a zip archive ({reason})") from error


def _read_size(file: BinaryIO, path: Path) -> tuple[int, int]:
    line = file.readline(MAX_FIRST_LINE)
    match = re.fullmatch(rb"\s*(\d{1,9})\s+(\d{1,9})\s*", line)
    if match is None:
        raise FileFormatError(
            f"{path}: its text begins with {line[:40]!r}, not with width and height"
        )
    return int(match[1]), int(match[2])


def _read_blocks(path: Path) -> Iterator[Columns]:
    texts = _read_texts(path)
    for block in texts:
        yield parse_rows(block, path)


def _read_texts(path: Path) -> Iterator[bytes]:
    with _open_text(path) as file:
        _read_size(file, path)
        yield from read_text_blocks(file)
