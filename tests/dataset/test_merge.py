"""Merged sets verify, keep every sample, and number classes together."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.dataset.conftest import make_set

import texvent.dataset
from texvent.cli.app import main
from texvent.dataset.generation.recipe import load_recipe
from texvent.dataset.generation.shards import read_members
from texvent.dataset.merge import merge
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.reading.stored_events import read_events
from texvent.dataset.verify import verify
from texvent.errors import ConfigError, InputError, OutputError, TexventWarning

APE = {
    "name": "apes",
    "splits": {"train": 1.0},
    "sources": [{"prompts": ["a bird flies up"], "label": "bird"}],
    "variants": {"esim": {"simulator": "esim"}},
}


@pytest.fixture(scope="module")
def birds(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_set(tmp_path_factory.mktemp("birds") / "birds", **APE)


def classes_of(folder: Path) -> dict[str, bytes]:
    return {
        f"{sample.label} {sample.key}": read_members(shard.path, sample.members)["cls"]
        for shard in StoredDataset.open(folder).shards()
        for sample in shard.samples
    }


def test_a_merged_set_holds_every_sample_and_is_sound(
    cars: Path, birds: Path, tmp_path: Path
) -> None:
    merged = merge([StoredDataset.open(cars), StoredDataset.open(birds)], tmp_path / "all")
    assert (merged.samples, merged.shards) == (10, 5)
    assert verify(StoredDataset.open(tmp_path / "all")).is_sound
    made = StoredDataset.open(tmp_path / "all")
    assert (made.labels, made.splits) == (("bird", "bus", "car"), ("train", "test"))
    assert made.simulator_of("esim") == "esim"
    for key, number in classes_of(tmp_path / "all").items():
        assert number == str(made.labels.index(key.split()[0])).encode()
    opened = texvent.dataset.open(tmp_path / "all")
    assert (len(opened), opened.labels) == (10, made.labels)
    assert all(opened.labels[one.class_number] == one.label for one in opened)
    events = {
        sample.key: read_events(shard.path, sample)
        for shard in made.shards()
        for sample in shard.samples
    }
    for source in (cars, birds):
        for shard in StoredDataset.open(source).shards():
            for sample in shard.samples:
                assert (events[sample.key].t == read_events(shard.path, sample).t).all()


def test_shards_whose_classes_stay_are_linked(cars: Path, birds: Path, tmp_path: Path) -> None:
    merged = merge(
        [StoredDataset.open(birds), StoredDataset.open(cars)], tmp_path / "all", name="both"
    )
    # "bird" is the first of all classes too, so its shard stays; those of cars move by one.
    assert merged.rewritten == 4
    shard = tmp_path / "all" / "esim" / "train-000000.tar"
    assert shard.stat().st_ino == (birds / "esim" / "train-000000.tar").stat().st_ino
    assert StoredDataset.open(tmp_path / "all").name == "both"


def test_what_would_break_the_set_is_refused(cars: Path, birds: Path, tmp_path: Path) -> None:
    made = StoredDataset.open(cars)
    with pytest.raises(InputError, match="same prompt in a variant of the same name"):
        merge([made, StoredDataset.open(cars)], tmp_path / "all")
    with pytest.raises(InputError, match="two data sets or more"):
        merge([made], tmp_path / "all")
    (tmp_path / "all").mkdir()
    with pytest.raises(OutputError, match="exists already"):
        merge([made, StoredDataset.open(birds)], tmp_path / "all")


def test_incomplete_sets_and_sets_half_with_classes_are_refused(
    copied: Path, birds: Path, tmp_path: Path
) -> None:
    (copied / "esim" / "test-000000.tar").unlink()
    with pytest.raises(InputError, match=r"lacks 1 shards, such as esim/test-000000\.tar"):
        merge([StoredDataset.open(copied), StoredDataset.open(birds)], tmp_path / "all")
    plain = make_set(tmp_path / "plain", **{**APE, "sources": [{"prompts": ["a dog runs right"]}]})
    with pytest.raises(InputError, match=r"has classes and .* has none"):
        merge([StoredDataset.open(birds), StoredDataset.open(plain)], tmp_path / "all")


def test_prompts_that_get_into_several_splits_are_said(cars: Path, tmp_path: Path) -> None:
    other = {"test": 1.0}
    again = make_set(
        tmp_path / "again",
        splits=other,
        variants={"again": {"simulator": "esim"}},
        license="cc0-1.0",
    )
    with pytest.warns(TexventWarning) as said:
        merge([StoredDataset.open(cars), StoredDataset.open(again)], tmp_path / "all")
    assert "2 prompts or videos are now in several splits" in str(said[0].message)
    assert "the licences differ (cc-by-4.0, cc0-1.0)" in str(said[1].message)


def test_a_merged_set_is_not_made_further(
    cars: Path, birds: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "all"
    assert main(["dataset", "merge", str(cars), str(birds), "-o", str(folder)]) == 0
    assert "10 samples of 2 data sets in 5 shards" in capsys.readouterr().out
    with pytest.raises(ConfigError, match="was merged from other data sets"):
        load_recipe(folder)
    assert main(["dataset", "make", str(folder)]) == 2
