"""Labels of three formats read alike, are refused in one line, and placed as computed by hand."""

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from texvent.errors import InputError
from texvent.sensor import SensorSize
from texvent.truth.labels import Labels, read_labels

SIZE = SensorSize(40, 20)
BOXES = ((0, 1, 4.0, 2.0, 8.0, 6.0), (0, 2, 30.0, 10.0, 14.0, 6.0), (2, 1, 8.0, 2.0, 8.0, 10.0))
"""Frame from 0, track, x, y, w, h; frame 1 shows nothing. The second leaves the picture."""


def coco(**changes: Any) -> str:
    annotations = [
        {"image_id": 10 + frame, "category_id": 3, "bbox": box, "track_id": track}
        for frame, track, *box in BOXES
    ]
    images = [{"id": 10 + k, "width": 40, "height": 20} for k in range(3)]
    categories = [{"id": 5, "name": "cat"}, {"id": 3, "name": "car"}]
    facts = {"images": images, "categories": categories, "annotations": annotations}
    return json.dumps({**facts, **changes})


def coco_box(*box: float) -> str:
    return coco(annotations=[{"image_id": 10, "category_id": 3, "bbox": box}])


def mot(*more: str) -> str:
    rows = (f"{f + 1},{i},{x + 1},{y + 1},{w},{h},1,3,1" for f, i, x, y, w, h in BOXES)
    return "\n".join([*rows, *more]) + "\n"


def test_three_formats_hold_the_same_boxes(tmp_path):
    (tmp_path / "a.json").write_text(coco())
    (tmp_path / "a.txt").write_text(mot("2,9,3,3,5,5,0,3,1"))  # confidence 0: not to be used
    (tmp_path / "yolo").mkdir()
    for frame in range(3):
        shares = (((x + w / 2) / 40, (y + h / 2) / 20, w / 40, h / 20)
                  for at, _, x, y, w, h in BOXES if at == frame)  # fmt: skip
        text = "".join(f"2 {' '.join(map(str, one))}\n" for one in shares)
        (tmp_path / f"yolo/clip_{frame + 1}.txt").write_text(text)
    for path, name in (("a.json", "car"), ("a.txt", "3"), ("yolo", "2")):
        labels = read_labels(tmp_path / path, SIZE)
        placed, known = labels.place(TIMES[:3], SIZE, {name: 0})
        found = [[one[column] for column in ("t", *"xywh")] for one in placed]
        wanted = [[1_000, 4, 2, 8, 6], [1_000, 30, 10, 10, 6], [3_000, 8, 2, 8, 10]]
        assert known.tolist() == [1_000, 2_000, 3_000]
        np.testing.assert_allclose(found, wanted, rtol=1e-6)
        assert labels.names == (name,)
        assert labels.boxes["track_id"].tolist() == ([0] * 3 if path == "yolo" else [1, 2, 1])
    with pytest.raises(InputError, match="add an empty file of number zero, or of the last"):
        labels.place(TIMES, SIZE, {"2": 0})
    (tmp_path / "yolo/clip_0.txt").touch()
    assert read_labels(tmp_path / "yolo", SIZE).place(TIMES, SIZE, {"2": 0})[0]["t"][-1] == 4_000
    (tmp_path / "yolo/clip_4.txt").write_text("\n2 0.5 0.5 0.5\n")
    with pytest.raises(InputError, match=r"4\.txt: line 2 has 4 columns; class cx cy w h are 5"):
        read_labels(tmp_path / "yolo", SIZE)


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("a.json", coco(annotations=[]), "has no box"),
        ("a.json", coco(images=[]), "image_id 10 of a box is not in its lists"),
        ("a.json", coco(categories=[]), "category_id 3 of a box is not in its lists"),
        ("a.json", '{"images": []}', "has no list 'annotations'; COCO has"),
        ("a.json", "[3]", "is not a COCO object"),
        ("a.json", coco(images=[{"id": 10, "width": 9, "height": 9}]), "labels pictures of 9x9"),
        ("a.json", coco_box(41, 2, 5, 5), "'car' in frame 0 has no part .* 40x20: left 41, top 2"),
        ("a.json", coco_box(4, 2, -3, 5), "no width or height: left 4, top 2, width -3, height 5"),
        ("a.txt", mot("1,1,3,3,5,5,1,3,1"), r"track 1 is twice in frame 0 \(from 0\)"),
        ("a.txt", "1,4,1,1,3,4,1,1\n2,4,36,1,3,4,1,1\n", "track 4 jumps from frame 0 to 1 "),
        ("a.txt", "1,4,1,1,3,4\n2,4,9,1,3,4\n3,4,1,1,3,4", "track 4 jumps from frame 0 to 1 "),
        ("a.txt", "0,4,3,3,5,5,1,1,1\n", "has a frame before the first"),
        ("a.txt", "1,2,3\n", "line 1 has 3 columns; frame id left top width height are 6"),
        ("a.csv", "1,2,3\n", "neither COCO"),
        ("b.txt", mot(), "no such labels"),
    ],
)
def test_labels_that_cannot_be_are_refused(tmp_path, name, content, said):
    (tmp_path / name).write_text(content)
    with pytest.raises(InputError, match=said):
        read_labels(tmp_path / name.replace("b.", "c."), SIZE)


