"""N-ImageNet's npz: one array `event_data` with fields x u2, y u2, t i8 (µs), p bool.

Older files call them x_pos, y_pos, timestamp and polarity.

Further arrays are width, height and texvent (all metadata as JSON), which its loader does not look
for; files of the data set itself have none: it is 640x480, to be given. As with every npz, writer
and reader hold the whole recording in memory (13 bytes per event).

Source: Kim et al., N-ImageNet: Towards Robust, Fine-Grained Object Recognition, ICCV 2021.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.arrays.npz import N_IMAGENET, NpzCodec, array_names
from texvent.io.block_writer import Columns, FileTarget, FormatLimits, WriteBlock
from texvent.io.files import load
from texvent.io.metadata import metadata_to_json
from texvent.sensor import SensorSize

SENSOR = SensorSize(640, 480)
"""Size of the recordings of the data set."""
EVENT = np.dtype([("x", "<u2"), ("y", "<u2"), ("t", "<i8"), ("p", "?")])


class NImageNetCodec(NpzCodec):
    """npz of one structured array."""

    name: ClassVar[str] = "n-imagenet"
    limits: ClassVar[FormatLimits] = FormatLimits("N-ImageNet npz", 1 << 16, 1 << 63)

    def recognises(self, path: Path) -> bool:
        """True if it is an archive with an array event_data."""
        return N_IMAGENET in array_names(path)

    @contextmanager
    def start(self, target: FileTarget, part: Path) -> Iterator[WriteBlock]:
        """Collect the events; the archive is written at the end."""
        blocks = [np.empty(0, dtype=EVENT)]

        def write(columns: Columns) -> None:
            block = np.empty(len(columns["t"]), dtype=EVENT)
            for name in "xytp":
                block[name] = columns[name]
            blocks.append(block)

        yield write
        arrays: dict[str, Any] = {
            N_IMAGENET: np.concatenate(blocks),
            "width": np.int64(target.size.width),
            "height": np.int64(target.size.height),
            "texvent": np.array(metadata_to_json(target.metadata)),
        }
        with part.open("wb") as file:
            np.savez(file, **arrays)


def load_stream(path: Path) -> EventStream:
    """Events of a file of any format; one that stores no sensor size is N-ImageNet's own."""
    try:
        return load(path)
    except InputError:
        return load(path, size=SENSOR)
