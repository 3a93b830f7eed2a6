"""EVREAL's folders of arrays.

    events_ts.npy  f8 [n], seconds   events_xy.npy  u2 [n, 2]   events_p.npy  bool [n]
    metadata.json  {"sensor_resolution": [height, width], "texvent": all metadata}

Seconds in f8 keep every µs for 71 years, so times stay below 2^51 µs. Images and their times
(images.npy, images_ts.npy, image_event_indices.npy), which the format may hold too, are not read
here.

Source: Ercan et al., EVREAL: Towards a Comprehensive Benchmark and Analysis Suite for
Event-based Video Reconstruction, CVPRW 2023, and its reader.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown
from texvent.io.arrays.npy_file import StoredArray
from texvent.io.block_codec import BlockReader, FileContents, TimedRows, read_rows, seek_rows
from texvent.io.metadata import metadata_from_json
from texvent.io.protocol import Columns

TIMES, PLACES, POLARITIES = "events_ts.npy", "events_xy.npy", "events_p.npy"
FACTS = "metadata.json"
STOP_US = 1 << 51
MICROSECONDS = 1_000_000
PACKET_EVENTS = 2**18


class EvrealFolderCodec(BlockReader):
    """Folders that EVREAL reads."""

    name: ClassVar[str] = "evreal"
    is_folder: ClassVar[bool] = True

    def recognises(self, path: Path) -> bool:
        """True if it is a folder with the three arrays."""
        return all((path / name).is_file() for name in (TIMES, PLACES, POLARITIES))

    def inspect(self, path: Path) -> FileContents:
        """Size and metadata are in metadata.json."""
        _open_arrays(path)
        size, metadata = _read_facts(path)
        rows = partial(_open_rows, path)
        return FileContents(size, metadata, partial(read_rows, rows), seek_rows(path, rows))


def _read_facts(path: Path) -> tuple[tuple[int, int] | None, dict[str, Any]]:
    facts = path / FACTS
    if not facts.is_file():
        return None, {}
    values = metadata_from_json(facts, facts.read_bytes())
    metadata = values.get("texvent")
    sides = values.get("sensor_resolution")
    stored = None
    if sides is not None:
        if not (isinstance(sides, list) and len(sides) == 2 and all(map(_is_whole, sides))):
            raise FileFormatError(f"{facts} states a sensor_resolution of {shown(sides)}")
        stored = sides[1], sides[0]
    return stored, metadata if isinstance(metadata, dict) else {}


def _is_whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _open_arrays(path: Path) -> tuple[StoredArray, StoredArray, StoredArray]:
    """Times [n] or [n, 1], places [n, 2] and polarities like the times."""
    missing = [name for name in (TIMES, PLACES, POLARITIES) if not (path / name).is_file()]
    if missing:
        raise FileFormatError(f"{path} has no {missing[0]}; EVREAL's folders have one")
    times = StoredArray(path / TIMES)
    places, polarities = StoredArray(path / PLACES), StoredArray(path / POLARITIES)
    count = times.shape[0] if times.ndim else -1
    columns = ((count,), (count, 1))
    if places.shape != (count, 2) or {times.shape, polarities.shape} - {*columns}:
        shapes = f"{shown(times.shape)}, {shown(places.shape)}, {shown(polarities.shape)}"
        raise FileFormatError(
            f"{path}: its arrays have shapes {shapes}; they must be [n], [n, 2] and [n]"
        )
    if times.dtype.kind not in "fiu" or places.dtype.kind not in "fiu":
        kinds = f"{shown(times.dtype)} and {shown(places.dtype)}"
        raise FileFormatError(f"{path}: its arrays hold {kinds}")
    if polarities.dtype.kind not in "biuf":
        raise FileFormatError(f"{path}: its polarities are {shown(polarities.dtype)}")
    return times, places, polarities


@contextmanager
def _open_rows(path: Path) -> Iterator[TimedRows]:
    times, places, polarities = _open_arrays(path)

    def microseconds(start: int, stop: int) -> NDArray[np.int64]:
        seconds = np.asarray(times.rows(start, stop).reshape(-1), dtype=np.float64)
        if not (np.abs(seconds) < STOP_US / MICROSECONDS).all():
            raise FileFormatError(f"{path / TIMES} holds times that are not seconds")
        return np.rint(seconds * MICROSECONDS).astype(np.int64)

    def read(start: int, stop: int) -> Columns:
        xy = _whole(places.rows(start, stop), path / PLACES)
        return {
            "x": xy[:, 0],
            "y": xy[:, 1],
            "t": microseconds(start, stop),
            "p": _whole(polarities.rows(start, stop).reshape(-1), path / POLARITIES),
        }

    yield TimedRows(
        len(times), lambda index: int(microseconds(index, index + 1)[0]), read, PACKET_EVENTS
    )


def _whole(values: NDArray[Any], path: Path) -> NDArray[np.int64]:
    """Integers, of any type they are stored as."""
    if values.dtype.kind == "f" and not (np.abs(values) < 2**31).all():
        raise FileFormatError(f"{path} holds values that are no pixels or polarities")
    whole = np.asarray(values).astype(np.int64)
    if (whole != values).any():
        raise FileFormatError(f"{path} holds fractions; texvent reads whole pixels and polarities")
    return whole
