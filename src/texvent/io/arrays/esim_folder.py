"""ESIM's folders: `0000000000.npz`, `0000000001.npz` …, arrays x, y, t (ns), p (-1 or +1).

ESIM's folders have no sensor size, so it is asked for, unless a file `texvent.json` states it.
Times that are no whole µs are rounded down.

Trap: tools that expect µs read these times 1000 times too long.

Source: Gehrig et al., Video to Events, CVPR 2020 (rpg_vid2e), and its files.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent.errors import FileFormatError
from texvent.io.arrays.npz import read_arrays
from texvent.io.block_codec import BlockReader, FileContents
from texvent.io.metadata import parse_sidecar
from texvent.io.protocol import Columns

FACTS = "texvent.json"
NS = 1000
"""Nanoseconds per µs."""


class EsimFolderCodec(BlockReader):
    """Folders of numbered npz files."""

    name: ClassVar[str] = "esim"
    has_checksums: ClassVar[bool] = True
    is_folder: ClassVar[bool] = True

    def recognises(self, path: Path) -> bool:
        """True if it is a folder of npz files with ten-digit names, or of none but texvent's."""
        return path.is_dir() and bool(_numbered(path) or _is_empty_recording(path))

    def inspect(self, path: Path) -> FileContents:
        """Size and metadata are in a file of texvent's own."""
        facts = path / FACTS
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
    return [one.name for one in path.iterdir()] == [FACTS]


def _read_blocks(path: Path) -> Iterator[Columns]:
    for file in _numbered(path):
        arrays = read_arrays(file)
        missing = [name for name in "xytp" if name not in arrays]
        if missing:
            raise FileFormatError(f"{file} has no array {missing[0]!r}")
        t = arrays["t"]
        if t.dtype.kind not in "iu":
            raise FileFormatError(f"{file}: t holds {t.dtype}; ESIM writes whole nanoseconds")
        yield {**{name: arrays[name] for name in "xyp"}, "t": t.astype(np.int64) // NS}
