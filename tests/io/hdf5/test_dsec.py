import errno
import json
import os
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.errors import FileFormatError, InputError, MissingDependencyError, OutputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io import block_writer
from texvent.io.files import load, open_events, save
from texvent.io.hdf5 import dsec
from texvent.io.hdf5.event_utils import save_with_frames
from texvent.io.hdf5.storage import DeferredErrorFile
from texvent.sensor import SensorSize

from ..format_cases import random_events

SIZE = SensorSize(6, 5)


def at_times(*times: int) -> EventStream:
    zeros = [0] * len(times)
    return EventStream.from_columns(zeros, zeros, list(times), zeros, size=SIZE)


def index_by_definition(times: np.ndarray, length: int) -> list[int]:
    """First index with t >= 1000 m, or the number of events."""
    return [
        next((index for index, t in enumerate(times) if t >= 1000 * m), len(times))
        for m in range(length)
    ]


@pytest.mark.parametrize("count", [0, 150_000])
def test_plain_h5py_finds_the_universal_layout(tmp_path, count):
    stream = random_events(count, SIZE)
    path = save(tmp_path / "events.h5", stream)
    with h5py.File(path, "r") as file:
        for name, dtype in {"x": "<u2", "y": "<u2", "t": "<i8", "p": "|u1"}.items():
            column = file[f"events/{name}"]
            assert column.dtype == np.dtype(dtype)
            assert (column.compression, column.shuffle) == ("gzip", True)
            np.testing.assert_array_equal(column[()], getattr(stream, name))
        assert file["t_offset"][()] == 0
        assert file["t_offset"].dtype == np.int64
        assert file["ms_to_idx"].dtype == np.uint64
        assert (file.attrs["width"], file.attrs["height"]) == tuple(stream.size)
        assert file.attrs["timestamp_scale_ms"] == 0.001


