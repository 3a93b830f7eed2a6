"""Statistics of a data set, counted from its records: samples, events, rates, classes, failures."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from texvent.dataset.generation.shard_files import (
    FAILED,
    FILTERED,
    MADE,
    SampleRecord,
    ShardRecord,
)
from texvent.dataset.stored.folder import StoredDataset, StoredShard
from texvent.errors import few
from texvent.prompt_report import PromptReport, ReportTally, ranked
from texvent.truth.boxes import SIZE_CLASSES

QUANTILES = (0.05, 0.5, 0.95)
MOST_REASONS = 10
MOST_CLASSES = 12
MICROSECONDS = 1_000_000
COUNTS = ("variant", "split", "samples", "left out", "failed", "events", "median events",
          "median s", "median events/s", "MB")  # fmt: skip


@dataclass
class Statistics:
    """Counts of all shards, of a variant, of a split of one, or of a trial."""

    shards: int = 0
    bytes: int = 0
    seconds: float = 0.0
    """Working time that the shards took."""
    left_out: int = 0
    """Samples that the filters leave out."""
    failed: int = 0
    events: list[int] = field(default_factory=list)
    """Number of events of each sample."""
    durations_us: list[int] = field(default_factory=list)
    """Duration of each sample, µs."""
    clips: set[str] = field(default_factory=set)
    classes: Counter[str] = field(default_factory=Counter)
    sensors: Counter[str] = field(default_factory=Counter)
    reasons: Counter[str] = field(default_factory=Counter)
    """Reasons of filtering and failure. Those that differ in numbers alone are counted as the first
    of them, as are warnings."""
    warnings: Counter[str] = field(default_factory=Counter)
    firsts: dict[str, str] = field(default_factory=dict)
    """Reason or warning without its numbers → the first of these."""
    boxes: Counter[str] = field(default_factory=Counter)
    """Class → boxes."""
    box_sizes: Counter[str] = field(default_factory=Counter)
    """COCO's size class, by area → boxes."""
    tracks: int = 0
    """Objects with boxes, of all samples."""
    unboxed: Counter[str] = field(default_factory=Counter)
    """Object that `classes` leaves out → samples whose scene has one."""
    with_truth: int = 0
    """Samples that store boxes."""
    without_boxes: int = 0
    """Those of them that have none."""
    reports: ReportTally = field(default_factory=ReportTally)
    """Understood and other words of prompts; each clip counts once over all variants."""
    reported: set[str] = field(default_factory=set)
    """Clips with a report."""
    unreported: set[str] = field(default_factory=set)
    """Clips of samples that failed, with no report."""
    versions: Counter[str] = field(default_factory=Counter)
    """Version of texvent → shards."""

    @classmethod
    def of(cls, records: Iterable[ShardRecord]) -> Statistics:
        """Count some shards."""
        statistics = cls()
        for record in records:
            statistics.add(record)
        return statistics

    def add(self, record: ShardRecord) -> None:
        """Count a shard."""
        self.shards += 1
        self.bytes += record.bytes
        self.seconds += record.seconds
        self.failed += record.count(FAILED)
        self.left_out += record.count(FILTERED)
        self.versions[record.versions.get("texvent", "unknown")] += 1
        for sample in record.samples:
            self.warnings.update(map(self._first_like, sample.warnings))
            self._add_report(sample)
            if sample.status == FILTERED:
                self.reasons[f"left out: {sample.reason}"] += 1
            if sample.status == FAILED:
                self.reasons[f"failed: {self._first_like(sample.reason or '')}"] += 1
            if sample.status != MADE:
                continue
            self.events.append(sample.events)
            self.durations_us.append(sample.duration_us)
            self.clips.add(sample.clip)
            self.sensors[f"{sample.width}x{sample.height}"] += 1
            if sample.label is not None:
                self.classes[sample.label] += 1
            if sample.boxes is not None:
                self._add_boxes(sample.boxes, sample.tracks)
            self.unboxed.update(sample.unboxed)

    def _first_like(self, text: str) -> str:
        return self.firsts.setdefault(without_numbers(text), text)

    def _add_boxes(self, boxes: Mapping[str, Sequence[int]], tracks: int) -> None:
        self.with_truth += 1
        self.without_boxes += not boxes
        self.tracks += tracks
        for name, counts in boxes.items():
            self.boxes[name] += sum(counts)
            self.box_sizes.update(dict(zip(SIZE_CLASSES, counts, strict=True)))

    def _add_report(self, sample: SampleRecord) -> None:
        if sample.prompt_report is None:
            if sample.status == FAILED:
                self.unreported.add(sample.clip)
        elif sample.clip not in self.reported:
            self.reported.add(sample.clip)
            self.reports.add(PromptReport.from_json(sample.prompt_report))

    @property
    def samples(self) -> int:
        """Number of samples."""
        return len(self.events)

    @property
    def prompts(self) -> ReportTally | None:
        """Counts of clips that show what their prompts say; one that could not be made is refused.

        None for videos, for learned generators, and where every clip failed.
        """
        if not self.reported:
            return None
        refused = len(self.unreported - self.reported)
        return replace(self.reports, prompts=self.reports.prompts + refused, refused=refused)

    @property
    def rates(self) -> list[float]:
        """Events per second of each sample that lasts."""
        pairs = zip(self.events, self.durations_us, strict=True)
        return [events / us * MICROSECONDS for events, us in pairs if us]

    @property
    def tables(self) -> dict[str, Any]:
        """Plain values, ready for JSON."""
        return {
            "samples": self.samples,
            "left_out": self.left_out,
            "failed": self.failed,
            "clips": len(self.clips),
            "shards": self.shards,
            "bytes": self.bytes,
            "working_seconds": round(self.seconds, 1),
            "events": sum(self.events),
            "duration_s": sum(self.durations_us) / MICROSECONDS,
            "events_per_sample": quantiles(self.events),
            "duration_s_per_sample": quantiles([us / MICROSECONDS for us in self.durations_us]),
            "events_per_second": quantiles(self.rates),
            "sensors": dict(sorted(self.sensors.items())),
            "classes": dict(sorted(self.classes.items())),
            **self._box_tables,
            "reasons": dict(self.reasons.most_common(MOST_REASONS)),
            "warnings": dict(self.warnings.most_common(MOST_REASONS)),
            "prompts": (self.prompts or ReportTally()).tables,
            "texvent_versions": dict(sorted(self.versions.items())),
        }

    @property
    def _box_tables(self) -> dict[str, Any]:
        if not self.with_truth:
            return {}
        return {
            "boxes": dict(sorted(self.boxes.items())),
            "boxes_by_size": {name: self.box_sizes[name] for name in SIZE_CLASSES},
            "unboxed": dict(sorted(self.unboxed.items())),
            "tracks": self.tracks,
            "samples_without_boxes": self.without_boxes / self.with_truth,
        }


