"""Size and metadata beside files that have no place for them: `events.es` → `events.es.json`."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, InputError
from texvent.io.columns import metadata_from_json, metadata_to_json
from texvent.sensor import SensorSize


def sidecar_path(path: str | Path) -> Path:
    """Where size and metadata of a file lie: `events.txt` → `events.txt.json`."""
    path = Path(path)
    return path.with_name(path.name + ".json")


def sidecar_text(size: SensorSize, metadata: Mapping[str, Any]) -> str:
    """What is written beside a file.

    Raises:
        InputError: the metadata is not JSON-serialisable.
    """
    facts = {
        "width": size.width,
        "height": size.height,
        "texvent": json.loads(metadata_to_json(metadata)),
    }
    return json.dumps(facts, indent=1) + "\n"


def read_sidecar(path: Path) -> tuple[tuple[int, int] | None, dict[str, Any]]:
    """Width and height, pixels, and metadata; None and nothing if no such file lies beside.

    Raises:
        InputError: it must not be read.
        FileFormatError: it is damaged.
    """
    beside = sidecar_path(path)
    if not beside.is_file():
        return None, {}
    try:
        text = beside.read_bytes()
    except OSError as error:
        raise InputError(f"cannot read {beside}: {error.strerror}") from error
    return parse_sidecar(beside, text)


def parse_sidecar(beside: Path, text: bytes) -> tuple[tuple[int, int], dict[str, Any]]:
    """Width and height, pixels, and metadata of what `sidecar_text` made.

    Raises:
        FileFormatError: it is damaged.
    """
    facts = metadata_from_json(beside, text)
    try:
        stored = int(facts["width"]), int(facts["height"])
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise FileFormatError(f"{beside} states no width and height") from error
    metadata = facts.get("texvent")
    return stored, metadata if isinstance(metadata, dict) else {}
