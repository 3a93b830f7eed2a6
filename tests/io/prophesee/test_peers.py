"""Independent programs read what texvent writes, and texvent reads what they write.

`evt3` (Rust, MIT) knows EVT3; `eventcv` (Rust, Apache-2.0) knows EVT2, EVT3 and DAT, and writes
EVT2 and DAT. Both are in the extra `dev`, for the machines they are built for. No reader on the
registry that may be depended on knows EVT2.1 or ECF: `tests/io/prophesee/test_evt.py` and
`tests/io/prophesee/test_ecf_chunks.py` hold those to the published descriptions.
"""

from pathlib import Path

import pytest

from texvent.events import EventStream
from texvent.io.files import load, save

from ..format_cases import assert_same
from .prophesee_files import EXTENSIONS, LATE_STREAMS, STREAMS, row_bursts

streams = pytest.mark.parametrize("name", [*STREAMS, *LATE_STREAMS])
REASON = "has no wheel for this machine; CI on Linux x86_64 runs these tests"


def make(name: str) -> EventStream:
    return {**STREAMS, **LATE_STREAMS}[name]()


@streams
def test_evt3_reads_every_event_of_our_evt3(tmp_path: Path, name: str) -> None:
    evt3 = pytest.importorskip("evt3", reason=f"evt3 {REASON}")
    events = make(name)
    back = evt3.decode_file(str(save(tmp_path / "e.raw", events)))
    assert_same(events, back.x, back.y, back.t, back.p)
    assert back.sensor_size == tuple(events.size)


@streams
@pytest.mark.parametrize("format", ["evt3", "dat"])
def test_eventcv_reads_every_event_we_write(tmp_path: Path, name: str, format: str) -> None:
    eventcv = pytest.importorskip("eventcv", reason=f"eventcv {REASON}")
    if format == "dat" and name in LATE_STREAMS:
        name = "a late start"
    events = make(name)
    path = save(tmp_path / f"e{EXTENSIONS[format]}", events, format=format)
    back = eventcv.load(str(path))
    assert back.columns == ("x", "y", "t", "p")
    assert_same(events, *back.numpy().T)
    assert back.sensor_size == tuple(events.size)


@pytest.mark.parametrize("extension", [".npz", ".h5"])
def test_eventcv_reads_our_archives_and_universal_hdf5_too(tmp_path: Path, extension: str) -> None:
    eventcv = pytest.importorskip("eventcv", reason=f"eventcv {REASON}")
    events = row_bursts(50)
    back = eventcv.load(str(save(tmp_path / f"e{extension}", events)))
    assert_same(events, *back.numpy().T)
    assert back.sensor_size == tuple(events.size)


@pytest.mark.parametrize("format", ["evt2", "dat"])
def test_we_read_every_event_eventcv_writes(tmp_path: Path, format: str) -> None:
    eventcv = pytest.importorskip("eventcv", reason=f"eventcv {REASON}")
    events = row_bursts(500)
    ours = save(tmp_path / "ours.raw", events)
    theirs = tmp_path / f"theirs{EXTENSIONS[format]}"
    eventcv.load(str(ours)).save(str(theirs))
    assert load(theirs).equals(events)


def test_a_long_metadata_line_does_not_disturb_them(tmp_path: Path) -> None:
    evt3 = pytest.importorskip("evt3", reason=f"evt3 {REASON}")
    events = row_bursts(5).with_metadata({"prompt": "a car " * 30_000})
    assert len(evt3.decode_file(str(save(tmp_path / "e.raw", events)))) == len(events)
