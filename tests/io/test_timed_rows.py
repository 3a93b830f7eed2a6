"""Formats that find a time: any part is that of the whole, and what lies outside is not read."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import FileFormatError
from texvent.event_packets import SeekablePackets
from texvent.events import EventStream
from texvent.io.block_codec import TimedRows, read_between
from texvent.io.files import open_events
from texvent.sensor import SensorSize

from .read_only_formats import write_ecf, write_evreal

SIZE = SensorSize(64, 48)
FORMATS = {"hdf5": "a.h5", "dsec": "b.h5", "prophesee-hdf5": "d.hdf5", "evreal": "e"}
COUNT = 60_000


WRITERS = {"prophesee-hdf5": write_ecf, "evreal": write_evreal}


def write(name: str, path: Path, events: EventStream) -> None:
    if name in WRITERS:
        WRITERS[name](path, events)
    else:
        events.save(path, format=name)


def recording(count: int) -> EventStream:
    """Events of which many share a µs, with a pause."""
    rng = np.random.default_rng(0)
    t = np.cumsum(rng.integers(0, 3, count)) + 5000
    t[count // 2 :] += 1_000_000
    x, y, p = (rng.integers(0, end, count) for end in (*SIZE, 2))
    return EventStream(x, y, t, p, SIZE)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("timed")
    for name, path in FORMATS.items():
        write(name, folder / path, recording(COUNT))
    return folder


@pytest.mark.long
@pytest.mark.parametrize("name", FORMATS)
@given(data=st.data())
def test_any_part_of_a_file_is_that_of_the_recording(folder, name, data):
    whole, opened = recording(COUNT), open_events(folder / FORMATS[name], format=name)
    assert isinstance(opened.packets, SeekablePackets)
    assert opened.time_range == whole.time_range
    around = st.one_of(
        st.integers(4990, 5200),
        st.sampled_from(whole.t[::997].tolist()),
        st.integers(0, int(whole.t[-1]) + 20),
    )
    start, stop = sorted((data.draw(around), data.draw(around)))
    assert opened.cut(start, stop).collect().equals(whole.cut(start, stop))


@pytest.mark.parametrize("unit", [1, 7, 64])
def test_bisection_reads_few_events(unit):
    times = np.sort(np.random.default_rng(1).integers(0, 5000, 1000))
    asked: list[int] = []

    def time_of(index: int) -> int:
        asked.append(index)
        return int(times[index])

    rows = TimedRows(1000, time_of, lambda start, stop: {}, 64, unit)
    for t_us in (0, 1, 2500, 4999, 9999):
        asked.clear()
        assert rows.find(t_us) == np.searchsorted(times[::unit], t_us)
        assert len(asked) <= 11
        assert all(index % unit == 0 for index in asked)


def write_times(path: Path, times: list[int]) -> Path:
    recording(len(times)).save(path)
    with h5py.File(path, "r+") as file:
        file["events/t"][:] = times
    return path


@pytest.mark.parametrize("is_first_least", [False, True])
def test_bisection_of_a_file_out_of_order_is_refused(tmp_path, is_first_least):
    times = np.random.default_rng(3).integers(0, 400_000, 2000)
    times[[0, -1]] = (0, 400_000) if is_first_least else (400_000, 0)
    opened = open_events(write_times(tmp_path / "a.h5", times.tolist()))
    with pytest.raises(FileFormatError, match="time decreases from"):
        opened.between(100_000, 200_000).collect()
    with pytest.raises(FileFormatError, match="time decreases from"):
        opened.cut(100_000, 200_000).collect()
    if not is_first_least:
        with pytest.raises(FileFormatError, match="time decreases from 400000 to 0 µs"):
            _ = opened.time_range


def test_times_that_decrease_inside_a_part_or_between_its_blocks_are_refused(tmp_path):
    for times, block in (([10, 20, 50, 40, 60, 70], 6), ([10, 20, 50, 40, 60, 70], 3)):

        @contextmanager
        def opened(times: list[int] = times, block: int = block) -> Iterator[TimedRows]:
            stored = np.array(times)
            yield TimedRows(6, times.__getitem__, lambda a, b: {"t": stored[a:b]}, block)

        with pytest.raises(FileFormatError, match="time decreases from 50 to 40 µs"):
            [*read_between(tmp_path / "a.h5", opened, 15, 65)]


PEAK = """
import resource, sys
import texvent
from texvent.io.files import open_events

def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

def read():
    for line in open("/proc/self/io"):
        if line.startswith("rchar"):
            return int(line.split()[1])

path, name, start, stop = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
open_events(path, format=name).cut(0, 1).collect()  # imports, compiled kernels
before, memory = read(), peak()
part = open_events(path, format=name).between(start, stop).collect()
print(len(part), read() - before, peak() - memory)
"""


@pytest.mark.skipif(not Path("/proc/self/io").exists(), reason="bytes read are counted by Linux")
@pytest.mark.parametrize("name", ["hdf5", "evreal"])
def test_a_short_part_of_a_long_file_is_all_that_is_read(tmp_path, name):
    whole = recording(2_000_000)
    path = tmp_path / FORMATS[name]
    write(name, path, whole)
    files = path.rglob("*") if path.is_dir() else [path]
    stored = sum(file.stat().st_size for file in files)
    start = int(whole.t[1_900_000])
    words = [path, name, start, start + 1000]
    done = subprocess.run(
        [sys.executable, "-c", PEAK, *map(str, words)], capture_output=True, text=True, check=True
    )
    events, read, memory_kb = map(int, done.stdout.split())
    assert events == len(whole.cut(start, start + 1000)) > 500
    assert read < stored / 5
    assert memory_kb * 1024 < 13 * len(whole) / 2
