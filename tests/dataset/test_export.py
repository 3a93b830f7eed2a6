"""Every layout is read back, by its own readers where there are any, with the same events."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from tests.dataset.conftest import assert_same, make_set, samples_of

import texvent
from texvent.cli.app import main
from texvent.dataset.export import LAYOUTS, export
from texvent.dataset.layouts.samples import folder_name
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
    words = ["dataset", "export", str(cars), "--layout", "hdf5", "--variant", "paper"]
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


def test_another_export_is_refused(cars: Path, tmp_path: Path) -> None:
    made, out = StoredDataset.open(cars), tmp_path / "out"
    export(made, "hdf5", out, variant="paper")
    with pytest.raises(OutputError, match="variant was paper, is esim"):
        export(made, "hdf5", out, variant="esim")
    with pytest.raises(InputError, match=r"has 2 variants \(paper, esim\)"):
        export(made, "hdf5", tmp_path / "other")
    with pytest.raises(ConfigError, match=f"unknown layout 'zarr'; allowed: {', '.join(LAYOUTS)}"):
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
    for label in ("///", "..", ".", "x" * 300):
        with pytest.raises(InputError, match="cannot name a folder"):
            folder_name(label)


@pytest.fixture(scope="module")
def traffic(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three clips with boxes, in one of which nothing is in view that drives."""
    return make_set(
        tmp_path_factory.mktemp("traffic") / "traffic",
        splits={"train": 0.67, "valid": 0.33},
        sources=[{"prompts": ["a red taxi drives left past a man", "a bus stops"]},
                 {"prompts": ["a tree"], "split": "train"}],
        options={"duration": 0.15, "sensor": "64x48"},
        variants={"paper": {}},
        truth=["boxes"],
    )  # fmt: skip


def test_layouts_with_boxes_from_the_command_line(
    traffic: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    samples = [one for shard in StoredDataset.open(traffic).shards() for one in shard.samples]
    splits = {one.key: split for one, split in zip(samples, ("train", "train", "val"), strict=True)}
    shown = {one.key for one in samples if set(one.boxes or {}) & {"taxi", "bus"}}
    words = ["dataset", "export", str(traffic), "--classes", "car,bus", "--layout"]
    for name in ("gen1", "rvt", "dsec-det", "coco", "coco"):
        assert main([*words, name, "-o", str(tmp_path / name)]) == 0
    told = capsys.readouterr().out
    assert "classes of boxes, in the order of their numbers: car, bus" in told
    assert "note: boxes of other classes are left out: man (4), tree (4)" in told
    assert f"{tmp_path}/coco: 3 samples as coco (3 were there)" in told
    assert "note: 1 samples show no box and are left out; its readers want one" in told
    for key, split in splits.items():
        assert (tmp_path / "rvt" / split / key).is_dir() == (key in shown)
        folder = tmp_path / "dsec-det/train" / key
        times = np.genfromtxt(folder / "images/timestamps.txt", dtype="int64")
        tracks = np.load(folder / "object_detections/left/tracks.npy")
        boxes = np.load(tmp_path / "gen1" / split / f"{key}_bbox.npy")
        assert len(list((folder / "images/left/distorted").iterdir())) == len(times) == 4
        assert set(tracks["t"].tolist()) == (set(times.tolist()) if key in shown else set())
        assert tracks["class_id"].tolist() == boxes["class_id"].tolist()
        assert texvent.load(tmp_path / "gen1" / split / f"{key}_td.dat").size == (64, 48)
    found = json.loads((tmp_path / "coco/val/annotations.json").read_text())
    numbers = json.loads((tmp_path / "coco/texvent-export.json").read_text())["class_numbers"]
    assert all(numbers[one["name"]] == one["id"] for one in found["categories"])
    assert len(found["images"]) == 2
    assert not [one for one in tmp_path.rglob("*") if one.name.startswith(".texvent")]


def test_what_a_layout_cannot_hold_is_refused_at_the_door(
    cars: Path, traffic: Path, tmp_path: Path
) -> None:
    out, boxes, none = tmp_path / "out", StoredDataset.open(traffic), StoredDataset.open(cars)
    with pytest.raises(InputError, match=r'has none; write truth = \["boxes"\] into the specif'):
        export(none, "rvt", out, variant="paper")
    with pytest.raises(InputError, match=r"gen1 has no class for bus, tree; choose with --classes"):
        export(boxes, "gen1", out)
    with pytest.raises(InputError, match="no box is of the classes 'train'; boxes are of bus, man"):
        export(boxes, "rvt", out, classes="train")
    with pytest.raises(ConfigError, match="classes are those of boxes, and layout hdf5 holds none"):
        export(boxes, "hdf5", out, classes="car")
    assert not out.exists()


def test_frames_that_cannot_be_made_again_are_said(traffic: Path, tmp_path: Path) -> None:
    copy = shutil.copytree(traffic, tmp_path / "copy")
    (copy / "items.jsonl").unlink()
    made = StoredDataset.open(copy)
    with pytest.raises(InputError, match=r"layout timelens holds frames.* has no items\.jsonl"):
        export(made, "timelens", tmp_path / "out")
    assert not (tmp_path / "out").exists()
    done = export(made, "dsec-det", tmp_path / "out", classes="car")
    assert "it does not hold images" in done.doubts[0]
    folder = next((tmp_path / "out/train").iterdir())
    times = np.genfromtxt(folder / "images/timestamps.txt", dtype="int64")
    assert times.tolist() == [0, 41_667, 83_333, 125_000]


def test_frames_of_a_replaced_video_are_not_put_beside_the_events(tmp_path: Path) -> None:
    clip = np.random.default_rng(0).integers(0, 255, (4, 12, 16), dtype=np.uint8)
    np.save(tmp_path / "v.npy", clip)
    made = StoredDataset.open(
        make_set(
            tmp_path / "set",
            splits={"train": 1.0},
            sources=[{"videos": [str(tmp_path / "v.npy")]}],
            options={"fps": 30},
            variants={"paper": {}},
        )
    )
    export(made, "timelens", tmp_path / "out")
    np.save(tmp_path / "v.npy", clip[::-1])
    with pytest.raises(InputError, match="is not the video that the events of"):
        export(made, "timelens", tmp_path / "again")
