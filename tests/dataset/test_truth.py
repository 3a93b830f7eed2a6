"""Ground truth in data sets: stored as the scene knows it, read back, counted, checked, drawn."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tests.dataset.conftest import CARS, make_set
from tests.dataset.generation.small_sets import digests, make

import texvent
from texvent import Augment
from texvent.cli.app import main
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.generation.shards import read_record, write_record
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.samples import SimulatedSamples
from texvent.dataset.specification.reading import specification_from
from texvent.dataset.statistics import DatasetStatistics
from texvent.dataset.verify import verify
from texvent.errors import ConfigError, InputError
from texvent.view.drawing.panels import BOX_COLOUR

TRUTH: dict[str, Any] = {
    "truth": ["boxes", "flow", "depth", "ids", "poses"],
    "classes": {"bus": "vehicle", "man": "person", "car": "vehicle"},
    "sources": [{"prompts": ["a red car drives left", "a man walks right past a tree"]}],
    "splits": {"train": 1.0},
}


@pytest.fixture(scope="module")
def labelled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_set(tmp_path_factory.mktemp("labelled") / "cars", **TRUTH)


def test_truth_is_that_of_the_scene_in_every_variant(labelled: Path, tmp_path: Path) -> None:
    samples = texvent.dataset.open(labelled)
    assert len(samples) == 6
    class_of = {"car": 0, "man": 1}
    for number, sample in enumerate(samples):
        prompt, clip = sample.caption or "", sample.facts["clip"]
        seeds = [one.facts["seed"] for one in samples if one.facts["clip"] == clip]
        frames = texvent.video(prompt, seed=seeds[0], sensor="32x24", duration=0.1)
        wanted = texvent.load_truth(texvent.save_truth(frames, tmp_path / f"{number}.truth"))
        truth = sample.truth
        assert truth.classes == {0: "vehicle", 1: "person"}
        assert truth.instances == wanted.instances
        names = [wanted.classes[one] for one in wanted.boxes["class_id"].tolist()]
        kept = wanted.boxes[[name in class_of for name in names]]
        for column in ("t", "x", "y", "w", "h", "track_id"):
            np.testing.assert_array_equal(truth.boxes[column], kept[column])
        assert truth.boxes["class_id"].tolist() == [class_of[one] for one in names if one != "tree"]
        for index in range(len(wanted)):
            np.testing.assert_allclose(truth.depth[index], wanted.depth(index), rtol=5e-4)
            np.testing.assert_array_equal(truth.instance[index], wanted.instance(index))
            if index < len(wanted) - 1:
                flow = wanted.flow(index)
                np.testing.assert_allclose(truth.flow[index], flow, rtol=5e-4, atol=1e-6)
                np.testing.assert_array_equal(truth.occluded[index], wanted.occluded(index))
        np.testing.assert_allclose(truth.poses, wanted.poses, atol=1e-8)


def test_a_set_made_twice_has_equal_bytes(labelled: Path, tmp_path: Path) -> None:
    assert digests(make_set(tmp_path / "again", **TRUTH)) == digests(labelled)


def test_without_classes_boxes_have_the_ids_of_nouns(tmp_path: Path) -> None:
    folder = make_set(tmp_path / "cars", **{**TRUTH, "truth": ["boxes"], "classes": []})
    for sample in texvent.dataset.open(folder, variant="esim"):
        names = {sample.truth.classes[one] for one in sample.truth.boxes["class_id"].tolist()}
        assert names == ({"car"} if "car" in (sample.caption or "") else {"man", "tree"})
        with pytest.raises(InputError, match=r"has no flow: .* stores is boxes"):
            sample.truth.flow  # noqa: B018


def test_boxes_are_counted_and_drawn(labelled: Path, capsys: pytest.CaptureFixture[str]) -> None:
    every = [sample.truth.boxes for sample in texvent.dataset.open(labelled)]
    total = DatasetStatistics.of(StoredDataset.open(labelled)).total.tables
    assert sum(total["boxes"].values()) == sum(map(len, every)) == 18
    assert total["boxes"] == {"person": 9, "vehicle": 9}
    assert total["boxes_by_size"] == {"small": 18, "medium": 0, "large": 0}
    assert (total["tracks"], total["samples_without_boxes"]) == (6, 0.0)
    assert main(["dataset", "stats", str(labelled)]) == 0
    assert "18 of 6 objects: person 9; vehicle 9" in capsys.readouterr().out
    png = texvent.dataset.open(labelled).members(0, ("png",))["png"]
    pixels = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)[..., ::-1]
    rows, columns = np.nonzero((pixels == BOX_COLOUR).all(axis=2))
    boxes, scale = every[0][1:], pixels.shape[1] / 32  # 50 ms end near the second or third frame
    assert abs(columns.min() - boxes["x"] * scale).min() < 3
    assert abs(rows.max() + 1 - (boxes["y"] + boxes["h"]) * scale).min() < 3


def test_verify_compares_boxes_with_the_record(labelled: Path, tmp_path: Path) -> None:
    assert verify(StoredDataset.open(labelled)).is_sound
    shard = labelled / "esim" / "train-000000.tar"
    record = read_record(shard)
    assert record is not None
    first, *others = record.samples
    try:
        write_record(shard, replace(record, samples=(replace(first, tracks=5), *others)))
        (said,) = verify(StoredDataset.open(labelled)).unsound
        assert "counts other boxes" in said
    finally:
        write_record(shard, record)


def test_targets_are_those_of_the_slice(labelled: Path) -> None:
    samples = texvent.dataset.open(labelled, variant="paper").with_targets("boxes", "flow", "depth")
    truth, made = samples[0].truth, samples.make(0)
    assert made["boxes"]["times"].tolist() == [0, 41_667, 83_333]
    np.testing.assert_array_equal(made["flow"], np.moveaxis(truth.flow, -1, 1))
    sliced = samples.represented("voxel-e2vid", slice_us=41_667).make(0)
    assert sliced["representation"].shape == (1, 5, 24, 32)
    assert [one["times"].tolist() for one in sliced["boxes"]] == [[41_667]]
    np.testing.assert_array_equal(sliced["depth"][0], truth.depth[1:2])
    np.testing.assert_array_equal(sliced["flow"][0], made["flow"][:1])
    calm = samples.augmented(Augment(["drop-events", "flip-polarity"]))
    np.testing.assert_array_equal(calm.make(0)["boxes"]["boxes"], made["boxes"]["boxes"])
    with pytest.raises(ConfigError, match="moves events by FlipX, and targets stay"):
        samples.augmented(Augment(["flip-x"]))
    with pytest.raises(ConfigError, match=r"unknown target 'box'; .* did you mean 'boxes'"):
        samples.with_targets("box")


def test_targets_that_are_not_stored_are_refused(cars: Path) -> None:
    with pytest.raises(InputError, match="9 of 9 samples store no boxes; name boxes in `truth`"):
        texvent.dataset.open(cars).with_targets("boxes")


def test_simulated_samples_have_boxes_too() -> None:
    samples = SimulatedSamples(
        prompts=["a red car drives left"], slice_us=41_667, targets=("boxes", "instance"),
        simulation={"sensor": "32x24", "duration": 0.1},
    )  # fmt: skip
    made = samples.make(0)
    assert len(made["boxes"]) == len(made["instance"]) == 1
    rows, columns = np.nonzero(made["instance"][0] == 1)
    x0, y0, x1, y1 = made["boxes"][0]["boxes"][0].tolist()
    assert (x0, y0, x1, y1) == (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)


@pytest.mark.torch
def test_batches_hold_a_table_of_boxes_per_sample(labelled: Path) -> None:
    torch = pytest.importorskip("torch")
    from texvent.dataset.loading.torch_samples import SampleDataset, collate

    samples = texvent.dataset.open(labelled, variant="paper").with_targets("boxes", "flow")
    dataset = SampleDataset(samples)
    batch = collate([dataset[0], dataset[1]])
    assert [len(one["labels"]) for one in batch["boxes"]] == [3, 3]
    assert batch["boxes"][0]["boxes"].dtype == torch.float32
    assert batch["boxes"][0]["labels"].dtype == torch.int64
    assert batch["flow"].shape == (2, 2, 2, 24, 32)
    sliced = SampleDataset(samples.represented("voxel-e2vid", slice_us=41_667))
    batch = collate([sliced[0], sliced[1]])
    assert batch["boxes"][1][0]["times"].tolist() == [41_667]
    assert batch["flow"][0][0].shape == (1, 2, 24, 32)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"truth": ["box"]}, "truth names 'box'; allowed: boxes, .* did you mean 'boxes'"),
        ({"classes": ["car", "trcuk"]}, "'trcuk', which no scene shows; did you mean 'truck'"),
        ({"classes": ["car", "car"]}, "name each object once"),
        ({"classes": ["car", 3]}, "give a list of objects"),
        ({"truth": ["flow"]}, "truth does not name boxes"),
        ({"store_videos": True}, "store_videos simulates from stored"),
        ({"options": {"generator": "opensora"}}, "does not know the scene of its"),
    ],
)
def test_truth_that_cannot_be_is_refused_before_any_work(
    changes: dict[str, Any], said: str
) -> None:
    with pytest.raises(ConfigError, match=said):
        Recipe.of(specification_from({**CARS, **TRUTH, **changes}, folder=Path()))


def test_videos_know_no_truth_of_their_own(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    np.save(tmp_path / "clip.npy", np.zeros((3, 8, 8), np.uint8))
    (tmp_path / "set.toml").write_text(
        'name = "set"\ntruth = ["depth"]\noptions.fps = 30\n[[sources]]\nvideos = ["clip.npy"]\n'
    )
    assert main(["dataset", "plan", str(tmp_path / "set.toml")]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "truth depth is not known of videos; give option motion or depth" in error


def test_classes_keep_their_order_in_the_folder(labelled: Path) -> None:
    facts = json.loads((labelled / "specification.json").read_text())
    pairs = [["bus", "vehicle"], ["man", "person"], ["car", "vehicle"]]
    assert facts["specification"]["classes"] == pairs
    other = specification_from({**CARS, **TRUTH, "classes": ["man", "bus"]}, folder=Path())
    turned = specification_from({**CARS, **TRUTH, "classes": ["bus", "man"]}, folder=Path())
    assert Recipe.of(other).identity != Recipe.of(turned).identity
    assert "truth" not in specification_from(CARS, folder=Path()).tables


@pytest.fixture(scope="module")
def filmed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the frames of a generated clip, and its boxes as COCO."""
    folder = tmp_path_factory.mktemp("filmed")
    frames = texvent.video("a red car drives left past a tree", sensor="32x24", duration=0.2)
    texvent.save_truth(frames, folder / "truth", "boxes")
    (folder / "truth/boxes/coco.json").rename(folder / "car.json")
    (folder / "clips").mkdir()
    np.save(folder / "clips/car.npy", np.stack([frame.pixels for frame in frames]).astype("u1"))
    return folder


