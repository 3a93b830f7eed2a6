"""Names that no file can have: with a NUL byte, or too long for the system."""

from __future__ import annotations

import os
from pathlib import Path

from texvent.errors import InputError, shown

MAX_NAME_BYTES, MAX_PATH_BYTES = 255, 4095
"""Bytes of one name and of a whole path on Linux."""


def usable_path(path: str | Path) -> Path:
    """A path that the system can be asked for.

    Raises:
        InputError: it holds a NUL byte or is too long; every function of the system would refuse it
            in words of its own.
    """
    content = os.fsencode(os.fspath(path))
    if b"\0" in content:
        raise InputError(f"{shown(str(path))} is no file name: it holds a NUL byte")
    longest = max(map(len, content.split(b"/")))
    if longest > MAX_NAME_BYTES or len(content) > MAX_PATH_BYTES:
        raise InputError(
            f"{shown(str(path))} is no file name: it is longer than {MAX_NAME_BYTES} bytes"
        )
    return Path(path)
