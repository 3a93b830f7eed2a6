"""Every error texvent raises on purpose, in one tree.

    TexventError
    ├── InputError               what the caller gave is wrong: a file, an array, a value
    │   ├── ConfigError          an option, preset or config file is wrong
    │   └── FileFormatError      a file is damaged or not what its name says
    ├── OutputError              a result cannot be written: exists, no folder, disk full
    └── MissingDependencyError   an optional package is not installed

A message says what was wrong, the value, what is allowed and what to do. The command line
prints it as one line and exits with `exit_code`; it never shows a traceback for these.

A `TexventWarning` says that a result is there but is hardly what was meant.
"""

from __future__ import annotations

import contextlib
import sys
import warnings
from collections.abc import Callable, Iterator


class TexventError(Exception):
    """Base of all errors that texvent raises on purpose."""

    exit_code: int = 1


class InputError(TexventError, ValueError):
    """What the caller gave cannot be used: a missing file, a NaN, a wrong shape."""

    exit_code = 2


class ConfigError(InputError):
    """An option, a preset name or a config file is wrong."""


class FileFormatError(InputError):
    """A file is damaged, truncated, or not of the format its name claims."""


class OutputError(TexventError):
    """A result cannot be written: it exists already, or its folder or disk refuses it."""

    exit_code = 3


class MissingDependencyError(TexventError, ImportError):
    """An optional package is needed and not installed."""

    exit_code = 4


class TexventWarning(UserWarning):
    """The result is probably not what was meant: words without effect, no event in a range.

    The command line shows it as one line; `warnings.simplefilter("error", texvent.TexventWarning)`
    makes it an error.
    """


_listeners: list[Callable[[str], None]] = []


@contextlib.contextmanager
def warnings_to(listener: Callable[[str], None]) -> Iterator[None]:
    """Give the texts of texvent's warnings to a function inside the block.

    Unlike `warnings.catch_warnings` this holds while other threads compile kernels.
    """
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def warn(message: str) -> None:
    """Issue a `TexventWarning` that points at the first line outside texvent."""
    if _listeners:
        _listeners[-1](message)
        return
    level = 2
    frame = sys._getframe(1)
    while frame.f_back is not None and _is_own(frame.f_globals.get("__name__", "")):
        frame = frame.f_back
        level += 1
    warnings.warn(message, TexventWarning, stacklevel=level)


def _is_own(module: str) -> bool:
    return module == "texvent" or module.startswith("texvent.")
