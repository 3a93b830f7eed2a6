"""What all codecs check when columns come in from a file, and how metadata becomes text."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError
from texvent.events import EventStream
from texvent.option_values import plain
from texvent.sensor import SensorSize, checked_size


def existing_file(path: str | Path) -> Path:
    """The path of a readable file.

    Raises:
        InputError: there is no such file, it is a folder, or it must not be read.
    """
    path = Path(path)
    if path.is_dir():
        raise InputError(f"{path} is a folder; give the name of an event file")
    if not path.exists():
        raise InputError(f"no such file: {path}; check the name and the folder")
    if not os.access(path, os.R_OK):
        raise InputError(f"{path} must not be read by this user; change its permissions")
    return path


def existing_folder(path: str | Path) -> Path:
    """The path of a readable folder.

    Raises:
        InputError: there is no such folder, it is a file, or it must not be read.
    """
    path = Path(path)
    if not path.exists():
        raise InputError(f"no such folder: {path}; check the name")
    if not path.is_dir():
        raise InputError(f"{path} is a file; this format is a folder of files")
    if not os.access(path, os.R_OK | os.X_OK):
        raise InputError(f"{path} must not be read by this user; change its permissions")
    return path


def binary_polarity(p: NDArray[Any]) -> NDArray[np.uint8]:
    """Polarity coded 0/1 (or false/true) or −1/+1 as uint8, 1 = ON; other values stay wrong.

    Raises:
        InputError: a value is none of −1, 0 and 1, or −1 and 0 both occur.
    """
    if p.size == 0 or p.dtype == np.uint8:
        return np.asarray(p, dtype=np.uint8)
    values = set(np.unique(p).tolist())
    if not (values <= {0, 1} or values <= {-1, 1}):
        raise InputError(f"polarity holds {sorted(values)[:4]}; it must be 0/1 or -1/+1 (OFF/ON)")
    return (p > 0).astype(np.uint8)


def stream_from_file(
    path: Path, columns: Mapping[str, NDArray[Any]], size: SensorSize, metadata: Mapping[str, Any]
) -> EventStream:
    """Columns x, y, t, p (and label) of a file as a stream; what is wrong is the file's fault.

    Raises:
        FileFormatError: lengths, order, coordinates or polarities are wrong.
    """
    try:
        return EventStream(
            columns["x"],
            columns["y"],
            columns["t"],
            binary_polarity(columns["p"]),
            size,
            metadata,
            columns.get("label"),
        )
    except (InputError, OverflowError) as error:
        raise FileFormatError(f"{path} holds wrong events: {error}") from error


def stored_or_given_size(
    path: Path, stored: tuple[int, int] | None, given: SensorSize | None
) -> SensorSize:
    """The sensor size a file states, else the one the caller gave; it is never guessed.

    Raises:
        InputError: there is neither, or they differ.
        FileFormatError: the stored size is impossible.
    """
    if stored is None:
        if given is None:
            raise InputError(
                f"{path} does not store the sensor size; give it "
                "(--sensor davis240c or --sensor 240x180, size=(240, 180) in Python)"
            )
        return checked_size(*given)
    try:
        size = checked_size(*stored)
    except InputError as error:
        raise FileFormatError(f"{path} states an impossible {error}") from error
    if given is not None and tuple(given) != tuple(size):
        raise InputError(
            f"{path} was recorded at {size}, not {given[0]}x{given[1]}; leave the size out"
        )
    return size


def metadata_to_json(metadata: Mapping[str, Any]) -> str:
    """Metadata as one line of ASCII JSON.

    Raises:
        InputError: a value cannot be written as JSON.
    """
    try:
        return json.dumps(plain(metadata), default=_plain_number)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"metadata cannot be stored ({error}); use text, numbers, lists and dictionaries"
        ) from error


def metadata_from_json(path: Path, text: str | bytes) -> dict[str, Any]:
    """Metadata read back.

    Raises:
        FileFormatError: the text is not a JSON object.
    """
    try:
        metadata = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise FileFormatError(f"{path} holds damaged metadata ({error})") from error
    if not isinstance(metadata, dict):
        raise FileFormatError(f"{path} holds damaged metadata (not a table of names and values)")
    return metadata


def _plain_number(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is not text, a number, a list or a dictionary")
