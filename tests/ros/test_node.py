"""The node, driven by rclpy's published interface (rclpy_interface.py), not by ROS itself."""

import re
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from tests.ros.rclpy_interface import ExternalShutdownException, Policy, World, image
from texvent_ros import node
from texvent_ros.node import main

import texvent
from texvent.io.prophesee.evt import Evt3Codec

FRAMES = np.random.default_rng(3).integers(0, 256, (4, 12, 16), dtype=np.uint8)
STEP_NS = 20_000_000


@pytest.fixture
def world(monkeypatch):
    world = World()
    for name, module in world.modules().items():
        monkeypatch.setitem(sys.modules, name, module)
    return world


def events_of(messages) -> np.ndarray:
    """x, y, t, p of the published messages; t in µs of ROS time."""
    decoder, parts = Evt3Codec().make_decoder(), []
    for message in messages:
        message.cdr()  # rosbags checks every field
        columns = decoder.decode(bytes(message.events))
        time = (message.time_base + columns["t"].astype(object) * 1000) // 1000
        parts.append(np.stack([columns["x"], columns["y"], time, columns["p"]]))
    return np.concatenate(parts, axis=1).astype(np.int64)


def as_rows(events, shift_us: int = 0) -> np.ndarray:
    return np.stack([events.x, events.y, events.t + shift_us, events.p]).astype(np.int64)


def run(**parameters) -> int:
    """The node with parameters, as `ros2 run texvent_ros event_camera --ros-args -p ...`."""
    words = [word for pair in parameters.items() for word in ("-p", "{}:={}".format(*pair))]
    return main(["--ros-args", *words])


def test_images_of_a_topic_become_packets_on_another(world):
    for i, pixels in enumerate(FRAMES):
        world.send("image_raw", image(pixels, 10**9 + i * STEP_NS))
    assert run(view="true", queue=7, seed=2, simulator="esim", contrast_threshold=1) == 0
    truth = texvent.simulate(
        FRAMES, fps=50, seed=2, simulator="esim", contrast_threshold=1, progress=False
    )
    assert (events_of(world.published["events"]) == as_rows(truth, 10**6)).all()
    views = world.published["events_image"]
    assert [(view.width, view.height, view.encoding) for view in views] == [(16, 12, "rgb8")] * 3
    assert views[-1].header.stamp.nanosec == 3 * STEP_NS
    assert len(views[0].cdr()) > 16 * 12 * 3
    assert world.profiles["image_raw"].reliability == Policy.BEST_EFFORT
    assert world.profiles["events"].reliability == Policy.RELIABLE
    assert world.profiles["events"].depth == 7
    assert [level for level, _ in world.log] == ["info"]
    assert world.nodes[0].is_destroyed
    assert not world.is_up


def test_a_bad_image_ends_the_node_with_one_line(world, capsys):
    world.send("image_raw", image(FRAMES[0], 10**9, encoding="bayer_rggb8"))
    assert run() == 2
    assert capsys.readouterr().err == (
        "error: an image is encoded as 'bayer_rggb8'; publish a demosaiced image, such as that of "
        "image_proc\n"
    )
    assert world.nodes[0].is_destroyed
    assert not world.is_up


@pytest.mark.parametrize("end", [KeyboardInterrupt(), ExternalShutdownException()])
def test_ctrl_c_and_a_shutdown_of_ros_end_the_node_quietly(world, capsys, end):
    world.ends_by = end
    assert run() == 0
    assert capsys.readouterr().err == ""
    assert world.nodes[0].is_destroyed


def test_a_prompt_is_published_on_the_clock_of_ros(world):
    options = {"duration": 0.1, "sensor": "32x24", "seed": 4, "fps": 20}
    assert run(prompt="a red ball bounces", rate=0, view="true", **options) == 0
    truth = texvent.generate("a red ball bounces", progress=False, **options)
    assert len(truth)
    assert (events_of(world.published["events"]) == as_rows(truth, world.now_ns // 1000)).all()
    assert world.published["events_image"]


@pytest.mark.parametrize("rate", [0.5, 4.0])
def test_a_prompt_is_published_at_its_rate_and_every_event_is_shown_once(world, monkeypatch, rate):
    clock, published, shown = SimpleNamespace(ns=0), [], []

    def sleep(seconds):
        clock.ns += round(seconds * 1e9)

    def publish(own, packets):
        published.append((clock.ns, packets[-1]))

    monkeypatch.setattr(node, "time", SimpleNamespace(monotonic_ns=lambda: clock.ns, sleep=sleep))
    monkeypatch.setattr(node.Publishers, "publish", publish)
    monkeypatch.setattr(node.Publishers, "show", lambda own, events, *_: shown.append(events))
    options = {"duration": 0.3, "sensor": "32x24", "seed": 4, "fps": 20}
    assert run(prompt="a red ball bounces", rate=rate, **options) == 0
    truth = texvent.generate("a red ball bounces", progress=False, **options)
    assert len(published) > 3
    assert published[-1][0] == pytest.approx(int(truth.t[-1]) * 1000 / rate, rel=0.01)
    for now_ns, packet in published:
        assert packet.stamp_ns - world.now_ns <= now_ns * rate + 1000
    assert len(shown) > 1
    assert texvent.EventStream.concat(shown).equals(truth)


@pytest.fixture
def folder(tmp_path):
    cv2 = pytest.importorskip("cv2")
    for i, pixels in enumerate(FRAMES):
        cv2.imwrite(str(tmp_path / f"{i}.png"), pixels)
    return tmp_path


def test_a_loop_faster_than_its_times_has_stamps_that_never_step_back(world, folder):
    options = {"source": folder, "fps": 50, "rate": 0, "seed": 2, "simulator": "esim"}
    assert run(**options) == 0
    first = world.published.pop("events")
    truth = texvent.simulate(FRAMES, fps=50, seed=2, simulator="esim", progress=False)
    assert (events_of(first) == as_rows(truth, world.now_ns // 1000)).all()
    messages = world.published["events"]
    sys.modules["rclpy"].ok = lambda: len(messages) <= 3 * len(first)
    assert run(**options, loop="true") == 0
    stamps = [one.header.stamp.sec * 10**9 + one.header.stamp.nanosec for one in messages]
    assert stamps == sorted(stamps)
    once, found = events_of(first), events_of(messages)
    count, pass_us = once.shape[1], int(truth.t[-1]) + 1
    assert found.shape[1] > 2 * count
    for number in range(2):
        part = found[:, number * count : (number + 1) * count]
        assert (part[2] == once[2] + number * pass_us).all()
        assert (part[[0, 1, 3]] == once[[0, 1, 3]]).all()


@pytest.mark.parametrize("missing", ["rclpy", "event_camera_msgs.msg"])
def test_without_ros_one_line_says_what_to_do(world, monkeypatch, capsys, missing):
    monkeypatch.setitem(sys.modules, missing, None)
    assert run() == 4
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert re.match(
        rf"error: {missing} is needed here and could not be imported .*comes with ROS 2, not with "
        r"pip: source /opt/ros/DISTRO/setup.bash, and install ros-DISTRO-",
        error,
    )


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"source": "clip.mp4", "prompt": "x"}, "source and prompt are both given"),
        ({"packet_ms": 0}, "packet_ms is 0; it must be 0.001..1000"),
        ({"stamps": "never"}, "stamps is 'never'"),
        ({"start": 2}, "start is for videos and files"),
        ({"sed": 2}, "unknown option 'sed'"),
    ],
)
def test_bad_parameters_are_one_line(world, capsys, parameters, message):
    assert run(**parameters) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
