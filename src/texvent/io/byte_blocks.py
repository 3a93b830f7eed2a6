"""Bytes of a file, block by block: whole records, none of them zeros that a crash left.

A file is read as it is when reading begins; one that becomes shorter meanwhile is refused.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import numpy as np

from texvent.errors import FileFormatError

BLOCK_BYTES = 2**21
"""Bytes read at once from files of fixed records."""
SECTOR_BYTES = 512
SHORTER = "became shorter while it was read; read it again"
LONGER = "became longer while it was read; read it again when it is complete"


def read_bytes(
    path: Path, start: int, unit: int = 1, *, has_zeros: bool = False
) -> Iterator[bytes]:
    """The bytes of a file from `start` to where it ends when this begins, a block at a time.

    Args:
        path: the file.
        start: first byte.
        unit: a block is a multiple of so many bytes.
        has_zeros: whether zeros may be no events, so that a part of zeros does no harm.

    Raises:
        FileFormatError: the file becomes shorter meanwhile, or a part of it is zeros.
    """
    block_bytes = BLOCK_BYTES // unit * unit
    with path.open("rb") as file:
        stop = os.fstat(file.fileno()).st_size
        file.seek(start)
        for place in range(start, stop, block_bytes):
            block = read_whole(path, file, min(stop - place, block_bytes))
            zeros = [] if has_zeros else zero_sectors(block)
            if zeros:
                sound = len(block[: zeros[0] * SECTOR_BYTES].rstrip(b"\0"))
                sound += -sound % unit
                if sound:
                    yield block[:sound]
                raise FileFormatError(
                    f"{path} holds zeros instead of events from byte {place + sound} on; a part of "
                    "it was lost"
                )
            yield block


def zero_sectors(block: bytes) -> list[int]:
    """Numbers of the sectors of a block that hold zeros alone, as a disk leaves them."""
    whole = len(block) // SECTOR_BYTES
    words = np.frombuffer(block, np.uint64, whole * SECTOR_BYTES // 8)
    found: list[int] = np.flatnonzero(~words.reshape(whole, SECTOR_BYTES // 8).any(axis=1)).tolist()
    return found


def read_whole(path: Path, file: BinaryIO, count: int) -> bytes:
    """The next bytes of an open file, which has had so many.

    Raises:
        FileFormatError: it has no more.
    """
    data = file.read(count)
    if len(data) < count:
        raise FileFormatError(f"{path} {SHORTER}")
    return data


def read_records(
    path: Path, start: int, record_bytes: int, *, has_zeros: bool = False
) -> Iterator[bytes]:
    """The bytes of whole records, from `start` on, a block at a time; else as `read_bytes`.

    Raises:
        FileFormatError: the file ends inside a record, becomes shorter meanwhile, or holds zeros.
    """
    for block in read_bytes(path, start, record_bytes, has_zeros=has_zeros):
        rest = len(block) % record_bytes
        if not rest:
            yield block
            continue
        if len(block) > rest:
            yield block[:-rest]
        raise FileFormatError(
            f"{path} ends inside a record of {record_bytes} bytes; the file was cut off"
        )
