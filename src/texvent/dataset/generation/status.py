"""Progress of a data set, read from its folder while it is made or afterwards."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from texvent.dataset.generation.make_shard import is_complete
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard
from texvent.dataset.generation.shards import FAILED, FILTERED, SampleRecord, ShardRecord

LOGS = "logs"


def log_path(folder: Path, shard: Shard) -> Path:
    """Path of the log of a shard."""
    return folder / LOGS / shard.variant / f"{shard.name}.log"


@contextmanager
def shard_log(folder: Path, shard: Shard) -> Iterator[Callable[[SampleRecord], None]]:
    """A function that notes the samples of a shard as they end."""
    path = log_path(folder, shard)
    path.parent.mkdir(parents=True, exist_ok=True)
    started = time.monotonic()
    with path.open("w", encoding="utf-8", buffering=1) as file:

        def note(sample: SampleRecord) -> None:
            what = [sample.reason] if sample.reason else []
            what += [f"warning: {warning}" for warning in sample.warnings]
            file.write(
                f"{time.monotonic() - started:9.2f} s  {sample.status:8} {sample.key} "
                f"{sample.events:>10} events  {'; '.join(what)}\n"
            )

        yield note


QUIET_S = 600.0
"""A shard without news for this long counts as given up."""


@dataclass
class StageStatus:
    """The videos, or a variant."""

    name: str
    total: int
    """Samples in all."""
    shards: int
    """Shards in all."""
    samples: int = 0
    """Done: made, left out or failed."""
    filtered: int = 0
    failed: int = 0
    events: int = 0
    bytes: int = 0
    complete: int = 0
    """Complete shards."""
    at_work: int = 0
    """Shards being made."""
    seconds: float = 0.0
    """Working time of complete shards."""

    def add(self, record: ShardRecord) -> None:
        """Count a complete shard."""
        self.complete += 1
        self.samples += len(record.samples)
        self.failed += record.count(FAILED)
        self.filtered += record.count(FILTERED)
        self.events += record.events
        self.bytes += record.bytes
        self.seconds += record.seconds


def read_status(recipe: Recipe, folder: Path) -> list[StageStatus]:
    """The state of every stage: the videos, if they are stored, then the variants.

    Args:
        recipe: of the data set.
        folder: of the data set.

    Raises:
        FileFormatError: the record of a shard is damaged.
    """
    clips = sum(recipe.clips.counts.values())
    stages = []
    for name in recipe.stages:
        seeds = 1 if name == VIDEOS else recipe.variants[name].seeds
        stage = StageStatus(name, clips * seeds, 0)
        for shard in recipe.shards(name):
            stage.shards += 1
            record = is_complete(recipe, folder, shard)
            if record is not None:
                stage.add(record)
            elif _is_at_work(log_path(folder, shard)):
                stage.at_work += 1
        stages.append(stage)
    return stages


def _is_at_work(log: Path) -> bool:
    """True if a log has news."""
    try:
        return time.time() - log.stat().st_mtime < QUIET_S
    except OSError:
        return False
