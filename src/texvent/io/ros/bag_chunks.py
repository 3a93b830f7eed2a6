"""Compressed chunks of a ROS 1 bag, unpacked up to a bound: a few bytes can hold gigabytes."""

from __future__ import annotations

import bz2
from collections.abc import Callable
from functools import partial
from typing import Any

import lz4.frame

from texvent.errors import FileFormatError

MAX_CHUNK_BYTES = 256 * 2**20
"""ROS writes chunks of less than a megabyte."""


def bound_chunks(bag: Any) -> None:
    """Let rosbags' reader of an open ROS 1 bag unpack no chunk beyond `MAX_CHUNK_BYTES`."""
    bounded = {bz2.decompress: bz2.BZ2Decompressor, lz4.frame.decompress: _lz4_decompressor}
    for position, chunk in bag.chunks.items():
        make = bounded.get(chunk.decompressor)
        if make is not None:
            bag.chunks[position] = chunk._replace(decompressor=partial(_unpack, make))


def _lz4_decompressor() -> Any:
    return lz4.frame.LZ4FrameDecompressor()


def _unpack(make: Callable[[], Any], data: bytes) -> bytes:
    decompressor = make()
    unpacked: bytes = decompressor.decompress(data, max_length=MAX_CHUNK_BYTES)
    if not decompressor.eof:
        raise FileFormatError(
            f"a chunk ends early or unpacks to more than {MAX_CHUNK_BYTES} bytes; the bag is "
            "damaged, or made to fill the memory"
        )
    return unpacked
