"""Every event format."""

from __future__ import annotations

import shutil
from functools import partial
from pathlib import Path

import texvent
from texvent.io.files import codec_that_reads, extension_of, open_events, save
from texvent.sensor import SensorSize

from ..io.format_cases import CASE_OF, METADATA, random_events
from ..io.test_corpus import CORPUS
from .reader import Reader, digest

DEFAULT_SIZE = SensorSize(64, 48)
EVENTS = 300


def event_readers() -> list[Reader]:
    """One per codec."""
    return [
        Reader(f"events {name}", partial(_make, name), partial(_read, name))
        for name in texvent.formats()
    ]


def _sensor(name: str) -> SensorSize:
    return CASE_OF[name].sensor if name in CASE_OF else DEFAULT_SIZE


def _make(name: str, folder: Path) -> Path:
    """The committed file, which needs no package to be written, or a new one."""
    if name in CASE_OF:
        shutil.copytree(CORPUS / name, folder, dirs_exist_ok=True)
        return folder / CASE_OF[name].file
    path = folder / f"e{extension_of(name)}"
    events = random_events(EVENTS, DEFAULT_SIZE).with_metadata(METADATA)
    return save(path, events, format=name)


def _read(name: str, path: Path) -> str:
    codec_that_reads(path)
    size = None if name in ("hdf5", "npz", "aedat4") else _sensor(name)
    events = open_events(path, format=name, size=size).collect()
    return digest((events.x, events.y, events.t, events.p))
