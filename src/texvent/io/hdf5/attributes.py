"""Size and metadata of a recording in attributes of an HDF5 file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from texvent.errors import shown
from texvent.io.hdf5.storage import (
    check_claims,
)
from texvent.io.metadata import metadata_from_json, metadata_to_json

MAX_ATTRIBUTE_BYTES = 32_768
"""Longer metadata goes to a dataset: many readers stop at 64 kB per attribute."""


MAX_PLAIN_ATTRIBUTES = 64


MAX_PLAIN_BYTES = 2048


RESERVED = ("width", "height", "timestamp_scale_ms", "texvent", "origin", "y_up")


def stored_size(node: Any, path: Path) -> tuple[int, int] | None:
    """Width and height, pixels, that the root or a group states.

    As attributes width and height; `sensor_resolution`, height before width, of event_utils; or
    the data set `calib/resolution`, width before height, of M3ED.
    """
    if "width" in node.attrs and "height" in node.attrs:
        width, height = (whole_attribute(node, name) for name in ("width", "height"))
        return width, height
    sides = node.attrs.get("sensor_resolution")
    if sides is not None and np.size(sides) == 2:
        height, width = (int(side) for side in np.ravel(sides))
        return width, height
    sides = node.get("calib/resolution") if hasattr(node, "get") else None
    if isinstance(sides, h5py.Dataset) and sides.size == 2:
        check_claims(sides, path)
        width, height = (int(side) for side in np.ravel(sides[()]))
        return width, height
    return None


def whole_attribute(node: Any, name: str) -> int:
    """A whole number; ValueError, which is reported as damage, for anything else."""
    value = np.asarray(node.attrs[name])
    if value.size != 1 or value.dtype.kind not in "iu":
        raise ValueError(f"{name} is {shown(value)}")
    return int(value.reshape(-1)[0])


def write_metadata(node: Any, metadata: Mapping[str, Any]) -> None:
    """All metadata as JSON, in an attribute of the root or a group, or beside it if too long.

    It has a fixed length, so it is in the checksummed header. HDF5 keeps text of variable length
    in a heap without checksums, where one flipped bit can hang it.
    """
    fixed = np.bytes_(metadata_to_json(metadata).encode("ascii"))
    if len(fixed) <= MAX_ATTRIBUTE_BYTES:
        node.attrs["texvent"] = fixed
    else:
        node.create_dataset("texvent", data=fixed)


def write_scalars(file: Any, metadata: Mapping[str, Any]) -> None:
    """Top-level scalars by name, for other programs; texvent never reads them back."""
    scalars = [
        (name, value)
        for name, value in metadata.items()
        if name not in RESERVED and _is_plain_attribute(name) and _is_plain_attribute(value)
    ]
    for name, value in scalars[:MAX_PLAIN_ATTRIBUTES]:
        file.attrs[name] = value


def _is_plain_attribute(value: Any) -> bool:
    if isinstance(value, str):
        # HDF5 text cannot hold NUL or unpaired surrogates; the JSON form can.
        encoded = value.encode("utf-8", errors="replace")
        sound = encoded.decode("utf-8") == value and "\0" not in value
        return sound and 0 < len(encoded) <= MAX_PLAIN_BYTES
    if isinstance(value, int):
        return -(2**63) <= value < 2**63
    return isinstance(value, float)


def read_metadata(node: Any, path: Path) -> dict[str, Any] | None:
    """Metadata that `write_metadata` stored, or None."""
    text = node.attrs.get("texvent")
    if text is None and isinstance(node.get("texvent"), h5py.Dataset):
        check_claims(node["texvent"], path)
        text = node["texvent"][()]
    return None if text is None else metadata_from_json(path, text)
