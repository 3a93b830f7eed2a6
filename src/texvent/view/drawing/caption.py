"""What a recording is called in captions and titles."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any


def title_of(metadata: Mapping[str, Any]) -> str:
    """What a recording shows: its prompt, else the name of its source, else nothing."""
    for key in ("prompt", "title", "source", "input"):
        value = metadata.get(key)
        if isinstance(value, Mapping):
            # A run stores what it knows of a video; its file or folder is called "source" again.
            value = Path(str(value.get("source") or "")).name
        if isinstance(value, str) and value.strip():
            return " ".join(value.split())
    return ""