@dataclass(frozen=True)
class DatasetStatistics:
    """Statistics of a data set, counted in one pass."""

    total: Statistics
    parts: dict[tuple[str, str], Statistics]
    """(variant, split) → its own, in the order of the shards."""

    @classmethod
    def of(cls, dataset: StoredDataset) -> DatasetStatistics:
        """Read all records.

        Raises:
            FileFormatError: one is damaged.
        """
        total, parts = Statistics(), dict[tuple[str, str], Statistics]()
        for shard in dataset.shards():
            total.add(shard.record)
            place = shard.record.variant, shard.record.split
            parts.setdefault(place, Statistics()).add(shard.record)
        return cls(total, parts)

    @property
    def class_counts(self) -> dict[str, Counter[str]]:
        """Split → number of samples of each class, over all variants."""
        counts: dict[str, Counter[str]] = {}
        for (_, split), part in self.parts.items():
            counts.setdefault(split, Counter()).update(part.classes)
        return counts

    @property
    def box_counts(self) -> dict[str, Counter[str]]:
        """Split → number of boxes of each class, over all variants."""
        counts: dict[str, Counter[str]] = {}
        for (_, split), part in self.parts.items():
            if part.with_truth:
                counts.setdefault(split, Counter()).update(part.boxes)
        return counts

    def lacking_boxes(self, classes: Iterable[str]) -> list[str]:
        """Warnings of splits that show no box of some classes, which other splits show."""
        return lacking_lines(self.box_counts, [one for one in classes if self.total.boxes[one]])

    @property
    def tables(self) -> dict[str, Any]:
        """Plain values, ready for JSON."""
        variants: dict[str, Any] = {}
        for (variant, split), part in self.parts.items():
            variants.setdefault(variant, {})[split] = part.tables
        return {"total": self.total.tables, "variants": variants}


def counts_rows(statistics: DatasetStatistics) -> list[list[str]]:
    """Cells for `COUNTS`: a row for each split of each variant."""
    rows = []
    for (variant, split), part in statistics.parts.items():
        facts = part.tables
        medians = (
            facts[name].get("median", 0.0)
            for name in ("events_per_sample", "duration_s_per_sample", "events_per_second")
        )
        counts = (part.samples, part.left_out, part.failed, facts["events"])
        rows.append(
            [
                *(variant, split),
                *(f"{count:,}" for count in counts),
                *map(number_text, medians),
                f"{part.bytes / 1e6:,.2f}",
            ]
        )
    return rows


