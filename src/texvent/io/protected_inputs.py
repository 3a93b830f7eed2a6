"""Files that a command reads, so that none of its outputs replaces one."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path

from texvent.errors import OutputError
from texvent.runtime.file_names import IMAGE_EXTENSIONS, VIDEO_EXTENSIONS


@dataclass(frozen=True)
class ProtectedInput:
    """A file or folder that is read."""

    given: str
    """Its name as the user wrote it."""
    path: Path
    """Absolute, symbolic links resolved."""
    status: os.stat_result


READ_FROM_FOLDERS = IMAGE_EXTENSIONS | VIDEO_EXTENSIONS | {".npy"}
"""Files of these kinds, put into an input folder, would be read as its frames by the next run."""

_inputs: ContextVar[tuple[ProtectedInput, ...]] = ContextVar("inputs", default=())


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
        try:
            path = Path(os.path.realpath(given))
            found.append(ProtectedInput(str(given), path, path.stat()))
        except (OSError, ValueError):  # ValueError: a text with a NUL byte, which names no file
            continue
    _inputs.set((*_inputs.get(), *found))


def refuse_inputs(path: str | Path, target: Path) -> None:
    """Refuse an output that would change an input.

    Files are compared by identity, so that links and other spellings of a name count.

    Args:
        path: the output's name as the user wrote it.
        target: the same, symbolic links resolved.

    Raises:
        OutputError: it is an input, would be read as a frame of an input folder, or is a folder
            that holds an input.
    """
    status = target.stat() if target.exists() else None
    for one in _inputs.get():
        if status is not None and os.path.samestat(status, one.status):
            raise OutputError(
                f"cannot write {path}: it is the input {one.given}, which is never replaced; give "
                "another name"
            )
        if target in one.path.parents:
            raise OutputError(
                f"cannot write {path}: it holds the input {one.given}, which is never replaced; "
                "give another name"
            )
        if target.parent == one.path and target.suffix.lower() in READ_FROM_FOLDERS:
            raise OutputError(
                f"cannot write {path}: it would lie among the files of the input {one.given}; "
                "give another folder"
            )
