"""Ground truth in data sets: stored as the scene or the labels know it, read, counted, drawn."""

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
from texvent.cli.app import main
from texvent.dataset.export import export
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.generation.shard_files import read_record, write_record
from texvent.dataset.simulated_samples import SimulatedSamples
from texvent.dataset.specification.reading import specification_from
from texvent.dataset.stored.folder import StoredDataset
from texvent.dataset.stored.stored_samples import StoredSamples
from texvent.dataset.verify import verify
from texvent.errors import ConfigError, InputError
from texvent.view.drawing.panels import BOX_COLOUR

TRUTH: dict[str, Any] = {
    "truth": ["boxes", "flow", "depth", "ids", "poses"],
    "classes": {"bus": "vehicle", "man": "person", "car": "vehicle"},
    "sources": [{"prompts": ["a red car drives left", "a man walks right past a cone"]}],
    "splits": {"train": 1.0},
}


@pytest.fixture(scope="module")
def labelled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_set(tmp_path_factory.mktemp("labelled") / "cars", **TRUTH)


@pytest.mark.long
def test_truth_is_that_of_the_scene_in_every_variant(labelled, tmp_path):
    samples = texvent.dataset.open(labelled)
    assert len(samples) == 6
    for number, sample in enumerate(samples):
        seeds = [one.facts["seed"] for one in samples if one.caption == sample.caption]
        frames = texvent.video(sample.caption, seed=seeds[0], sensor="32x24", duration=0.1)
        wanted = texvent.load_truth(texvent.save_truth(frames, tmp_path / f"{number}.truth"))
        truth = sample.truth
        assert truth.classes == {0: "vehicle", 1: "person"}
        assert truth.instances == wanted.instances
        names = np.array([wanted.classes[one] for one in wanted.boxes["class_id"].tolist()])
        boxes = wanted.boxes[names != "cone"]
        for column in ("t", "x", "y", "w", "h", "track_id"):
            np.testing.assert_array_equal(truth.boxes[column], boxes[column])
        np.testing.assert_array_equal(truth.boxes["class_id"], names[names != "cone"] == "man")
        np.testing.assert_allclose(truth.depth(), wanted.depth(), rtol=5e-4)
        np.testing.assert_array_equal(truth.instance(), wanted.instance())
        np.testing.assert_allclose(truth.flow(), wanted.flow(), rtol=5e-4, atol=1e-6)
        np.testing.assert_array_equal(truth.occluded(), wanted.occluded())
        np.testing.assert_allclose(truth.poses, wanted.poses, atol=1e-8)
    assert digests(make_set(tmp_path / "again", **TRUTH)) == digests(labelled)


def test_without_classes_boxes_have_the_ids_of_nouns(tmp_path):
    folder = make_set(tmp_path / "cars", **{**TRUTH, "truth": ["boxes"], "classes": []})
    for sample in texvent.dataset.open(folder, variant="esim"):
        names = {sample.truth.classes[one] for one in sample.truth.boxes["class_id"].tolist()}
        assert names == ({"car"} if "car" in (sample.caption or "") else {"man", "cone"})


def test_boxes_are_counted_checked_and_drawn(labelled, tmp_path, capsys):
    none = make_set(tmp_path, **{**TRUTH, "truth": ["boxes"], "classes": ["dragonfly"]})
    assert main(["dataset", "stats", str(none)]) == 0
    assert "\nwarning  no sample shows: dragonfly\n" in capsys.readouterr().out
    plan = tmp_path / "plan.yaml"
    plan.write_text(json.dumps({**CARS, **TRUTH, "truth": ["boxes"], "classes": ["dragonfly"]}))
    assert main(["dataset", "plan", str(plan), "--trial", "1", "--workers", "1"]) == 0
    assert "\nwarning  no sample shows: dragonfly\n" in capsys.readouterr().out
    with pytest.raises(InputError, match="layout coco holds boxes, and no sample shows dragonfly"):
        export(StoredDataset.open(none), "coco", tmp_path / "out", variant="esim")
    samples = texvent.dataset.open(labelled)
    assert sum(len(sample.truth.boxes) for sample in samples) == 18
    assert main(["dataset", "stats", str(labelled)]) == 0
    out = capsys.readouterr().out
    assert "18 of 6 objects: person 9; vehicle 9" in out
    assert "18 small, 0 medium, 0 large" in out
    assert "\nboxes of  train\nperson        9\nvehicle       9\n" in out
    assert "\nno box   of cone 3 (samples with them): classes leaves them out\n" in out
    pixels = cv2.imdecode(np.frombuffer(samples.members(0)["png"], np.uint8), cv2.IMREAD_COLOR)
    assert pixels is not None
    rows, columns = np.nonzero((pixels[..., ::-1] == BOX_COLOUR).all(axis=2))
    boxes, scale = samples[0].truth.boxes[1:], pixels.shape[1] / 32  # one of the last two frames
    assert abs(columns.min() - boxes["x"] * scale).min() < 3
    assert abs(rows.max() + 1 - (boxes["y"] + boxes["h"]) * scale).min() < 3
    shard = labelled / "esim" / "train-000000.tar"
    record = read_record(shard)
    assert record is not None
    first, *others = record.samples
    write_record(shard, replace(record, samples=(replace(first, tracks=5), *others)))
    (said,) = verify(StoredDataset.open(labelled)).unsound
    assert "counts other boxes" in said
    write_record(shard, record)
    assert verify(StoredDataset.open(labelled)).is_sound


