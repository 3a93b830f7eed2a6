"""Clocks of limited width go on where they turn, in every format that has one."""

import struct

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray

from texvent.errors import FileFormatError, TexventWarning
from texvent.io.clocks import TurningClock
from texvent.io.files import load


@given(
    bits=st.sampled_from([23, 31, 32]),
    before=st.integers(1, 2**19),
    steps=st.lists(st.integers(-50, 2**18), min_size=1, max_size=60),
    cut=st.integers(0, 60),
)
def test_times_go_on_through_turns_whatever_the_blocks(bits, before, steps, cut):
    times = 2 * (1 << bits) + (np.cumsum([0, *steps]) - before) * (1 << bits - 23)
    # Before the first turn, a time that rises far is only later.
    assume((times >> bits).min() == times[0] >> bits)
    stored = times % (1 << bits)
    clock = TurningClock(bits)
    found = np.concatenate([clock.unroll(stored[:cut]), clock.unroll(stored[cut:])])
    assert (np.diff(found) == np.diff(times)).all()
    assert found[0] == stored[0]


def aedat2(times: NDArray[np.int64]) -> tuple[str, bytes]:
    records = np.zeros((len(times), 2), ">u4")
    records[:, 0], records[:, 1] = 5 << 8, times
    return "e.aedat", b"#!AER-DAT2.0\r\n# AEChip: DVS128\r\n" + records.tobytes()


def aedat1(times: NDArray[np.int64]) -> tuple[str, bytes]:
    records = np.zeros(len(times), [("place", ">u2"), ("t", ">u4")])
    records["place"], records["t"] = 5 << 8, times
    return "e.aedat", b"#!AER-DAT1.0\r\n# AEChip: DVS128\r\n" + records.tobytes()


def dat(times: NDArray[np.int64]) -> tuple[str, bytes]:
    records = np.full((len(times), 2), 5, "<u4")
    records[:, 0] = times
    return "e.dat", b"% Height 128\n% Version 2\n% Width 128\n\x0c\x08" + records.tobytes()


def aedat3(times: NDArray[np.int64]) -> tuple[str, bytes]:
    """By a program that does not count the turns."""
    head = struct.pack("<2h6i", 1, 1, 8, 4, 0, len(times), len(times), len(times))
    events = b"".join(struct.pack("<2I", 5 << 17 | 5 << 2 | 1, t) for t in times.tolist())
    return "e.aedat", b"#!AER-DAT3.1\r\n#Size: 128x128\r\n#!END-HEADER\r\n" + head + events


def atis(times: NDArray[np.int64]) -> tuple[str, bytes]:
    rows = [bytes([5, 5]) + int(t).to_bytes(3, "big") for t in times]
    return "e.bin", b"".join(rows)


@pytest.mark.parametrize(
    ("write", "bits"),
    [
        *((aedat2, 32), (aedat2, 31), (aedat1, 32), (aedat3, 31)),
        *((dat, 32), (dat, 31), (atis, 23)),
    ],
)
def test_no_repair_is_needed_where_a_clock_turns(tmp_path, write, bits):
    times = (1 << bits) - 500_000 + 1000 * np.arange(1000)
    name, content = write(times % (1 << bits))
    (tmp_path / name).write_bytes(content)
    assert load(tmp_path / name, size=(128, 128)).t.tolist() == times.tolist()


def atis_overflows(times: NDArray[np.int64]) -> tuple[str, bytes]:
    """Each event after a mark of its own, which stands for 8192 µs."""
    rows = [bytes([0, 240, 0, 0, 0, 5, 5]) + int(t).to_bytes(3, "big") for t in times % 2**13]
    return "e.bin", b"".join(rows)


@pytest.mark.parametrize(
    ("write", "bits"),
    [(aedat2, 32), (aedat1, 32), (aedat3, 31), (dat, 32), (atis, 23), (atis_overflows, 23)],
)
@pytest.mark.parametrize("block_bytes", [20, 60, 1000])
def test_blocks_of_any_size_are_read_alike(tmp_path, monkeypatch, write, bits, block_bytes):
    """Also where the clock turns."""
    name, content = write(((1 << bits) - 200_000 + 10_000 * np.arange(100)) % (1 << bits))
    (tmp_path / name).write_bytes(content)
    whole = load(tmp_path / name, size=(128, 128))
    monkeypatch.setattr("texvent.io.byte_blocks.BLOCK_BYTES", block_bytes)
    assert load(tmp_path / name, size=(128, 128)).equals(whole)
    assert np.ptp(whole.t) == 990_000 or write is atis_overflows
    assert len(whole) == 100


@pytest.mark.parametrize(
    ("write", "bits"), [(aedat2, 32), (aedat1, 31), (aedat3, 31), (dat, 32), (dat, 31), (atis, 23)]
)
@pytest.mark.parametrize(("start", "wrong"), [(0, 1 - 1 / 64), (1 - 1 / 8, 1 / 64)])
def test_a_lone_wrong_time_is_no_turn(tmp_path, write, bits, start, wrong):
    times = int(start * 2**bits) + 1000 * np.arange(1000)
    stored = times.copy()
    stored[500] = wrong * 2**bits
    name, content = write(stored)
    (tmp_path / name).write_bytes(content)
    with pytest.raises(FileFormatError, match="time decreases"):
        load(tmp_path / name, size=(128, 128))
    with pytest.warns(TexventWarning, match="stray times: 1"):
        found = load(tmp_path / name, size=(128, 128), repair=True)
    assert found.t.tolist() == np.delete(times, 500).tolist()


def test_a_fall_that_is_no_turn_is_a_reset(tmp_path):
    after = 10**6 + 1000 * np.arange(500)
    name, content = dat(np.concatenate([3 * 10**9 + after, after]))
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(FileFormatError, match=r"time decreases after event 499 \(3001499000"):
        load(path)
    with pytest.warns(UserWarning, match="clock resets: 1"):
        assert len(load(path, repair=True)) == 1000
