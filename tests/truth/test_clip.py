"""What is read of a clip, from a folder or a sample, is what can be computed by hand."""

import io
import itertools
import json
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.truth.hand_video import DEPTH_M, SIZE, SPEED_PX_PER_FRAME, board_video

import texvent
from texvent.errors import FileFormatError, InputError
from texvent.truth.boxes import BOX_RECORD, detection_target, size_classes
from texvent.truth.clip import ClipTruth
from texvent.truth.layout import CLIP_FILES, parse_parts
from texvent.truth.recorder import TruthRecorder
from texvent.truth.sinks import FolderSink, SampleSink
from texvent_scenes.procedural import ProceduralVideo

TIMES = [0, 40_000, 80_000, 120_000]
Files = dict[str, bytes]
FOLDER_PARTS = parse_parts("flow,flow-back,depth,ids,boxes,poses")


def record(sink: FolderSink | SampleSink) -> None:
    """Four source frames of the board, and one between two of them."""
    video = board_video(duration=0.12)
    between = replace(video.at(20_000), is_source=False)
    with TruthRecorder(sink) as recorder:
        for frame in (next(iter(video)), between, *itertools.islice(video, 1, None)):
            recorder.append(frame)


def read(files: Files, **facts: Any) -> ClipTruth:
    known = {"truth": {**json.loads(files["json"])["truth"], **facts}}
    return ClipTruth({**files, "json": json.dumps(known).encode()}.__getitem__, "sample k")


@pytest.fixture(scope="module")
def stored() -> Files:
    classes = {"cone": "hazard", "box": "obstacle"}
    sink = SampleSink(board_video(duration=0.12), tuple(CLIP_FILES), classes)
    record(sink)
    return {**sink.members, "json": json.dumps({"truth": sink.facts}).encode()}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("clip") / "board.truth"
    record(FolderSink(path, board_video(duration=0.12), FOLDER_PARTS, metadata={}))
    return path


@pytest.fixture(params=["folder", "sample"])
def truth(request: pytest.FixtureRequest, stored: Files, folder: Path) -> ClipTruth:
    return read(stored) if request.param == "sample" else texvent.load_truth(folder)


def test_what_is_read_of_the_board_is_its_closed_form(truth: ClipTruth) -> None:
    truth.check(SIZE)
    assert truth.times_us.tolist() == truth.box_times_us.tolist() == TIMES
    assert truth.instances == {3: "box"}
    boxes = truth.boxes
    assert boxes["t"].tolist() == TIMES
    assert boxes["track_id"].tolist() == [3] * 4
    assert {truth.classes[one] for one in boxes["class_id"].tolist()} <= {"box", "obstacle"}
    # 2 m wide, 7.5 m away, a focal length of 80 px: 21.33 px, its left edge at 40 − 2 · 80 / 7.5.
    left = 40 - 2 * 80 / DEPTH_M + SPEED_PX_PER_FRAME * np.arange(4)
    np.testing.assert_array_equal(boxes["x"], np.round(left))
    assert set(boxes["w"].tolist()) <= {21.0, 22.0}
    assert truth.boxes_at(2).tolist() == boxes[2:3].tolist()
    assert truth.visibility.tolist() == [1.0] * 4
    board = truth.instance() == 3
    assert board.sum(axis=(1, 2)).min() > 300
    flow = truth.flow()[..., 0]
    np.testing.assert_allclose(flow[board[:3]], SPEED_PX_PER_FRAME, rtol=5e-4)
    assert np.abs(flow[~board[:3]]).max() < 1e-9
    np.testing.assert_allclose(truth.depth()[board], DEPTH_M, rtol=5e-4)
    assert np.isinf(truth.depth()).any()  # the sky
    hidden = truth.occluded() & ~board[:3]
    np.testing.assert_array_equal(hidden, board[1:] & ~board[:3])
    np.testing.assert_allclose(truth.poses[:, :3, 3], [[0.0, -8.0, 1.5]] * 4)
    np.testing.assert_allclose(truth.poses[:, :3, 2], [[0.0, 1.0, 0.0]] * 4, atol=1e-8)
    np.testing.assert_allclose(truth.intrinsics, [[80.0, 80.0, 39.5, 29.5]] * 4)
    assert truth.camera_matrices[3].tolist() == [[80, 0, 39.5], [0, 80, 29.5], [0, 0, 1]]
    for method, last in ((truth.flow, 2), (truth.occluded, 2), (truth.depth, 3)):
        np.testing.assert_array_equal(method(), [method(index) for index in range(last + 1)])
        with pytest.raises(InputError, match=rf"there are those of 0\.\.{last}"):
            method(last + 1)


