"""Counts equal those of the samples themselves."""

from __future__ import annotations

import shutil
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from texvent.cli.dataset.stored import _print_counts
from texvent.dataset.generation.dry_run import StageEstimate
from texvent.dataset.generation.shard_files import (
    FAILED,
    MADE,
    SampleRecord,
    ShardRecord,
    read_record,
    write_record,
)
from texvent.dataset.statistics import DatasetStatistics, Statistics, quantiles, summary_lines
from texvent.dataset.stored.folder import StoredDataset
from texvent.prompt_report import PromptReport


def test_counts_are_those_of_the_samples(cars: Path) -> None:
    statistics = DatasetStatistics.of(StoredDataset.open(cars))
    total = statistics.total
    events = [
        len(shard.files(sample).events())
        for shard in StoredDataset.open(cars).shards()
        for sample in shard.samples
    ]
    assert total.events == events
    assert total.samples == 9
    assert len(total.clips) == 3
    assert sum(total.classes.values()) == 9
    assert dict(total.sensors) == {"32x24": 9}
    assert total.rates == pytest.approx(
        [count / us * 1e6 for count, us in zip(events, total.durations_us, strict=True)]
    )
    assert {place: part.samples for place, part in statistics.parts.items()} == {
        ("paper", "train"): 4,
        ("paper", "test"): 2,
        ("esim", "train"): 2,
        ("esim", "test"): 1,
    }
    assert any("not understood" in warning for warning in total.warnings)


def test_reasons_and_warnings_count_together_and_are_said(copied: Path) -> None:
    shard = copied / "paper" / "train-000000.tar"
    record = read_record(shard)
    assert record is not None
    failed = [
        replace(sample, status=FAILED, reason=f"frame {n} fails", warnings=(f"{n} Hz",), members={})
        for n, sample in enumerate(record.samples)
    ]
    write_record(shard, replace(record, samples=tuple(failed)))
    total = DatasetStatistics.of(StoredDataset.open(copied)).total
    assert total.failed == len(failed)
    assert dict(total.reasons) == {"failed: frame 0 fails": len(failed)}
    assert summary_lines(total)[1:3] == [
        f"failed   {len(failed)}: frame 0 fails",
        f"warning  {len(failed)}: 0 Hz",
    ]


def test_boxes_and_reports_are_counted_by_hand() -> None:
    report = PromptReport(not_understood=("wug",)).to_json()
    sample = SampleRecord(key="a", clip="c", status=MADE, seed=1, tracks=2, prompt_report=report,
                          boxes={"car": (1, 2, 4)})  # fmt: skip
    samples = (sample, replace(sample, key="b"), replace(sample, key="d", clip="e", boxes={}))
    record = ShardRecord(name="train-000000", split="train", variant="v", identity="i", sha256="",
                         bytes=1, samples=samples, seconds=1.0)  # fmt: skip
    total = Statistics.of([record])
    assert (total.boxes, total.tracks, total.without_boxes) == ({"car": 14}, 6, 1)
    assert total.box_sizes == {"small": 2, "medium": 4, "large": 8}
    assert total.reports.prompts == 2  # a clip counts once
    trial = StageEstimate("v", 3, (record, replace(record, samples=samples[:1])), 0.0, 0.0, 0.0)
    assert (trial.tried, trial.share(MADE), trial.share(FAILED)) == (4, 1.0, 0.0)


def test_quantiles_by_hand() -> None:
    assert quantiles([]) == {}
    facts = quantiles([1, 2, 3, 4, 100])
    assert (facts["mean"], facts["median"], facts["min"], facts["max"]) == (22.0, 3.0, 1.0, 100.0)


def test_a_shard_of_another_set_is_not_counted(copied: Path) -> None:
    for suffix in (".tar", ".json"):
        own = copied / "esim" / f"train-000000{suffix}"
        shutil.copy(own, own.with_stem("train-000007"))
    assert DatasetStatistics.of(StoredDataset.open(copied)).total.samples == 9


def test_the_first_sensors_are_named_where_there_are_any(
    cars: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    dataset = StoredDataset.open(cars)
    for count in (0, 1, 12, 14):
        statistics = DatasetStatistics.of(dataset)
        statistics.total.sensors = Counter({f"{10 + side}x8": 1 for side in range(count)})
        _print_counts(dataset, statistics)
        told = capsys.readouterr().out
        assert ("sensors:" in told, told.count("x8 1")) == (count > 0, min(count, 12))
        assert (" and 2 more\n" in told) == (count == 14)
