"""The .mcap file for Foxglove, read back message by message by rosbags."""

from pathlib import Path

import cv2
import numpy as np
import pytest

import texvent
from texvent.cli.app import main
from texvent.errors import ConfigError, InputError, OutputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.ros.bags import message_types
from texvent.sensor import SensorSize
from texvent.video import Video
from texvent.view.render import RenderConfig, render_events

rosbag2 = pytest.importorskip("rosbags.rosbag2")

SIZE = SensorSize(32, 24)
START_US = 20_000_000


def moving_dot() -> EventPackets:
    t = np.arange(0, 300_000, 500)
    events = EventStream(t // 20_000 % 32, t // 500 % 24, t + START_US, t // 500 % 2, SIZE)
    return EventPackets([events[:100], events[100:]], SIZE, {"prompt": "a dot"})


def read(path: Path) -> list[tuple[str, int, object, str]]:
    """Topic, time, message and schema's encoding of every message, as they lie in the file."""
    types = message_types(2)
    with rosbag2.Reader(path) as bag:
        return [
            (one.topic, time_ns, types.deserialize_cdr(data, one.msgtype), one.msgdef.format.name)
            for one, time_ns, data in bag.messages()
        ]


def video() -> Video:
    pixels = np.zeros((4, 24, 32, 3), dtype=np.uint8)
    pixels[:, :, :, 0] = np.arange(4)[:, None, None] * 60
    return Video(pixels, [START_US + i * 100_000 for i in range(4)])


def test_all_messages_decode_in_order_of_time_with_their_definitions(tmp_path):
    path = render_events(moving_dot(), tmp_path / "out.mcap", frames=video())
    messages = read(path)
    topics = [topic for topic, *_ in messages]
    assert topics[0] == "/texvent"
    assert {topic: topics.count(topic) for topic in sorted(set(topics))} == {
        "/camera/image": 3,  # the fourth begins where the events end
        "/dvs/events": 30,
        "/dvs/image": 9,
        "/texvent": 1,
    }
    times = [time_ns for _, time_ns, *_ in messages]
    assert times == sorted(times)
    assert {format for *_, format in messages} == {"MSG"}
    for topic, time_ns, message, _ in messages:
        if topic != "/texvent":
            stamp = message.header.stamp
            assert stamp.sec * 10**9 + stamp.nanosec == time_ns


def test_images_show_the_events_and_the_video(tmp_path):
    messages = read(render_events(moving_dot(), tmp_path / "out.mcap", frames=video()))
    image = next(message for topic, _, message, _ in messages if topic == "/dvs/image")
    assert image.format == "png"
    pixels = cv2.imdecode(image.data, cv2.IMREAD_COLOR)
    # 33.3 ms: 67 events in two columns, one event after the other in each row.
    assert ((pixels != 255).any(axis=2).sum(axis=0) > 0).nonzero()[0].tolist() == [0, 1]
    frame = [message for topic, _, message, _ in messages if topic == "/camera/image"][2]
    assert frame.format == "jpeg"
    blue, _, red = cv2.imdecode(frame.data, cv2.IMREAD_COLOR)[12, 16].astype(int)
    assert abs(red - 120) < 4
    assert blue < 4


def test_texvent_reads_the_events_back(tmp_path):
    path = render_events(moving_dot(), tmp_path / "out.mcap", config=RenderConfig(decay=20.0))
    events = texvent.load(path)
    assert events.equals(moving_dot().collect())
    assert events.metadata["prompt"] == "a dot"


def test_a_speed_is_refused(tmp_path):
    with pytest.raises(ConfigError, match=r"speed is 0\.5; \.mcap files keep the recording's time"):
        render_events(moving_dot(), tmp_path / "out.mcap", config=RenderConfig(speed=0.5))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("events", "words"),
    [
        (EventStream.empty(SIZE), "holds no events to show"),
        (EventStream([0], [0], [1 << 42], [1], SIZE), "holds times below"),
        (EventStream([0], [0], [0], [1], SensorSize(4000, 2)), "holds sensors up to 2048x2048"),
    ],
)
def test_what_cannot_be_written_leaves_no_file(tmp_path, events, words):
    with pytest.raises(InputError, match=words):
        render_events(events, tmp_path / "out.mcap")
    assert list(tmp_path.iterdir()) == []


def test_an_existing_file_is_kept(tmp_path, capsys):
    source = tmp_path / "a.h5"
    moving_dot().save(source)
    assert main(["render", str(source), "-o", str(tmp_path / "a.mcap"), "--quiet"]) == 0
    before = (tmp_path / "a.mcap").read_bytes()
    with pytest.raises(OutputError, match="exists already"):
        render_events(moving_dot(), tmp_path / "a.mcap")
    assert (tmp_path / "a.mcap").read_bytes() == before
