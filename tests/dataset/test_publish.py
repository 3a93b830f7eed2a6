"""The card is the same every time and states the licence; other libraries read the set by it."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from tests.dataset.conftest import assert_same, samples_of

from texvent.cli.app import main
from texvent.dataset.publish import hub_name, publish
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.errors import InputError, OutputError, TexventWarning

pytestmark = [
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.filterwarnings("ignore::FutureWarning"),
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]


@pytest.fixture
def published(copied: Path) -> Path:
    publish(StoredDataset.open(copied))
    return copied


def test_the_card_has_what_the_hub_reads(published: Path) -> None:
    card = (published / "README.md").read_text("utf-8")
    header = yaml.safe_load(card.split("---")[1])
    assert header["license"] == "cc-by-4.0"
    assert header["size_categories"] == ["n<1K"]
    assert header["configs"][0] == {
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


def test_missing_shards_foreign_cards_and_no_licence_are_said(copied: Path) -> None:
    (copied / "esim" / "test-000000.tar").unlink()
    with pytest.raises(InputError, match=r"1 shards are missing, such as esim/test-000000\.tar"):
        publish(StoredDataset.open(copied))
    card, path = copied / "README.md", copied / "specification.json"
    card.write_text("my own")
    with pytest.raises(OutputError, match="was not written by texvent"):
        publish(StoredDataset.open(copied), partial=True)
    card.unlink()
    (copied / "items.jsonl").unlink()
    path.write_text(path.read_text().replace('"cc-by-4.0"', '""'))
    with pytest.warns(TexventWarning, match="no licence is stated"):
        publish(StoredDataset.open(copied), partial=True)
    assert "license: unknown" in card.read_text("utf-8")


def test_publishing_again_gives_the_same_bytes(copied: Path) -> None:
    words = ["dataset", "publish", str(copied), "--license", "mit"]
    cards = []
    for _ in range(2):
        assert main(words) == 0
        cards.append((copied / "README.md").read_bytes())
    assert cards[0] == cards[1]
    assert main(["dataset", "verify", str(copied)]) == 0


@pytest.mark.dataset
def test_webdataset_reads_the_shards(published: Path) -> None:
    webdataset = pytest.importorskip("webdataset")
    expected, seen = samples_of(published), 0
    for shard in StoredDataset.open(published).shards("paper"):
        for sample in webdataset.WebDataset(str(shard.path), shardshuffle=False).decode():
            columns = {name: sample[f"{name}.npy"] for name in "xytp"}
            assert_same(columns, expected[sample["__key__"]][2])
            assert sample["txt"] == sample["json"]["prompt"]
            assert isinstance(sample["cls"], int)
            assert sample["png"].startswith(b"\x89PNG")
            seen += 1
    assert seen == len(expected)


@pytest.mark.dataset
def test_hugging_face_datasets_reads_the_folder(published: Path, tmp_path: Path) -> None:
    pytest.importorskip("PIL")
    datasets = pytest.importorskip("datasets")
    expected, seen = samples_of(published), 0
    for split in ("train", "test"):
        table = datasets.load_dataset(
            str(published), "paper", split=split, cache_dir=str(tmp_path / "cache")
        )
        assert table.features["cls"].names == ["bus", "car"]
        assert table.features["x.npy"].feature.dtype == "uint16"
        for sample in table:
            columns = {name: sample[f"{name}.npy"] for name in "xytp"}
            assert_same(columns, expected[sample["__key__"].split("/")[-1]][2])
            assert sample["json"]["prompt"] == sample["txt"]
            assert sample["png"].size == (32, 24)
            seen += 1
    assert seen == len(expected)
    default = datasets.load_dataset(str(published), split="train", streaming=True)
    assert next(iter(default.select_columns(["txt"])))["txt"]


@pytest.mark.dataset
def test_the_lines_of_the_card_run(published: Path, tmp_path: Path) -> None:
    for package in ("webdataset", "datasets", "pandas", "PIL"):
        pytest.importorskip(package)
    card = (published / "README.md").read_text("utf-8")
    blocks = re.findall(r"```python\n(.*?)```", card, re.DOTALL)
    assert len(blocks) == 3
    script = "\n".join(blocks).replace("DIR", str(published)) + "\nprint(len(times), caption)\n"
    place = tmp_path / "card.py"
    place.write_text(script)
    environment = {**os.environ, "HF_HOME": str(tmp_path / "hf"), "HF_HUB_OFFLINE": "1"}
    done = subprocess.run(
        [sys.executable, str(place)],
        capture_output=True,
        text=True,
        env=environment,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert "drives left" in done.stdout
