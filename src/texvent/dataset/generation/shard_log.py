"""The log of a shard at work: a line for each sample, read by `texvent dataset status`."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

from texvent.dataset.generation.recipe import Shard
from texvent.dataset.generation.records import FAILED, SampleRecord

LOGS = "logs"


@dataclass(frozen=True)
class LogState:
    """How far a shard at work is."""

    samples: int
    events: int
    failed: int
    changed_s: float
    """Unix time of the last line."""


def log_path(folder: Path, shard: Shard) -> Path:
    """Where the log of a shard lies."""
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


def read_log(folder: Path, shard: Shard) -> LogState | None:
    """How far a shard is, or None if it has not begun."""
    path = log_path(folder, shard)
    try:
        text, changed = path.read_text(encoding="utf-8"), path.stat().st_mtime
    except OSError:
        return None
    words = [line.split() for line in StringIO(text)]
    lines = [line for line in words if len(line) >= 6]
    return LogState(
        samples=len(lines),
        events=sum(int(line[4]) for line in lines if line[4].isdigit()),
        failed=sum(line[2] == FAILED for line in lines),
        changed_s=changed,
    )