def video_set(folder: Path, **changes: Any) -> Recipe:
    source = {"videos": ["clips"], "boxes": "{name}.json", **changes.pop("source", {})}
    tables = {"name": "filmed", "truth": ["boxes"], "classes": ["car"], "sources": [source],
              "filters": {"min_events": 1}, "options": {"fps": 24, "interpolate": "none"}}  # fmt: skip
    return Recipe.of(specification_from({**tables, **changes}, folder=folder))


def test_labels_of_a_video_become_the_boxes_of_its_sample(filmed: Path, tmp_path: Path) -> None:
    rated = {"source": {"box_rate": 48}, "options": {"fps": 24, "sensor": "16x12"}}
    for name, changes in (("plain", {}), ("rated", rated)):
        assert not make(video_set(filmed, **changes), tmp_path / name).failures
        assert verify(StoredDataset.open(tmp_path / name)).is_sound
    wanted = np.load(filmed / "truth/boxes/bbox.npy")
    wanted = wanted[wanted["track_id"] == 1]
    (plain,), (rated,) = (texvent.dataset.open(tmp_path / name) for name in ("plain", "rated"))
    boxes = plain.truth.boxes
    assert plain.truth.classes == {0: "car"}
    assert set(boxes["class_id"].tolist()) == {0}
    for column in ("t", "x", "y", "w", "h", "track_id"):
        np.testing.assert_array_equal(boxes[column], wanted[column])
    assert len(rated.truth.box_times_us) == 2 * len(plain.truth.box_times_us) - 1
    np.testing.assert_allclose(rated.truth.boxes["x"][::2], boxes["x"] / 2)
    middles = (boxes["x"][1:] + boxes["x"][:-1]) / 4
    np.testing.assert_allclose(rated.truth.boxes["x"][1::2], middles, atol=1e-3)


