"""The .bin and .bs2 files of N-MNIST and N-Caltech101, recorded with an ATIS.

5 bytes per event:

    byte 0  x · byte 1  y · bytes 2..4  p << 23 | t (µs, 23 bits), big-endian
    y = 240 is no event: from here on 8192 µs are added to all times; so is a turn of the 23 bits

So x is below 256, y below 240, and texvent writes times below 2^23 µs (8.39 s); the additions
are read, not written, because readers disagree about them. The bytes hold no sensor size and
no metadata: texvent writes both beside the file, in `NAME.bin.json`. For files of others the size
is asked for (N-MNIST 34x34; N-Caltech101 240x180).

Source: Orchard et al., Converting Static Image Datasets to Spiking Neuromorphic Datasets, 2015.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent.errors import InputError
from texvent.io.block_codec import BlockCodec, FileContents, write_records
from texvent.io.block_writer import UNLIMITED, Columns, FileTarget, FormatLimits, WriteBlock
from texvent.io.byte_blocks import read_records
from texvent.io.clocks import TurningClock
from texvent.io.metadata import read_sidecar
from texvent.io.reading import ReadOptions
from texvent.sensor import SensorSize

EVENT_BYTES = 5
MAX_SIZE = SensorSize(256, 240)
OVERFLOW_Y = 240
OVERFLOW_US = 8192
STOP_US = 1 << 23


class NMnistCodec(BlockCodec):
    """N-Caltech101 and N-MNIST files."""

    name: ClassVar[str] = "atis"
    extensions: ClassVar[tuple[str, ...]] = (".bin", ".bs2")
    limits: ClassVar[FormatLimits] = FormatLimits("ATIS .bin", MAX_SIZE.width, STOP_US)
    has_sidecar: ClassVar[bool] = True

    def check_target(self, target: FileTarget) -> None:
        """Refuse a sensor that is too high."""
        if target.size.height > MAX_SIZE.height:
            raise InputError(
                f"cannot write {target.path}: ATIS .bin holds sensors up to {MAX_SIZE}, not "
                f"{target.size}; {UNLIMITED} hold it"
            )

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Size and metadata are in a sidecar file."""
        size, metadata = read_sidecar(path)
        return FileContents(size, metadata, partial(_read_blocks, path))

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Records begin at once."""
        return write_records(part, b"", encode_records)


def encode_records(columns: Columns) -> bytes:
    """Events as five bytes each: x, y, then p in the top bit and the time, µs, in 23 bits."""
    t = columns["t"].astype(np.uint32)
    records = np.empty((len(t), EVENT_BYTES), dtype=np.uint8)
    records[:, 0] = columns["x"]
    records[:, 1] = columns["y"]
    records[:, 2] = columns["p"] << 7 | (t >> 16).astype(np.uint8)
    records[:, 3] = (t >> 8).astype(np.uint8)
    records[:, 4] = t.astype(np.uint8)
    return records.tobytes()


def _read_blocks(path: Path) -> Iterator[Columns]:
    added_us = 0
    clock = TurningClock(STOP_US.bit_length() - 1)
    for block in read_records(path, 0, EVENT_BYTES):
        records = np.frombuffer(block, dtype=np.uint8).reshape(-1, EVENT_BYTES)
        stored = (
            (records[:, 2] & 127).astype(np.int64) << 16
            | records[:, 3].astype(np.int64) << 8
            | records[:, 4]
        )
        t = clock.unroll(stored) + added_us
        columns: dict[str, Any] = {"x": records[:, 0], "y": records[:, 1], "p": records[:, 2] >> 7}
        is_overflow = records[:, 1] == OVERFLOW_Y
        if is_overflow.any():
            count = np.cumsum(is_overflow)
            added_us += OVERFLOW_US * int(count[-1])
            t += OVERFLOW_US * count
            columns = {name: column[~is_overflow] for name, column in columns.items()}
            t = t[~is_overflow]
        yield {**columns, "t": t}
