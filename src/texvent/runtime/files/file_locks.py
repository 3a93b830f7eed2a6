"""Locks of files and folders that are being written, seen by every process of a machine."""

from __future__ import annotations

import os
import struct
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

LOCK = struct.Struct("hhqqi")
"""Linux' struct flock: type, whence, start, length, process."""
LOCKED_BYTE = 2**62


@contextmanager
def locked(descriptor: int) -> Iterator[None]:
    """Lock an open part while the block runs; close it at once where no such locks are known.

    A process elsewhere may see no process of the part's number. The lock is far behind the end, so
    that libraries may lock the part too.
    """
    with ExitStack() as stack:
        stack.callback(os.close, descriptor)
        try:
            _ask_lock(descriptor, "F_OFD_SETLK", "F_RDLCK")
        except (ImportError, AttributeError, OSError):
            stack.close()
        yield


def is_locked(part: Path) -> bool:
    """True if a process writes a part, wherever it runs."""
    import fcntl

    descriptor = os.open(part, os.O_RDONLY | os.O_NONBLOCK)
    try:
        return _ask_lock(descriptor, "F_OFD_GETLK", "F_WRLCK") != fcntl.F_UNLCK
    except (AttributeError, OSError):
        return False
    finally:
        os.close(descriptor)


def _ask_lock(descriptor: int, command: str, kind: str) -> int:
    """Kind of the lock that fcntl answers with."""
    import fcntl

    lock = LOCK.pack(getattr(fcntl, kind), os.SEEK_SET, LOCKED_BYTE, 1, 0)
    return int(LOCK.unpack(fcntl.fcntl(descriptor, getattr(fcntl, command), lock))[0])