def test_the_way_back_is_the_way_there_where_nothing_is_hidden(folder: Path) -> None:
    truth = texvent.load_truth(folder)
    board = truth.instance() == 3
    np.testing.assert_allclose(truth.flow_back()[board[1:]][:, 0], -SPEED_PX_PER_FRAME, atol=1e-4)
    hidden = truth.occluded(part="flow-back") & ~board[1:]
    np.testing.assert_array_equal(hidden, board[:-1] & ~board[1:])
    np.testing.assert_array_equal(truth.flow_back(2), truth.flow_back()[1])
    with pytest.raises(InputError, match=r"frame 0 has no flow-back; there are those of 1\.\.3"):
        truth.flow_back(0)


def test_samples_have_classes_in_training_order_and_times_in_archives(stored: Files) -> None:
    truth = read(stored)
    assert truth.classes == {0: "hazard", 1: "obstacle"}
    assert truth.boxes["class_id"].tolist() == [1] * 4
    flow_file = np.load(io.BytesIO(stored["flow.npz"]))
    assert (flow_file["t"].tolist(), flow_file["to_t"].tolist()) == (TIMES[:3], TIMES[1:])
    with pytest.raises(InputError, match="sample k does not say the class of pixels"):
        truth.class_id(0)


def test_a_part_that_is_not_stored_is_named(truth: ClipTruth) -> None:
    none = ClipTruth({"json": b"{}"}.__getitem__, "sample k")
    none.check(SIZE)
    with pytest.raises(InputError, match=r"sample k has no boxes: .* stores is none; name boxes"):
        none.boxes  # noqa: B018
    with pytest.raises(InputError, match=r"has no events: the truth that it stores is .*boxes"):
        truth.event_instance  # noqa: B018


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
    with pytest.raises(FileFormatError, match=r"depth has the shape .*, and 5 frames have it"):
        read(stored, times_us=[*TIMES, 160_000]).depth(4)


@pytest.mark.parametrize("part", ["flow", "depth", "ids", "poses", "visibility"])
def test_rows_of_truth_that_are_fewer_than_its_frames_are_damage(stored: Files, part: str) -> None:
    name = f"{part}.npy" if part == "visibility" else f"{part}.npz"
    whole = np.load(io.BytesIO(stored[name]))
    whole = {"": whole} if part == "visibility" else dict(whole)
    for array in whole.keys() - {"t", "to_t"}:
        fewer = {**whole, array: whole[array][:-1]}
        file = io.BytesIO()
        np.savez(file, **fewer) if array else np.save(file, fewer[""])
        truth = read({**stored, name: file.getvalue()})
        with pytest.raises(FileFormatError):
            truth.occluded() if array == "occluded" else truth.check(SIZE)


@pytest.mark.parametrize(
    ("name", "part"), [("boxes/bbox.npy", "boxes"), ("poses.txt", "poses"), ("depth", "depth")]
)
def test_a_file_that_is_gone_is_damage(folder: Path, tmp_path: Path, name: str, part: str) -> None:
    shutil.copytree(folder, tmp_path / "b.truth")
    (tmp_path / "b.truth" / name).rename(tmp_path / "elsewhere")
    truth = texvent.load_truth(tmp_path / "b.truth")
    with pytest.raises(FileFormatError):
        truth.depth(0) if part == "depth" else getattr(truth, part)


def test_a_camera_is_asked_for_where_poses_are_wanted(tmp_path: Path) -> None:
    class OtherCamera(ProceduralVideo):
        def camera_at(self, t_us: int) -> Any:
            return object()

    known = board_video(duration=0.12)
    video = OtherCamera(known.scene, known.size, known.config)
    texvent.save_truth(video, tmp_path / "c.truth", "depth")
    assert texvent.load_truth(tmp_path / "c.truth").parts == ("depth",)


def test_targets_and_size_classes_by_hand() -> None:
    rows = [(5, 1.5, 2, 31, 33, 4, 7, 1), (5, 0, 0, 32, 32, 4, 8, 1), (9, 0, 0, 96, 96, 1, 7, 1)]
    boxes = np.array(rows, BOX_RECORD)
    assert size_classes(boxes).tolist() == [0, 1, 2]
    target = detection_target(boxes)
    assert target["boxes"].tolist() == [[1.5, 2, 32.5, 35], [0, 0, 32, 32], [0, 0, 96, 96]]
    assert target["labels"].tolist() == [4, 4, 1]
    assert target["times"].tolist() == [5, 5, 9]
