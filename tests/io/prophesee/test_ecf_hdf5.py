from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from texvent.errors import FileFormatError, InputError
from texvent.events import EventStream
from texvent.io.files import codec_for, codec_that_reads, load, open_events, save
from texvent.io.prophesee import prophesee_ecf as ecf_hdf5

from ..read_only_formats import CHUNK_EVENTS, write_ecf
from ..read_only_formats import ECF_EVENT as EVENT
from .ecf_bodies import make_chunk
from .prophesee_files import SIZE, at_times, events_of, row_bursts


def make_foreign(path: Path, records: np.ndarray, **options: Any) -> Path:
    """A file with events of another program."""
    with h5py.File(path, "w") as file:
        file.create_dataset("CD/events", data=records, **options)
        file.attrs.create("geometry", "1280x720", dtype=h5py.string_dtype("ascii"))
    return path


def records_of(events: EventStream) -> np.ndarray:
    records = np.zeros(len(events), dtype=EVENT)
    for name in "xytp":
        records[name] = getattr(events, name)
    return records


def test_the_content_decides_which_hdf5_reader_opens_it(tmp_path):
    events = at_times(1, 2)
    for extension in (".h5", ".hdf5"):
        ours = save(tmp_path / f"universal{extension}", events)
        theirs = write_ecf(tmp_path / f"metavision{extension}", events)
        assert codec_that_reads(ours).name == codec_for(theirs).name == "hdf5"
        assert codec_that_reads(theirs).name == "prophesee-hdf5"
        assert load(ours).equals(events)
        assert load(theirs).equals(events)
    with pytest.raises(FileFormatError, match="has no dataset CD/events"):
        load(ours, format="prophesee-hdf5")


def test_a_chunk_the_filter_was_not_applied_to_is_read(tmp_path):
    events = row_bursts(50)
    path = write_ecf(tmp_path / "e.hdf5", EventStream.empty(SIZE))
    full = np.zeros(CHUNK_EVENTS, dtype=EVENT)
    full[: len(events)] = records_of(events)
    with h5py.File(path, "r+") as file:
        file["CD/events"].resize((len(events),))
        file["CD/events"].id.write_direct_chunk((0,), full.tobytes(), filter_mask=1)
    assert load(path).equals(events)


@pytest.mark.parametrize(
    "options",
    [{}, {"chunks": (100,)}, {"chunks": (100,), "compression": "gzip", "shuffle": True}],
    ids=["contiguous", "chunks", "gzip"],
)
def test_files_without_ecf_are_read(tmp_path, options):
    events = row_bursts(50)
    path = make_foreign(tmp_path / "e.hdf5", records_of(events), **options)
    back = load(path)
    assert back.equals(events)
    assert back.metadata == {"header": {"geometry": "1280x720"}}


def test_packets_end_with_whole_chunks_and_memory_stays_flat(tmp_path, monkeypatch):
    events = row_bursts(4000)
    path = write_ecf(tmp_path / "e.hdf5", events)
    monkeypatch.setattr(ecf_hdf5, "PACKET_CHUNKS", 1)
    packets = list(open_events(path))
    assert [len(packet) for packet in packets[:-1]] == [CHUNK_EVENTS] * (len(packets) - 1)
    assert EventStream.concat(packets).equals(events)


def test_an_absent_size_is_asked_for(tmp_path):
    path = make_foreign(tmp_path / "e.hdf5", records_of(at_times(1)))
    with h5py.File(path, "r+") as file:
        del file.attrs["geometry"]
    with pytest.raises(InputError, match="does not store the sensor size"):
        load(path)
    assert load(path, size=(1280, 720)).equals(at_times(1))


def damage(path: Path, change: str) -> None:
    events = at_times(1, 2, 3)
    with h5py.File(path, "r+") as file:
        dataset = file["CD/events"]
        if change == "claims more":
            dataset.resize((2**50,))
        elif change == "a chunk is missing":
            dataset.resize((CHUNK_EVENTS + 1,))
        elif change == "a short chunk":
            dataset.id.write_direct_chunk((0,), make_chunk(events_of(events)[:2], "packed"))
        elif change == "a huge chunk":
            dataset.id.write_direct_chunk((0,), bytes(64 * CHUNK_EVENTS + 5000))
        elif change == "no fields":
            del file["CD/events"]
            file["CD/events"] = np.zeros((3, 4))
        elif change == "large chunks":
            del file["CD/events"]
            file.create_dataset("CD/events", (3,), EVENT, chunks=(2**23,), maxshape=(None,))
        elif change == "a group":
            del file["CD/events"]
            file.create_group("CD/events")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("claims more", "claims 1125899906842624 values and stores at most 16384"),
        ("a chunk is missing", "claims 16385 values and stores at most 16384"),
        ("a short chunk", "holds 2 events instead of 3"),
        ("a huge chunk", "has 1053576 bytes; at most 1052672"),
        ("no fields", "must be a list of x, y, p, t"),
        ("large chunks", "chunks of 8388608 events; at most 4194304"),
        ("a group", "has no dataset CD/events"),
    ],
)
def test_a_damaged_file_is_one_clear_line(tmp_path, change, message):
    path = write_ecf(tmp_path / "e.hdf5", at_times(1, 2, 3))
    damage(path, change)
    with pytest.raises(FileFormatError, match=message) as caught:
        load(path, format="prophesee-hdf5")
    assert "\n" not in str(caught.value)


def test_time_that_decreases_between_packets_is_noticed(tmp_path, monkeypatch):
    monkeypatch.setattr(ecf_hdf5, "PACKET_CHUNKS", 1)
    path = write_ecf(tmp_path / "e.hdf5", at_times(*[100] * (CHUNK_EVENTS + 3)))
    with h5py.File(path, "r+") as file:
        early = make_chunk([(0, 0, 99, 0)] * 3, "packed")
        file["CD/events"].id.write_direct_chunk((CHUNK_EVENTS,), early)
    with pytest.raises(FileFormatError, match="time decreases from 100 to 99 µs"):
        load(path)
