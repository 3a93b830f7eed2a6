"""Files of the layouts, read by the rules of their readers with NumPy and h5py alone."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path

import h5py
import numpy as np
import pytest
import yaml
from tests.dataset.layouts.crossing import SIZE, crossing, crossing_boxes, crossing_events

from texvent.dataset.export import LAYOUTS
from texvent.dataset.layouts.rvt import REPRESENTATION, write_rvt
from texvent.errors import InputError, OutputError
from texvent.view.drawing.event_image import frame_image


def test_rvt_holds_what_its_loader_asserts(tmp_path: Path) -> None:
    sample, out = crossing(), tmp_path / "abc"
    assert LAYOUTS["rvt"].write(sample, out)
    with np.load(out / "labels_v2/labels.npz") as stored:
        labels, starts = stored["labels"], stored["objframe_idx_2_label_idx"]
    place = out / "event_representations_v2" / REPRESENTATION
    ends, windows = (
        np.load(place / "timestamps_us.npy"),
        np.load(place / "objframe_idx_2_repr_idx.npy"),
    )
    assert ends.tolist() == [50_000, 100_000, 150_000, 200_000]
    assert ends[windows].tolist() == np.load(out / "labels_v2/timestamps_us.npy").tolist()
    assert (starts.dtype, windows.dtype) == (np.int64, np.int64)
    assert len(starts) == len(np.unique(labels["t"])) == len(windows) == 4
    assert (np.diff([*starts, len(labels)]) > 0).all()
    found = labels[["t", "x", "w", "class_id", "track_id"]].tolist()
    assert found[:2] == [(50_000, 1, 20, 0, 7), (100_000, 6, 20, 0, 7)]
    assert found[2:4] == [(150_000, 11, 20, 0, 7), (150_000, 40, 8, 1, 9)]
    # At the edge, the last pixels are the end; less than 5 px are no box.
    edge = crossing_boxes()
    edge["x"], edge["w"] = np.where(edge["track_id"] == 7, 50, 59), 40
    LAYOUTS["rvt"].write(crossing(boxes=edge), tmp_path / "edge")
    with np.load(tmp_path / "edge/labels_v2/labels.npz") as stored:
        assert set(stored["labels"][["x", "w", "track_id"]].tolist()) == {(50, 13, 7)}
    events = crossing_events()
    with h5py.File(place / "event_representations.h5") as file:
        assert file["data"].dtype == np.uint8
        assert file["data"].shape == (4, 20, *SIZE.shape)
        second = file["data"][1]
    # Both ends of a window count; bins are those of its first to its last event.
    counts = np.zeros((2, 10, *SIZE.shape), int)
    inside = (events.t >= 50_000) & (events.t <= 100_000)
    first, last = events.t[inside][[0, -1]].tolist()
    columns = (getattr(events, name)[inside].tolist() for name in "xytp")
    for x, y, t, p in zip(*columns, strict=True):
        counts[p, min(9, 10 * (t - first) // (last - first)), y, x] += 1
    assert counts.max() > 10
    np.testing.assert_array_equal(second, np.minimum(counts, 10).reshape(20, *SIZE.shape))


def test_rvt_leaves_out_what_has_no_box_and_leaves_nothing_half_written(tmp_path: Path) -> None:
    nothing = crossing_boxes()[:0]
    assert not LAYOUTS["rvt"].write(crossing(boxes=nothing), tmp_path / "a")
    times = {"start_us": 0, "stop_us": 49_999}
    with pytest.raises(InputError, match="49999 µs of events are shorter than a window of 50000"):
        write_rvt(tmp_path / "a", crossing_events(), nothing, **times)
    with pytest.raises(OutputError, match="does not exist; create it"):
        LAYOUTS["rvt"].write(crossing(), tmp_path / "no" / "such")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("count", [0, 30_000])
def test_gen1_by_the_bits_of_the_toolbox(tmp_path: Path, count: int) -> None:
    events = crossing_events()[:count]
    sample = crossing(read_events=lambda: events)
    assert LAYOUTS["gen1"].write(sample, tmp_path / "abc_td.dat")
    with (tmp_path / "abc_td.dat").open("rb") as file:
        header = {}
        while (line := file.peek(2)[:2]) == b"% ":
            words = file.readline().split()
            header[words[1]] = words[2]
        assert file.read(2)[1] == 8
        raw = np.frombuffer(file.read(), "<u4").reshape(-1, 2)
    assert line != b"% "
    assert (header[b"Width"], header[b"Height"]) == (b"64", b"48")
    np.testing.assert_array_equal(raw[:, 0], events.t)
    np.testing.assert_array_equal(raw[:, 1] & 16383, events.x)
    np.testing.assert_array_equal(raw[:, 1] >> 14 & 16383, events.y)
    np.testing.assert_array_equal(raw[:, 1] >> 28, events.p)
    boxes = np.load(tmp_path / "abc_bbox.npy")
    for name in sample.boxes.dtype.names:
        np.testing.assert_array_equal(boxes[name], sample.boxes[name])


def test_dsec_det_windows_between_images(tmp_path: Path) -> None:
    sample = crossing()
    events = sample.read_events().between(3_000, 200_000)  # later than the first image
    LAYOUTS["dsec-det"].write(crossing(read_events=lambda: events), tmp_path / "abc")
    times = np.genfromtxt(tmp_path / "abc/images/timestamps.txt", dtype="int64")
    assert times.tolist() == sample.instants_us.tolist()
    pictures = sorted((tmp_path / "abc/images/left/distorted").glob("*.png"))
    assert len(pictures) == len(times)
    tracks = np.load(tmp_path / "abc/object_detections/left/tracks.npy")
    assert tracks.dtype.names == (
        "t",
        "x",
        "y",
        "h",
        "w",
        "class_id",
        "class_confidence",
        "track_id",
    )
    assert set(tracks["t"].tolist()) <= set(times.tolist())
    np.testing.assert_array_equal(tracks["h"], sample.boxes["h"])
    with h5py.File(tmp_path / "abc/events/left/events.h5") as file:
        index, offset = file["ms_to_idx"][()], int(file["t_offset"][()])
        columns = {name: file["events"][name][()] for name in "xytp"}
    kinds = [columns[name].dtype.str for name in "xytp"]
    assert (kinds, index.dtype.str) == (["<u2", "<u2", "<u4", "|u1"], "<u8")
    for start, stop in pairwise(times):
        # Whole milliseconds: the index alone gives the events.
        first, last = (
            index[(start - offset) // 1000],
            index[min((stop - offset) // 1000, len(index) - 1)],
        )
        part = events.cut(int(start), int(stop))
        np.testing.assert_array_equal(columns["t"][first:last] + offset, part.t)
        np.testing.assert_array_equal(columns["y"][first:last], part.y)


def test_dsec_det_names_the_sequences_of_splits_that_share_a_folder(tmp_path: Path) -> None:
    samples = [crossing(key=key, split=split) for key, split in (("a", "train"), ("b", "val"))]
    LAYOUTS["dsec-det"].finish(tmp_path, samples, ())
    found = yaml.safe_load((tmp_path / "train_val_test_split.yaml").read_text())
    assert found == {"train": ["a"], "val": ["b"]}


def test_timelens_has_the_events_between_two_frames_beside_them(tmp_path: Path) -> None:
    import cv2

    sample = crossing()
    LAYOUTS["timelens"].write(sample, tmp_path / "abc")
    times = np.loadtxt(tmp_path / "abc/images/timestamp.txt").tolist()
    assert times == sample.instants_us.tolist()
    with sample.read_frames() as frames:
        for index, frame in enumerate(frames):
            picture = cv2.imread(str(tmp_path / f"abc/images/{index:06d}.png"))[..., ::-1]
            np.testing.assert_array_equal(picture, frame_image(frame))
    files = sorted((tmp_path / "abc/events").iterdir())
    assert [one.name for one in files] == [f"{index:06d}.npz" for index in range(1, 7)]
    stored = [np.load(one) for one in files]
    events = sample.read_events()
    for name in "xytp":
        np.testing.assert_array_equal(
            np.concatenate([one[name] for one in stored]), getattr(events, name)
        )
    assert all(
        ((one["t"] >= 40_000 * n) & (one["t"] < 40_000 * (n + 1))).all()
        for n, one in enumerate(stored)
    )


def test_coco_has_an_image_of_every_instant_with_events_behind_it(tmp_path: Path) -> None:
    sample = crossing()
    LAYOUTS["coco"].write(sample, tmp_path / "train/abc") if (
        tmp_path / "train"
    ).mkdir() is None else None
    LAYOUTS["coco"].finish(
        tmp_path, [sample, crossing(key="b", boxes=sample.boxes[:0])], ("car", "man")
    )
    found = json.loads((tmp_path / "train/annotations.json").read_text())
    assert found["categories"][1] == {"id": 2, "name": "man", "supercategory": "object"}
    assert [one["t_us"] for one in found["images"]] == [
        80_000,
        120_000,
        160_000,
        200_000,
        240_000,
    ] * 2
    assert all((tmp_path / "train" / one["file_name"]).is_file() for one in found["images"][:5])
    assert len(found["annotations"]) == 9
    last = found["annotations"][-1]
    assert last == {"id": 9, "image_id": 5, "category_id": 2, "bbox": [40, 20, 8, 20], "area": 160,
                    "iscrowd": 0, "track_id": 9}  # fmt: skip
