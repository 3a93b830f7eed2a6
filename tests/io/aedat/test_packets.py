"""Packets of AEDAT3.1 and AEDAT4 that are not as they seem."""

import bz2
import operator
import struct
import tracemalloc
from collections.abc import Callable

import lz4.frame
import numpy as np
import pytest

from texvent.errors import FileFormatError, TexventWarning
from texvent.events import EventStream
from texvent.io.aedat import aedat4_container
from texvent.io.aedat.aedat4_container import (
    LZ4_CODE,
    LZ4_NAME,
    MAGIC,
    PACKET_HEAD,
    load_zstd,
    pack_lz4,
    unpack_bz2,
    unpack_lz4,
    unpack_zstd,
)
from texvent.io.aedat.aedat4_tables import (
    UNKNOWN,
    Table,
    make_events,
    make_header,
    make_info,
    read_events,
)
from texvent.io.files import load, save
from texvent.io.reading import SeveralRecordingsError
from texvent.sensor import SensorSize

from ..format_cases import CASE_OF, STREAMS

SIZE = SensorSize(9, 7)


@pytest.mark.parametrize("turns", [(0, 0, 1, 1), (1, 0, 0, 0), (0, 3, 0, 0)])
def test_aedat3_counts_of_turns_where_the_time_goes_on_are_damage(tmp_path, turns):
    path = tmp_path / "e.aedat"
    packets = [
        struct.pack("<hhiiiiiiII", 1, 1, 8, 4, turn, 1, 1, 1, 1, 1000 * at)
        for at, turn in enumerate(turns)
    ]
    path.write_bytes(b"#!AER-DAT3.1\r\n#Size: 9x9\r\n#!END-HEADER\r\n" + b"".join(packets))
    with pytest.raises(FileFormatError, match="count of turns goes from"):
        load(path)
    with pytest.warns(TexventWarning, match="the times alone say the turns"):
        assert np.diff(load(path, repair=True).t).tolist() == [1000] * 3


def packet(count: int, *, is_same: bool = False) -> bytes:
    """A list of tables of a time (i8) and a type (i1) each, by hand; the type of every third is
    left out."""
    full, short = struct.pack("<4H", 8, 13, 4, 12), struct.pack("<3H", 6, 12, 4)
    head = struct.pack("<II4s3HHiII", 0, 16, b"TRIG", 6, 8, 4, 0, 8, 4, count)
    start = len(head) + 4 * count
    tables, offsets = full + short + bytes(2), b""
    for number in range(count):
        place = start + len(tables)
        vtable = start + (0 if number % 3 else len(full))
        at = start + 16 if is_same else place
        offsets += struct.pack("<I", at - len(head) - 4 * number)
        tables += struct.pack("<iqb3x", place - vtable, 1000 * number, number % 5)
    data = head + offsets + tables
    return struct.pack("<I", len(data) - 4) + data[4:]


@pytest.mark.parametrize("part", [2, 1 << 16])
def test_lists_of_tables_are_read_a_part_at_a_time(monkeypatch, part):
    monkeypatch.setattr("texvent.io.aedat.aedat4_tables.PART_TABLES", part)
    found = list(Table.root(packet(7), b"TRIG").columns(0, ["<i8", "<i1"]))
    assert np.concatenate([one[0] for one in found]).tolist() == [1000 * at for at in range(7)]
    assert np.concatenate([one[1] for one in found]).tolist() == [0, 1, 2, 0, 4, 0, 0]


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (packet(5, is_same=True), "the same table twice"),
        (packet(5)[:36] + bytes(200), "what is no table"),
    ],
)
def test_a_list_that_grows_from_nothing_is_refused(data, message):
    with pytest.raises(FileFormatError, match=message):
        list(Table.root(struct.pack("<I", len(data) - 4) + data[4:], b"TRIG").columns(0, ["<i8"]))


@pytest.mark.parametrize("name", STREAMS)
def test_the_list_at_the_end_says_of_each_packet_what_it_holds(tmp_path, name):
    """As a walk from packet to packet finds it: place, stream and length, events, times."""
    events = STREAMS[name](CASE_OF["aedat4"])
    data = save(tmp_path / "e.aedat4", events).read_bytes()
    at, (end,) = 18 + struct.unpack_from("<I", data, 14)[0], struct.unpack_from("<q", data, 46)
    walked = []
    while at < end:
        (head,) = struct.unpack_from("<q", data, at)
        stop = at + 8 + (head >> 32)
        times = read_events(unpack_lz4(data[at + 8 : stop]))["t"].tolist()
        walked.append((at + 8, head, len(times), times[0], times[-1]))
        at = stop
    listed = Table.root(unpack_lz4(data[end:]), b"FTAB").columns(0, 5 * ["<i8"])
    assert [row for part in listed for row in zip(*part, strict=True)] == walked
    assert (at, sum(row[2] for row in walked)) == (end, len(events))


@pytest.mark.parametrize("numbers", [(0, 1), (1, 0), (3, 1), (0, 7)])
def test_of_several_streams_a_number_means_the_one_that_has_it(tmp_path, numbers):
    recordings = [EventStream([n, 1], [n, 2], [5, 90 + n], [1, 0], SIZE) for n in (3, 4)]
    begin, _, end = make_info(SIZE, LZ4_NAME, "{}").decode().partition('<node name="0"')
    streams, _, end = end.rpartition("</node></dv>")
    nodes = [f'<node name="{n}"{streams}'.replace("Info/0/", f"Info/{n}/") for n in numbers]
    header = make_header(LZ4_CODE, UNKNOWN, f"{begin}{''.join(nodes)}</node></dv>".encode())
    packed = [pack_lz4(make_events(one.columns())) for one in recordings]
    packets = [PACKET_HEAD.pack(*one) for one in zip(numbers, map(len, packed), strict=True)]
    path = tmp_path / "e.aedat4"
    path.write_bytes(MAGIC + header + b"".join(map(operator.add, packets, packed)))
    with pytest.raises(SeveralRecordingsError, match="2 recordings"):
        load(path)
    for number, events in zip(numbers, recordings, strict=True):
        for name in (f"{number}", f"{number}:texvent"):
            assert load(path, stream=name).equals(events)


PACKINGS = {
    "LZ4": (lambda data: lz4.frame.compress(data, content_checksum=True), unpack_lz4),
    "Zstandard": (lambda data: load_zstd().compress(data), unpack_zstd),
    "bzip2": (bz2.compress, unpack_bz2),
}
"""Name → a program that packs, and what unpacks."""


@pytest.mark.parametrize("name", PACKINGS)
def test_packets_come_back_whole_or_are_refused_in_bounded_memory(name, monkeypatch):
    pack: Callable[[bytes], bytes]
    pack, unpack = PACKINGS[name]
    most = 2**20
    monkeypatch.setattr(aedat4_container, "MAX_PACKET_BYTES", most)
    noise = np.random.default_rng(0).bytes(most // 2)
    for data in (b"", b"x", bytes(most - 1), noise):
        assert unpack(pack(data)) == data
    with pytest.raises(FileFormatError, match=rf"is cut off \({name}\)"):
        unpack(pack(noise)[:-99])
    for size in (most + 1, 99 * most):
        packed = pack(bytes(size))
        tracemalloc.start()
        with pytest.raises(FileFormatError, match=rf"unpacks to more than 1 MiB \({name}\)"):
            unpack(packed)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < 4 * most
