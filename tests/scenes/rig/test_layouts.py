"""Recordings in every layout, read back by what people load them with."""

import csv
import json
from pathlib import Path

import cv2
import h5py
import numpy as np
import pytest
import yaml
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

import texvent
from texvent import rig
from texvent.capture.open import open_frames
from texvent.cli.app import main
from texvent.config import CaptureConfig
from texvent.errors import OutputError
from texvent.io.ros.messages import (
    EVENT_ARRAY,
    EVENT_ARRAY_TEXT,
    EVENT_PACKET,
    EVENT_PACKET_TEXT,
    EVENT_TEXT,
    open_message,
)

PROMPT = "a red ball rolls left near a bush, handheld camera"
OPTIONS = {
    "stereo": 0.1,
    "sensor": "64x48",
    "duration": 0.25,
    "imu": 100.0,
    "frames": 20,
    "exposure": 0.002,
    "samples": 1,
    "progress": False,
}


@pytest.fixture(scope="module")
def native(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("native") / "out"
    return rig.record(PROMPT, out, truth="poses,depth,events", **OPTIONS)


def assert_same_events(one: texvent.EventStream, other: texvent.EventStream) -> None:
    assert one.size == other.size
    for name in "txyp":
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


def facts_of(folder: Path) -> dict:
    return json.loads((folder / "rig.json").read_text())


@pytest.mark.long
def test_native_folder_holds_all_and_says_how_it_was_made(native):
    facts = facts_of(native)
    found = sorted(str(one.relative_to(native)) for one in native.rglob("*") if one.is_file())
    assert found == sorted(facts["files"])
    assert facts["prompt"] == PROMPT
    assert facts["frames"] == {"cam0": 4, "cam1": 4}
    for name in ("cam0", "cam1"):
        events = texvent.load(native / name / "events.h5")
        assert len(events) == facts["events"][name] > 50
        assert events.metadata["rig"]["camera"] == name
        assert events.metadata["seed"] == facts["pixel_seeds"][name]
        with (native / name / "frames.csv").open() as file:
            rows = list(csv.DictReader(file))
        assert [int(row["t_us"]) for row in rows] == [50_000, 100_000, 150_000, 200_000]
        assert float(rows[0]["first_row_start_us"]) == pytest.approx(49_000)
        assert cv2.imread(str(native / name / rows[0]["file"])).shape == (48, 64, 3)
        truth = texvent.load_truth(native / name / "truth")
        np.testing.assert_array_equal(events.instance, truth.event_instance)
        assert set(truth.instances.values()) == {"ball", "bush"}
    assert len(set(facts["pixel_seeds"].values())) == 2


@pytest.mark.long
def test_native_imu_and_poses_are_rows_of_their_formats(native):
    imu = np.loadtxt(native / "imu.csv", delimiter=",", comments="#")
    poses = np.loadtxt(native / "poses.txt")
    assert imu.shape == (26, 7)
    assert imu[:, 0].tolist() == [number * 10_000_000 for number in range(26)]
    assert np.linalg.norm(imu[:, 4:], axis=1) == pytest.approx(9.8, abs=0.5)
    assert poses.shape == (26, 8)
    np.testing.assert_allclose(np.linalg.norm(poses[:, 4:], axis=1), 1.0, atol=1e-8)
    truth = np.loadtxt(native / "cam0" / "truth" / "poses.txt")
    np.testing.assert_allclose(truth[0, 1:], poses[0, 1:], atol=1e-8)
    right = np.loadtxt(native / "cam1" / "truth" / "poses.txt")
    assert np.linalg.norm(right[0, 1:4] - truth[0, 1:4]) == pytest.approx(0.1, abs=1e-8)


@pytest.mark.long
def test_only_a_recording_is_replaced(native, tmp_path):
    small = {**OPTIONS, "frames": None, "exposure": 0.0, "stereo": None, "duration": 0.1}
    out = rig.record(PROMPT, tmp_path / "one", **small)
    with pytest.raises(OutputError, match="exists already"):
        rig.record(PROMPT, out, **small)
    rig.record(PROMPT, out, overwrite=True, **{**small, "imu": None})
    assert not (out / "imu.csv").exists()
    (out / "notes.txt").write_text("mine")
    with pytest.raises(OutputError, match="other files"):
        rig.record(PROMPT, out, overwrite=True, **small)


def assert_points_match(chain: dict, to_depth: np.ndarray) -> None:
    """Of points before the left camera, the files give one row, and depth from disparity."""
    turns = [np.array(chain["extrinsics"][f"R_rect{number}"]) for number in (0, 3)]
    across = np.array(chain["extrinsics"]["T_21"])
    lens = chain["intrinsics"]["camRect0"]["camera_matrix"]
    for point in np.random.default_rng(4).uniform((-1, -1, 2), (1, 1, 9), (20, 3)):
        seen = [turns[0] @ point, turns[1] @ (across @ [*point, 1.0])[:3]]
        (x, y), (other, row) = (lens[:2] * one[:2] / one[2] + lens[2:] for one in seen)
        assert row == pytest.approx(y, abs=1e-6)
        where = to_depth @ [x, y, x - other, 1.0]
        np.testing.assert_allclose(where[:3] / where[3], seen[0], atol=1e-6)


@pytest.mark.long
def test_dsec_frames_return_to_the_raw_pixels(tmp_path, native):
    """Through rectification and back, frames differ from the raw ones by interpolation only."""
    lenses = """
    cam0: {intrinsics: [70, 70, 31, 24], distortion_model: radtan,
           distortion_coeffs: [-0.1, 0.02, 0, 0]}
    cam1: {intrinsics: [60, 60, 32, 23], distortion_model: equidistant,
           distortion_coeffs: [0.01, 0, 0, 0], baseline: 0.1, rotation: [0, -2, 1]}
    """
    path = tmp_path / "lenses.yaml"
    path.write_text(lenses)
    options = {**OPTIONS, "rig": path, "stereo": None}
    out = rig.record(PROMPT, tmp_path / "dsec", layout="dsec", **options)
    raw = rig.record(PROMPT, tmp_path / "raw", **{**options, "imu": None})
    for side, name in (("left", "cam0"), ("right", "cam1")):
        events = texvent.load(out / "events" / side / "events.h5")
        assert_same_events(events, texvent.load(raw / name / "events.h5"))
    with h5py.File(out / "events/right/rectify_map.h5") as file:
        assert file["rectify_map"].shape == (48, 64, 2)
    there = [frame for frame in open_frames(out, CaptureConfig(), size=None)]
    assert [frame.t_us for frame in there] == [50_000, 100_000, 150_000, 200_000]
    own = cv2.imread(str(raw / "cam0/frames/000001.png"))[..., ::-1].astype(np.float32)
    back = np.asarray(there[1].pixels, dtype=np.float32)

    def difference(x: float, y: float) -> float:
        shift = np.array([[1.0, 0.0, x], [0.0, 1.0, y]])
        moved = cv2.warpAffine(own, shift, (64, 48))
        return float(np.abs(moved - back)[8:40, 10:54].mean())

    there_and_back = difference(0.0, 0.0)  # fine textures are blurred by rectifying twice
    assert there_and_back < 7.0
    halves = ((0.5, 0), (-0.5, 0), (0, 0.5), (0, -0.5))
    assert all(difference(*way) > 1.05 * there_and_back for way in halves)
    chain = yaml.safe_load((out / "calibration/cam_to_cam.yaml").read_text())
    assert sorted(chain) == ["disparity_to_depth", "extrinsics", "intrinsics"]
    depth = np.array(chain["disparity_to_depth"]["cams_03"])
    assert 1.0 / depth[3, 2] == pytest.approx(0.1)
    assert_points_match(chain, depth)
    disparity = cv2.imread(str(out / "disparity/event/000001.png"), cv2.IMREAD_UNCHANGED)
    assert disparity.dtype == np.uint16
    lines = (out / "images/left/exposure_timestamps.txt").read_text().splitlines()
    assert lines[1:] == [f"{mid - 1000}, {mid + 1000}" for mid in range(50_000, 250_000, 50_000)]


@pytest.mark.long
@pytest.mark.parametrize("layout", ["rosbag1", "mcap"])
def test_bags_are_read_back_by_rosbags(layout, tmp_path, native):
    pytest.importorskip("rosbags")
    out = rig.record(PROMPT, tmp_path / "bag", layout=layout, **OPTIONS)
    path = out / ("rig.bag" if layout == "rosbag1" else "rig.mcap")
    counts: dict[str, int] = {}
    events, images, imu, poses, times = 0, [], [], [], []
    with AnyReader([path], default_typestore=types_with_events()) as reader:
        for connection, time_ns, data in reader.messages():
            counts[connection.topic] = counts.get(connection.topic, 0) + 1
            times.append(time_ns)
            message = reader.deserialize(data, connection.msgtype)
            if connection.topic == "/cam0/events":
                if layout == "rosbag1":
                    events += len(message.events)
                else:
                    assert message.encoding == "evt3"
                    assert open_message(EVENT_PACKET, data, 2).size == (64, 48)
            elif connection.topic == "/cam0/image_raw":
                images.append(message.data.reshape(message.height, message.width, 3))
            elif connection.topic == "/imu0":
                measured = message.angular_velocity, message.linear_acceleration
                stamp = message.header.stamp.sec * 10**9 + message.header.stamp.nanosec
                imu.append([stamp, *(vector(one) for one in measured)])
            elif connection.topic == "/groundtruth":
                pose = message.pose
                poses.append(
                    [*vector(pose.position), *vector(pose.orientation), pose.orientation.w]
                )
            elif connection.topic == "/cam1/camera_info":
                fields = {one.lower(): getattr(message, one) for one in dir(message)}
                (focal, *_), (_, fy, _), _ = matrix = np.reshape(fields["k"], (3, 3))
                assert focal == fy > 0.0
                assert matrix.tolist() == [[focal, 0, 31.5], [0, focal, 23.5], [0, 0, 1]]
                assert fields["distortion_model"] == "plumb_bob"
    assert times == sorted(times)
    assert counts["/imu0"] == counts["/groundtruth"] == 26
    assert counts["/cam0/image_raw"] == counts["/cam1/camera_info"] == 4
    assert counts["/texvent"] == 1
    stored = cv2.imread(str(native / "cam0/frames/000003.png"))[..., ::-1]
    np.testing.assert_array_equal(images[3], stored)
    rows = np.loadtxt(native / "imu.csv", delimiter=",", comments="#")
    np.testing.assert_allclose([[one[0], *one[1], *one[2]] for one in imu], rows, rtol=1e-7)
    np.testing.assert_allclose(poses, np.loadtxt(native / "poses.txt")[:, 1:], atol=1e-7)
    if layout == "rosbag1":
        assert events == facts_of(out)["events"]["cam0"]
    read = texvent.load(path, stream="/cam0/events")
    assert_same_events(read, texvent.load(native / "cam0/events.h5"))


def vector(value) -> tuple[float, float, float]:  # type: ignore[no-untyped-def]
    return value.x, value.y, value.z


def types_with_events():  # type: ignore[no-untyped-def]
    types = get_typestore(Stores.ROS1_NOETIC)
    types.register(get_types_from_msg(EVENT_TEXT, "dvs_msgs/msg/Event"))
    types.register(get_types_from_msg(EVENT_ARRAY_TEXT, EVENT_ARRAY))
    types.register(get_types_from_msg(EVENT_PACKET_TEXT, EVENT_PACKET))
    return types


def test_the_command_says_what_it_made(tmp_path, capsys):
    out = tmp_path / "made"
    code = main(["rig", "a ball", "-o", str(out), "--sensor", "32x24", "--duration", "0.1"])
    captured = capsys.readouterr()
    assert code == 0
    assert captured.out.strip() == str(out)
    assert "cam0" in captured.err
