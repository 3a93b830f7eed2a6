import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.errors import FileFormatError
from texvent.io.prophesee import prophesee_ecf as ecf_chunks

from .ecf_bodies import Event, make_chunk

KINDS = ("packed", "pairs", "masked")
events_lists = st.lists(
    st.tuples(
        st.one_of(st.integers(100, 108), st.integers(0, 2047)),
        st.one_of(st.just(5), st.integers(0, 2047)),
        st.one_of(st.integers(0, 20), st.integers(0, 2**40)),
        st.integers(0, 1),
    ),
    min_size=1,
    max_size=60,
).map(lambda rows: sorted(rows, key=lambda row: row[2]))


def events_in(chunk: bytes) -> list[Event]:
    columns = ecf_chunks.decode_chunk(chunk)
    return list(zip(*(columns[name].tolist() for name in "xytp"), strict=True))


def test_a_packed_chunk_worked_out_by_hand() -> None:
    # Two events at 1000 µs; one 3 µs later; one 300 = 0x12c µs after that (c, 2, 1: low first).
    chunk = (
        struct.pack("<IQ", 4 << 2 | 0b10, 1000)
        + bytes([0x02, 0x31, 0xFC, 0xF2, 0xF1, 0x01])
        + struct.pack("<3I", 0x123457_89, 0x3456_CDEF, 0x2D_2CF9FF)
    )
    words = (0x123457, 0x345689, 0x2DCDEF, 0x2CF9FF)
    times = (1000, 1000, 1003, 1303)
    assert events_in(chunk) == [
        (word >> 1 & 2047, word >> 12, time, word & 1)
        for word, time in zip(words, times, strict=True)
    ]


def test_a_masked_chunk_worked_out_by_hand() -> None:
    chunk = (
        struct.pack("<IQ", 4 << 2, 7)
        + bytes([0x04])
        + struct.pack("<HH", 9 << 5 | 3, 10 << 5 | 1)
        + struct.pack("<HH", 40 << 5 | 0b10001, 12 << 5)
        + bytes([0x82, 0x02])
    )
    assert events_in(chunk) == [(40, 9, 7, 1), (41, 9, 7, 1), (45, 9, 7, 0), (12, 10, 7, 0)]


def test_a_chunk_of_pairs_worked_out_by_hand() -> None:
    chunk = (
        struct.pack("<IQ", 2 << 2 | 0b01, 7)
        + bytes([0x02])
        + struct.pack("<H", 9 << 5 | 2)
        + struct.pack("<HHH", 0x1235, 0x4700, 0x0000)
    )
    assert events_in(chunk) == [(0x123 >> 1, 9, 7, 1), (0x475 >> 1, 9, 7, 1)]


@pytest.mark.parametrize("kind", KINDS)
@examples(60)
@given(events=events_lists)
def test_every_legal_body_is_read(kind: str, events: list[Event]) -> None:
    assert events_in(make_chunk(events, kind)) == events


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("count", [15, 31, 127, 16_384])
def test_runs_longer_than_their_nibbles_are_read(kind: str, count: int) -> None:
    events = [(8, 9, 5, 1)] * count + [(9, 10, 5 + 2**35, 0)]
    assert events_in(make_chunk(events, kind)) == events


def test_bits_beyond_the_last_event_are_ignored_as_in_the_reference_filter() -> None:
    chunk = bytearray(make_chunk([(8, 9, 5, 1)], "masked"))
    chunk[-3] |= 0b11111
    assert events_in(bytes(chunk)) == [(8, 9, 5, 1)]


def test_a_chunk_may_be_empty_and_have_a_padded_end() -> None:
    assert events_in(struct.pack("<IQ", 0b10, 0)) == []
    events = [(8, 9, 5, 1)]
    assert events_in(make_chunk(events, "packed") + bytes(100)) == events


@pytest.mark.parametrize("kind", KINDS)
def test_a_chunk_cut_anywhere_is_refused(kind: str) -> None:
    events = [(8, 9, 5, 1)] * 200 + [(9, 10, 500 + i, i % 2) for i in range(40)]
    chunk = make_chunk(events, kind)
    for length in range(len(chunk)):
        with pytest.raises(FileFormatError):
            ecf_chunks.decode_chunk(chunk[:length])


@pytest.mark.parametrize(
    "chunk",
    [
        struct.pack("<IQ", 65_536 << 2 | 0b10, 0),
        struct.pack("<IQ", 0xFFFF_FFFF, 0),
        struct.pack("<IQ", 1 << 2 | 0b10, 2**63) + bytes([0x01]) + bytes(12),
        struct.pack("<IQ", 1 << 2 | 0b10, 0) + bytes([0xFF] * 20) + bytes([0x01]) + bytes(12),
        struct.pack("<IQ", 1 << 2 | 0b10, 0) + bytes([0x02]) + bytes(12),
        struct.pack("<IQ", 1 << 2 | 0b10, 0) + bytes(1000),
    ],
    ids=["too many", "far too many", "late", "a step without end", "too long a run", "no run"],
)
def test_absurd_numbers_are_refused(chunk: bytes) -> None:
    with pytest.raises(FileFormatError):
        ecf_chunks.decode_chunk(chunk)
