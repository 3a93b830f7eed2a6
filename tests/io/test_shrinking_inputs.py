"""A file that becomes shorter while it is read is refused: no bus error, no shorter recording."""

from __future__ import annotations

import os
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError
from texvent.io.arrays import folders
from texvent.io.arrays.npy_file import StoredArray
from texvent.io.files import open_events, save

from .format_cases import CASE_OF, random_events
from .read_only_formats import write_evreal

SHORTER = "became shorter while it was read"


def test_an_array_of_frames(tmp_path: Path) -> None:
    path = tmp_path / "frames.npy"
    np.save(path, np.zeros((20, 64, 64), np.uint8))
    frames = iter(open_frames(path, CaptureConfig(fps=Fraction(25))))
    next(frames)
    os.truncate(path, 64 * 64 * 4)
    with pytest.raises(FileFormatError, match=SHORTER):
        list(frames)


def test_the_events_of_an_evreal_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(folders, "PACKET_EVENTS", 1000)
    path = write_evreal(tmp_path / "e", random_events(20_000, CASE_OF["evreal"].sensor))
    packets = iter(open_events(path))
    next(packets)
    os.truncate(path / "events_xy.npy", 4000)
    with pytest.raises(FileFormatError, match=SHORTER):
        list(packets)


def test_an_aedat4_file_of_many_packets(tmp_path: Path) -> None:
    events = random_events(50_000, CASE_OF["aedat4"].sensor, span_us=5_000_000)
    path = save(tmp_path / "e.aedat4", events)
    packets = iter(open_events(path))
    next(packets)
    os.truncate(path, path.stat().st_size // 2)
    with pytest.raises(FileFormatError, match=SHORTER):
        list(packets)


def test_an_array_stored_by_columns_gives_its_rows(tmp_path: Path) -> None:
    values = np.arange(24).reshape(4, 6)
    np.save(tmp_path / "a.npy", np.asfortranarray(values))
    assert (StoredArray(tmp_path / "a.npy").rows(1, 3) == values[1:3]).all()
