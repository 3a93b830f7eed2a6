"""Steps of `texvent dataset` that read one: verify, stats, sample, export."""

from __future__ import annotations

import dataclasses
import json
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.dataset.export import LAYOUTS, export
from texvent.dataset.statistics import (
    COUNTS,
    MICROSECONDS,
    DatasetStatistics,
    class_lines,
    counts_rows,
    lacking_lines,
    summary_lines,
)
from texvent.dataset.stored.folder import StoredDataset
from texvent.dataset.verify import Findings, verify
from texvent.errors import ConfigError
from texvent.prompt_report import ranked
from texvent.runtime.files.file_names import inside
from texvent.runtime.threads import count_threads

MOST_LINES, MOST_SENSORS = 20, 12
WIDTH = 110
"""Width of the table of counts, which has ten columns, also where there is no terminal."""
TITLES = {
    "missing": "missing or not complete",
    "changed": "changed",
    "foreign": "not of this data set",
    "unsound": "damaged samples",
}
ABOUT = {
    "verify": """Check a data set, or a published copy of one: hash every shard, read every sample,
and say what is missing, changed, foreign or damaged.

Exit code: 0 all is well, 1 something is not.""",
    "stats": """Count what a data set holds, while it is made or afterwards: samples, events, rates,
classes, missing shards, and why samples are not there. Records are read, not samples.""",
    "sample": """Look at some samples, drawn by chance: a page (HTML) with images, captions and all
facts.

  texvent dataset sample cars
  texvent dataset sample cars --variant paper --label bus -n 60 -o buses.html""",
    "export": f"""Write the samples of a data set in another layout: {", ".join(LAYOUTS)}. What a
layout cannot hold is said. A stopped export goes on when it is run again.

  texvent dataset export cars --layout hdf5 -o cars-h5       one file per sample, with everything
  texvent dataset export cars --layout rvt --classes car,pedestrian -o cars-rvt""",
}


def _parse(step: str, arguments: Sequence[str], options: Any) -> Any:
    (parsed,) = parse_configs(
        arguments, {"data set": options}, prog=f"texvent dataset {step}", description=ABOUT[step]
    )
    return parsed


@dataclass(frozen=True, kw_only=True)
class StoredOptions:
    """Data set to read."""

    positional: ClassVar[tuple[str, ...]] = ("folder",)
    outputs: ClassVar[tuple[str, ...]] = ("folder",)

    folder: Path = REQUIRED
    """Folder of the data set."""


@dataclass(frozen=True, kw_only=True)
class JsonOptions(StoredOptions):
    """Data set to read."""

    json: bool = False
    """Print JSON."""


@dataclass(frozen=True, kw_only=True)
class VerifyOptions(JsonOptions):
    """Extent of the check."""

    contents: bool = True
    """Whether samples are read too, or digests of shards compared alone."""
    workers: int | None = None
    """Threads that read; default: one per core."""

    def __post_init__(self) -> None:
        check_range("workers", self.workers, 1, 1024)


def run_verify(arguments: Sequence[str]) -> int:
    """Run `texvent dataset verify`; returns its exit code."""
    options = _parse("verify", arguments, VerifyOptions())
    workers = count_threads() if options.workers is None else options.workers
    dataset = StoredDataset.open(options.folder)
    findings = verify(dataset, workers=workers, contents=options.contents)
    if options.json:
        facts = {**dataclasses.asdict(findings), "is_sound": findings.is_sound}
        write_out(json.dumps(facts, indent=1) + "\n")
    else:
        write_out("".join(f"{line}\n" for line in _finding_lines(options, findings)))
    return 0 if findings.is_sound else 1


def _finding_lines(options: VerifyOptions, findings: Findings) -> Iterator[str]:
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


def run_stats(arguments: Sequence[str]) -> int:
    """Run `texvent dataset stats`; returns its exit code."""
    options = _parse("stats", arguments, JsonOptions())
    dataset = StoredDataset.open(options.folder)
    statistics = DatasetStatistics.of(dataset)
    if options.json:
        facts = {**statistics.tables, "missing_shards": len(dataset.missing())}
        write_out(json.dumps(facts, indent=1, ensure_ascii=False) + "\n")
    else:
        _print_counts(dataset, statistics)
    return 0


