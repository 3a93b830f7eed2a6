"""Counts equal those of the samples themselves."""

import shutil
from collections import Counter
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.cli.dataset.stored import _print_counts
from texvent.dataset.generation.dry_run import StageEstimate
from texvent.dataset.generation.shard_files import (
    FAILED,
    FILTERED,
    MADE,
    SampleRecord,
    ShardRecord,
    read_record,
    write_record,
)
from texvent.dataset.statistics import DatasetStatistics, Statistics, quantiles, summary_lines
from texvent.dataset.stored.folder import StoredDataset
from texvent.prompt_report import PromptReport


def test_counts_are_those_of_the_samples(cars):
    statistics = DatasetStatistics.of(StoredDataset.open(cars))
    total = statistics.total
    events = [
        len(shard.files(sample).events())
        for shard in StoredDataset.open(cars).shards()
        for sample in shard.samples
    ]
    assert total.events == events
    assert {place: part.samples for place, part in statistics.parts.items()} == {
        ("paper", "train"): 4,
        ("paper", "test"): 2,
        ("esim", "train"): 2,
        ("esim", "test"): 1,
    }
    assert any("not understood" in warning for warning in total.warnings)


def test_reasons_and_warnings_count_together_and_are_said(copied):
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


COUNTS = st.tuples(*[st.integers(0, 3)] * 3)
NAMES = st.sampled_from(["car", "bus"])
SAMPLES = st.builds(
    SampleRecord,
    key=st.just("k"),
    clip=st.sampled_from("abc"),
    status=st.sampled_from([MADE, FILTERED, FAILED]),
    seed=st.just(1),
    label=st.none() | NAMES,
    reason=st.sampled_from(["too few", "frame 3 fails", "frame 4 fails"]),
    warnings=st.lists(st.sampled_from(["1 Hz", "2 Hz", "dark"]), max_size=2).map(tuple),
    prompt_report=st.none() | st.just(PromptReport(not_understood=("wug",)).to_json()),
    events=st.integers(0, 9),
    duration_us=st.sampled_from([0, 1_000_000, 2_000_000]),
    width=st.sampled_from([32, 64]),
    height=st.just(24),
    boxes=st.none() | st.dictionaries(NAMES, COUNTS),
    tracks=st.integers(0, 3),
    unboxed=st.lists(st.just("tree"), max_size=1).map(tuple),
)


@given(st.lists(SAMPLES, max_size=8), st.lists(SAMPLES, max_size=8))
def test_figures_are_counts_of_the_records(first, second):
    records = [
        ShardRecord(name=f"train-{at:06d}", split="train", variant="v", identity="i", sha256="",
                    bytes=7 + at, samples=tuple(samples), seconds=1.5)
        for at, samples in enumerate((first, second))
    ]  # fmt: skip
    samples, of = [*first, *second], Statistics.of(records)
    made = [one for one in samples if one.status == MADE]
    boxed = [one for one in made if one.boxes is not None]
    sizes = [sum(counts[at] for one in boxed for counts in one.boxes.values()) for at in range(3)]
    told = {one.clip for one in samples if one.prompt_report is not None}
    lost = {one.clip for one in samples if one.status == FAILED and one.prompt_report is None}
    tables, trial = of.tables, StageEstimate("v", 3, tuple(records), 0.0, 0.0, 0.0)
    assert (of.samples, of.left_out, of.failed, of.shards, of.bytes, of.seconds) == (
        len(made), sum(one.status == FILTERED for one in samples),
        sum(one.status == FAILED for one in samples), 2, 15, 3.0,
    )  # fmt: skip
    assert of.events == [one.events for one in made]
    assert of.rates == [1e6 * o.events / o.duration_us for o in made if o.duration_us]
    assert tables["clips"] == len({one.clip for one in made})
    assert tables["classes"] == dict(sorted(Counter(o.label for o in made if o.label).items()))
    assert sum(of.sensors.values()) == len(made)
    assert sum(tables["warnings"].values()) == sum(len(one.warnings) for one in samples)
    assert sum(tables["reasons"].values()) == len(samples) - len(made)
    assert (
        len([one for one in tables["reasons"] if one.startswith("failed: frame")]) <= 1
    )  # numbers do not count
    assert [of.box_sizes[name] for name in ("small", "medium", "large")] == sizes
    assert of.tracks == sum(one.tracks for one in boxed)
    assert of.unboxed["tree"] == sum(len(one.unboxed) for one in made)
    if boxed:
        assert tables["samples_without_boxes"] == sum(not o.boxes for o in boxed) / len(boxed)
    refused = len(lost - told) if told else 0
    prompts = (len(told) + refused, refused)
    assert (tables["prompts"]["prompts"], tables["prompts"]["refused"]) == prompts
    assert trial.tried == len(samples)
    assert trial.share(FAILED) * max(len(samples), 1) == pytest.approx(of.failed)


def test_quantiles_by_hand():
    assert quantiles([]) == {}
    facts = quantiles([1, 2, 3, 4, 100])
    assert (facts["mean"], facts["median"], facts["min"], facts["max"]) == (22.0, 3.0, 1.0, 100.0)


def test_a_shard_of_another_set_is_not_counted(copied):
    for suffix in (".tar", ".json"):
        own = copied / "esim" / f"train-000000{suffix}"
        shutil.copy(own, own.with_stem("train-000007"))
    assert DatasetStatistics.of(StoredDataset.open(copied)).total.samples == 9


def test_the_first_sensors_are_named_where_there_are_any(cars, capsys):
    dataset = StoredDataset.open(cars)
    for count in (0, 1, 12, 14):
        statistics = DatasetStatistics.of(dataset)
        statistics.total.sensors = Counter({f"{10 + side}x8": 1 for side in range(count)})
        _print_counts(dataset, statistics)
        told = capsys.readouterr().out
        assert ("sensors:" in told, told.count("x8 1")) == (count > 0, min(count, 12))
        assert (" and 2 more\n" in told) == (count == 14)
