"""What is known of a shard that is complete: a JSON file beside it, written last."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, one_line
from texvent.io.atomic import atomic_file

MADE, FILTERED, FAILED = "made", "filtered", "failed"
LAYOUT = 1


@dataclass(frozen=True, kw_only=True)
class SampleRecord:
    """What became of one sample."""

    key: str
    clip: str
    """Key of its video; all variants of it share this."""
    status: str
    """made, filtered (left out by the filters) or failed."""
    seed: int
    """Of its simulation; of its video in a shard of videos."""
    prompt: str | None = None
    label: str | None = None
    is_scene: bool = False
    """Whether it shows a scene file, of which others may have the same prompt."""
    reason: str | None = None
    """Why it is not there."""
    warnings: tuple[str, ...] = ()
    """What is hardly meant, such as words that are not understood."""
    prompt_report: Mapping[str, Any] | None = None
    """What became of the prompt's words, a `PromptReport` as JSON; None where it is not known."""
    events: int = 0
    """That are stored."""
    signal_events: int = 0
    """That the video fired, noise apart; also known of a sample that the filters leave out."""
    duration_us: int = 0
    start_us: int = 0
    """Time of the first frame: 0, but for clips cut from a longer video."""
    width: int = 0
    height: int = 0
    members: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    """Extension → position of its content in the shard, and bytes."""


@dataclass(frozen=True, kw_only=True)
class ShardSummary:
    """The counts of a complete shard; small, where its record is not."""

    made: int
    filtered: int
    failed: int
    events: int
    bytes: int
    seconds: float

    @property
    def samples(self) -> int:
        """All of them, also those that are not there."""
        return self.made + self.filtered + self.failed


@dataclass(frozen=True, kw_only=True)
class ShardRecord:
    """A complete shard."""

    name: str
    """Such as "train-000012"."""
    split: str
    variant: str
    """"videos" for shards of videos."""
    identity: str
    """Of the data set that it belongs to; see `Recipe.identity`."""
    sha256: str
    bytes: int
    samples: tuple[SampleRecord, ...]
    seconds: float
    """How long it took."""
    versions: Mapping[str, str] = field(default_factory=dict)
    """Package → version, of the process that made it."""
    layout: int = LAYOUT

    def count(self, status: str) -> int:
        """How many of its samples have a status."""
        return sum(sample.status == status for sample in self.samples)

    @property
    def events(self) -> int:
        """Events of all its samples."""
        return sum(sample.events for sample in self.samples)

    @property
    def summary(self) -> ShardSummary:
        """Its counts."""
        return ShardSummary(
            made=self.count(MADE),
            filtered=self.count(FILTERED),
            failed=self.count(FAILED),
            events=self.events,
            bytes=self.bytes,
            seconds=self.seconds,
        )


def record_path(shard: Path) -> Path:
    """Where the record of a shard lies."""
    return shard.with_suffix(".json")


def write_record(shard: Path, record: ShardRecord) -> None:
    """Write the record of a shard, which makes it complete."""
    tables = asdict(record)
    for sample in tables["samples"]:
        if not sample["is_scene"]:  # which versions before scene files do not know
            del sample["is_scene"]
    text = json.dumps(tables, ensure_ascii=False, separators=(",", ":"))
    with atomic_file(record_path(shard), overwrite=True) as part:
        part.write_text(text + "\n", encoding="utf-8")


def read_record(shard: Path) -> ShardRecord | None:
    """The record of a shard, or None if it has none.

    Raises:
        FileFormatError: it is damaged.
    """
    path = record_path(shard)
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return None
    except UnicodeDecodeError as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)}); {REMEDY}") from error
    try:
        tables = json.loads(text)
        samples = tuple(_sample(one) for one in tables.pop("samples"))
        known = {one.name for one in fields(ShardRecord)}
        return ShardRecord(samples=samples, **{k: v for k, v in tables.items() if k in known})
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)}); {REMEDY}") from error


REMEDY = "delete it, and texvent dataset make makes its shard again"


def _sample(tables: Mapping[str, Any]) -> SampleRecord:
    members = {name: (int(begin), int(size)) for name, (begin, size) in tables["members"].items()}
    return SampleRecord(
        **{**tables, "members": members, "warnings": tuple(tables.get("warnings", ()))}
    )
