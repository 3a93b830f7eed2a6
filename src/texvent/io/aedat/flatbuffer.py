"""The part of FlatBuffers that AEDAT4 needs: reading tables with every offset checked.

AEDAT4 uses three fixed tables, so writing them takes one NumPy record each (`aedat4_tables`),
and reading them takes this file; hostile offsets end in `FileFormatError`, never elsewhere.

Source: FlatBuffers, "FlatBuffer Internals" (little-endian; offsets relative to themselves).
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass

from texvent.errors import FileFormatError

PREFIX_BYTES = 4
"""Size-prefixed buffers: u32 number of bytes that follow."""


@dataclass(frozen=True)
class Table:
    """A table inside a buffer.

    Raises:
        FileFormatError: in every method, an offset points outside the buffer.
    """

    data: bytes | memoryview
    position: int

    @classmethod
    def root(cls, data: bytes | memoryview, identifier: bytes) -> Table:
        """The root table of a size-prefixed buffer.

        Raises:
            FileFormatError: the buffer is cut off or of another type.
        """
        if len(data) < 3 * PREFIX_BYTES or bytes(data[8:12]) != identifier:
            raise FileFormatError(f"no {identifier.decode()} table where one must be")
        if _number("<I", data, 0) > len(data) - PREFIX_BYTES:
            raise FileFormatError(f"the {identifier.decode()} table is cut off")
        return cls(data, PREFIX_BYTES + _number("<I", data, PREFIX_BYTES))

    def field(self, slot: int) -> int | None:
        """Where a field is stored, or None if it has its default value."""
        vtable = self.position - _number("<i", self.data, self.position)
        entry = 4 + 2 * slot
        if entry + 2 > _number("<H", self.data, vtable):
            return None
        offset = _number("<H", self.data, vtable + entry)
        return self.position + offset if offset else None

    def number(self, slot: int, form: str, default: int) -> int:
        """A number; `form` is its struct format, such as `<q`."""
        position = self.field(slot)
        return default if position is None else _number(form, self.data, position)

    def text(self, slot: int) -> bytes:
        """A string, empty if it is left out."""
        start, count = self.vector(slot)
        if start + count > len(self.data):
            raise FileFormatError("a text reaches past the end of its table")
        return bytes(self.data[start : start + count])

    def vector(self, slot: int) -> tuple[int, int]:
        """First byte and number of elements of a vector; their bytes are not checked."""
        position = self.field(slot)
        if position is None:
            return 0, 0
        vector = position + _number("<I", self.data, position)
        return vector + 4, _number("<I", self.data, vector)

    def tables(self, slot: int) -> Iterator[Table]:
        """The tables of a vector of tables."""
        start, count = self.vector(slot)
        if start + 4 * count > len(self.data):
            raise FileFormatError("a list reaches past the end of its table")
        for index in range(count):
            entry = start + 4 * index
            yield Table(self.data, entry + _number("<I", self.data, entry))


def _number(form: str, data: bytes | memoryview, position: int) -> int:
    # struct counts negative positions from the end.
    if position < 0:
        raise FileFormatError(f"an offset points {-position} bytes before its table")
    try:
        value: int = struct.unpack_from(form, data, position)[0]
    except struct.error as error:
        raise FileFormatError("an offset points past the end of its table") from error
    return value
