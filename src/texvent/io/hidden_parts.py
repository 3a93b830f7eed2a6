"""Hidden files that hold an output until it is complete, and the sweep of those left behind.

A process holds a lock on each of its parts for as long as it lives, however it ends. A part
without a lock belongs to a process that was killed: the next run in that folder removes it.
Windows renames no file that is open, so parts have no locks there, and none is swept.
"""

from __future__ import annotations

import contextlib
import importlib.util
import os
import secrets
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

PREFIX = ".texvent-"
HAS_LOCKS = importlib.util.find_spec("fcntl") is not None
_swept: set[str] = set()
"""Folders that this process has swept."""
_own: set[Path] = set()
"""Parts of this process."""


@contextmanager
def hidden_file(folder: Path, suffix: str) -> Iterator[Path]:
    """An empty file in `folder`, locked; what is left of it when the block ends is removed.

    Args:
        folder: where it lies.
        suffix: how its name ends, with the dot.

    Raises:
        OSError: the folder refuses it.
    """
    sweep(folder)
    part, lock = _make_locked(folder, f".part{suffix}", _make_file)
    try:
        yield part
    finally:
        with contextlib.suppress(PermissionError):  # still open, on Windows
            part.unlink(missing_ok=True)
        _own.discard(part)
        _release(lock)


@contextmanager
def hidden_folder(folder: Path, suffix: str = ".part") -> Iterator[Path]:
    """An empty folder in `folder`, locked; what is left of it when the block ends is removed.

    Raises:
        OSError: the folder refuses it.
    """
    sweep(folder)
    part, lock = _make_locked(folder, suffix, Path.mkdir)
    try:
        yield part
    finally:
        shutil.rmtree(part, ignore_errors=True)
        _own.discard(part)
        _release(lock)


def remove_own_parts() -> None:
    """Remove parts that a signal left at the very moment when they came or went.

    For a process that is about to end: what it was writing is dropped.
    """
    for part in list(_own):
        with contextlib.suppress(OSError):
            _remove(part)
        _own.discard(part)


def sweep(folder: Path) -> None:
    """Remove parts of dead processes from a folder, once per process and folder.

    An output folder that was being replaced when its process died gets its name back.
    """
    if not HAS_LOCKS or str(folder) in _swept:
        return
    _swept.add(str(folder))
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if is_hidden_part(Path(entry.path)):
                with contextlib.suppress(OSError):
                    _remove_if_dead(Path(entry.path))


def is_hidden_part(path: Path) -> bool:
    """True if a path has the name of a part: `.texvent-….part.h5`, `.texvent-….old`."""
    return path.name.startswith(PREFIX) and (".part" in path.name or path.suffix == ".old")


def _remove_if_dead(part: Path) -> None:
    """Remove a part whose lock can be had; OSError if it cannot, or if there are no locks here."""
    descriptor = os.open(part, os.O_RDONLY | os.O_NOFOLLOW)
    try:
        _lock(descriptor)
        _remove(part)
    finally:
        os.close(descriptor)


def _remove(part: Path) -> None:
    if not part.is_dir():
        part.unlink()
        return
    if part.suffix == ".old":
        _put_back(part)
    shutil.rmtree(part)


def _put_back(old: Path) -> None:
    """Give a replaced folder its name back where nothing has taken it."""
    for replaced in old.iterdir():
        if not (old.parent / replaced.name).exists():
            replaced.rename(old.parent / replaced.name)


def _make_locked(
    folder: Path, suffix: str, make: Callable[[Path], None]
) -> tuple[Path, int | None]:
    """Make a part, and the descriptor that holds its lock; None where there are no locks."""
    while True:
        part = folder / f"{PREFIX}{secrets.token_hex(6)}{suffix}"
        _own.add(part)  # before it exists: a signal may come at any moment
        make(part)
        if not HAS_LOCKS:
            return part, None
        with contextlib.suppress(FileNotFoundError):  # swept before it was locked
            descriptor = os.open(part, os.O_RDONLY)
            if _claim(descriptor, part):
                return part, descriptor
            os.close(descriptor)
        _own.discard(part)


def _make_file(part: Path) -> None:
    os.close(os.open(part, os.O_CREAT | os.O_EXCL | os.O_RDWR, 0o666))


def _release(lock: int | None) -> None:
    if lock is not None:
        os.close(lock)


def _lock(descriptor: int) -> None:
    """Take the lock; BlockingIOError if another process has it."""
    import fcntl  # Windows has no such module

    fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)


def _claim(descriptor: int, part: Path) -> bool:
    """Lock a new part; False if another process swept it in between."""
    try:
        _lock(descriptor)
    except BlockingIOError:
        return False
    except OSError:
        return True  # a file system without locks, where nothing is swept either
    try:
        return os.path.samestat(os.fstat(descriptor), part.stat())
    except FileNotFoundError:
        return False