def test_a_split_without_a_class_of_boxes_is_told(tmp_path, capsys):
    file = tmp_path / "cars.yaml"
    file.write_text(
        json.dumps({**CARS, "truth": ["boxes"], "classes": ["car", "bus", "tree"], "variants": {}})
    )
    assert main(["dataset", "make", str(file), "-o", str(tmp_path / "cars"), "--workers", "1"]) == 0
    made = capsys.readouterr().out
    assert main(["dataset", "stats", str(tmp_path / "cars")]) == 0
    samples = texvent.dataset.open(tmp_path / "cars")
    splits = {split: {one.label for one in texvent.dataset.open(tmp_path / "cars", split=split)}
              for split in ("train", "test")}  # fmt: skip
    assert len(samples) == 3
    lacking = [(split, name) for split, has in splits.items() for name in {"car", "bus"} - has]
    assert lacking
    for out in (made, capsys.readouterr().out):
        for split, name in lacking:
            assert f"\nwarning  {split} has no {name}\n" in out
        assert "\nwarning  no sample shows: tree\n" in out
        assert "no box   of" not in out


def test_targets_are_those_of_the_slice(labelled, cars):
    samples = texvent.dataset.open(labelled, variant="paper").with_targets("boxes", "flow", "depth")
    truth, made = samples[0].truth, samples.make(0)
    assert made["boxes"]["times"].tolist() == [0, 41_667, 83_333]
    np.testing.assert_array_equal(made["flow"], np.moveaxis(truth.flow(), -1, 1))
    sliced = samples.represented("voxel-e2vid", slice_us=41_667).make(0)
    assert sliced["representation"].shape == (1, 5, 24, 32)
    assert [one["times"].tolist() for one in sliced["boxes"]] == [[41_667]]
    np.testing.assert_array_equal(sliced["depth"], truth.depth()[1:2])
    np.testing.assert_array_equal(sliced["flow"], made["flow"][:1])
    with pytest.raises(InputError, match="9 of 9 samples store no boxes; name boxes in `truth`"):
        texvent.dataset.open(cars).with_targets("boxes")


@pytest.fixture(scope="module")
def twins(tmp_path_factory: pytest.TempPathFactory) -> tuple[StoredSamples, SimulatedSamples]:
    """The same clips through both doors: stored, and simulated when they are asked for."""
    folder = tmp_path_factory.mktemp("twins")
    prompts = ["a red car drives left, the camera pans right", "a ball bounces"]
    options = {"sensor": "32x24", "duration": 0.25, "fps": 25, "interpolate": "none"}
    simulated = SimulatedSamples(prompts=prompts, simulation=options)
    rows = [{"prompt": one, "seed": simulated.seed_of(n)} for n, one in enumerate(prompts)]
    (folder / "list.jsonl").write_text("".join(f"{json.dumps(row)}\n" for row in rows))
    tables = {"name": "twins", "sources": [{"file": "list.jsonl"}], "options": options,
              "truth": ["flow", "depth"], "filters": {"min_events": 0}}  # fmt: skip
    specification = specification_from(tables, folder=folder)
    assert not make(Recipe.of(specification), folder / "twins").failures
    return texvent.dataset.open(folder / "twins"), simulated


