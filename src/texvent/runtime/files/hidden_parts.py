"""Hidden parts: files and folders that are being written, locked while their process lives.

A part is `.texvent-HOST-PROCESS-….part…`, seen by every process of a machine. What a killed process
leaves behind is removed by the next one that writes into the folder.
"""

from __future__ import annotations

import contextlib
import os
import platform
import re
import secrets
import shutil
import struct
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from texvent.runtime.work.interrupts import clean_ups

PREFIX = ".texvent-"
HOST = re.sub(r"[^A-Za-z0-9]", "", platform.node())[:32]
CAN_SWEEP = os.name == "posix"
"""Windows has no harmless way to ask whether a process lives."""
DEAD_SECONDS = 7 * 86_400
"""Parts of other machines that were not written to for so long are left behind."""
_swept: set[str] = set()
"""Folders that this process has swept."""
_own: set[Path] = set()
"""Parts of this process."""


@contextmanager
def hidden_file(folder: Path, suffix: str) -> Iterator[Path]:
    """An empty hidden file in `folder`; it is removed at the end of the block if it is still there.

    Raises:
        OSError: the folder refuses it.
    """
    sweep(folder)
    part = _new_part(folder, f".part{suffix}")
    try:
        with locked(os.open(part, os.O_CREAT | os.O_EXCL | os.O_RDWR, 0o666)):
            yield part
    finally:
        with contextlib.suppress(PermissionError):  # still open, on Windows
            part.unlink(missing_ok=True)
        _own.discard(part)


@contextmanager
def hidden_folder(folder: Path, suffix: str = ".part") -> Iterator[Path]:
    """An empty hidden folder in `folder`; the end of the block removes it if it is still there.

    Raises:
        OSError: the folder refuses it.
    """
    sweep(folder)
    part = _new_part(folder, suffix)
    try:
        part.mkdir()
        with locked(os.open(part, os.O_RDONLY)) if CAN_SWEEP else contextlib.nullcontext():
            yield part
    finally:
        shutil.rmtree(part, ignore_errors=True)
        _own.discard(part)


def _new_part(folder: Path, suffix: str) -> Path:
    part = folder / f"{PREFIX}{HOST}-{os.getpid()}-{secrets.token_hex(6)}{suffix}"
    _own.add(part)  # before it exists: a signal may come at any moment
    return part


@contextmanager
def temporary_folder() -> Iterator[Path]:
    """A folder that only this user can read; the next run removes it if this one is killed."""
    with hidden_folder(Path(tempfile.gettempdir())) as folder:
        folder.chmod(0o700)
        yield folder


def is_hidden_part(path: Path) -> bool:
    """True if a path has the name of a part: `.texvent-….part.h5`, `.texvent-….old`."""
    return path.name.startswith(PREFIX) and (".part" in path.name or path.suffix == ".old")


def remove_own_parts() -> None:
    """Remove parts that a signal left at the very moment when they came or went.

    For a process that is about to end: the file it was writing is dropped.
    """
    for part in list(_own):
        if f"-{os.getpid()}-" in part.name:  # a forked process knows those of its parent
            with contextlib.suppress(OSError):
                _remove(part)
        _own.discard(part)


clean_ups.append(remove_own_parts)


def sweep(folder: Path) -> None:
    """Remove this user's parts of dead processes from a folder, once per process and folder.

    An output folder that was being replaced when its process died gets its name back. Those of
    other users stay: in a folder for temporary files they could become links meanwhile.
    """
    if not CAN_SWEEP or str(folder) in _swept:
        return
    _swept.add(str(folder))
    with contextlib.suppress(OSError):
        for part in filter(is_hidden_part, folder.iterdir()):
            with contextlib.suppress(OSError):
                is_own = not part.is_symlink() and part.lstat().st_uid == os.geteuid()
                if is_own and _is_dead(part) and not is_locked(part):
                    _remove(part)


def _is_dead(part: Path) -> bool:
    """True if the process that a part is named after lives no longer."""
    named = re.match(rf"{re.escape(PREFIX)}(\w*)-(\d+)-", part.name)
    if named is None or named[1] != HOST:
        return time.time() - part.stat().st_mtime > DEAD_SECONDS
    try:
        os.kill(int(named[2]), 0)
    except ProcessLookupError:
        return True
    except (PermissionError, OverflowError):
        return False
    return _is_zombie(named[2])


def _is_zombie(pid: str) -> bool:
    """True if a process has ended and waits for its parent, as in containers without an init."""
    with contextlib.suppress(OSError):
        state = Path("/proc", pid, "stat").read_bytes().rpartition(b") ")[2]
        return state.startswith(b"Z")
    return False


def _remove(part: Path) -> None:
    if not part.is_dir():
        part.unlink()
        return
    if part.suffix == ".old":
        for replaced in part.iterdir():
            # A replaced folder gets its name back where nothing has taken it.
            if not (part.parent / replaced.name).exists():
                replaced.rename(part.parent / replaced.name)
    shutil.rmtree(part)


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
