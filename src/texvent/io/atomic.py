"""Files that appear under their name only when they are complete.

Every file texvent writes goes through `atomic_file`: it is written beside its target under a
hidden name, flushed to disk, and renamed. A crash, Ctrl-C or a full disk leaves the old file (or
none). Only a process that is killed outright can leave the hidden file `.texvent-….part…` behind;
it may be deleted.
"""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from texvent.errors import OutputError

DISK_FULL = (errno.ENOSPC, errno.EDQUOT)


def check_output(path: str | Path, *, overwrite: bool) -> Path:
    """The path, if a file can be put there.

    Args:
        path: the file to be written.
        overwrite: whether an existing file may be replaced.

    Returns:
        The path, symbolic links resolved, so that replacing it replaces what it points to.

    Raises:
        OutputError: it exists already, it is not a regular file, or its folder is missing or
            not writable.
    """
    target = Path(os.path.realpath(path))
    folder = target.parent
    if target.exists() and not target.is_file():
        what = "a folder" if target.is_dir() else "not a regular file"
        raise OutputError(f"cannot write {path}: it is {what}; give the name of a file")
    if target.exists() and not overwrite:
        raise OutputError(
            f"{path} exists already; choose another name, or allow replacing it "
            "(--overwrite, or overwrite=True in Python)"
        )
    if not folder.is_dir():
        raise OutputError(
            f"cannot write {path}: the folder {folder} does not exist; "
            f"create it with: mkdir -p '{folder}'"
        )
    if not os.access(folder, os.W_OK | os.X_OK):
        raise OutputError(
            f"cannot write {path}: the folder {folder} is not writable; "
            "choose another folder or change its permissions"
        )
    return target


@contextmanager
def atomic_file(path: str | Path, *, overwrite: bool) -> Iterator[Path]:
    """A path to write to, which becomes `path` if the `with` block ends without an exception.

    The path given lies in the same folder and has the same extension.

    Args:
        path: the file to be written.
        overwrite: whether an existing file may be replaced.

    Raises:
        OutputError: see `check_output`; or the disk became full inside the block.
    """
    target = check_output(path, overwrite=overwrite)
    part = target.parent / f".texvent-{secrets.token_hex(6)}.part{target.suffix}"
    try:
        _create(part, path)
        yield part
        _flush_to_disk(part)
        # Another program may have made the file meanwhile.
        check_output(path, overwrite=overwrite)
        os.replace(part, target)
    except BaseException as error:
        # BaseException: Ctrl-C and SystemExit must not leave a half-written file either.
        part.unlink(missing_ok=True)
        if is_disk_full(error):
            raise _disk_full(path, target) from error
        raise
    _flush_folder(target.parent)


def check_output_folder(
    path: str | Path, *, overwrite: bool, is_own: Callable[[Path], bool]
) -> Path:
    """The path, if a folder of files can be put there.

    Args:
        path: the folder to be written.
        overwrite: whether a folder of the same kind may be replaced.
        is_own: tells from its path whether a file is of this kind; a folder with any other file
            is never replaced.

    Raises:
        OutputError: it exists already, holds other files, or its parent folder is missing or not
            writable.
    """
    target = Path(os.path.realpath(path))
    if target.is_dir():
        foreign = [one.name for one in target.iterdir() if not (one.is_file() and is_own(one))]
        if foreign:
            raise OutputError(
                f"cannot write {path}: the folder holds other files ({sorted(foreign)[0]!r}), "
                "which are never replaced; choose another name"
            )
        if not overwrite:
            raise OutputError(
                f"{path} exists already; choose another name, or allow replacing it "
                "(--overwrite, or overwrite=True in Python)"
            )
        return target
    return check_output(path, overwrite=False)


@contextmanager
def atomic_folder(
    path: str | Path, *, overwrite: bool, is_own: Callable[[Path], bool]
) -> Iterator[Path]:
    """A folder to write into, which becomes `path` if the `with` block ends without an exception.

    Between the old folder's going and the new one's coming lies an instant without either; a
    process killed then leaves the old one as the hidden folder `.texvent-….old`.

    Raises:
        OutputError: see `check_output_folder`; or the disk became full inside the block.
    """
    target = check_output_folder(path, overwrite=overwrite, is_own=is_own)
    part = target.parent / f".texvent-{secrets.token_hex(6)}.part"
    old = part.with_suffix(".old")
    try:
        part.mkdir()
        yield part
        for file in part.iterdir():
            _flush_to_disk(file)
        _flush_folder(part)
        check_output_folder(path, overwrite=overwrite, is_own=is_own)
        if target.is_dir():
            os.replace(target, old)
        os.replace(part, target)
    except BaseException as error:
        shutil.rmtree(part, ignore_errors=True)
        if old.is_dir() and not target.exists():
            os.replace(old, target)
        if is_disk_full(error):
            raise _disk_full(path, target) from error
        raise
    shutil.rmtree(old, ignore_errors=True)
    _flush_folder(target.parent)


def is_disk_full(error: BaseException) -> bool:
    """True if `error` says that the disk, or the user's share of it, is full."""
    return isinstance(error, OSError) and error.errno in DISK_FULL


def _disk_full(path: str | Path, target: Path) -> OutputError:
    return OutputError(
        f"cannot write {path}: the disk is full ({target.parent}); nothing was kept. "
        "Free some space or choose another folder"
    )


def _create(part: Path, path: str | Path) -> None:
    """Make the hidden file now, so that a refusal comes before any work is done."""
    try:
        os.close(os.open(part, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
    except OSError as error:
        if is_disk_full(error):
            raise
        raise OutputError(
            f"cannot write {path}: {error.strerror}; choose another folder or name"
        ) from error


def _flush_to_disk(part: Path) -> None:
    descriptor = os.open(part, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _flush_folder(folder: Path) -> None:
    """Make the rename itself durable."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
