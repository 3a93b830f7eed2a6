"""Every event format."""

from __future__ import annotations

import shutil
from functools import partial
from pathlib import Path

import texvent
from texvent.io.files import codec_that_reads, open_events

from ..io.format_cases import CASE_OF
from ..io.test_corpus import CORPUS
from .reader import Reader, digest


def event_readers() -> list[Reader]:
    """One per codec."""
    return [
        Reader(f"events {name}", partial(_make, name), partial(_read, name))
        for name in texvent.formats()
    ]


def _make(name: str, folder: Path) -> Path:
    """The committed file, which needs no package to be written."""
    shutil.copytree(CORPUS / name, folder, dirs_exist_ok=True)
    return folder / CASE_OF[name].file


def _read(name: str, path: Path) -> str:
    codec_that_reads(path)
    size = None if name in ("hdf5", "npz", "aedat4") else CASE_OF[name].sensor
    events = open_events(path, format=name, size=size).collect()
    return digest((events.x, events.y, events.t, events.p))
