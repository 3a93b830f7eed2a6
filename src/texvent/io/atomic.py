"""Files that appear under their name only when they are complete, and never replace an input.

Every file texvent writes goes through `atomic_file`: it is written beside its target under a
hidden name, flushed to disk, and renamed. A crash, Ctrl-C or a full disk leaves the old file (or
none). Only a process that is killed outright leaves the hidden file `.texvent-….part…` behind; the
next run that writes into the folder removes it.
"""

from __future__ import annotations

import contextlib
import errno
import os
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any, Self

from texvent.errors import OutputError, shown
from texvent.runtime.files.file_names import IMAGE_EXTENSIONS, VIDEO_EXTENSIONS
from texvent.runtime.files.hidden_parts import (
    PREFIX,
    hidden_file,
    hidden_folder,
)

DISK_FULL = (errno.ENOSPC, errno.EDQUOT)
READ_FROM_FOLDERS = IMAGE_EXTENSIONS | VIDEO_EXTENSIONS | {".npy"}
"""Files of these kinds, put into an input folder, would be read as its frames by the next run."""

_inputs: ContextVar[tuple[tuple[str, Path], ...]] = ContextVar("inputs", default=())
"""Names of protected inputs as the user wrote them, and resolved."""


@contextmanager
def protected_inputs() -> Iterator[None]:
    """Forget, at the end of the block, the inputs that were protected inside it."""
    token = _inputs.set(())
    try:
        yield
    finally:
        _inputs.reset(token)


def protect_inputs(paths: Iterable[str | Path]) -> None:
    """Let no output replace these files, or join the frames of these folders."""
    found = []
    for given in paths:
        with contextlib.suppress(OSError, ValueError):  # ValueError: a NUL byte names no file
            path = Path(os.path.realpath(given))
            if path.exists():
                found.append((str(given), path))
    _inputs.set((*_inputs.get(), *found))


def _refuse_inputs(path: str | Path, target: Path) -> None:
    """Refuse an output that is an input, holds one, or would be read as a frame of one."""
    for given, source in _inputs.get():
        # By identity: links and other spellings of a name count.
        if target.exists() and source.exists() and target.samefile(source):
            raise OutputError(
                f"cannot write {path}: it is the input {given}, which is never replaced; give "
                "another name"
            )
        if target in source.parents:
            raise OutputError(
                f"cannot write {path}: it holds the input {given}, which is never replaced; "
                "give another name"
            )
        if target.parent == source and target.suffix.lower() in READ_FROM_FOLDERS:
            raise OutputError(
                f"cannot write {path}: it would lie among the files of the input {given}; "
                "give another folder"
            )


def check_output(path: str | Path, *, overwrite: bool) -> Path:
    """The path, if a file can be put there.

    Returns:
        The path, symbolic links resolved, so that replacing it replaces what it points to.

    Raises:
        OutputError: it exists already, is an input of this command or not a regular file, or its
            folder is missing or not writable.
    """
    target = _resolved(path)
    _refuse_inputs(path, target)
    folder = target.parent
    if target.exists() and not target.is_file():
        what = "a folder" if target.is_dir() else "not a regular file"
        raise OutputError(f"cannot write {path}: it is {what}; give the name of a file")
    if target.exists() and not overwrite:
        raise OutputError(
            f"{path} exists already; choose another name, or --overwrite (overwrite=True in Python)"
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

    The path given is in the same folder and has the same extension.

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
        is_own: whether a file of this path is of this kind; a folder with any other file is never
            replaced.
        is_nested: whether folders inside it may hold such files.

    Raises:
        OutputError: it exists already, holds other files, or its parent folder is missing or not
            writable.
    """
    target = _resolved(path)
    _refuse_inputs(path, target)
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
                f"{path} exists already; choose another name, or "
                "--overwrite (overwrite=True in Python)"
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

    For an instant neither the old folder nor the new one is there; if the process is killed then,
    the next run beside it puts the old one back.

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
    """True if the disk, or the user's share of it, is full."""
    return isinstance(error, OSError) and error.errno in DISK_FULL


@contextmanager
def _refusals(path: str | Path, target: Path) -> Iterator[None]:
    """Report in one line why the system refused to write."""
    try:
        yield
    except OSError as error:
        if is_disk_full(error):
            reason = f"the disk is full ({target.parent}); free some space or choose another folder"
        elif error.errno == errno.EFBIG:
            reason = (
                "it grew over the largest file allowed here (ulimit -f); raise the limit or write "
                "less"
            )
        elif isinstance(error, PermissionError) and error.filename2 == str(target):
            reason = f"{error.strerror}; end what has the old one open, or choose another name"
        elif PREFIX in str(error.filename) and target.parent in Path(error.filename).parents:
            reason = f"{error.strerror} ({error.filename}); choose another folder or name"
        else:
            raise
        raise OutputError(f"cannot write {path}: {reason}") from error


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


class AtomicOutput(ABC):
    """Output that is complete when its `with` block ends without error, else absent."""

    def __init__(self) -> None:
        self._stack = ExitStack()

    @abstractmethod
    def _open(self, stack: ExitStack) -> None:
        """Enter the contexts of the files, such as `atomic_file`."""

    @abstractmethod
    def _complete(self) -> None:
        """Write what is left; the block ended without error."""

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            self._open(stack)
            self._stack = stack.pop_all()
        return self

    def __exit__(self, *raised: Any) -> None:
        if raised[0] is not None:
            self._stack.__exit__(*raised)
            return
        with self._stack:
            self._complete()
