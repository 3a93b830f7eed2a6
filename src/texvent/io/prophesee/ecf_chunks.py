"""ECF, the event compression of Prophesee HDF5 files (HDF5 filter 0x8ECF): one chunk of events.

    u32   number of events n (at most 65535) << 2 | f1 << 1 | f0
    u64   time of the first event, µs
    times     runs of equal times; a byte is the step from the time before << 4 | number of events.
              Number 15: the number follows in 16 bits. Step 15: no run, but four bits of a longer
              step, lowest first, that the next run adds to its own.
    f1 = 1    24 bits per event, y << 12 | x << 1 | p, in groups of four; three words of 32 bits:
              a << 8 | b & 0xff · (b >> 8) << 16 | c & 0xffff · (c >> 16) << 24 | d
    f1 = 0    rows: words y << 5 | number of events, 31: the number follows in 16 bits; then
      f0 = 1      12 bits per event, x << 1 | p, in groups of four; three words of 16 bits:
                  a << 4 | b & 0xf · (b >> 4) << 8 | c & 0xff · (c >> 8) << 12 | d
      f0 = 0      columns: words x << 5 | mask; bit 4 − j: another event at x + j + 1; then
                  polarities: bytes p << 7 | number of events, 127: the number follows in 16 bits

All little-endian. texvent writes f1 = 1, whose size does not depend on the scene (3 bytes per
event and the times), and reads all. Steps are positive: a time that decreases cannot be stored.

Source: Prophesee, `hdf5_ecf` (the reference filter), from which the layout was learned.
"""

from __future__ import annotations

import struct

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.events import COLUMN_TYPES
from texvent.io.protocol import Columns

MAX_EVENTS = 65_535
MAX_SIDE = 2048
"""Coordinates have 11 bits."""
MAX_START_US = 1 << 62
"""Of the times of a chunk; see `texvent.io.prophesee.ecf_coding`."""
_HEAD = struct.Struct("<IQ")
_STEP_BYTES = 20
"""Most that one event adds to the times: a step of 16 nibbles, its run, a long number."""


def encode_chunk(columns: Columns) -> bytes:
    """One chunk from columns x, y, t, p of 1 to `MAX_EVENTS` events with non-decreasing times."""
    from texvent.io.prophesee import ecf_coding  # brings Numba

    x, y, t, p = (columns[name] for name in "xytp")
    body = np.empty(_STEP_BYTES * len(t) + 3 * (len(t) + 3), dtype=np.uint8)
    end = ecf_coding.encode_times(t, body)
    end += ecf_coding.encode_packed((x, y, p), body[end:])
    return _HEAD.pack(len(t) << 2 | 0b10, int(t[0])) + body[:end].tobytes()


def decode_chunk(chunk: bytes) -> Columns:
    """Columns x, y, t, p of a chunk.

    Raises:
        FileFormatError: the chunk is damaged.
    """
    if len(chunk) < _HEAD.size:
        raise FileFormatError(f"an ECF chunk has {len(chunk)} bytes; at least {_HEAD.size}")
    head, origin = _HEAD.unpack_from(chunk)
    count = head >> 2
    if count > MAX_EVENTS or origin >= MAX_START_US:
        raise FileFormatError(
            f"an ECF chunk claims {count} events from {origin} µs on; at most {MAX_EVENTS}"
        )
    columns = {name: np.empty(count, dtype=COLUMN_TYPES[name]) for name in "xytp"}
    body = np.frombuffer(chunk, dtype=np.uint8, offset=_HEAD.size)
    _decode_body(body, origin, head & 0b11, columns)
    return columns


def _decode_body(body: NDArray[np.uint8], origin: int, flags: int, columns: Columns) -> None:
    from texvent.io.prophesee import ecf_coding  # brings Numba

    x, y, t, p = (columns[name] for name in "xytp")
    rest = _skip(body, ecf_coding.decode_times(body, origin, t))
    if flags & 0b10:
        _skip(rest, ecf_coding.decode_packed(rest, (x, y, p)))
        return
    rest = _skip(rest, ecf_coding.decode_rows(rest, y))
    if flags & 0b01:
        _skip(rest, ecf_coding.decode_pairs(rest, (x, p)))
        return
    rest = _skip(rest, ecf_coding.decode_masked(rest, x))
    _skip(rest, ecf_coding.decode_polarities(rest, p))


def _skip(body: NDArray[np.uint8], used: int) -> NDArray[np.uint8]:
    if used < 0:
        raise FileFormatError("an ECF chunk is damaged: its events do not add up")
    return body[used:]