@examples(30)
@given(times=st.lists(st.integers(0, 12_000), max_size=25))
def test_ms_to_idx_follows_its_definition(tmp_path_factory, times):
    events = at_times(*sorted(times))
    path = save(tmp_path_factory.mktemp("index") / "events.h5", events)
    with h5py.File(path, "r") as file:
        index = file["ms_to_idx"][()].tolist()
    assert index == index_by_definition(events.t, len(index))
    # Closing entry: also the first ms after the last event can be looked up.
    assert len(index) == (int(events.t[-1]) // 1000 + 2 if times else 1)
    assert index[-1] == len(events)


def test_ms_to_idx_spans_silence_and_batches(tmp_path, monkeypatch):
    monkeypatch.setattr(dsec, "CHUNK_EVENTS", 4)
    monkeypatch.setattr(block_writer, "BLOCK_EVENTS", 8)
    monkeypatch.setattr(dsec, "INDEX_BATCH", 3)
    times = [0, 1, 999, 1000, 1000, 1001, 30_000, 30_000, 30_500, 31_000, 90_001]
    parts = [at_times(time) for time in times]
    path = save(tmp_path / "events.h5", EventPackets(parts, SIZE))
    assert load(path).t.tolist() == times
    with h5py.File(path, "r") as file:
        index = file["ms_to_idx"][()].tolist()
    assert index == index_by_definition(np.array(times), 92)


def test_provenance_is_whole_as_json_and_readable_by_name(tmp_path):
    metadata = {"prompt": "a cat 🐈", "seed": 0, "deep": {"a": [1, 2]}, "width": 999, "none": None}
    path = save(tmp_path / "events.h5", EventStream.empty(SIZE, metadata))
    with h5py.File(path, "r") as file:
        stored = json.loads(file.attrs["texvent"])
        assert (file.attrs["prompt"], file.attrs["seed"]) == ("a cat 🐈", 0)
        assert file.attrs["width"] == SIZE.width, "layout attributes are not overwritten"
        assert "deep" not in file.attrs
    assert stored == {"prompt": "a cat 🐈", "seed": 0, "deep": {"a": [1, 2]}, "width": 999}


def test_metadata_longer_than_an_attribute_may_be_is_kept(tmp_path):
    metadata = {"prompt": "long " * 40_000, **{f"name {i}": "v" * 2000 for i in range(80)}}
    path = save(tmp_path / "events.h5", EventStream.empty(SIZE, metadata))
    assert load(path).metadata == metadata


def test_text_that_hdf5_cannot_hold_is_kept_in_the_json(tmp_path):
    metadata = {"prompt": "nul \0 inside", "lone": "\ud800", "big": 2**80}
    path = save(tmp_path / "events.h5", EventStream.empty(SIZE, metadata))
    assert load(path).metadata == metadata


def test_a_size_that_contradicts_the_file_is_refused(tmp_path):
    path = save(tmp_path / "events.h5", at_times(1))
    with pytest.raises(InputError, match="was recorded at 6x5, not 7x5"):
        load(path, size=(7, 5))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda file: file.__delitem__("events/p"), "holds no events by names"),
        (lambda file: file["events/x"].resize((1,)), "differ in length"),
        (lambda file: file.attrs.__setitem__("timestamp_scale_ms", 2.0), "units of"),
        (lambda file: file.attrs.__setitem__("width", 0), "impossible"),
        (lambda file: file.attrs.__setitem__("width", 2), "x runs from 0 to 3"),
        (lambda file: file["events/t"].__setitem__(0, 10**9), "time decreases"),
        (lambda file: file.attrs.__setitem__("texvent", "{"), "damaged metadata"),
    ],
)
def test_a_wrong_layout_is_one_clear_line(tmp_path, change, message):
    events = EventStream.from_columns([0, 3], [0, 0], [5, 9], [1, 0], size=SIZE)
    path = save(tmp_path / "events.h5", events)
    with h5py.File(path, "r+") as file:
        change(file)
    with pytest.raises(FileFormatError, match=message) as caught:
        load(path)
    assert "\n" not in str(caught.value)


def test_order_is_checked_between_packets_too(tmp_path, monkeypatch):
    path = save(tmp_path / "events.h5", at_times(10, 11, 12, 13))
    with h5py.File(path, "r+") as file:
        file["events/t"][:] = [10, 11, 5, 6]
    monkeypatch.setattr(dsec, "PACKET_EVENTS", 2)
    with pytest.raises(FileFormatError, match="time decreases from 11 to 5 µs"):
        load(path)


def test_reading_packets_holds_one_packet(tmp_path, monkeypatch):
    path = save(tmp_path / "events.h5", at_times(*range(10)))
    monkeypatch.setattr(dsec, "PACKET_EVENTS", 4)
    assert [len(packet) for packet in open_events(path)] == [4, 4, 2]


def test_clock_times_are_stored_relative_to_t_offset(tmp_path):
    start_us = 1_790_000_000_123_456
    events = at_times(start_us, start_us + 5)
    path = save(tmp_path / "events.h5", events)
    assert load(path).equals(events)
    with h5py.File(path, "r") as file:
        assert file["t_offset"][()] == start_us // 1000 * 1000
        assert file["ms_to_idx"][()].tolist() == [0, 2]


def test_times_that_the_index_cannot_hold_are_refused(tmp_path):
    with pytest.raises(InputError, match=r"holds up to 38\.2 h"):
        save(tmp_path / "events.h5", at_times(0, 2**40))
    with pytest.raises(InputError, match="start at 0 or later"):
        save(tmp_path / "events.h5", at_times(-1, 0))
    assert not list(tmp_path.iterdir())


def test_labelled_and_unlabelled_packets_do_not_mix(tmp_path):
    labelled = EventStream(*(np.zeros(1, int),) * 4, SIZE, {}, np.ones(1, np.uint8))
    with pytest.raises(InputError, match="give all or none one"):
        save(tmp_path / "events.h5", EventPackets([labelled, at_times(3)], SIZE))


