"""Locks of files and folders that are being written, seen by every process of a machine."""

from __future__ import annotations

import os
import struct
from pathlib import Path

LOCK = struct.Struct("hhqqi")
"""Linux' struct flock: type, whence, start, length, process."""
LOCKED_BYTE = 2**62


def hold_lock(descriptor: int) -> int | None:
    """Hold a lock on a part: a process elsewhere may see no process of its number.

    It is one of an open file, far behind its end, so that libraries may lock the part too.

    Returns:
        The descriptor; None where the system or the file system knows no such locks.
    """
    try:
        _ask_lock(descriptor, "F_OFD_SETLK", "F_RDLCK")
    except (ImportError, AttributeError, OSError):
        os.close(descriptor)
        return None
    return descriptor


def release(descriptor: int | None) -> None:
    """End a lock."""
    if descriptor is not None:
        os.close(descriptor)


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