@pytest.mark.parametrize("slice_us", [40_000, 120_000, 50_000])
def test_targets_of_slices_are_those_of_the_same_clip_simulated(twins, slice_us):
    stored, simulated = (
        one.represented("voxel-e2vid", slice_us=slice_us).with_targets("flow", "depth")
        for one in twins
    )
    assert stored.count == simulated.count == 2
    for number in range(2):
        mine = stored.make(number)
        wanted = simulated.make([simulated.seed_of(n) for n in range(2)].index(mine["seed"]))
        np.testing.assert_array_equal(mine["representation"], wanted["representation"])
        flow, exact = mine["flow"], wanted["flow"]
        assert flow.shape == exact.shape == (len(mine["stop_us"]), 2, 24, 32)
        assert mine["depth"].shape == wanted["depth"].shape
        if slice_us == 40_000:  # from frame to frame, as it is stored, in float16
            np.testing.assert_allclose(flow, exact, rtol=5e-4, atol=1e-6)
            np.testing.assert_allclose(mine["depth"], wanted["depth"], rtol=5e-4)
            continue
        is_known = np.isfinite(flow).all(axis=1) & np.isfinite(exact).all(axis=1)
        assert is_known.mean() > 0.5
        off = np.hypot(*np.moveaxis(flow - exact, 1, 0))[is_known]
        assert np.quantile(off, 0.9) < 0.05
        assert np.quantile(off, 0.98) < 0.3


def test_simulated_samples_have_boxes_too():
    options = {"sensor": "32x24", "duration": 0.1}
    made = SimulatedSamples(
        prompts=["a red car drives left"], slice_us=41_667, targets=("boxes", "instance"),
        simulation=options,
    ).make(0)  # fmt: skip
    rows, columns = np.nonzero(made["instance"][0] == 1)
    x0, y0, x1, y1 = made["boxes"][0]["boxes"][0].tolist()
    assert (x0, y0, x1, y1) == (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)


@pytest.mark.torch
def test_batches_hold_a_table_of_boxes_per_sample(labelled):
    torch = pytest.importorskip("torch")
    from texvent.dataset.torch_samples import SampleDataset, collate

    samples = texvent.dataset.open(labelled, variant="paper").with_targets("boxes", "flow")
    batch = collate([SampleDataset(samples)[number] for number in (0, 1)])
    assert [len(one["labels"]) for one in batch["boxes"]] == [3, 3]
    assert batch["boxes"][0]["boxes"].dtype == torch.float32
    assert batch["flow"].shape == (2, 2, 2, 24, 32)
    sliced = SampleDataset(samples.represented("voxel-e2vid", slice_us=41_667))
    batch = collate([sliced[0], sliced[1]])
    assert batch["boxes"][1][0]["times"].tolist() == [41_667]
    assert batch["flow"].flatten(0, 1).shape == (2, 2, 24, 32)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"truth": ["box"]}, "truth names 'box'; allowed: boxes, .* did you mean 'boxes'"),
        ({"classes": ["car", "trcuk"]}, "'trcuk', which no source shows; did you mean 'truck'"),
        ({"classes": ["pedestrian"]}, "which boxes call 'person'; .* person = 'pedestrian' }"),
        (
            {"classes": {"person": "one", "pedestrian": "one"}},
            "object = class, .* person = 'one' }",
        ),
        ({"classes": ["car", "car"]}, "name each object once"),
        ({"classes": ["car", 3]}, "give a list of objects"),
        ({"truth": ["flow"]}, "truth does not name boxes"),
        ({"store_videos": True}, "store_videos simulates from stored"),
        ({"options": {"generator": "opensora"}}, "does not know the scene of its"),
    ],
)
def test_truth_that_cannot_be_is_refused_before_any_work(changes, said):
    with pytest.raises(ConfigError, match=said):
        Recipe.of(specification_from({**CARS, **TRUTH, **changes}, folder=Path()))


def test_the_order_of_classes_is_part_of_the_identity():
    def identity(*classes: str) -> str:
        tables = {**CARS, **TRUTH, "classes": list(classes)}
        recipe = Recipe.of(specification_from(tables, folder=Path()))
        again = specification_from(recipe.specification.tables, folder=Path())
        assert again.class_of == recipe.specification.class_of
        return recipe.identity

    assert identity("man", "bus") != identity("bus", "man")
    assert "truth" not in specification_from(CARS, folder=Path()).tables  # as before there was any