def test_a_foreign_filter_names_the_package_to_install(tmp_path, monkeypatch):
    path = save(tmp_path / "events.h5", at_times(1, 2))
    monkeypatch.setattr(h5py.h5z, "filter_avail", lambda code: False)
    monkeypatch.setitem(sys.modules, "hdf5plugin", None)
    with pytest.raises(MissingDependencyError, match=r"pip install .texvent\[blosc\]"):
        load(path)


def test_a_disk_that_fills_up_while_writing_leaves_nothing(tmp_path, monkeypatch):
    room = 3000
    really_write = os.write

    def write_until_full(descriptor: int, content: bytes) -> int:
        if os.lseek(descriptor, 0, os.SEEK_CUR) + len(content) > room:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return really_write(descriptor, content)

    monkeypatch.setattr(os, "write", write_until_full)
    with pytest.raises(OutputError, match="the disk is full") as caught:
        save(tmp_path / "events.h5", at_times(*range(5000)))
    assert "\n" not in str(caught.value)
    assert not list(tmp_path.iterdir())


def test_a_failed_write_is_remembered_and_ends_writing(tmp_path, monkeypatch):
    def refuse(*_: object) -> int:
        raise OSError(errno.ENOSPC, "full")

    path = tmp_path / "file.bin"
    path.touch()
    with DeferredErrorFile(path) as file:
        file.write(b"ab")
        monkeypatch.setattr(os, "write", refuse)
        assert file.write(b"cd") == 2
        monkeypatch.undo()
        assert file.write(b"ef") == 2
        file.truncate()
        file.seek(0)
        found = bytearray(6)
        assert file.readinto(found) == 6
        assert found == b"ab\0\0\0\0"
        with pytest.raises(OSError, match="full"):
            file.raise_failure()
    assert path.read_bytes() == b"ab"


EVENTS = EventStream.from_columns(
    [3, 4, 5], [1, 2, 0], [70, 80, 2_000_000], [1, 0, 1], size=SensorSize(9, 3)
)


def test_events_and_frames_are_in_one_file(tmp_path: Path) -> None:
    path = tmp_path / "e.h5"
    colour = np.zeros((3, 9, 3), np.uint8)
    colour[..., 0] = 200
    images = [(75, np.full((3, 9), 7, np.uint8)), (80, colour)]
    assert save_with_frames(path, EventPackets([EVENTS], EVENTS.size), images) == 2
    with h5py.File(path) as file:
        assert file["events/ts"][()].tolist() == [70e-6, 80e-6, 2.0]
        assert file["events/ps"].dtype == bool
        facts = {
            name: file.attrs[name] for name in ("num_events", "num_pos", "num_neg", "num_imgs")
        }
        assert facts == {"num_events": 3, "num_pos": 2, "num_neg": 1, "num_imgs": 2}
        assert file.attrs["sensor_resolution"].tolist() == [3, 9]
        assert (file.attrs["t0"], file.attrs["tk"]) == (70e-6, 2.0)
        first, second = file["images/image000000000"], file["images/image000000001"]
        assert (first.attrs["timestamp"], first.attrs["event_idx"]) == (75e-6, 1)
        assert second.attrs["event_idx"] == 1, "an event at the time of the frame comes after it"
        assert second[0, 0].tolist() == [0, 0, 200], "BGR"
    assert load(path).equals(EVENTS)


def test_a_frame_of_another_sensor_leaves_no_file(tmp_path: Path) -> None:
    images = [(75, np.zeros((4, 9), np.uint8))]
    with pytest.raises(InputError, match="frame 0 is 9x4, the events are 9x3"):
        save_with_frames(tmp_path / "e.h5", EventPackets([EVENTS], EVENTS.size), images)
    assert not list(tmp_path.iterdir())
