"""Size and metadata of recordings as text: one line of JSON, or a file beside the recording.

`events.es` has no place for them, so they are in `events.es.json`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from texvent.errors import FileFormatError, InputError, one_line
from texvent.options.values import plain
from texvent.sensor import SensorSize

MAX_HEADER_BYTES = 8 * 2**20
"""More text than this before the first event is not a header."""


def metadata_to_json(metadata: Mapping[str, Any]) -> str:
    """Metadata as one line of ASCII JSON.

    Raises:
        InputError: a value cannot be written as JSON.
    """
    try:
        return json.dumps(plain(metadata), default=_plain_number)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"metadata cannot be stored ({one_line(error)}); use text, numbers, lists and "
            "dictionaries"
        ) from error


def metadata_from_json(path: Path, text: str | bytes) -> dict[str, Any]:
    """Metadata read back.

    Raises:
        FileFormatError: the text is not a JSON object.
    """
    try:
        metadata = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise FileFormatError(f"{path} holds damaged metadata ({one_line(error)})") from error
    if not isinstance(metadata, dict):
        raise FileFormatError(f"{path} holds damaged metadata (not a table of names and values)")
    return metadata


def header_metadata(metadata: Mapping[str, Any]) -> str:
    """Metadata as one line of ASCII JSON that fits into a text header.

    Raises:
        InputError: it is not JSON-serialisable or too long.
    """
    text = metadata_to_json(metadata)
    if len(text) > MAX_HEADER_BYTES // 2:
        raise InputError(
            f"metadata of {len(text)} bytes cannot be stored in a text header; "
            f"at most {MAX_HEADER_BYTES // 2} bytes, or write hdf5 (.h5)"
        )
    return text


def sidecar_path(path: str | Path) -> Path:
    """Path of the sidecar file: `events.txt` → `events.txt.json`."""
    path = Path(path)
    return path.with_name(path.name + ".json")


def sidecar_text(size: SensorSize, metadata: Mapping[str, Any]) -> str:
    """Text of a sidecar file.

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
    """Width and height, pixels, and metadata; (None, {}) if there is no sidecar file.

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


def _plain_number(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is not text, a number, a list or a dictionary")
