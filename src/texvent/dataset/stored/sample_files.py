"""Files of a stored sample: its events, facts and ground truth."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.generation.shard_files import read_json, read_members, read_part
from texvent.errors import FileFormatError, InputError, one_line
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.truth.clip import ClipTruth

COLUMN_MEMBERS = ("x.npy", "y.npy", "t.npy", "p.npy", "label.npy")
_STORED_TYPES = {"x": np.uint16, "y": np.uint16, "t": np.uint32, "p": np.uint8}
_HEADER = re.compile(
    rb"\x93NUMPY\x01\x00..\{'descr': '([<|][ui][1248])', 'fortran_order': False, "
    rb"'shape': \((\d+),\), \} *\n",
    re.DOTALL,
)


def npy_column(content: memoryview) -> NDArray[Any]:
    """The one-dimensional array of a .npy file; it shares the memory of `content`.

    `numpy.load` parses each header as Python, which takes longer than reading a small sample.

    Raises:
        FileFormatError: it is no .npy file of one-dimensional integers.
    """
    header = _HEADER.match(content)
    if header is None:
        raise FileFormatError("not a .npy column of integers")
    try:
        dtype, count = np.dtype(header[1].decode()), int(header[2])
        return np.frombuffer(content, dtype, count, header.end())
    except (ValueError, TypeError) as error:
        raise FileFormatError(f"not a .npy column ({one_line(error)})") from error


def events_of(columns: Mapping[str, NDArray[Any]], size: SensorSize) -> EventStream:
    """The events of stored columns, checked.

    Raises:
        InputError, FileFormatError: they are not events of that sensor.
    """
    missing = [name for name in "xytp" if name not in columns]
    if missing:
        raise FileFormatError(f"column {missing[0]} is missing")
    x, y, t, p = (columns[name] for name in "xytp")
    label = columns.get("label")
    if label is None and _are_events(columns, size):
        return EventStream.unchecked(x, y, t.astype(np.int64), p, size=size, label=None)
    return EventStream(x, y, t, p, size, {}, label)  # says what is wrong


def _are_events(columns: Mapping[str, NDArray[Any]], size: SensorSize) -> bool:
    """True if the columns have the usual types and hold events.

    The check costs little on these small types; about a quarter of that of EventStream.
    """
    if any(columns[name].dtype != dtype for name, dtype in _STORED_TYPES.items()):
        return False
    if len({columns[name].shape for name in "xytp"}) > 1 or columns["t"].ndim != 1:
        return False
    x, y, t, p = (columns[name] for name in "xytp")
    return not len(x) or bool(
        x.max() < size.width and y.max() < size.height and p.max() <= 1 and (t[1:] >= t[:-1]).all()
    )


@dataclass(frozen=True)
class SampleFiles:
    """The files of a sample, read when they are asked for.

    All methods raise FileFormatError where the shard is gone, cut off or changed.
    """

    shard: Path
    """The tar."""
    key: str
    """Key of the sample."""
    places: Mapping[str, tuple[int, int]]
    """Name, such as "json" → position of its content in the shard, and bytes."""
    size: SensorSize
    """Size of the sensor."""

    def read(self, only: Sequence[str]) -> dict[str, bytes]:
        """Those of some files that there are: name → content."""
        return read_members(self.shard, self.places, only)

    def events(self) -> EventStream:
        """The events, checked, with `facts` as metadata."""
        return self.columns().with_metadata(self.facts())

    def columns(self) -> EventStream:
        """The events, checked, without metadata; one read, as the columns are adjacent."""
        own = {name: self.places[name] for name in COLUMN_MEMBERS if name in self.places}
        start = min((begin for begin, _ in own.values()), default=0)
        end = max((begin + length for begin, length in own.values()), default=0)
        content = memoryview(read_part(self.shard, start, end - start))
        try:
            columns = {
                name.removesuffix(".npy"): npy_column(content[begin - start :][:length])
                for name, (begin, length) in own.items()
            }
            return events_of(columns, self.size)
        except (FileFormatError, InputError) as error:
            raise FileFormatError(
                f"{self._where} is damaged: {error}; run texvent dataset verify"
            ) from error

    def facts(self) -> dict[str, Any]:
        """All that is known of it: its .json."""
        try:
            facts = read_json(self.read(("json",)).get("json", b""))
        except (ValueError, RecursionError) as error:
            raise FileFormatError(
                f"{self._where} is damaged ({one_line(error)}); run texvent dataset verify"
            ) from error
        if not isinstance(facts, dict):
            raise FileFormatError(
                f"{self._where} is damaged: its facts are no table; run texvent dataset verify"
            )
        return facts

    def truth(self) -> ClipTruth:
        """Ground truth; its arrays are read when they are asked for."""
        return ClipTruth(self._read_one, self._where)

    def _read_one(self, name: str) -> bytes:
        return read_part(self.shard, *self.places[name])

    @property
    def _where(self) -> str:
        return f"sample {self.key} of {self.shard}"
