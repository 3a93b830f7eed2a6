"""Other libraries read the shards of a data set."""

from pathlib import Path

import pytest
from tests.dataset.conftest import assert_same, samples_of

from texvent.dataset.stored.folder import StoredDataset

pytestmark = [
    pytest.mark.dataset,
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.filterwarnings("ignore::FutureWarning"),
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]


def test_webdataset_reads_the_shards(cars: Path) -> None:
    webdataset = pytest.importorskip("webdataset")
    expected, seen = samples_of(cars), 0
    for shard in StoredDataset.open(cars).shards("paper"):
        for sample in webdataset.WebDataset(str(shard.path), shardshuffle=False).decode():
            columns = {name: sample[f"{name}.npy"] for name in "xytp"}
            assert_same(columns, expected[sample["__key__"]][2])
            assert sample["txt"] == sample["json"]["prompt"]
            assert isinstance(sample["cls"], int)
            assert sample["png"].startswith(b"\x89PNG")
            seen += 1
    assert seen == len(expected)


def test_hugging_face_datasets_reads_the_shards(cars: Path, tmp_path: Path) -> None:
    pytest.importorskip("PIL")
    datasets = pytest.importorskip("datasets")
    expected = samples_of(cars)
    table = datasets.load_dataset(
        "webdataset",
        data_files=str(cars / "paper" / "*.tar"),
        split="train",
        cache_dir=str(tmp_path),
    )
    for sample in table:
        columns = {name: sample[f"{name}.npy"] for name in "xytp"}
        assert_same(columns, expected[sample["__key__"].split("/")[-1]][2])
        assert sample["json"]["prompt"] == sample["txt"]
        assert sample["png"].size == (32, 24)
    assert len(table) == len(expected)