def test_labels_of_more_frames_fail_their_sample_in_one_line(filmed: Path, tmp_path: Path) -> None:
    shorter = tmp_path / "clips"
    shorter.mkdir()
    np.save(shorter / "car.npy", np.load(filmed / "clips/car.npy")[:3])
    (tmp_path / "car.json").write_bytes((filmed / "car.json").read_bytes())
    make(video_set(tmp_path), tmp_path / "set")
    record = read_record(tmp_path / "set/events/train-000000.tar")
    assert record is not None
    (sample,) = record.samples
    assert sample.status == "failed"
    assert "car.json labels frame 4 (from 0), and the video has 3 frames" in (sample.reason or "")


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"classes": ["cra"]}, "'cra', which no label has; .*did you mean 'car'"),
        ({"classes": []}, "labels of videos need `classes`"),
        ({"truth": []}, "truth does not name boxes"),
        ({"truth": ["boxes", "poses"]}, "truth poses is not known of videos; leave it out"),
        ({"options": {"fps": 24, "start": 0.1}}, "option start shows others"),
        ({"source": {"boxes": "{name}.txt"}}, "no such labels: .*car.txt"),
        ({"source": {"boxes": "{nmae}.json"}}, "names {nmae}; there is: folder, name"),
        ({"source": {"boxes": ""}}, "or each source `boxes`, its labels"),
        ({"source": {"box_rate": 0}}, "box_rate is 0"),
    ],
)
def test_labels_that_cannot_be_are_refused_before_any_work(
    filmed: Path, changes: dict[str, Any], said: str
) -> None:
    with pytest.raises(InputError, match=said):
        video_set(filmed, **changes)
