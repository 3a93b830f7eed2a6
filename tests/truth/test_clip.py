"""What is recorded of a clip is what can be computed by hand, and reads back from NumPy alone."""

from __future__ import annotations

import io
from dataclasses import replace

import numpy as np
import pytest
from tests.truth.hand_video import DEPTH_M, SIZE, SPEED_PX_PER_FRAME, board_video

from texvent.errors import FileFormatError, InputError
from texvent.truth.boxes import BOX_RECORD, detection_target, size_classes
from texvent.truth.clip import ClipTruth, StoredTruth
from texvent.truth.layout import CLIP_FILES
from texvent.truth.recorder import TruthRecorder

TIMES = [0, 40_000, 80_000, 120_000]


@pytest.fixture(scope="module")
def stored() -> StoredTruth:
    video = board_video(duration=0.12)
    recorder = TruthRecorder(video, tuple(CLIP_FILES), {"cone": "hazard", "box": "obstacle"})
    frames = list(video)
    for frame in (*frames[:2], video.at(60_000), *frames):  # a run that was stopped, then another
        recorder.add(frame)
    truth = recorder.finish()
    recorder.add(replace(frames[-1], t_us=160_000))
    assert recorder.finish() is truth
    return truth


def test_the_board_is_where_it_moves(stored: StoredTruth) -> None:
    truth = stored.read
    truth.check(SIZE)
    assert truth.times_us.tolist() == truth.box_times_us.tolist() == TIMES
    assert truth.classes == {0: "hazard", 1: "obstacle"}
    assert truth.instances == {3: "box"}
    boxes = truth.boxes
    assert boxes["t"].tolist() == TIMES
    assert set(boxes["class_id"].tolist()) == {1}
    assert set(boxes["track_id"].tolist()) == {3}
    # 2 m wide, 7.5 m away, a focal length of 80 px: 21.33 px, its left edge at 40 − 2 · 80 / 7.5.
    left = 40 - 2 * 80 / DEPTH_M + SPEED_PX_PER_FRAME * np.arange(4)
    np.testing.assert_array_equal(boxes["x"], np.round(left))
    assert set(boxes["w"].tolist()) <= {21.0, 22.0}
    assert truth.visibility.tolist() == [1.0] * 4
    board = truth.instance == 3
    flow = truth.flow[:, :, :, 0][board[:3]]
    np.testing.assert_allclose(flow, SPEED_PX_PER_FRAME, rtol=5e-4)
    assert not truth.flow[~board[:3]].any()
    np.testing.assert_allclose(truth.depth[board], DEPTH_M, rtol=5e-4)
    assert np.isinf(truth.depth).any()  # the sky
    assert truth.occluded.shape == (3, *SIZE.shape)
    np.testing.assert_allclose(truth.poses[:, :3, 3], [[0.0, -8.0, 1.5]] * 4)
    np.testing.assert_allclose(truth.intrinsics, [[80.0, 80.0, 39.5, 29.5]] * 4)


def test_files_are_read_by_numpy_alone(stored: StoredTruth) -> None:
    opened = {name: np.load(io.BytesIO(content)) for name, content in stored.files.items()}
    assert set(opened) == {name for names in CLIP_FILES.values() for name in names}
    assert opened["boxes.npy"].dtype == BOX_RECORD
    assert opened["flow.npz"]["t"].tolist() == TIMES[:3]
    assert opened["flow.npz"]["to_t"].tolist() == TIMES[1:]
    assert opened["poses.npz"]["t"].tolist() == TIMES


def test_a_part_that_is_not_stored_is_named() -> None:
    truth = ClipTruth({}, dict[str, bytes]().__getitem__, "sample k of a.tar")
    with pytest.raises(InputError, match=r"sample k of a.tar has no boxes: .* stores is none"):
        truth.boxes  # noqa: B018
    truth.check(SIZE)


def npy(array: np.ndarray) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


@pytest.mark.parametrize(
    ("column", "value", "said"),
    [("x", -1.0, r"box \[-1.0, .*\] at 40000 µs is not inside 80x60"), ("w", 70.0, "not inside"),
     ("h", 0.0, "not inside"), ("class_id", 7, "class 7 is not known"),
     ("track_id", 9, "track 9 is not known"), ("t", 41_000, "time 41000 is not known"),
     ("t", 140_000, "its times are not in order")],
)  # fmt: skip
def test_boxes_that_cannot_be_are_found(
    stored: StoredTruth, column: str, value: float, said: str
) -> None:
    boxes = stored.read.boxes.copy()
    boxes[column][1] = value
    changed = replace(stored, files={**stored.files, "boxes.npy": npy(boxes)})
    with pytest.raises(FileFormatError, match=said):
        changed.read.check(SIZE)


def test_other_damage_is_found(stored: StoredTruth) -> None:
    for facts, files, said in (
        ({"times_us": TIMES[::-1]}, {}, "times of frames do not increase"),
        ({"times_us": "noon"}, {}, "json"),
        ({}, {"boxes.npy": b"\x93NUMPY"}, "boxes.npy"),
        ({}, {"depth.npz": stored.files["flow.npz"]}, "depth.npz: it has no depth"),
        ({"instances": {}}, {"boxes.npy": npy(np.zeros(3))}, "its type is float64"),
        ({"instances": {"4": "box"}}, {}, "3 is not known"),
        ({"times_us": [0, 40_000, 80_000, 120_000, 160_000]}, {}, "flow.npz: shape"),
    ):
        changed = StoredTruth({**stored.files, **files}, {**stored.facts, **facts})
        with pytest.raises(FileFormatError, match=said):
            changed.read.check(SIZE)


def test_targets_and_size_classes_by_hand() -> None:
    rows = [
        (5, 1.5, 2, 31, 33, 4, 7, 1.0),
        (5, 0, 0, 32, 32, 4, 8, 1.0),
        (9, 0, 0, 96, 96, 1, 7, 1),
    ]
    boxes = np.array(rows, BOX_RECORD)
    assert size_classes(boxes).tolist() == [0, 1, 2]
    target = detection_target(boxes)
    assert target["boxes"].tolist() == [[1.5, 2, 32.5, 35], [0, 0, 32, 32], [0, 0, 96, 96]]
    assert target["boxes"].dtype == np.float32
    assert [target[name].tolist() for name in ("labels", "track_ids", "times")] == [
        [4, 4, 1], [7, 8, 7], [5, 5, 9],
    ]  # fmt: skip