@pytest.mark.parametrize("right", [2, 3])
def test_a_track_may_tremble(tmp_path, right):
    """By less than a diagonal of its box, 5 px, from frame to frame and back."""
    (tmp_path / "a.txt").write_text(f"1,4,1,1,3,4\n2,4,{right},1,3,4\n3,4,1,1,3,4\n")
    assert read_labels(tmp_path / "a.txt", SIZE).boxes["x"].tolist() == [0, right - 1, 0]


def test_a_track_may_go_as_far_in_each_of_many_frames(tmp_path):
    (tmp_path / "a.txt").write_text("1,4,1,1,3,4,1,1\n21,4,36,1,3,4,1,1\n")
    assert read_labels(tmp_path / "a.txt", SIZE).boxes["x"].tolist() == [0, 35]


TIMES = np.array([1_000, 2_000, 3_000, 4_000])
IDS = {"1": 4, "2": 0}


@pytest.fixture
def labels(tmp_path: Path) -> Labels:
    """A car that moves and grows from frame 0 to 2, a man in frame 2, and nothing in frame 3."""
    rows = ("1,1,5,3,8,6,1,1", "3,1,9,3,8,10,1,1", "3,2,31,1,4,4,1,2", "4,3,1,1,1,1,0,1")
    (tmp_path / "a.txt").write_text("\n".join(rows))
    return read_labels(tmp_path / "a.txt", SIZE)


def test_without_a_clock_boxes_are_at_the_labelled_frames(labels):
    boxes, known = labels.place(TIMES, SIZE, IDS)
    assert known.tolist() == [1_000, 3_000, 4_000]
    assert boxes.tolist() == [
        (1_000, 4, 2, 8, 6, 4, 1, 1), (3_000, 8, 2, 8, 10, 4, 1, 1), (3_000, 30, 0, 4, 4, 0, 2, 1),
    ]  # fmt: skip
    boxes, _ = labels.place(TIMES, SIZE, {"2": 0})
    assert boxes["track_id"].tolist() == [2]
    with pytest.raises(InputError, match=r"labels more frames \(4\) than the video has \(2\)"):
        labels.place(TIMES[:2], SIZE, IDS)
    boxes, known = labels.place(TIMES[:2], SIZE, IDS, is_whole=False)
    assert (len(boxes), known.tolist()) == (1, [1_000])


def test_tracks_are_interpolated_on_the_clock(labels):
    boxes, known = labels.place(TIMES, SIZE, IDS, rate_hz=Fraction(2_000))
    assert known.tolist() == [1_000, 1_500, 2_000, 2_500, 3_000, 3_500, 4_000]
    assert (np.diff(boxes["t"]) >= 0).all()
    car = boxes[boxes["track_id"] == 1]
    assert car["t"].tolist() == [1_000, 1_500, 2_000, 2_500, 3_000]
    assert car["x"].tolist() == [4, 5, 6, 7, 8]
    assert car["h"].tolist() == [6, 7, 8, 9, 10]
    assert boxes[boxes["track_id"] == 2]["t"].tolist() == [3_000]  # seen in one labelled frame
    boxes, known = labels.place(TIMES, SIZE, IDS, rate_hz=Fraction(700))
    assert known.tolist() == [1_000, 2_429, 3_857]
    assert boxes["t"].tolist() == [1_000, 2_429]


@pytest.mark.parametrize(
    ("fit", "wanted"),
    [
        ("stretch", [(2, 2, 4, 6), (4, 2, 4, 10), (15, 0, 2, 4)]),
        # 40x20 cut to its middle 20x20: 10 px go on either side.
        ("cover", [(0, 2, 2, 6), (0, 2, 6, 10)]),
        # 40x20 becomes 20x10 under a bar of 5 px.
        ("contain", [(2, 6, 4, 3), (4, 6, 4, 5), (15, 5, 2, 2)]),
    ],
)
def test_boxes_are_fitted_as_frames_are(labels, fit, wanted):
    boxes, _ = labels.place(TIMES, SensorSize(20, 20), IDS, fit=fit)
    assert [tuple(one) for one in boxes[list("xywh")].tolist()] == wanted
