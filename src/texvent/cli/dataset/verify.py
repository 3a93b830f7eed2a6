"""`texvent dataset verify DIR`: every file and every sample of a data set checked."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.verify import Findings, verify
from texvent.runtime.threads import count_threads

MOST_LINES = 20
DESCRIPTION = """Check a data set, or a published copy of one: hash every shard, read every sample,
and say what is missing, changed, foreign, there twice or damaged.

Exit code: 0 all is well, 1 something is not."""
TITLES = {
    "missing": "missing or not complete",
    "changed": "changed",
    "foreign": "not of this data set",
    "twice": "keys of several samples",
    "unsound": "damaged samples",
}


@dataclass(frozen=True, kw_only=True)
class VerifyOptions:
    """What to check."""

    positional: ClassVar[tuple[str, ...]] = ("folder",)

    folder: Path = REQUIRED
    """Folder of the data set."""
    contents: bool = True
    """Whether samples are read too, or digests of shards compared alone."""
    workers: int | None = None
    """Threads that read; default: one per core."""
    json: bool = False
    """Print JSON."""

    def __post_init__(self) -> None:
        check_range("workers", self.workers, 1, 1024)


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments,
        {"data set": VerifyOptions()},
        prog="texvent dataset verify",
        description=DESCRIPTION,
    )
    workers = count_threads() if options.workers is None else options.workers
    findings = verify(
        StoredDataset.open(options.folder), workers=workers, contents=options.contents
    )
    if options.json:
        facts = {**dataclasses.asdict(findings), "is_sound": findings.is_sound}
        write_out(json.dumps(facts, indent=1) + "\n")
    else:
        write_out("".join(f"{line}\n" for line in _lines(options, findings)))
    return 0 if findings.is_sound else 1


def _lines(options: VerifyOptions, findings: Findings) -> Iterator[str]:
    for kind, problems in findings.problems():
        if problems:
            yield f"{TITLES[kind]}: {len(problems)}"
            yield from (f"  {one}" for one in problems[:MOST_LINES])
            if len(problems) > MOST_LINES:
                yield f"  and {len(problems) - MOST_LINES} more; --json names all"
    yield from (f"note: {note}" for note in findings.notes[:MOST_LINES])
    read = "every sample read" if options.contents else "samples not read"
    yield (
        f"{options.folder}: {findings.shards:,} shards hashed, {read}: {findings.samples:,} "
        f"samples, {findings.events:,} events, {findings.filtered:,} left out, "
        f"{findings.failed:,} failed; {'all is well' if findings.is_sound else 'NOT SOUND'}"
    )
