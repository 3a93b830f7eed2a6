"""A file that remembers the first failed write instead of raising it.

HDF5 cannot be told that the disk is full: it keeps retrying what it holds when the file is
closed, prints pages of errors and then crashes the process. Behind this file it never learns;
the writer asks for `failure` after each batch and throws the file away.
"""

from __future__ import annotations

import io
import os
from pathlib import Path
from typing import TYPE_CHECKING

from texvent.io.positioned import FLAGS, read_at, write_at

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer, WriteableBuffer


class DeferredErrorFile(io.RawIOBase):
    """Reads and writes an existing file at a position; writes never fail.

    After a failure nothing more is written, and parts that are missing read as zeros.
    """

    def __init__(self, path: Path) -> None:
        super().__init__()
        self._descriptor = os.open(path, os.O_RDWR | FLAGS)
        self._position = 0
        self._size = os.fstat(self._descriptor).st_size
        self.failure: OSError | None = None
        """The first write that failed, if any."""

    def raise_failure(self) -> None:
        """Raise what went wrong so far.

        Raises:
            OSError: a write failed.
        """
        if self.failure is not None:
            raise self.failure

    def readable(self) -> bool:
        """True."""
        return True

    def writable(self) -> bool:
        """True."""
        return True

    def seekable(self) -> bool:
        """True."""
        return True

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        """Move to an offset from the start, the current position or the end."""
        start = {os.SEEK_SET: 0, os.SEEK_CUR: self._position, os.SEEK_END: self._size}[whence]
        self._position = start + offset
        return self._position

    def tell(self) -> int:
        """The current position."""
        return self._position

    def readinto(self, buffer: WriteableBuffer) -> int:
        """Fill the buffer from the current position."""
        view = memoryview(buffer).cast("B")
        wanted = max(0, min(len(view), self._size - self._position))
        content = read_at(self._descriptor, wanted, self._position)
        view[:wanted] = content.ljust(wanted, b"\0")
        self._position += wanted
        return wanted

    def write(self, buffer: ReadableBuffer) -> int:
        """Write all bytes at the current position; a failure is remembered, not raised."""
        view = memoryview(buffer).cast("B")
        written = 0
        try:
            while self.failure is None and written < len(view):
                written += write_at(self._descriptor, view[written:], self._position + written)
        except OSError as error:
            self.failure = error
        self._position += len(view)
        self._size = max(self._size, self._position)
        return len(view)

    def truncate(self, size: int | None = None) -> int:
        """Set the file's length, by default to the current position."""
        self._size = self._position if size is None else size
        try:
            if self.failure is None:
                os.ftruncate(self._descriptor, self._size)
        except OSError as error:
            self.failure = error
        return self._size

    def close(self) -> None:
        """Close the file; a second time does nothing."""
        if not self.closed:
            os.close(self._descriptor)
        super().close()
