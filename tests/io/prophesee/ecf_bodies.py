"""Bodies of ECF chunks of every legal kind, made by plain loops from the described layout."""

import itertools
import struct
from collections.abc import Sequence

Event = tuple[int, int, int, int]
"""x, y, t, p."""


def make_chunk(events: Sequence[Event], kind: str) -> bytes:
    """A chunk whose body is of a kind: "packed", "pairs" or "masked"."""
    x, y, t, p = zip(*events, strict=True)
    flags = {"packed": 0b10, "pairs": 0b01, "masked": 0b00}[kind]
    head = struct.pack("<IQ", len(events) << 2 | flags, t[0])
    if kind == "packed":
        return head + _times(t) + _packed(x, y, p)
    if kind == "pairs":
        return head + _times(t) + _rows(y) + _pairs(x, p)
    return head + _times(t) + _rows(y) + _masked(x) + _polarities(p)


def _runs(values: Sequence[int]) -> list[tuple[int, int]]:
    return [(value, len(list(group))) for value, group in itertools.groupby(values)]


def _times(times: Sequence[int]) -> bytes:
    body = b""
    now = times[0]
    for time, count in _runs(times):
        step = time - now
        now = time
        if step >= 15:
            while step:
                body += bytes([0xF0 | step & 15])
                step >>= 4
        body += bytes([step << 4 | min(count, 15)])
        body += struct.pack("<H", count) if count >= 15 else b""
    return body


def _rows(rows: Sequence[int]) -> bytes:
    return b"".join(
        struct.pack("<H", y << 5 | count) if count < 31 else struct.pack("<HH", y << 5 | 31, count)
        for y, count in _runs(rows)
    )


def _polarities(signs: Sequence[int]) -> bytes:
    return b"".join(
        bytes([p << 7 | count]) if count < 127 else struct.pack("<BH", p << 7 | 127, count)
        for p, count in _runs(signs)
    )


def _masked(columns: Sequence[int]) -> bytes:
    body = b""
    i = 0
    while i < len(columns):
        base, word = columns[i], columns[i] << 5
        i += 1
        for step in range(1, 6):
            if i < len(columns) and columns[i] == base + step:
                word |= 1 << (5 - step)
                i += 1
        body += struct.pack("<H", word)
    return body


def _pairs(columns: Sequence[int], signs: Sequence[int]) -> bytes:
    values = [x << 1 | p for x, p in zip(columns, signs, strict=True)]
    values += [0] * (-len(values) % 4)
    return b"".join(
        struct.pack("<3H", a << 4 | b & 15, (b >> 4) << 8 | c & 255, (c >> 8) << 12 | d)
        for a, b, c, d in zip(*[iter(values)] * 4, strict=True)
    )


def _packed(columns: Sequence[int], rows: Sequence[int], signs: Sequence[int]) -> bytes:
    values = [y << 12 | x << 1 | p for x, y, p in zip(columns, rows, signs, strict=True)]
    values += [0] * (-len(values) % 4)
    return b"".join(
        struct.pack("<3I", a << 8 | b & 255, (b >> 8) << 16 | c & 65535, (c >> 16) << 24 | d)
        for a, b, c, d in zip(*[iter(values)] * 4, strict=True)
    )
