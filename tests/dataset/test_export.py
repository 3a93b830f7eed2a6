"""Every layout is read back, by its own readers where there are any, with the same events."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from tests.dataset.conftest import assert_same, make_set, samples_of

import texvent
from texvent.cli.app import main
from texvent.dataset.export import LAYOUTS, export, folder_name
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.errors import ConfigError, InputError, OutputError


def test_n_imagenet_as_its_loader_opens_it(cars: Path, tmp_path: Path) -> None:
    done = export(StoredDataset.open(cars), "n-imagenet", tmp_path / "N", variant="paper")
    expected = samples_of(cars)
    seen = set()
    for name, split in (("train_list.txt", "train"), ("val_list.txt", "test")):
        for line in (tmp_path / "N" / name).read_text().splitlines():
            path = Path(line)
            stored = np.load(path)["event_data"]
            of_split, label, events = expected[path.stem]
            assert stored.dtype.names == ("x", "y", "t", "p")
            assert (of_split, label) == (split, path.parent.name)
            assert_same(stored, events)
            seen.add(path.stem)
    assert seen == set(expected)
    assert done.samples == len(seen)
    assert "does not hold captions" in done.doubts[0]
    assert "640x480 pixels for granted, and these are 32x24" in done.doubts[1]


def test_hdf5_holds_everything_and_is_made_again_from_itself(
    cars: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "H"
    words = ["dataset", "export", str(cars), "--format", "hdf5", "--variant", "paper"]
    assert main([*words, "-o", str(out)]) == 0
    for key, (split, label, events) in samples_of(cars).items():
        path = out / split / f"{key}.h5"
        assert main(["info", str(path)]) == 0
        loaded = texvent.load(path)
        assert_same(loaded.columns(), events)
        assert loaded.metadata["label"] == label
        assert loaded.metadata["settings"]
    capsys.readouterr()


def test_n_caltech101_as_its_bytes(cars: Path, tmp_path: Path) -> None:
    export(StoredDataset.open(cars), "n-caltech101", tmp_path / "C", variant="paper")
    lists = {
        line: split
        for split in ("train", "test")
        for line in (tmp_path / "C" / f"{split}.txt").read_text().splitlines()
    }
    for key, (split, label, events) in samples_of(cars).items():
        place = f"Caltech101/{label}/{key}.bin"
        assert lists[place] == split
        raw = np.fromfile(tmp_path / "C" / place, np.uint8).reshape(-1, 5).astype(np.int64)
        columns = {
            "x": raw[:, 0],
            "y": raw[:, 1],
            "t": (raw[:, 2] & 127) << 16 | raw[:, 3] << 8 | raw[:, 4],
            "p": raw[:, 2] >> 7,
        }
        assert_same(columns, events)


def test_a_second_run_goes_on_and_another_export_is_refused(cars: Path, tmp_path: Path) -> None:
    made, out = StoredDataset.open(cars), tmp_path / "out"
    export(made, "hdf5", out, variant="paper")
    gone = next((out / "train").iterdir())
    kept = next((out / "test").iterdir())
    gone.unlink()
    before = kept.stat().st_mtime_ns
    done = export(made, "hdf5", out, variant="paper")
    assert (done.samples, done.kept) == (6, 5)
    assert gone.exists()
    assert kept.stat().st_mtime_ns == before
    with pytest.raises(OutputError, match="holds something else"):
        export(made, "hdf5", out, variant="esim")
    with pytest.raises(InputError, match=r"has 2 variants \(paper, esim\)"):
        export(made, "hdf5", tmp_path / "other")
    with pytest.raises(ConfigError, match=f"unknown format 'zarr'; allowed: {', '.join(LAYOUTS)}"):
        export(made, "zarr", tmp_path / "other")


def test_noise_labels_go_where_they_can_be_held(tmp_path: Path) -> None:
    noisy = make_set(
        tmp_path / "noisy",
        splits={"train": 1.0},
        sources=[{"prompts": ["a dog runs right"], "label": "dog"}],
        options={"duration": 0.1, "sensor": "32x24", "label_noise": True},
        variants={"paper": {}},
    )
    made = StoredDataset.open(noisy)
    export(made, "hdf5", tmp_path / "h")
    assert texvent.load(next((tmp_path / "h" / "train").iterdir())).label is not None
    done = export(made, "n-imagenet", tmp_path / "n")
    assert "does not hold which events are noise" in " ".join(done.doubts)


def test_classes_become_folder_names() -> None:
    assert folder_name("../../etc") == "etc"
    assert re.fullmatch(r"[\w.-]+", folder_name("fire truck / red"))
    with pytest.raises(InputError, match="cannot name a folder"):
        folder_name("///")