def _print_counts(dataset: StoredDataset, statistics: DatasetStatistics) -> None:
    console = Console(file=sys.stdout, highlight=False, soft_wrap=True, width=WIDTH)
    table = Table(box=None, pad_edge=False)
    for number, title in enumerate(COUNTS):
        table.add_column(title, justify="left" if number < 2 else "right")
    for row in counts_rows(statistics):
        table.add_row(*map(escape, row))
    console.print(table)
    total = statistics.total
    counts = statistics.class_counts
    for line in class_lines(counts):
        console.print(escape(line))
    boxes = statistics.box_counts
    for line in class_lines(boxes, "boxes of"):
        console.print(escape(line))
    if dataset.is_shared_out and not dataset.missing():
        lacks = lacking_lines(counts, dataset.labels)
        for line in (*lacks, *statistics.lacking_boxes(dataset.box_classes)):
            console.print(escape(line))
    sensors = [f"{name} {count:,}" for name, count in ranked(total.sensors)]
    if sensors:
        more = f" and {len(sensors) - MOST_SENSORS} more" if len(sensors) > MOST_SENSORS else ""
        console.print(escape(f"sensors: {'; '.join(sensors[:MOST_SENSORS])}{more}"))
    for line in summary_lines(total, dataset.box_classes):
        console.print(escape(line))
    console.print(
        f"{escape(dataset.name)}: {total.samples:,} samples of {len(total.clips):,} videos, "
        f"{sum(total.events):,} events in {sum(total.durations_us) / MICROSECONDS:,.1f} s, "
        f"{total.bytes / 1e6:,.1f} MB in {total.shards:,} shards, made in "
        f"{total.seconds / 3600:,.2f} hours of one process; {len(dataset.missing()):,} shards are "
        "missing"
    )


@dataclass(frozen=True, kw_only=True)
class SampleOptions(StoredOptions):
    """Samples to show."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "count": "-n"}
    outputs: ClassVar[tuple[str, ...]] = ("folder", "out")

    out: Path | None = None
    """The page, .html. Default: samples.html in the folder."""
    count: int = 24
    """Number of samples."""
    variant: str | None = None
    """Samples of this variant only."""
    split: str | None = None
    """Samples of this split only."""
    label: str | None = None
    """Samples of this class only."""
    seed: int = 0
    """Another draws others."""
    overwrite: bool = False
    """Replace files that exist."""

    def __post_init__(self) -> None:
        check_range("count", self.count, 1, 1000)
        check_range("seed", self.seed, 0, 2**63 - 1)


def run_sample(arguments: Sequence[str]) -> int:
    """Run `texvent dataset sample`; returns its exit code."""
    from texvent.dataset.preview import choose_samples, write_sample_page  # brings OpenCV

    options = _parse("sample", arguments, SampleOptions())
    out = inside(options.folder, "samples.html") if options.out is None else options.out
    if out.suffix.lower() not in (".html", ".htm"):
        raise ConfigError(f"out is {out}; name a page, .html")
    dataset = StoredDataset.open(options.folder)
    samples = choose_samples(
        dataset,
        options.count,
        variant=options.variant,
        split=options.split,
        label=options.label,
        seed=options.seed,
    )
    write_sample_page(dataset, samples, out, overwrite=options.overwrite)
    write_out(f"{len(samples)} samples of {dataset.name}: {out}\n")
    return 0


@dataclass(frozen=True, kw_only=True)
class ExportOptions(StoredOptions):
    """Layout and its folder."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o"}
    outputs: ClassVar[tuple[str, ...]] = ("out",)

    layout: str = "hdf5"
    """Name of the layout."""
    out: Path | None = None
    """Folder to write."""
    variant: str | None = None
    """Variant; needed where there are several."""
    classes: str | None = None
    """Classes of boxes in the order of their numbers, others are left out: car,pedestrian; a name
    may gather some: vehicle=car+bus. Default: those of the layout, or of the data set."""


def run_export(arguments: Sequence[str]) -> int:
    """Run `texvent dataset export`; returns its exit code."""
    options = _parse("export", arguments, ExportOptions())
    if options.out is None:
        raise ConfigError("export needs the folder to write; name it with -o")
    dataset = StoredDataset.open(options.folder)
    done = export(
        dataset,
        options.layout,
        options.out,
        variant=options.variant,
        classes=options.classes,
    )
    kept = f" ({done.kept:,} were there)" if done.kept else ""
    write_out(f"{options.out}: {done.samples:,} samples as {options.layout}{kept}\n")
    if done.classes:
        write_out(f"classes of boxes, in the order of their numbers: {', '.join(done.classes)}\n")
    for doubt in done.doubts:
        write_out(f"note: {doubt}\n")
    return 0
