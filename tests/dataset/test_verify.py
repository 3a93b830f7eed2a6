"""`verify` finds each kind of damage, and nothing in a sound set or a published copy of one."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.dataset.conftest import make_set

from texvent.cli.app import main
from texvent.dataset.generation.make_sample import npy_bytes
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.generation.shard_files import (
    ShardRecord,
    TarShardWriter,
    read_members,
    read_record,
    write_record,
)
from texvent.dataset.specification.reading import specification_from
from texvent.dataset.statistics import DatasetStatistics
from texvent.dataset.stored.folder import StoredDataset
from texvent.dataset.verify import Findings, verify
from texvent.errors import ConfigError


def check(folder: Path) -> Findings:
    return verify(StoredDataset.open(folder), workers=2)


def record_of(shard: Path) -> ShardRecord:
    record = read_record(shard)
    assert record is not None
    return record


def test_a_sound_set_is_sound(cars):
    findings = check(cars)
    assert findings.is_sound
    assert not findings.notes
    total = DatasetStatistics.of(StoredDataset.open(cars)).total
    assert (findings.shards, findings.samples, findings.events) == (4, 9, sum(total.events))
    for shard in StoredDataset.open(cars).shards():
        for sample in shard.samples:
            number = ("bus", "car").index(sample.label or "")
            assert shard.files(sample).read(("cls",)) == {"cls": str(number).encode()}


def test_stored_videos_are_checked_and_a_copy_may_leave_them_out(tmp_path):
    one = {"sources": [{"prompts": ["a red bus drives left"]}], "splits": {"train": 1.0}}
    folder = make_set(tmp_path / "stored", **one, variants={"paper": {}}, store_videos=True)
    videos = folder / "videos"
    whole = check(folder)
    assert whole.is_sound
    assert not whole.notes
    (videos / "train-000000.tar").unlink()
    assert check(folder).missing == ["videos/train-000000.tar"]
    shutil.rmtree(videos)
    without = check(folder)
    assert without.is_sound
    assert without.notes == ["its videos are not here; no loader needs them"]
    assert (whole.shards, without.shards) == (2, 1)


def test_missing_changed_and_foreign_files_are_told_apart(copied):
    (copied / "esim" / "test-000000.tar").unlink()
    (copied / "paper" / "test-000000.json").unlink()
    shard = copied / "paper" / "train-000000.tar"
    content = bytearray(shard.read_bytes())
    content[700] ^= 1
    shard.write_bytes(content)
    for suffix in (".tar", ".json"):
        own = copied / "esim" / f"train-000000{suffix}"
        shutil.copy(own, own.with_stem("train-000009"))
    (copied / "paper" / "notes.txt").write_text("mine")
    findings = check(copied)
    assert findings.missing == ["esim/test-000000.tar", "paper/test-000000.tar"]
    assert findings.changed == ["paper/train-000000.tar: its sha256 is not that of its record"]
    assert findings.foreign == [
        "paper/notes.txt",
        "esim/train-000009.json",
        "esim/train-000009.tar",
    ]


def test_samples_that_cannot_be_used_are_named_although_digests_agree(copied):
    shard = copied / "paper" / "train-000000.tar"
    record = record_of(shard)
    samples, problems = [], iter(("outside", "order"))
    contents = [read_members(shard, sample.members) for sample in record.samples]
    with shard.open("wb") as file:
        writer = TarShardWriter(file)
        for sample, members in zip(record.samples, contents, strict=True):
            match next(problems, None):
                case "outside":
                    members["x.npy"] = npy_bytes(np.full(sample.events, 32, np.uint16))
                case "order":
                    times = np.arange(sample.events, 0, -1, dtype=np.uint32)
                    members["t.npy"] = npy_bytes(times)
            samples.append(replace(sample, members=writer.add(sample.key, members)))
        writer.close()
    import hashlib

    content = shard.read_bytes()
    sha256 = hashlib.sha256(content).hexdigest()
    changed = replace(record, samples=tuple(samples), sha256=sha256, bytes=len(content))
    write_record(shard, changed)
    findings = check(copied)
    assert not findings.changed
    first, second = findings.unsound
    assert "outside" in first or "32" in first
    assert samples[1].key in second
    assert verify(StoredDataset.open(copied), contents=False).is_sound


@pytest.mark.parametrize(
    ("name", "value"),
    [("key", "k"), ("clip", "k"), ("seed", 1), ("width", 33), ("height", 25), ("label", "k"),
     ("prompt", "k"), ("events", 1)],
)  # fmt: skip
def test_a_record_that_says_other_things_than_its_sample_is_found(copied, name, value):
    shard = copied / "paper" / "train-000000.tar"
    record = record_of(shard)
    first, *others = record.samples
    write_record(shard, replace(record, samples=(replace(first, **{name: value}), *others)))
    (said,) = check(copied).unsound
    assert ("caption" if name == "prompt" else name) in said


def test_damaged_records_are_all_named(copied, capsys):
    for variant in ("paper", "esim"):
        (copied / variant / "train-000000.json").write_text('{"name": "train')
    findings = check(copied)
    assert len(findings.changed) == 2
    assert all("train-000000.json is damaged" in one for one in findings.changed)
    assert main(["dataset", "verify", str(copied)]) == 1
    capsys.readouterr()


def test_a_copy_without_items_is_checked_too(copied):
    (copied / "items.jsonl").unlink()
    findings = check(copied)
    assert findings.is_sound
    assert "not noticed" in findings.notes[0]
    assert main(["dataset", "make", str(copied)]) == 2


def test_the_command_says_it_in_its_exit_code(copied, capsys):
    assert main(["dataset", "verify", str(copied)]) == 0
    assert "all is well" in capsys.readouterr().out
    (copied / "esim" / "test-000000.tar").unlink()
    assert main(["dataset", "verify", str(copied), "--json"]) == 1
    assert json.loads(capsys.readouterr().out)["missing"] == ["esim/test-000000.tar"]
    assert main(["dataset", "verify", str(copied / "esim")]) == 2


def test_a_shard_of_a_high_number_is_counted_and_lists_nothing(copied):
    (copied / "items.jsonl").unlink()
    for suffix in (".tar", ".json"):
        own = copied / "esim" / f"test-000000{suffix}"
        own.rename(own.with_stem("test-999999999"))
    record = copied / "esim" / "test-999999999.json"
    record.write_text(record.read_text().replace("test-000000", "test-999999999"))
    assert check(copied).missing == ["esim/test-000000.tar to esim/test-999999998.tar"]


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("members", {"x.npy": [0, 10**15]}),
        ("members", {"x.npy": [-1, 5]}),
        ("members", {"x.npy": [0, 10**30]}),
        ("events", "many"),
        ("events", 10**30),
        ("width", 1.5),
        ("prompt", 5),
        ("label", ["car"]),
        ("warnings", [1]),
        ("boxes", {"car": [1]}),
        ("prompt_report", {"shown": [{}]}),
        ("key", "a/b"),
        ("clip", ".."),
        ("unknown", 1),
    ],
)
def test_wrong_values_of_a_record_are_damage(copied, name, value, capsys):
    path = copied / "paper" / "train-000000.json"
    tables = json.loads(path.read_text())
    tables["samples"][0][name] = value
    path.write_text(json.dumps(tables))
    assert main(["dataset", "verify", str(copied)]) == 1
    assert "damaged" in (said := capsys.readouterr().out) or "shorter than" in said
    for words in (["stats"], ["preview", "-o", str(copied / "page.html")]):
        assert main(["dataset", words[0], str(copied), *words[1:]]) in (0, 2)


def test_a_specification_cannot_ask_for_shards_without_end():
    tables = {"name": "n", "sources": [{"prompts": ["a car"]}], "repeats": 10**8}
    specification = specification_from({**tables, "samples_per_shard": 1}, folder=Path())
    with pytest.raises(ConfigError, match="100,000,000 shards are too many"):
        Recipe.of(specification)
