"""Labels of three formats read alike, are refused in one line, and placed as computed by hand."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from texvent.errors import InputError
from texvent.sensor import SensorSize
from texvent.truth.labels.labels import Labels, make_labels
from texvent.truth.labels.placing import PlacedLabels
from texvent.truth.labels.reading import read_labels

SIZE = SensorSize(40, 20)
BOXES = ((0, 1, 4.0, 2.0, 8.0, 6.0), (0, 2, 30.0, 10.0, 14.0, 6.0), (2, 1, 8.0, 2.0, 8.0, 10.0))
"""Frame from 0, track, x, y, w, h; frame 1 shows nothing. The second leaves the picture."""


def coco(**changes: Any) -> str:
    facts = {
        "images": [{"id": 10 + k, "width": 40, "height": 20} for k in range(3)],
        "categories": [{"id": 5, "name": "cat"}, {"id": 3, "name": "car"}],
        "annotations": [
            {"id": k, "image_id": 10 + frame, "category_id": 3, "bbox": box, "track_id": track}
            for k, (frame, track, *box) in enumerate(BOXES)
        ],
    }
    return json.dumps({**facts, **changes})


def mot(*more: str) -> str:
    rows = (f"{f + 1},{i},{x + 1},{y + 1},{w},{h},1,3,1" for f, i, x, y, w, h in BOXES)
    return "\n".join([*rows, *more]) + "\n"


def yolo(folder: Path, names: str | None = "cat\ncar\n") -> Path:
    folder.mkdir()
    for frame in range(3):
        lines = [
            f"1 {(x + w / 2) / 40} {(y + h / 2) / 20} {w / 40} {h / 20}\n"
            for at, _, x, y, w, h in BOXES
            if at == frame
        ]
        (folder / f"clip_{frame + 1}.txt").write_text("".join(lines))
    if names is not None:
        (folder / "classes.txt").write_text(names)
    return folder


def test_three_formats_hold_the_same_boxes(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(coco())
    (tmp_path / "a.txt").write_text(mot("2,9,3,3,5,5,0,3,1"))  # confidence 0: not to be used
    paths = tmp_path / "a.json", tmp_path / "a.txt", yolo(tmp_path / "yolo")
    for path, tracks, frames in zip(
        paths, ([1, 2, 1], [1, 2, 1], [0, 0, 0]), ([0, 1, 2], [0, 2], [0, 1, 2]), strict=True
    ):
        labels = read_labels(path)
        boxes = labels.inside(SIZE)
        found = np.stack([boxes[name] for name in ("frame", *"xywh")], axis=1)
        wanted = [[0, 4, 2, 8, 6], [0, 30, 10, 10, 6], [2, 8, 2, 8, 10]]
        np.testing.assert_allclose(found, wanted, atol=1e-9)
        assert {labels.names[one] for one in boxes["class_id"]} == {"car"}
        assert boxes["track_id"].tolist() == tracks
        assert labels.frames.tolist() == frames
        assert labels.has_tracks == (tracks[0] > 0)


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("a.json", coco(annotations=[]), "holds no box"),
        ("a.json", coco(images=[]), "annotation 0 has image_id 10, which the file does not name"),
        ("a.json", coco(categories=[]), "annotation 0 has category_id 3, which"),
        ("a.json", '{"images": []}', "cannot be read as COCO"),
        ("a.json", coco(annotations=[{"image_id": 10, "category_id": 3, "bbox": [41, 2, 5, 5]}]),
         r"box \[41.0, 2.0, 5.0, 5.0\] of class 'car' in frame 0 is outside the picture"),
        ("a.json", coco(annotations=[{"image_id": 10, "category_id": 3, "bbox": [4, 2, 0, 5]}]),
         "has no size"),
        ("a.txt", mot("1,1,3,3,5,5,1,3,1"), "track 1 is twice in frames 0 "),
        ("a.txt", "1,4,1,1,3,4,1,1,1\n2,4,36,1,3,4,1,1,1\n", "track 4 jumps in frames 0 to 1 "),
        ("a.txt", mot("3,4,3,3,5,5,1,14,1"), r"class 14; MOT has those of 1..13"),
        ("a.txt", "0,4,3,3,5,5,1,1,1\n", "frame 0; MOT counts frames from 1"),
        ("a.txt", "1,2,3\n", "has 3 columns"),
        ("a.txt", "a car\n", "cannot be read as MOT"),
        ("a.csv", "1,2,3\n", "neither COCO"),
    ],
)  # fmt: skip
def test_labels_that_cannot_be_are_refused(
    tmp_path: Path, name: str, content: str, said: str
) -> None:
    (tmp_path / name).write_text(content)
    with pytest.raises(InputError, match=said):
        read_labels(tmp_path / name)


def test_yolo_folders_that_cannot_be_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such labels"):
        read_labels(tmp_path / "none")
    with pytest.raises(InputError, match=r"put their names into classes.txt"):
        read_labels(yolo(tmp_path / "a", names=None))
    with pytest.raises(InputError, match="has class 1, and 1 classes have names"):
        read_labels(yolo(tmp_path / "b", names="cat\n"))
    named = yolo(tmp_path / "c", names=None)
    (tmp_path / "data.yaml").write_text("names: {0: cat, 1: car}\n")
    assert read_labels(named).names == ("cat", "car")


def placed(**changes: Any) -> PlacedLabels:
    rows: list[tuple[float, ...]] = [
        (0, 4, 2, 8, 6, 0, 1, 1.0), (2, 8, 2, 8, 10, 0, 1, 1.0), (2, 30, 0, 4, 4, 1, 2, 0.5),
    ]  # fmt: skip
    labels = make_labels(Path("a.txt"), rows, ("car", "man"), frames={0, 2, 3})
    return PlacedLabels(**{"labels": labels, "picture": SIZE, "fit": "stretch", **changes})


TIMES = np.array([1_000, 2_000, 3_000, 4_000])


def test_without_a_clock_boxes_are_at_the_labelled_frames() -> None:
    boxes, known = placed().boxes(TIMES, SIZE, {"car": 4, "man": 0})
    assert known.tolist() == [1_000, 3_000, 4_000]
    assert boxes.tolist() == [
        (1_000, 4, 2, 8, 6, 4, 1, 1.0), (3_000, 8, 2, 8, 10, 4, 1, 1.0),
        (3_000, 30, 0, 4, 4, 0, 2, 0.5),
    ]  # fmt: skip
    boxes, _ = placed().boxes(TIMES, SIZE, {"man": 0})
    assert boxes["track_id"].tolist() == [2]


def test_tracks_are_interpolated_on_the_clock() -> None:
    boxes, known = placed(rate_hz=Fraction(2_000)).boxes(TIMES, SIZE, {"car": 4, "man": 0})
    assert known.tolist() == [1_000, 1_500, 2_000, 2_500, 3_000, 3_500, 4_000]
    car = boxes[boxes["track_id"] == 1]
    assert car["t"].tolist() == [1_000, 1_500, 2_000, 2_500, 3_000]
    assert car["x"].tolist() == [4, 5, 6, 7, 8]
    assert car["h"].tolist() == [6, 7, 8, 9, 10]
    assert boxes[boxes["track_id"] == 2]["t"].tolist() == [3_000]  # seen in one labelled frame
    _, known = placed(rate_hz=Fraction(700)).boxes(TIMES, SIZE, {"car": 4})
    assert known.tolist() == [1_000, 2_429, 3_857]


@pytest.mark.parametrize(
    ("fit", "size", "wanted"),
    [
        ("stretch", (20, 20), [(2, 2, 4, 6), (4, 2, 4, 10), (15, 0, 2, 4)]),
        # 40x20 cut to its middle 20x20: 10 px go on either side.
        ("cover", (20, 20), [(0, 2, 2, 6), (0, 2, 6, 10)]),
        # 40x20 becomes 20x10 under a bar of 5 px.
        ("contain", (20, 20), [(2, 6, 4, 3), (4, 6, 4, 5), (15, 5, 2, 2)]),
    ],
)
def test_boxes_are_fitted_as_frames_are(
    fit: str, size: tuple[int, int], wanted: list[tuple[float, ...]]
) -> None:
    boxes, _ = placed(fit=fit).boxes(TIMES, SensorSize(*size), {"car": 0, "man": 1})
    assert [tuple(one) for one in boxes[list("xywh")].tolist()] == wanted


def test_labels_of_another_video_are_refused() -> None:
    with pytest.raises(InputError, match=r"labels frame 3 \(from 0\), and the video has 2 frames"):
        placed().boxes(TIMES[:2], SIZE, {"car": 0})
    boxes, known = placed(is_whole=False).boxes(TIMES[:2], SIZE, {"car": 0})
    assert (len(boxes), known.tolist()) == (1, [1_000])
    sized = Labels(Path("a.json"), placed().labels.boxes, np.array([0]), ("car",), SensorSize(9, 9))
    with pytest.raises(InputError, match="labels pictures of 9x9, and the video has 40x20"):
        sized.inside(SIZE)
