"""The events of a stored sample, and the facts beside them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from texvent.dataset.contents.npy_columns import COLUMN_MEMBERS, events_of, npy_column
from texvent.dataset.generation.records import SampleRecord
from texvent.dataset.generation.tar_shard import read_members
from texvent.errors import FileFormatError, InputError, one_line
from texvent.events import EventStream
from texvent.sensor import SensorSize


def read_events(shard: Path, sample: SampleRecord) -> EventStream:
    """The events of a sample, checked, with all that is known of them as metadata.

    Args:
        shard: the tar.
        sample: its record.

    Raises:
        FileFormatError: the shard is cut off or changed, or the events are not sound.
    """
    members = read_members(shard, sample.members, COLUMN_MEMBERS)
    try:
        columns = {
            name.removesuffix(".npy"): npy_column(memoryview(content))
            for name, content in members.items()
        }
        events = events_of(columns, SensorSize(sample.width, sample.height))
    except InputError as error:
        raise FileFormatError(f"{shard}: sample {sample.key} is damaged ({error})") from error
    return events.with_metadata(read_sample_facts(shard, sample))


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
