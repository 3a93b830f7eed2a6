"""The cache folder: files that can be made or downloaded again."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from texvent.errors import OutputError

CACHE_VARIABLE = "TEXVENT_CACHE"
"""Environment variable that names the cache folder."""


def cache_folder(kind: str = "") -> Path:
    """Folder of one kind of file: below $TEXVENT_CACHE, else below the user's cache folder.

    The user's cache folder is $XDG_CACHE_HOME/texvent or ~/.cache/texvent; without a home, as in
    some containers, it is among the temporary files. It is not created.

    Args:
        kind: name of the folder, such as "weights"; "": the folder of all kinds.
    """
    chosen = os.environ.get(CACHE_VARIABLE)
    if chosen:
        return Path(chosen).expanduser() / kind
    base = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    if base.startswith("~"):
        base = os.path.join(tempfile.gettempdir(), f"cache-{os.getuid()}")
    return Path(base) / "texvent" / kind


def make_folder(folder: Path, variable: str = CACHE_VARIABLE) -> None:
    """Make a folder and its parents.

    Args:
        folder: what to make; it may exist.
        variable: environment variable that names another place, for the message.

    Raises:
        OutputError: that is not possible.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"cannot make the folder {folder} ({error.strerror}); choose another with the "
            f"environment variable {variable}"
        ) from error
