"""Every layout is read back, by its own readers where there are any, with the same events."""

import io
import json
import re
import shutil
import tarfile
from pathlib import Path

import numpy as np
import pytest
from tests.dataset.conftest import assert_same, make_set, samples_of
from tests.dataset.layouts.readers import READERS, Box

import texvent
from texvent.cli.app import main
from texvent.dataset.export import LAYOUTS, export
from texvent.dataset.layouts.checks import folder_name
from texvent.dataset.layouts.layout import Layout, LayoutSample
from texvent.dataset.stored.folder import StoredDataset
from texvent.errors import ConfigError, InputError, OutputError


def test_another_export_is_refused(cars, tmp_path):
    made, out = StoredDataset.open(cars), tmp_path / "out"
    export(made, "hdf5", out, variant="paper")
    with pytest.raises(OutputError, match="variant was paper, is esim"):
        export(made, "hdf5", out, variant="esim")
    with pytest.raises(InputError, match=r"has 2 variants \(paper, esim\)"):
        export(made, "hdf5", tmp_path / "other")
    with pytest.raises(ConfigError, match=f"unknown layout 'zarr'; allowed: {', '.join(LAYOUTS)}"):
        export(made, "zarr", tmp_path / "other")


def test_noise_labels_go_where_they_can_be_held(tmp_path):
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


@pytest.mark.parametrize("began_us", [0, 5_000_000, -30_000])
def test_a_layout_is_given_each_sample_with_its_span(tmp_path, monkeypatch, began_us):
    np.save(tmp_path / "a.npy", np.random.default_rng(1).integers(0, 255, (5, 12, 16), np.uint8))
    times = [(began_us + 20_000 * number) / 1e6 for number in range(5)]
    (tmp_path / "times.txt").write_text("".join(f"{one:.6f}\n" for one in times))
    folder = make_set(
        tmp_path / "set",
        sources=[{"videos": [str(tmp_path / "a.npy")]}],
        options={"timestamps": str(tmp_path / "times.txt"), "interpolate": "none"},
        variants={"paper": {}},
        splits={"train": 1.0},
    )
    given = list[LayoutSample]()
    layout = Layout(place="{split}/{key}.x", write=lambda one, path: not given.append(one))
    monkeypatch.setitem(LAYOUTS, "own", layout)
    export(StoredDataset.open(folder), "own", tmp_path / "out")
    (sample,) = given
    assert (sample.start_us, sample.stop_us) == (began_us, began_us + 80_000)
    t = sample.read_events().t
    assert len(t) > 50
    assert began_us <= t[0] <= t[-1] < began_us + 80_000
    assert (sample.split, sample.size) == ("train", (16, 12))


def test_classes_become_folder_names():
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
        sources=[{"prompts": ["a red taxi drives left past a man", "a bus stands"], "label": "car"},
                 {"prompts": ["a tree"], "split": "train", "label": "tree"}],
        options={"duration": 0.15, "sensor": "64x48", "point_spread": 0},
        variants={"paper": {}},
        truth=["boxes"],
    )  # fmt: skip


NUMBERS = {"taxi": 0, "bus": 1}
"""Classes of the traffic that `--classes car,bus` keeps."""


def boxes_of(folder: Path) -> dict[str, list[Box]]:
    """Key → boxes of these classes, from the tars."""
    found: dict[str, list[Box]] = {}
    for shard in folder.glob("paper/*.tar"):
        with tarfile.open(shard) as tar:
            files = {one.name: tar.extractfile(one).read() for one in tar}  # type: ignore[union-attr]
        for name in [one for one in files if one.endswith(".boxes.npy")]:
            key = name.split(".")[0]
            names = json.loads(files[f"{key}.json"])["truth"]["classes"]
            records = np.load(io.BytesIO(files[name]))
            found[key] = [
                (*(float(one[side]) for side in "txywh"), NUMBERS[kind], float(one["track_id"]))
                for one in records
                if (kind := names[str(one["class_id"])]) in NUMBERS
            ]
    return found


