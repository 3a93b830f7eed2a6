"""Folders of arrays: EVREAL's and ESIM's.

EVREAL:

    events_ts.npy  f8 [n], seconds   events_xy.npy  u2 [n, 2]   events_p.npy  bool [n]
    metadata.json  {"sensor_resolution": [height, width], "texvent": all metadata}

Seconds in f8 keep every µs for 71 years, so times stay below 2^51 µs. Images and their times
(images.npy, images_ts.npy, image_event_indices.npy), which the format may hold too, are not read
here.

ESIM: `0000000000.npz`, `0000000001.npz` …, arrays x, y, t (ns), p (-1 or +1). These folders have no
sensor size, so it is asked for, unless a file `texvent.json` states it. Times that are no whole µs
are rounded down. Trap: tools that expect µs read these times 1000 times too long.

Source: Ercan et al., EVREAL: Towards a Comprehensive Benchmark and Analysis Suite for
Event-based Video Reconstruction, CVPRW 2023, and its reader; Gehrig et al., Video to Events, CVPR
2020 (rpg_vid2e), and its files.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

from texvent.errors import FileFormatError, shown
from texvent.io.arrays.npy_file import StoredArray
from texvent.io.arrays.npz import open_arrays
from texvent.io.block_codec import BlockReader, FileContents, already_open, contents_of_rows
from texvent.io.block_writer import Columns
from texvent.io.metadata import metadata_from_json, parse_sidecar
from texvent.io.reading import ReadOptions
from texvent.io.table_search import find_tables

EVREAL = ("events_xy", "events_ts", "events_p")
"""Names of its arrays."""
EVREAL_FACTS = "metadata.json"
PACKET_EVENTS = 2**18
ESIM_FACTS = "texvent.json"


class EvrealFolderCodec(BlockReader):
    """Folders that EVREAL reads."""

    name: ClassVar[str] = "evreal"
    is_folder: ClassVar[bool] = True

    def recognises(self, path: Path) -> bool:
        """True if it is a folder with the three arrays."""
        return all((path / f"{name}.npy").is_file() for name in EVREAL)

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Size and metadata are in metadata.json."""
        arrays = {name: StoredArray(path / f"{name}.npy") for name in EVREAL}
        table = replace(find_tables(path, arrays, options)[0], unit="s")
        table.check(path, arrays)
        size, metadata = _read_facts(path)
        rows = already_open(table.rows(path, arrays, options, block=PACKET_EVENTS))
        return contents_of_rows(size, metadata, rows)


def _read_facts(path: Path) -> tuple[tuple[int, int] | None, dict[str, Any]]:
    facts = path / EVREAL_FACTS
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


class EsimFolderCodec(BlockReader):
    """Folders of numbered npz files."""

    name: ClassVar[str] = "esim"
    has_checksums: ClassVar[bool] = True
    is_folder: ClassVar[bool] = True

    def recognises(self, path: Path) -> bool:
        """True if it is a folder of npz files with ten-digit names, or of none but texvent's."""
        return path.is_dir() and bool(_numbered(path) or _is_empty_recording(path))

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Size and metadata are in a file of texvent's own."""
        facts = path / ESIM_FACTS
        size: tuple[int, int] | None = None
        metadata: dict[str, Any] = {}
        if facts.is_file():
            size, metadata = parse_sidecar(facts, facts.read_bytes())
        elif not _numbered(path):
            raise FileFormatError(f"{path} holds no files 0000000000.npz, 0000000001.npz …")
        return FileContents(size, metadata, partial(_read_blocks, path))


def _numbered(path: Path) -> list[Path]:
    try:
        files = [one for one in path.iterdir() if re.fullmatch(r"\d{10}\.npz", one.name)]
    except OSError:
        return []
    return sorted(files)


def _is_empty_recording(path: Path) -> bool:
    return [one.name for one in path.iterdir()] == [ESIM_FACTS]


def _read_blocks(path: Path) -> Iterator[Columns]:
    for file in _numbered(path):
        arrays = open_arrays(file)
        if "t" in arrays and arrays["t"].dtype.kind not in "iu":
            raise FileFormatError(
                f"{file}: t is {arrays['t'].dtype}; ESIM writes whole nanoseconds"
            )
        table = replace(find_tables(file, arrays, ReadOptions())[0], unit="ns")
        table.check(file, arrays)
        rows = table.rows(file, arrays, ReadOptions(), block=PACKET_EVENTS)
        yield rows.read(0, rows.count)
