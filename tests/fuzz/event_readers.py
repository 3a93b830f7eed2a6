"""Every event format, and layouts that former versions wrote."""

import shutil
from functools import partial
from pathlib import Path

import texvent
from texvent.io.files import codec_that_reads, open_events

from ..io.format_cases import ALL_CASES
from ..io.test_corpus import CORPUS, OTHER_LAYOUTS
from .reader import Reader, digest

CASES = {case.name: case for case in (*ALL_CASES, *OTHER_LAYOUTS)}


def event_readers() -> list[Reader]:
    """One per kind of file."""
    return [Reader(f"events {name}", partial(_make, name), partial(_read, name)) for name in CASES]


def _make(name: str, folder: Path) -> Path:
    """The committed file, which needs no package to be written."""
    shutil.copytree(CORPUS / name, folder, dirs_exist_ok=True)
    return folder / CASES[name].file


def _read(name: str, path: Path) -> str:
    codec_that_reads(path)
    size = None if name in ("hdf5", "npz", "aedat4") else CASES[name].sensor
    format = name if name in texvent.formats() else None
    events = open_events(path, format=format, size=size).collect()
    return digest((events.x, events.y, events.t, events.p))
