"""How codecs recognise their own files: by the first bytes."""

from __future__ import annotations

from pathlib import Path


def begins_with(path: Path, magic: bytes) -> bool:
    """True if the file can be read and begins with these bytes."""
    try:
        with path.open("rb") as file:
            return file.read(len(magic)) == magic
    except OSError:
        return False
