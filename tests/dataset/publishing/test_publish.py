"""What is published is the same every time, complete, and says who may use it."""

from __future__ import annotations

import hashlib
import io
import json
from pathlib import Path

import numpy as np
import pytest
import yaml

from texvent.cli.app import main
from texvent.dataset.publishing.card import PublicationInfo, card_text, hub_name
from texvent.dataset.publishing.croissant import croissant_text
from texvent.dataset.publishing.index import index_rows
from texvent.dataset.publishing.publish import publish
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.reading.stored_events import read_events
from texvent.dataset.statistics import DatasetStatistics
from texvent.errors import ConfigError, InputError, OutputError, TexventWarning


def card_of(folder: Path, **notice: str) -> str:
    made = StoredDataset.open(folder)
    return card_text(made, DatasetStatistics.of(made), PublicationInfo(**notice), missing=0)


def header_of(card: str) -> dict[str, object]:
    header: dict[str, object] = yaml.safe_load(card.split("---")[1])
    return header


def test_a_row_of_the_index_finds_its_sample(cars: Path) -> None:
    made = StoredDataset.open(cars)
    rows = list(index_rows(made))
    samples = [(shard, one) for shard in made.shards() for one in shard.samples]
    assert [row["key"] for row in rows] == [sample.key for _, sample in samples]
    for row, (shard, sample) in zip(rows, samples, strict=True):
        content = (cars / row["shard"]).read_bytes()
        assert hashlib.sha256(content).hexdigest() == row["shard_sha256"]
        for name in "xytp":
            begin, size = row[f"{name}_offset"], row[f"{name}_bytes"]
            column = np.load(io.BytesIO(content[begin : begin + size]))
            np.testing.assert_array_equal(column, getattr(read_events(shard.path, sample), name))
        assert row["simulator"] == {"paper": "texvent", "esim": "esim"}[row["variant"]]
        assert row["label"] == made.labels[row["class_number"]]
        assert row["caption"] == sample.prompt


def test_the_simulator_is_read_from_the_samples_where_it_was_drawn(cars: Path) -> None:
    made = StoredDataset.open(cars)
    made.variants["esim"]["options"]["simulator"] = {"choice": ["esim", "v2e"]}  # type: ignore[index]
    assert made.simulator_of("esim") is None
    assert {row["simulator"] for row in index_rows(made) if row["variant"] == "esim"} == {"esim"}


def test_the_card_has_what_the_hub_reads(cars: Path) -> None:
    card = card_of(cars, creator="A. Author")
    header = header_of(card)
    assert header["license"] == "cc-by-4.0"
    assert header["size_categories"] == ["n<1K"]
    assert header["configs"][0] == {  # type: ignore[index]
        "config_name": "paper",
        "default": True,
        "data_files": [
            {"split": "train", "path": "paper/train-??????.tar"},
            {"split": "test", "path": "paper/test-??????.tar"},
        ],
    }
    assert "9 samples of 3 videos" in card
    assert "| esim | test | 1 |" in card
    assert "carry a warning" in card
    assert hub_name("hard-test") == "hard_test"


def test_the_description_names_every_shard_with_its_digest(cars: Path, tmp_path: Path) -> None:
    index = tmp_path / "index.parquet"
    index.write_bytes(b"index")
    made = StoredDataset.open(cars)
    text = croissant_text(
        made, DatasetStatistics.of(made), PublicationInfo(url="https://a.b/c"), index
    )
    document = json.loads(text)
    files = {one["@id"]: one for one in document["distribution"]}
    for shard in made.shards():
        assert files[shard.place]["sha256"] == shard.record.sha256
        assert files[shard.place]["contentSize"] == f"{shard.record.bytes} B"
    assert document["conformsTo"][0] == "http://mlcommons.org/croissant/1.1"
    assert document["license"] == "cc-by-4.0"
    assert {"rai:dataCollection", "rai:dataBiases", "rai:dataLimitations"} < document.keys()


def test_a_date_is_a_day() -> None:
    with pytest.raises(ConfigError, match="date is 'yesterday'; it must be a day"):
        PublicationInfo(date="yesterday")


def test_missing_shards_foreign_cards_and_no_licence_are_said(copied: Path) -> None:
    (copied / "esim" / "test-000000.tar").unlink()
    with pytest.raises(InputError, match=r"1 shards are missing, such as esim/test-000000\.tar"):
        publish(StoredDataset.open(copied), PublicationInfo())
    (copied / "README.md").write_text("my own")
    with pytest.raises(OutputError, match="was not written by texvent"):
        publish(StoredDataset.open(copied), PublicationInfo(), partial=True)


@pytest.mark.dataset
def test_publishing_again_gives_the_same_bytes(copied: Path) -> None:
    pytest.importorskip("pyarrow")
    words = ["dataset", "publish", str(copied), "--date", "2026-11-21", "--creator", "A. Author"]

    def contents() -> dict[str, bytes]:
        assert main(words) == 0
        names = ("index.parquet", "README.md", "croissant.json")
        return {name: (copied / name).read_bytes() for name in names}

    assert contents() == contents()
    assert main(["dataset", "verify", str(copied)]) == 0
    specification = copied / "specification.json"
    facts = json.loads(specification.read_text())
    facts["specification"]["license"] = ""
    specification.write_text(json.dumps(facts))
    with pytest.warns(TexventWarning, match="no licence is stated"):
        publish(StoredDataset.open(_without_items(copied)), PublicationInfo())


def _without_items(folder: Path) -> Path:
    (folder / "items.jsonl").unlink()
    return folder


@pytest.mark.dataset
def test_a_description_of_other_shards_is_found(
    copied: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("pyarrow")
    publish(StoredDataset.open(copied), PublicationInfo())
    path = copied / "croissant.json"
    document = json.loads(path.read_text())
    document["distribution"][1]["sha256"] = "0" * 64
    path.write_text(json.dumps(document))
    assert main(["dataset", "verify", str(copied)]) == 1
    assert "it describes other shards (such as paper/train-000000.tar)" in capsys.readouterr().out