def class_lines(counts: Mapping[str, Counter[str]], title: str = "class") -> list[str]:
    """A table of classes and splits, the most frequent classes first; nothing without classes.

    Example:
        >>> counts = {"train": Counter(left=12, right=8), "val": Counter(left=3)}
        >>> print(*class_lines(counts), sep=chr(10))
        class  train  val
        left      12    3
        right      8    0
    """
    total = sum(counts.values(), Counter[str]())
    names = [name for name, _ in ranked(total)]
    if not names:
        return []
    rows = [[title, *counts]]
    rows += [[one, *(f"{of[one]:,}" for of in counts.values())] for one in names[:MOST_CLASSES]]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ["  ".join([row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])])
             for row in rows]  # fmt: skip
    more = len(names) - MOST_CLASSES
    return [*lines, f"... {more:,} more"] if more > 0 else lines


def lacking_lines(counts: Mapping[str, Counter[str]], classes: Sequence[str]) -> list[str]:
    """Warnings of splits that lack some of `classes`.

    Example:
        >>> lacking_lines({"train": Counter(car=9, bus=1), "val": Counter(car=2)}, ["car", "bus"])
        ['warning  val has no bus']
    """
    return [
        f"warning  {split} has no {few(lacks)}"
        for split, of in counts.items()
        if (lacks := [one for one in classes if not of[one]])
    ]


def quantiles(values: Sequence[float]) -> dict[str, float]:
    """Mean, 5 %, median, 95 %, least and most; nothing of no values."""
    if not values:
        return {}
    low, middle, high = np.quantile(values, QUANTILES)
    facts = {"mean": np.mean(values), "p5": low, "median": middle, "p95": high,
             "min": min(values), "max": max(values)}  # fmt: skip
    return {name: float(f"{value:.7g}") for name, value in facts.items()}


def number_text(value: float) -> str:
    """Three digits, or all before the point.

    Example:
        >>> number_text(0.08333), number_text(23894.5)
        ('0.0833', '23,894')
    """
    return f"{value:,.0f}" if value >= 1000 else f"{value:.3g}"


def without_numbers(text: str) -> str:
    """A message with N for its numbers, so that equal ones count together.

    Example:
        >>> without_numbers("frame 12 of 1,000 is damaged")
        'frame N of N is damaged'
    """
    return re.sub(r"\b\d[\d,.]*\b", "N", text)


def in_several_splits(shards: Iterable[StoredShard]) -> set[str]:
    """Prompts, or videos, with samples in several splits, so that tests see training data."""
    split_of: dict[str, str] = {}
    found = set()
    for shard in shards:
        for sample in shard.samples:
            shows = sample.clip if sample.is_scene else sample.prompt or sample.clip
            if split_of.setdefault(shows, shard.record.split) != shard.record.split:
                found.add(shows)
    return found


def summary_lines(statistics: Statistics, classes: Iterable[str] = ()) -> list[str]:
    """The counts of a data set, of a part of it, or of the trial of a plan, for people.

    Of `classes` of boxes, those that no sample shows are named.

    Example:
        >>> summary_lines(Statistics())
        ['samples  0 made, 0 left out, 0 failed']
    """
    lines = [
        f"samples  {statistics.samples:,} made, {statistics.left_out:,} left out, "
        f"{statistics.failed:,} failed"
    ]
    for reason, count in ranked(statistics.reasons)[:MOST_REASONS]:
        kind, _, why = reason.partition(": ")
        lines.append(f"{kind:8} {count:,}: {why}")
    for warning, count in ranked(statistics.warnings)[:MOST_REASONS]:
        lines.append(f"warning  {count:,}: {warning}")
    if statistics.with_truth:
        lines += _box_lines(statistics)
        missing = [name for name in classes if not statistics.boxes[name]]
        lines += [f"warning  no sample shows: {few(missing)}"] if missing else []
    if statistics.prompts is not None:
        lines.append(f"prompts  {statistics.prompts.line('clips')}")
    return lines


def _box_lines(statistics: Statistics) -> list[str]:
    classes = "; ".join(f"{name} {count:,}" for name, count in ranked(statistics.boxes))
    sizes = ", ".join(f"{statistics.box_sizes[name]:,} {name}" for name in SIZE_CLASSES)
    share = statistics.without_boxes / statistics.with_truth
    objects = f" of {statistics.tracks:,} objects" if statistics.tracks else ""
    lines = [
        f"boxes    {sum(statistics.boxes.values()):,}{objects}: {classes or 'none'}",
        f"sizes    {sizes} (COCO's, by area: below 32² and 96² px)",
        f"no box   in {100 * share:.0f} % of samples",
    ]
    if statistics.unboxed:
        names = [f"{name} {count:,}" for name, count in ranked(statistics.unboxed)]
        lines.append(f"no box   of {few(names)} (samples with them): classes leaves them out")
    return lines
