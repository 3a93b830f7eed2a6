"""Layouts read back by evlib, which has Prophesee's tools too, pycocotools, tonic, SpikingJelly.

tonic is under the GPL: `make test-gpl` alone installs it.
"""

import importlib
from pathlib import Path

import numpy as np
import pytest
from tests.dataset.conftest import assert_same, make_set, samples_of
from tests.dataset.layouts.crossing import SIZE, crossing, crossing_events

from texvent.cli.app import main
from texvent.dataset.export import LAYOUTS, export
from texvent.dataset.layouts.rvt import REPRESENTATION
from texvent.dataset.stored.folder import StoredDataset


@pytest.mark.detect
def test_evlib_loads_rvt_sequences_with_the_histograms_that_it_computes(tmp_path):
    import evlib
    import evlib.data as data

    for key in ("a", "b"):
        LAYOUTS["rvt"].write(crossing(key=key), tmp_path / key)
    sources = [
        data.PreprocessedH5Source(tmp_path / key, REPRESENTATION, downsample_by_2=False)
        for key in ("a", "b")
    ]
    windows, labels = sources[0].read_windows(0, 4)
    assert labels[0].tolist() == [[0, 11, 17.5, 20, 15]]  # class, centre, sides
    assert labels[2].tolist() == [[0, 21, 17.5, 20, 15], [1, 44, 30, 8, 20]]
    columns = {name: getattr(crossing_events(), name).astype(np.int64) for name in "txyp"}
    ends = np.array([50_000, 100_000, 150_000, 200_000])
    maps = np.arange(SIZE.height), np.arange(SIZE.width)
    dense = evlib.representations_rs.stacked_histogram_dense(
        *columns.values(), ends, 50_000, 10, 10, *maps, SIZE.height, SIZE.width
    )
    np.testing.assert_array_equal(np.stack([one.numpy() for one in windows]), dense)
    dataset = data.SequenceRandomDataset(sources, sequence_length=3)
    batch = data.custom_collate_random([dataset[index] for index in range(len(dataset))])
    assert batch["ev_repr"][0].shape == (4, 20, *SIZE.shape)
    assert batch["is_padded_mask"].sum() == 4


@pytest.mark.detect
def test_evlib_streams_a_data_set_that_was_made_and_exported(tmp_path):
    import evlib.data as data

    prompts = [f"a {noun} drives left" for noun in ("car", "bus", "taxi")]
    options = {"duration": 0.3, "sensor": "64x48"}
    tables = {"options": options, "variants": {"paper": {}}, "truth": ["boxes"]}
    made = make_set(tmp_path / "made", sources=[{"prompts": prompts}], **tables)
    words = ["dataset", "export", str(made), "--layout", "rvt", "--classes", "bus,car"]
    assert main([*words, "-o", str(tmp_path / "rvt")]) == 0
    sources = [
        data.PreprocessedH5Source(one, REPRESENTATION, downsample_by_2=False)
        for one in sorted((tmp_path / "rvt").glob("*/*"))
    ]
    (batch,) = map(data.custom_collate_stream, data.SequenceStreamDataset(sources, 5, batch_size=3))
    assert len(batch["ev_repr"]) == 5  # the last frame is at 292 ms
    assert all(one.sum() > 0 for one in batch["ev_repr"])
    classes = [[int(box[0]) for box in one] for one in batch["objlabels_seq"][3]]
    assert sorted(classes) == [[0], [1], [1]]


@pytest.mark.detect
def test_evlib_reads_and_filters_boxes_of_gen1(tmp_path):
    import evlib.data as data
    from evlib.eval.prophesee.box_filtering import filter_boxes

    LAYOUTS["gen1"].write(crossing(), tmp_path / "abc_td.dat")
    boxes = data.read_raw_bbox(tmp_path / "abc_bbox.npy")
    kept = data.apply_filters(boxes, dataset="gen1", split="train", height=48, width=64)
    assert len(kept) == len(boxes) == 11
    assert len(filter_boxes(boxes, skip_ts=100_000, min_box_diag=20, min_box_side=10)) == 4


@pytest.mark.dataset
def test_pycocotools_indexes_the_images(tmp_path):
    from pycocotools.coco import COCO

    (tmp_path / "train").mkdir()
    LAYOUTS["coco"].write(crossing(), tmp_path / "train/abc")
    LAYOUTS["coco"].finish(tmp_path, [crossing()], ("car", "man"))
    found = COCO(str(tmp_path / "train/annotations.json"))
    (men,) = {one["category_id"] for one in found.loadAnns(found.getAnnIds(catIds=[2]))}
    assert (men, found.loadCats([2])[0]["name"], len(found.getImgIds())) == (2, "man", 5)
    image = found.loadImgs(found.getImgIds(catIds=[2]))[0]
    assert (tmp_path / "train" / image["file_name"]).is_file()


SPIKING = {"n-mnist": "34x34", "dvs-gesture": "128x128"}
NUMBERS = {"bus": 0, "car": 1, "taxi": 2}


@pytest.fixture(params=SPIKING)
def spiking(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[str, Path, Path]:
    """Name of a layout, a data set of three classes, and the folder of its export."""
    colours = {"colour": ["red", "white"]}
    source = {"template": "a {colour} {class} drives left", "words": colours, "classes": [*NUMBERS]}
    made = make_set(
        tmp_path / "made",
        sources=[source],
        splits={"train": 0.5, "test": 0.5},
        options={"duration": 0.15, "sensor": SPIKING[request.param], "samples": 1},
        variants={"paper": {}},
    )
    done = export(StoredDataset.open(made), request.param, tmp_path / "out")
    assert f"its classes are {', '.join(f'{n} {one}' for one, n in NUMBERS.items())}" in done.doubts
    return request.param, made, tmp_path / "out"


@pytest.mark.gpl
def test_tonics_own_loaders_read_every_event(spiking, monkeypatch):
    name, made, out = spiking
    datasets = importlib.import_module("tonic.datasets")
    loader = {"n-mnist": datasets.NMNIST, "dvs-gesture": datasets.DVSGesture}[name]
    monkeypatch.setattr(loader, "_check_exists", lambda self: True)
    wanted = samples_of(made)
    for split in ("train", "test"):
        found = loader(str(out), train=split == "train")
        for path, (columns, number) in zip(map(Path, found.data), found, strict=True):
            key = path.parent.name.split("_")[1] if name == "dvs-gesture" else path.stem
            expected_split, label, events = wanted.pop(key)
            assert (expected_split, NUMBERS[label]) == (split, number)
            assert len(events) > 0
            assert_same(columns, events)
    assert not wanted


@pytest.mark.detect
def test_spikingjellys_own_loaders_read_every_event(spiking):
    from spikingjelly.datasets.dvs128_gesture import DVS128Gesture
    from spikingjelly.datasets.n_mnist import NMNIST

    name, made, out = spiking
    loader = {"n-mnist": NMNIST, "dvs-gesture": DVS128Gesture}[name]
    wanted = samples_of(made)
    for split in ("train", "test"):
        found = loader(str(out), train=split == "train")
        frames = loader(
            str(out), split == "train", data_type="frame", frames_number=3, split_by="number"
        )
        for (path, _), (columns, number), (dense, _) in zip(
            found.samples, found, frames, strict=True
        ):
            expected_split, label, events = wanted.pop(Path(path).stem)
            assert (expected_split, NUMBERS[label]) == (split, number)
            assert_same(columns, events)
            assert dense.shape == (3, 2, *events.size.shape)
            assert dense.sum() == len(events) > 0
    assert not wanted
