"""Every event format, of the committed files; single arrays and bags of ROS 2 beside them."""

from __future__ import annotations

import shutil
from functools import partial
from pathlib import Path

import numpy as np

import texvent
from texvent.io.files import codec_that_reads, open_events

from ..io.format_cases import ALL_CASES
from ..io.ros.test_bags import EVENT_ARRAY, array_message, types_of, write_bag
from ..io.test_corpus import CORPUS, OTHER_LAYOUTS
from ..io.test_other_layouts import RECORDS, SIZE
from .reader import Reader, digest

CASES = {case.name: case for case in (*ALL_CASES, *OTHER_LAYOUTS)}


def event_readers() -> list[Reader]:
    """One per kind of file."""
    return [
        *(Reader(f"events {name}", partial(_make, name), partial(_read, name)) for name in CASES),
        Reader("events npy", _make_array, partial(_read, "npy")),
        Reader("events rosbag2", _make_bag, partial(_read, "rosbag2")),
    ]


def _make(name: str, folder: Path) -> Path:
    """The committed file, which needs no package to be written."""
    shutil.copytree(CORPUS / name, folder, dirs_exist_ok=True)
    return folder / CASES[name].file


def _make_array(folder: Path) -> Path:
    np.save(folder / "e.npy", RECORDS)
    return folder / "e.npy"


def _make_bag(folder: Path) -> Path:
    """A folder with an SQLite file."""
    message = array_message(types_of(2), EVENT_ARRAY, 2, 3)
    return write_bag(folder / "bag", 2, {"/e": (EVENT_ARRAY, [message])})


def _read(name: str, path: Path) -> str:
    codec_that_reads(path)
    given = CASES[name].sensor if name in CASES else SIZE
    size = None if name in ("hdf5", "npz", "aedat4") else given  # which state it
    format = name if name in texvent.formats() else None
    events = open_events(path, format=format, size=size).collect()
    return digest((events.x, events.y, events.t, events.p))
