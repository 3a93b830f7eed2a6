"""Memory stays flat, however long a file is."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import pytest

from texvent.io import block_codec, block_writer
from texvent.io.files import load, open_events, save

from .prophesee_files import EXTENSIONS, FORMATS, row_bursts


@pytest.mark.parametrize("format", FORMATS)
def test_memory_does_not_grow_with_the_file(
    tmp_path: Path, format: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    events = row_bursts(20_000)
    whole = sum(column.nbytes for column in events.columns().values())
    monkeypatch.setattr(block_codec, "BLOCK_BYTES", 2**14)
    monkeypatch.setattr(block_writer, "BLOCK_EVENTS", 2**12)
    path = save(tmp_path / f"warm{EXTENSIONS[format]}", row_bursts(10), format=format)
    assert len(load(path))
    tracemalloc.start()
    path = save(tmp_path / f"e{EXTENSIONS[format]}", events, format=format)
    written = tracemalloc.get_traced_memory()[1]
    tracemalloc.reset_peak()
    assert sum(len(packet) for packet in open_events(path)) == len(events)
    read = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert max(written, read) < whole / 3
