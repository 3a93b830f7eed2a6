"""Read a descriptor at an offset, also on Windows, which has no `pread`."""

from __future__ import annotations

import os
import threading

FLAGS = getattr(os, "O_BINARY", 0)
"""To open with: without it Windows changes line ends."""
_moving = threading.Lock()
"""Held while a descriptor's one position is moved and used. Only where no process forks."""


def read_at(descriptor: int, size: int, offset: int) -> bytes:
    """At most `size` bytes from `offset` on; any number of threads may share a descriptor.

    Raises:
        OSError: the system refuses it.
    """
    if hasattr(os, "pread"):
        return os.pread(descriptor, size, offset)
    with _moving:
        os.lseek(descriptor, offset, os.SEEK_SET)
        return os.read(descriptor, size)