@pytest.fixture(scope="module")
def filmed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the frames of a generated clip, and its boxes as COCO."""
    folder = tmp_path_factory.mktemp("filmed")
    frames = texvent.video("a red car drives left past a tree", sensor="32x24", duration=0.2)
    texvent.save_truth(frames, folder / "truth", "boxes")
    (folder / "truth/boxes/coco.json").rename(folder / "car.json")
    facts = json.loads((folder / "car.json").read_text())
    for box in facts["annotations"]:
        del box["track_id"]
    (folder / "loose.json").write_text(json.dumps(facts))
    (folder / "clips").mkdir()
    np.save(folder / "clips/car.npy", np.stack([frame.pixels for frame in frames]).astype("u1"))
    return folder


def video_set(folder: Path, source: dict[str, Any] | None = None, **changes: Any) -> Recipe:
    tables = {
        "name": "filmed",
        "truth": ["boxes"],
        "classes": ["car"],
        "filters": {"min_events": 1},
        "options": {"fps": 24, "interpolate": "none"},
        "sources": [{"videos": ["clips"], "boxes": "{name}.json", **(source or {})}],
    }
    return Recipe.of(specification_from({**tables, **changes}, folder=folder))


def test_labels_of_a_video_become_the_boxes_of_its_sample(filmed, tmp_path):
    fitted = {"fps": 24, "interpolate": "none", "sensor": "16x12"}
    assert not make(video_set(filmed), tmp_path / "plain").failures
    rated = video_set(filmed, {"box_rate": 48}, options=fitted)
    assert not make(rated, tmp_path / "rated").failures
    (shard,) = StoredDataset.open(tmp_path / "plain").shards()
    assert [one.unboxed for one in shard.samples] == [("tree",)]
    (plain,) = texvent.dataset.open(tmp_path / "plain")
    wanted = np.load(filmed / "truth/boxes/bbox.npy")
    wanted = wanted[wanted["track_id"] == 1]
    boxes = plain.truth.boxes
    assert (plain.truth.classes, set(boxes["class_id"].tolist())) == ({0: "car"}, {0})
    for column in ("t", "x", "y", "w", "h", "track_id"):
        np.testing.assert_array_equal(boxes[column], wanted[column])
    (sample,) = texvent.dataset.open(tmp_path / "rated")
    assert len(sample.truth.box_times_us) == 2 * len(plain.truth.box_times_us) - 1
    np.testing.assert_allclose(sample.truth.boxes["x"][::2], boxes["x"] / 2)
    middles = (boxes["x"][1:] + boxes["x"][:-1]) / 4
    np.testing.assert_allclose(sample.truth.boxes["x"][1::2], middles, atol=1e-3)
    assert verify(StoredDataset.open(tmp_path / "rated")).is_sound
    part = video_set(filmed, options={"fps": 24, "interpolate": "none", "stop": 0.1})
    assert not make(part, tmp_path / "part").failures
    (cut,) = texvent.dataset.open(tmp_path / "part")
    assert cut.truth.boxes.tolist() == boxes[boxes["t"] < 100_000].tolist()


def test_labels_of_more_frames_are_refused_before_any_work(filmed, tmp_path):
    (tmp_path / "clips").mkdir()
    np.save(tmp_path / "clips/car.npy", np.load(filmed / "clips/car.npy")[:3])
    (tmp_path / "car.json").write_bytes((filmed / "car.json").read_bytes())
    said = r"car\.json labels more frames \(5\) than the video has \(3\)"
    with pytest.raises(InputError, match=said):
        video_set(tmp_path)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"classes": ["cra"]}, "'cra', which no source shows; .*did you mean 'car'"),
        ({"classes": []}, "boxes of videos need `classes`"),
        ({"truth": []}, "truth does not name boxes"),
        ({"truth": ["boxes", "poses"]}, "truth poses is not known of videos; leave it out"),
        ({"truth": ["boxes", "depth"]}, "of videos; give option motion or depth"),
        ({"options": {"fps": 24, "start": 0.1}}, "option start shows others"),
        ({"source": {"boxes": "{name}.txt"}}, "no such labels: .*car.txt"),
        ({"source": {"boxes": "{nmae}.json"}}, "names {nmae}; there is: folder, name"),
        ({"source": {"boxes": ""}}, "or sources `boxes`, labels of their videos"),
        ({"source": {"box_rate": 0}}, "box_rate is 0"),
        (
            {"source": {"boxes": "loose.json", "box_rate": 48}},
            "loose.json has boxes without one; l",
        ),
        (
            {
                "sources": [
                    {"videos": ["clips"], "boxes": one} if one else {"videos": ["clips"]}
                    for one in ("car.json", "")
                ]
            },
            "give all some, or none",
        ),
    ],
)
def test_labels_that_cannot_be_are_refused_before_any_work(filmed, changes, said):
    with pytest.raises(InputError, match=said):
        video_set(filmed, **changes)
