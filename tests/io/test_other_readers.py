"""Independent readers find every event where texvent put it.

`aedat`, `dv-processing` and `rosbags` belong to the development tools. Where one cannot be
installed the test is reported as skipped; CI installs them.
"""

import zipfile

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.io.files import save
from texvent.sensor import SensorSize

from .format_cases import assert_same, random_events, recording

SIZE = SensorSize(346, 260)


@pytest.fixture(scope="module")
def events() -> EventStream:
    return recording(SIZE)


def test_aedat_reads_aedat4(tmp_path, events):
    aedat = pytest.importorskip("aedat", reason="the reader `aedat` is not installed")
    path = save(tmp_path / "e.aedat4", events)
    decoder = aedat.Decoder(str(path))
    assert decoder.id_to_stream() == {0: {"type": "events", "width": 346, "height": 260}}
    theirs = np.concatenate([packet["events"] for packet in decoder])
    assert_same(events, theirs["x"], theirs["y"], theirs["t"], theirs["on"])


def test_dv_processing_reads_aedat4_and_seeks_in_it(tmp_path, events):
    dv = pytest.importorskip("dv_processing", reason="the reader dv-processing is not installed")
    path = save(tmp_path / "e.aedat4", events)
    recording = dv.io.MonoCameraRecording(str(path))
    assert recording.getEventResolution() == (346, 260)
    assert recording.getTimeRange() == (int(events.t[0]), int(events.t[-1]))
    parts = []
    while (batch := recording.getNextEventBatch()) is not None:
        parts.append(batch.numpy())
    theirs = np.concatenate(parts)
    assert_same(events, theirs["x"], theirs["y"], theirs["timestamp"], theirs["polarity"])
    window = recording.getEventsTimeRange(35_000, 62_000)
    assert window.size() == len(events.between(35_000, 62_000))


def test_dv_processing_takes_a_recording_without_events(tmp_path):
    dv = pytest.importorskip("dv_processing", reason="the reader dv-processing is not installed")
    path = save(tmp_path / "e.aedat4", EventStream.empty(SIZE))
    recording = dv.io.MonoCameraRecording(str(path))
    assert recording.getEventResolution() == (346, 260)
    assert recording.getNextEventBatch() is None


def test_rosbags_reads_every_field_of_a_bag(tmp_path, events):
    rosbag1 = pytest.importorskip("rosbags.rosbag1", reason="rosbags is not installed")
    typesys = pytest.importorskip("rosbags.typesys")
    few = events[:300]
    path = save(tmp_path / "e.bag", few)
    types = typesys.get_typestore(typesys.Stores.EMPTY)
    found = []
    with rosbag1.Reader(path) as bag:
        chosen = [one for one in bag.connections if one.topic == "/dvs/events"]
        types = typesys.get_typestore(typesys.Stores.ROS1_NOETIC)
        types.register(typesys.get_types_from_msg(chosen[0].msgdef.data, chosen[0].msgtype))
        for connection, stamp, data in bag.messages(chosen):
            message = types.deserialize_ros1(data, connection.msgtype)
            assert (message.width, message.height) == (346, 260)
            first = message.events[0].ts
            assert stamp == first.sec * 10**9 + first.nanosec
            found += [
                (one.x, one.y, one.ts.sec * 10**6 + one.ts.nanosec // 1000, one.polarity)
                for one in message.events
            ]
    assert_same(few, *zip(*found, strict=True))


@pytest.mark.parametrize(("file", "module"), [("e.bag", "rosbag1"), ("e.mcap", "rosbag2")])
def test_a_bag_begins_with_its_first_event(tmp_path, file, module):
    bags = pytest.importorskip(f"rosbags.{module}", reason="rosbags is not installed")
    start = 1_000_000_000_000
    path = save(tmp_path / file, random_events(50, SIZE, start_us=start))
    with bags.Reader(path) as bag:
        # A player waits from message to message: none may lie at 1970.
        assert start * 1000 <= bag.start_time < (start + 50_000) * 1000


def test_rosbags_reads_an_mcap_file_and_its_words_are_evt3(tmp_path, events):
    rosbag2 = pytest.importorskip("rosbags.rosbag2", reason="rosbags is not installed")
    typesys = pytest.importorskip("rosbags.typesys")
    path = save(tmp_path / "e.mcap", events)
    raw = save(tmp_path / "e.raw", events).read_bytes()
    words = b""
    with rosbag2.Reader(path) as bag:
        chosen = [one for one in bag.connections if one.topic == "/dvs/events"]
        types = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)
        types.register(typesys.get_types_from_msg(chosen[0].msgdef.data, chosen[0].msgtype))
        for index, (connection, stamp, data) in enumerate(bag.messages(chosen)):
            message = types.deserialize_cdr(data, connection.msgtype)
            assert (message.width, message.height, message.seq) == (346, 260, index)
            assert (message.encoding, message.is_bigendian) == ("evt3", False)
            header = message.header.stamp
            assert stamp == header.sec * 10**9 + header.nanosec
            # "event ros time = time_base + decoded event_time": the words have whole times.
            assert message.time_base == 0
            words += message.events.tobytes()
    assert len(words) > 40_000
    # Byte for byte what the EVT3 file holds after its text header.
    assert raw.endswith(b"% end\n" + words)


def test_plain_zipfile_reads_e2vid(tmp_path, events):
    path = save(tmp_path / "e.zip", events)
    with zipfile.ZipFile(path) as archive:
        assert archive.namelist() == ["events.txt"]
        first, *rows = archive.read("events.txt").decode().splitlines()
    assert first == "346 260"
    t, x, y, p = np.array([row.split() for row in rows], dtype=np.float64).T
    assert_same(events, x, y, np.rint(t * 1e6), p)
