"""How AEDAT4 packets are compressed: not at all, LZ4 frames, or Zstandard frames.

Zstandard is in Python's library from 3.14 on; before, the extra `zstd` brings the same module.
A packet that unpacks to more than 256 MiB is refused: it is damaged, or made to fill the memory.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType
from typing import Any

from texvent._require import require
from texvent.errors import FileFormatError, MissingDependencyError, one_line

MAX_PACKET_BYTES = 256 * 2**20
"""16 million events, or a frame of 80 megapixels."""


@dataclass(frozen=True)
class Packing:
    """One way to compress."""

    name: str
    """As the file's XML says it."""
    code: int
    """As the file's header says it."""
    pack: Callable[[bytes], bytes]
    unpack: Callable[[bytes], bytes]


def packing_of(code: int) -> Packing:
    """The packing that a file's header names.

    Raises:
        FileFormatError: no packing has this number.
        MissingDependencyError: Zstandard is needed and not installed.
    """
    if code == 0:
        return NONE
    if code in (1, 2):
        return LZ4
    if code in (3, 4):
        _zstd()
        return ZSTD
    raise FileFormatError(f"its header names compression {code}; AEDAT4 knows 0 to 4")


def _keep(data: bytes) -> bytes:
    return data


def _pack_lz4(data: bytes) -> bytes:
    packed: bytes = _lz4().compress(data, content_checksum=True)
    return packed


def _unpack_lz4(data: bytes) -> bytes:
    lz4 = _lz4()
    return _unpack(lz4.LZ4FrameDecompressor(), data, RuntimeError, "LZ4")


def _pack_zstd(data: bytes) -> bytes:
    zstd = _zstd()
    options = {zstd.CompressionParameter.checksum_flag: 1}
    packed: bytes = zstd.compress(data, options=options)
    return packed


def _unpack_zstd(data: bytes) -> bytes:
    zstd = _zstd()
    return _unpack(zstd.ZstdDecompressor(), data, zstd.ZstdError, "Zstandard")


def _unpack(decompressor: Any, data: bytes, failure: type[Exception], name: str) -> bytes:
    # In steps: with one large limit, LZ4 sets the whole of it aside for every packet.
    step = max(65_536, 4 * len(data))
    parts: list[bytes] = []
    total = 0
    try:
        while not decompressor.eof and total < MAX_PACKET_BYTES:
            part = decompressor.decompress(b"" if parts else data, max_length=step)
            if parts and not part:
                break
            parts.append(part)
            total += len(part)
    except (failure, EOFError, MemoryError) as error:
        raise FileFormatError(f"a packet is damaged ({name}: {one_line(error)})") from error
    if not decompressor.eof:
        what = "is cut off"
        if total >= MAX_PACKET_BYTES:
            what = f"unpacks to more than {MAX_PACKET_BYTES // 2**20} MiB"
        raise FileFormatError(f"a packet {what} ({name})")
    return parts[0] if len(parts) == 1 else b"".join(parts)


def _lz4() -> ModuleType:
    return require("lz4.frame")


def _zstd() -> ModuleType:
    try:
        return require("compression.zstd")
    except MissingDependencyError:
        return require("backports.zstd", extra="zstd")


NONE = Packing("NONE", 0, _keep, _keep)
LZ4 = Packing("LZ4", 1, _pack_lz4, _unpack_lz4)
ZSTD = Packing("ZSTD", 3, _pack_zstd, _unpack_zstd)
