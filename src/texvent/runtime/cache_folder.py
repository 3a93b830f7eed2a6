"""The cache folder: files that can be made or downloaded again."""

from __future__ import annotations

import os
from pathlib import Path

CACHE_VARIABLE = "TEXVENT_CACHE"
"""Environment variable that names the cache folder."""


def cache_folder(kind: str) -> Path:
    """Folder of one kind of file: below $TEXVENT_CACHE, else below the user's cache folder.

    The user's cache folder is $XDG_CACHE_HOME/texvent or ~/.cache/texvent. It is not created.

    Args:
        kind: name of the folder, such as "weights".
    """
    chosen = os.environ.get(CACHE_VARIABLE)
    if chosen:
        return Path(chosen).expanduser() / kind
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "texvent" / kind
