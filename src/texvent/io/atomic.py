"""Files that appear under their name only when they are complete.

Every file texvent writes goes through `atomic_file`: it is written beside its target under a
hidden name, flushed to disk, and renamed. A crash, Ctrl-C or a full disk leaves the old file (or
none). Only a process that is killed outright leaves the hidden file `.texvent-….part…` behind; the
next run that writes into the folder removes it.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from texvent.errors import OutputError, shown
from texvent.io.hidden_parts import hidden_file, hidden_folder, is_hidden_part
from texvent.io.protected_inputs import refuse_inputs

DISK_FULL = (errno.ENOSPC, errno.EDQUOT)
_completed: list[list[Path]] = []
"""Lists that note what is put in place."""


@contextmanager
def noting_completed() -> Iterator[list[Path]]:
    """The files and folders that this process puts in place inside the block, in order."""
    completed: list[Path] = []
    _completed.append(completed)
    try:
        yield completed
    finally:
        # By identity: two empty lists are equal.
        _completed[:] = [one for one in _completed if one is not completed]


def _note(target: Path) -> None:
    for completed in _completed:
        completed.append(target)


def check_output(path: str | Path, *, overwrite: bool) -> Path:
    """The path, if a file can be put there.

    Args:
        path: the file to be written.
        overwrite: whether an existing file may be replaced.

    Returns:
        The path, symbolic links resolved, so that replacing it replaces what it points to.

    Raises:
        OutputError: it exists already, is an input of this command or not a regular file, or its
            folder is missing or not writable.
    """
    target = _resolved(path)
    refuse_inputs(path, target)
    folder = target.parent
    if target.exists() and not target.is_file():
        what = "a folder" if target.is_dir() else "not a regular file"
        raise OutputError(f"cannot write {path}: it is {what}; give the name of a file")
    if target.exists() and not overwrite:
        raise OutputError(
            f"{path} exists already; choose another name, or allow replacing it (overwrite=True)"
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


def check_outputs(paths: Sequence[str | Path], *, overwrite: bool) -> None:
    """Refuse outputs of which one cannot be written, or that would replace each other.

    Raises:
        OutputError: see `check_output`; or two are the same file.
    """
    targets: dict[Path, str | Path] = {}
    for path in paths:
        target = check_output(path, overwrite=overwrite)
        if target in targets:
            raise OutputError(
                f"{path} and {targets[target]} are the same file; give each output its own name"
            )
        targets[target] = path


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
    # Ctrl-C and SystemExit leave no half-written file either: the hidden one goes with its block.
    with _refusals(path, target), hidden_file(target.parent, target.suffix) as part:
        yield part
        _flush_to_disk(part)
        # Another program may have made the file meanwhile.
        check_output(path, overwrite=overwrite)
        os.replace(part, target)
        _note(target)
    _flush_to_disk(target.parent)


def check_output_folder(
    path: str | Path,
    *,
    overwrite: bool,
    is_own: Callable[[Path], bool],
    is_nested: bool = False,
) -> Path:
    """The path, if a folder of files can be put there.

    Args:
        path: the folder to be written.
        overwrite: whether a folder of the same kind may be replaced.
        is_own: tells from its path whether a file is of this kind; a folder with any other file
            is never replaced.
        is_nested: whether such files may lie in folders inside it.

    Raises:
        OutputError: it exists already, holds other files, or its parent folder is missing or not
            writable.
    """
    target = _resolved(path)
    refuse_inputs(path, target)
    if target.is_dir():
        found = target.rglob("*") if is_nested else target.iterdir()
        entries = (one for one in found if not (is_nested and _is_real_folder(one)))
        foreign = [one.name for one in entries if not (one.is_file() and is_own(one))]
        if foreign:
            raise OutputError(
                f"cannot write {path}: the folder holds other files ({sorted(foreign)[0]!r}), "
                "which are never replaced; choose another name"
            )
        if not overwrite:
            raise OutputError(
                f"{path} exists already; choose another name, or allow replacing it "
                "(overwrite=True)"
            )
        return target
    return check_output(path, overwrite=False)


@contextmanager
def atomic_folder(
    path: str | Path,
    *,
    overwrite: bool,
    is_own: Callable[[Path], bool],
    is_nested: bool = False,
) -> Iterator[Path]:
    """A folder to write into, which becomes `path` if the `with` block ends without an exception.

    Between the old folder's going and the new one's coming lies an instant without either; if the
    process is killed then, the next run beside it puts the old one back.

    Raises:
        OutputError: see `check_output_folder`; or the disk became full inside the block.
    """
    target = check_output_folder(path, overwrite=overwrite, is_own=is_own, is_nested=is_nested)
    with _refusals(path, target), hidden_folder(target.parent) as part:
        yield part
        for file in part.rglob("*"):
            _flush_to_disk(file)
        _flush_to_disk(part)
        check_output_folder(path, overwrite=overwrite, is_own=is_own, is_nested=is_nested)
        if target.is_dir():
            _replace_folder(target, part)
        else:
            os.replace(part, target)
        _note(target)
    _flush_to_disk(target.parent)


def _is_real_folder(path: Path) -> bool:
    return path.is_dir() and not path.is_symlink()


def _replace_folder(target: Path, part: Path) -> None:
    with hidden_folder(target.parent, ".old") as old:
        replaced = old / target.name
        os.replace(target, replaced)
        try:
            os.replace(part, target)
        except BaseException:
            os.replace(replaced, target)
            raise


def _resolved(path: str | Path) -> Path:
    """The path without symbolic links, if the system takes such a name."""
    try:
        target = Path(os.path.realpath(path))
        target.exists()
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise OutputError(
            f"cannot write {shown(str(path))}: {reason}; choose another name"
        ) from error
    return target


def is_disk_full(error: BaseException) -> bool:
    """True if `error` says that the disk, or the user's share of it, is full."""
    return isinstance(error, OSError) and error.errno in DISK_FULL


@contextmanager
def _refusals(path: str | Path, target: Path) -> Iterator[None]:
    """Say in one line why the system refused to write."""
    try:
        yield
    except OSError as error:
        if is_disk_full(error):
            raise OutputError(
                f"cannot write {path}: the disk is full ({target.parent}); free some space or "
                "choose another folder"
            ) from error
        if error.errno == errno.EFBIG:
            raise OutputError(
                f"cannot write {path}: it grew over the largest file allowed here (ulimit -f); "
                "raise the limit or write less"
            ) from error
        if isinstance(error, PermissionError) and error.filename2 == str(target):
            raise OutputError(
                f"cannot write {path}: {error.strerror}; end what has the old one open, or "
                "choose another name"
            ) from error
        if _is_part(error.filename, target.parent):
            raise OutputError(
                f"cannot write {path}: {error.strerror} ({error.filename}); choose another folder "
                "or name"
            ) from error
        raise


def _is_part(name: Any, folder: Path) -> bool:
    """True if a system error is about a hidden file of an output."""
    return (
        isinstance(name, str | Path) and is_hidden_part(Path(name)) and folder in Path(name).parents
    )


def _flush_to_disk(path: Path) -> None:
    """Make a file durable, or the names in a folder; Windows keeps those itself."""
    if hasattr(os, "O_DIRECTORY"):
        mode = os.O_RDONLY
    elif path.is_dir():
        return
    else:
        mode = os.O_RDWR  # what Windows asks for
    descriptor = os.open(path, mode)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
