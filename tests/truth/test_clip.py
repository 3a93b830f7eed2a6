"""What is recorded of a clip is what can be computed by hand, and reads back from NumPy alone."""

from __future__ import annotations

import io
import itertools
import json
from typing import Any

import numpy as np
import pytest
from tests.truth.hand_video import DEPTH_M, SIZE, SPEED_PX_PER_FRAME, board_video

from texvent.errors import FileFormatError, InputError
from texvent.truth.boxes import BOX_RECORD, detection_target, size_classes
from texvent.truth.clip import ClipTruth
from texvent.truth.layout import CLIP_FILES
from texvent.truth.recorder import TruthRecorder
from texvent.truth.sinks import SampleSink

TIMES = [0, 40_000, 80_000, 120_000]
Files = dict[str, bytes]


def read(files: Files, **facts: Any) -> ClipTruth:
    known = {"truth": {**json.loads(files["json"])["truth"], **facts}}
    return ClipTruth({**files, "json": json.dumps(known).encode()}.__getitem__, "sample k")


@pytest.fixture(scope="module")
def stored() -> Files:
    video = board_video(duration=0.12)
    sink = SampleSink(video, tuple(CLIP_FILES), {"cone": "hazard", "box": "obstacle"})
    recorder = TruthRecorder(sink)
    for frame in (*itertools.islice(video, 2), video.at(60_000), *itertools.islice(video, 2, None)):
        recorder.append(frame)
    recorder.finish()
    return {**sink.members, "json": json.dumps({"truth": sink.facts}).encode()}


def test_the_board_is_where_it_moves(stored: Files) -> None:
    truth = read(stored)
    truth.check(SIZE)
    assert truth.times_us.tolist() == truth.box_times_us.tolist() == TIMES
    assert (truth.classes, truth.instances) == ({0: "hazard", 1: "obstacle"}, {3: "box"})
    boxes = truth.boxes
    assert boxes["t"].tolist() == TIMES
    assert boxes["class_id"].tolist() == [1] * 4
    assert boxes["track_id"].tolist() == [3] * 4
    # 2 m wide, 7.5 m away, a focal length of 80 px: 21.33 px, its left edge at 40 − 2 · 80 / 7.5.
    left = 40 - 2 * 80 / DEPTH_M + SPEED_PX_PER_FRAME * np.arange(4)
    np.testing.assert_array_equal(boxes["x"], np.round(left))
    assert set(boxes["w"].tolist()) <= {21.0, 22.0}
    assert truth.visibility.tolist() == [1.0] * 4
    board = truth.instance() == 3
    flow = truth.flow()[..., 0]
    np.testing.assert_allclose(flow[board[:3]], SPEED_PX_PER_FRAME, rtol=5e-4)
    assert not flow[~board[:3]].any()
    np.testing.assert_allclose(truth.depth()[board], DEPTH_M, rtol=5e-4)
    assert np.isinf(truth.depth()).any()  # the sky
    assert truth.occluded().shape == (3, *SIZE.shape)
    np.testing.assert_allclose(truth.poses[:, :3, 3], [[0.0, -8.0, 1.5]] * 4)
    np.testing.assert_allclose(truth.intrinsics, [[80.0, 80.0, 39.5, 29.5]] * 4)
    flow_file = np.load(io.BytesIO(stored["flow.npz"]))
    assert (flow_file["t"].tolist(), flow_file["to_t"].tolist()) == (TIMES[:3], TIMES[1:])


def test_a_part_that_is_not_stored_is_named() -> None:
    truth = ClipTruth({"json": b"{}"}.__getitem__, "sample k")
    truth.check(SIZE)
    with pytest.raises(InputError, match=r"sample k has no boxes: .* stores is none"):
        truth.boxes  # noqa: B018


def npy(array: np.ndarray) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


def test_truth_that_cannot_be_is_found(stored: Files) -> None:
    for column, value, said in (
        ("x", -1, r"box \[\(40000, -1.0, .*\] is not inside 80x60"), ("w", 70, "not inside"),
        ("h", 0, "not inside"), ("class_id", 7, "class 7 is not known"),
        ("track_id", 9, "object 9 is not known"), ("t", 41_000, "time 41000 is not known"),
        ("t", 140_000, "times of boxes are not in order"),
    ):  # fmt: skip
        boxes = read(stored).boxes.copy()
        boxes[column][1] = value
        with pytest.raises(FileFormatError, match=said):
            read({**stored, "boxes.npy": npy(boxes)}).check(SIZE)
    changes: tuple[tuple[dict[str, Any], Files, str], ...] = (
        ({"times_us": TIMES[::-1]}, {}, "times of boxes are not in order"),
        ({}, {"boxes.npy": b"\x93NUMPY"}, "boxes.npy holds no array"),
        ({}, {"depth.npz": stored["flow.npz"]}, "depth.npz holds no depth"),
        ({}, {"boxes.npy": npy(np.zeros(3))}, "boxes.npy holds float64"),
        ({"instances": {"4": "box"}}, {}, "object 3 is not known"),
        ({"times_us": [*TIMES, 160_000]}, {}, "flow has the shape"),
    )
    for facts, files, said in changes:
        with pytest.raises(FileFormatError, match=said):
            read({**stored, **files}, **facts).check(SIZE)


def test_targets_and_size_classes_by_hand() -> None:
    rows = [(5, 1.5, 2, 31, 33, 4, 7, 1), (5, 0, 0, 32, 32, 4, 8, 1), (9, 0, 0, 96, 96, 1, 7, 1)]
    boxes = np.array(rows, BOX_RECORD)
    assert size_classes(boxes).tolist() == [0, 1, 2]
    target = detection_target(boxes)
    assert target["boxes"].tolist() == [[1.5, 2, 32.5, 35], [0, 0, 32, 32], [0, 0, 96, 96]]
    assert target["labels"].tolist() == [4, 4, 1]
    assert target["times"].tolist() == [5, 5, 9]