@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_layout_reads_back_as_the_events_boxes_splits_and_classes_that_were_made(
    layout, traffic, tmp_path
):
    classes = "car,bus" if LAYOUTS[layout].has_boxes else None
    done = export(StoredDataset.open(traffic), layout, tmp_path / "out", classes=classes)
    read, boxes = dict(READERS[layout](tmp_path / "out")), boxes_of(traffic)
    assert read
    assert done.samples == len(read)
    if LAYOUTS[layout].size is not None:
        assert "pixels for granted, and these are 64x48" in "; ".join(done.doubts)
    lacks = "split test has no tree, so SpikingJelly numbers its classes otherwise"
    assert (lacks in done.doubts) == LAYOUTS[layout].numbers_classes
    for key, (split, label, events) in samples_of(traffic).items():
        if layout == "rvt" and not boxes[key]:
            continue  # its readers want a box
        one = read.pop(key)
        assert one.split[:3] == LAYOUTS[layout].split_of(split)[:3]
        assert one.label in (None, label)
        if one.events is not None:
            assert_same(one.events, events)
        if one.boxes is not None:
            first = 50_000 if layout == "coco" else 0
            np.testing.assert_allclose(one.boxes, [box for box in boxes[key] if box[0] >= first])
        for start, last, lit in one.pictures or ():
            inside = (events.t >= start) & (events.t <= last)
            expected = np.zeros(lit.shape, bool)
            expected[events.y[inside], events.x[inside]] = True
            np.testing.assert_array_equal(lit, expected)
    assert not read


def test_layouts_with_boxes_from_the_command_line(traffic, tmp_path, capsys):
    words = ["dataset", "export", str(traffic), "--classes", "car,bus", "--layout"]
    for name in ("rvt", "coco", "coco"):
        assert main([*words, name, "-o", str(tmp_path / name)]) == 0
    told = capsys.readouterr().out
    assert "classes of boxes, in the order of their numbers: car, bus" in told
    assert "note: boxes of other classes are left out: man (4), tree (4)" in told
    assert f"{tmp_path}/coco: 3 samples as coco (3 were there)" in told
    assert "note: 1 samples show no box and are left out; its readers want one" in told
    found = json.loads((tmp_path / "coco/val/annotations.json").read_text())
    numbers = json.loads((tmp_path / "coco/texvent-export.json").read_text())["class_numbers"]
    assert all(numbers[one["name"]] == one["id"] for one in found["categories"])
    assert not [one for one in tmp_path.rglob("*") if one.name.startswith(".texvent")]


def test_what_a_layout_cannot_hold_is_refused_at_the_door(cars, traffic, tmp_path):
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


def test_classes_with_numbers_need_no_folder_names_and_large_numbers_give_way_to_places(tmp_path):
    for labels, numbers in ((("A", "a"), (0, 1)), (("10", "11"), (0, 1)), (("3", "7"), (3, 7))):
        name = "".join(labels)
        made = make_set(
            tmp_path / name,
            splits={"train": 1.0},
            sources=[{"prompts": ["a red car drives left"], "label": one} for one in labels],
            options={"duration": 0.1, "sensor": "32x24", "interpolate": "none"},
            variants={"esim": {"simulator": "esim"}},
        )
        out = tmp_path / f"{name}-exported"
        done = export(StoredDataset.open(made), "n-mnist", out)
        pairs = zip(numbers, labels, strict=True)
        assert f"its classes are {', '.join(f'{n} {one}' for n, one in pairs)}" in done.doubts
        assert sorted(int(one.name) for one in (out / "NMNIST/Train").iterdir()) == [*numbers]
    with pytest.raises(InputError, match="classes 'A' and 'a' would share the folder"):
        export(StoredDataset.open(tmp_path / "Aa"), "n-imagenet", tmp_path / "no")


def test_frames_that_cannot_be_made_again_are_said(traffic, tmp_path):
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
