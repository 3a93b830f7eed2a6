"""Events and facts of a stored sample."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.generation.shards import SampleRecord, read_json, read_members, read_part
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


def read_columns(
    shard: Path, key: str, places: Mapping[str, tuple[int, int]], size: SensorSize
) -> EventStream:
    """The events of a sample, checked, without metadata; one read, as the columns are adjacent.

    Args:
        shard: the tar.
        key: of the sample, for messages.
        places: member → position and bytes; those beside `COLUMN_MEMBERS` are not read.
        size: of the sensor.

    Raises:
        FileFormatError: the shard is cut off or changed, or the events are not sound.
    """
    own = {name: places[name] for name in COLUMN_MEMBERS if name in places}
    start = min((begin for begin, _ in own.values()), default=0)
    end = max((begin + length for begin, length in own.values()), default=0)
    content = memoryview(read_part(shard, start, end - start))
    try:
        columns = {
            name.removesuffix(".npy"): npy_column(content[begin - start : begin - start + length])
            for name, (begin, length) in own.items()
        }
        return events_of(columns, size)
    except (FileFormatError, InputError) as error:
        raise FileFormatError(
            f"sample {key} of {shard} is damaged: {error}; run texvent dataset verify"
        ) from error


def read_events(shard: Path, sample: SampleRecord) -> EventStream:
    """The events of a sample, checked, with all that is known of them as metadata.

    Args:
        shard: the tar.
        sample: its record.

    Raises:
        FileFormatError: as `read_columns`.
    """
    size = SensorSize(sample.width, sample.height)
    events = read_columns(shard, sample.key, sample.members, size)
    return events.with_metadata(read_sample_facts(shard, sample))


def read_sample_facts(shard: Path, sample: SampleRecord) -> dict[str, Any]:
    """All that is known of a sample: its .json.

    Raises:
        FileFormatError: the shard is cut off or changed.
    """
    content = read_members(shard, sample.members, ("json",)).get("json", b"")
    return sample_facts(content, f"sample {sample.key} of {shard}")


def sample_facts(content: bytes, where: str) -> dict[str, Any]:
    """The facts in a .json of a sample; `where` is its name in messages.

    Raises:
        FileFormatError: it is damaged.
    """
    try:
        facts = read_json(content)
    except (ValueError, RecursionError) as error:
        raise FileFormatError(f"{where} is damaged ({one_line(error)})") from error
    if not isinstance(facts, dict):
        raise FileFormatError(f"{where} is damaged: its facts are no table")
    return facts


def sample_truth(shard: Path, key: str, places: Mapping[str, tuple[int, int]]) -> ClipTruth:
    """Ground truth of a sample, read when it is asked for; arguments as `read_columns`."""

    def read_file(name: str) -> bytes:
        return read_part(shard, *places[name])

    return ClipTruth(read_file, f"sample {key} of {shard}")
