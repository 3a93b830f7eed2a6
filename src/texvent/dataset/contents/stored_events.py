"""The events of a stored sample, and the facts beside them."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np

from texvent.dataset.generation.records import SampleRecord
from texvent.dataset.generation.sample import COLUMNS
from texvent.dataset.generation.tar_shard import read_members
from texvent.errors import FileFormatError, InputError, one_line
from texvent.events import EventStream
from texvent.sensor import SensorSize

LABEL = "label"


def read_events(shard: Path, sample: SampleRecord) -> EventStream:
    """The events of a sample with all that is known of them as metadata.

    Args:
        shard: the tar.
        sample: its record.

    Raises:
        FileFormatError: the shard is cut off or changed, or the events are not sound.
    """
    wanted = tuple(f"{name}.npy" for name in (*COLUMNS, LABEL))
    members = read_members(shard, sample.members, (*wanted, "json"))
    try:
        columns: dict[str, Any] = {
            name.removesuffix(".npy"): np.load(io.BytesIO(members[name]), allow_pickle=False)
            for name in wanted
            if name in members
        }
        columns["t"] = columns["t"].astype(np.int64)
        size = SensorSize(sample.width, sample.height)
        return EventStream(**columns, size=size, metadata=json.loads(members["json"]))
    except (KeyError, ValueError, TypeError, EOFError, InputError) as error:
        raise FileFormatError(
            f"{shard}: sample {sample.key} is damaged ({one_line(error)})"
        ) from error


def read_sample_facts(shard: Path, sample: SampleRecord) -> dict[str, Any]:
    """All that is known of a sample: its .json.

    Raises:
        FileFormatError: the shard is cut off or changed.
    """
    content = read_members(shard, sample.members, ("json",)).get("json", b"")
    try:
        facts = json.loads(content)
    except ValueError as error:
        raise FileFormatError(
            f"{shard}: sample {sample.key} is damaged ({one_line(error)})"
        ) from error
    if not isinstance(facts, dict):
        raise FileFormatError(f"{shard}: the facts of sample {sample.key} are no table")
    return facts
