"""The node's logic: messages in, messages out, held against rosbags' definitions."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.ros.rclpy_interface import TYPES, EventPacket, image
from texvent_ros.config import RosConfig
from texvent_ros.image_events import ImageEvents
from texvent_ros.messages import PacketMaker
from texvent_ros.node import fill_packet

import texvent
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.prophesee.evt import Evt3Codec
from texvent.io.ros.messages import EVENT_PACKET, open_message, pack_event_packet
from texvent.sensor import SensorSize

SIZE = SensorSize(16, 12)
FRAMES = np.random.default_rng(3).integers(0, 256, (4, 12, 16), dtype=np.uint8)
START_NS = 1_790_000_000_123_456_789
STEP_NS = 33_000_000
TIMES = [round(i * STEP_NS / 1000) for i in range(4)]
KIND = "event_camera_msgs/msg/EventPacket"


def make(**options) -> tuple[ImageEvents, list[str]]:
    warned: list[str] = []
    chosen = {"seed": 2, "simulator": "esim"}
    return ImageEvents(chosen, RosConfig(**options), warned.append), warned


def decode(packets) -> dict:
    """The events of successive messages, each with its ROS time by the time base, ns.

    Headers are stamped with the first of them.
    """
    decoder = Evt3Codec().make_decoder()
    found = {name: [] for name in ("x", "y", "p", "ns")}
    for packet in packets:
        columns = decoder.decode(packet.payload)
        for name in "xyp":
            found[name] += columns[name].tolist()
        times = [(packet.time_base_ns + 1000 * int(t)) % 2**64 for t in columns["t"]]
        assert packet.stamp_ns == times[0]
        found["ns"] += times
    return found


def expected(first_ns: int, times=TIMES, frames=FRAMES) -> dict:
    events = texvent.simulate(frames, t_us=times, seed=2, simulator="esim", progress=False)
    columns = {name: getattr(events, name).tolist() for name in "xyp"}
    return {**columns, "ns": [first_ns + 1000 * t for t in events.t.tolist()]}


def test_messages_span_no_more_than_the_packet_length_and_are_stamped_with_their_first_event():
    logic, _ = make(packet_ms=5.0)
    packets = []
    for i, pixels in enumerate(FRAMES):
        answer = logic.take(image(pixels, i * STEP_NS, frame_id=f"camera {i}"), 0)
        assert {one.frame for one in answer.packets} | {answer.frame_id} == {f"camera {i}"}
        packets += answer.packets
    assert len(packets) > 15
    for packet in packets:
        times = Evt3Codec().make_decoder().decode(packet.payload)["t"]
        assert times[0] // 5000 == times[-1] // 5000
        assert packet.stamp_ns == packet.time_base_ns + 1000 * int(times[0])


def test_a_message_can_be_decoded_without_those_before_it():
    logic, _ = make()
    logic.take(image(FRAMES[0], 0), 0)
    packets = logic.take(image(FRAMES[1], STEP_NS), 0).packets
    alone = [decode([packet]) for packet in packets]
    assert len(alone) > 1
    assert [ns for one in alone for ns in one["ns"]] == decode(packets)["ns"]


@pytest.mark.parametrize("step_ns", [5_000_000_000, -2_000_000_000])
def test_a_step_of_time_begins_a_new_recording_and_the_clock_of_the_words_goes_on(step_ns):
    logic, warned = make()
    packets = []
    for first_ns in (START_NS, START_NS + 3 * STEP_NS + step_ns):
        for i, pixels in enumerate(FRAMES):
            packets += logic.take(image(pixels, first_ns + i * STEP_NS), 0).packets
    second_ns = START_NS + 3 * STEP_NS + step_ns
    once, again = expected(START_NS), expected(second_ns)
    assert decode(packets) == {name: once[name] + again[name] for name in once}
    assert warned == [
        f"time steps by {step_ns / 1e9:+.3f} s, beyond max_gap: a new recording begins"
    ]
    assert logic.recordings == 2
    words = Evt3Codec().make_decoder()
    times = np.concatenate([words.decode(packet.payload)["t"] for packet in packets])
    assert (np.diff(times) >= 0).all()


def test_events_that_a_simulator_holds_back_come_before_a_restart_and_at_the_end(held_back):
    settings = {"seed": 2, "simulator": held_back}
    logic = ImageEvents(settings, RosConfig(), lambda _: None)
    assert logic.finish() is None
    second_ns, packets = START_NS + 60_000_000_000, []
    for first_ns in (START_NS, second_ns):
        for i, pixels in enumerate(FRAMES):
            answer = logic.take(image(pixels, first_ns + i * STEP_NS), 0)
            packets += answer.packets
            if answer.packets:
                assert (first_ns, i) == (second_ns, 0)
                assert answer.stamp_ns == START_NS + 3 * STEP_NS
                assert len(answer.events)
    packets += logic.finish().packets
    assert logic.finish() is None
    once, again = expected(START_NS), expected(second_ns)
    assert decode(packets) == {name: once[name] + again[name] for name in once}
    assert [packet.sequence for packet in packets] == list(range(len(packets)))


def test_images_whose_time_does_not_increase_are_dropped_and_said():
    logic, warned = make()
    logic.take(image(FRAMES[0], 1000), 0)
    assert logic.take(image(FRAMES[1], 1000), 0).packets == []
    assert logic.take(image(FRAMES[1], 1999), 0).packets == []  # the same µs
    assert logic.take(image(FRAMES[1], 900), 0).events is None
    assert logic.dropped == 3
    assert warned[0] == "dropped 1 image(s): the time 1000 ns does not come after 1000 ns"
    assert len(warned) == 2  # the first and the second
    assert logic.take(image(FRAMES[1], 5_000_000), 0).packets


def test_images_without_times_take_the_clock_of_the_node():
    logic, warned = make()
    logic.take(image(FRAMES[0], 0), 0)
    logic.take(image(FRAMES[1], 0), 0)
    assert warned == [
        "dropped 1 image(s): the time 0 ns does not come after 0 ns; images without times need "
        "stamps:=arrival"
    ]
    logic, warned = make(stamps="arrival")
    packets = []
    for i, pixels in enumerate(FRAMES):
        packets += logic.take(image(pixels, 0, frame_id=""), START_NS + i * STEP_NS).packets
    assert decode(packets) == expected(START_NS)
    assert not warned
    assert packets[0].frame == "event_camera"


def test_another_size_begins_a_new_recording():
    logic, warned = make()
    logic.take(image(FRAMES[0], 0), 0)
    answer = logic.take(image(FRAMES[1][:6], STEP_NS), 0)
    assert answer.packets == []
    assert answer.events is None
    assert warned == ["images are 16x6 now, they were 16x12: a new recording begins"]
    packets = logic.take(image(FRAMES[2][:6], 2 * STEP_NS), 0).packets
    assert {packet.size for packet in packets} == {SensorSize(16, 6)}


def test_a_bad_image_leaves_the_recording_as_it_was():
    logic, _ = make()
    logic.take(image(FRAMES[0], START_NS), 0)
    with pytest.raises(InputError, match="bayer_rggb8"):
        logic.take(image(FRAMES[1], START_NS + 1000, encoding="bayer_rggb8"), 0)
    packets = []
    for i in (1, 2, 3):
        packets += logic.take(image(FRAMES[i], START_NS + i * STEP_NS), 0).packets
    assert decode(packets) == expected(START_NS)


@pytest.mark.parametrize("frame", ["", "dvs", "event_camera", "kamera_ä"])
def test_packed_bytes_are_those_of_rosbags(frame):
    maker = PacketMaker(10_000)
    maker.start(START_NS)
    events = EventStream.from_columns([3, 15], [11, 0], [7, 20_000], [1, 0], size=SIZE)
    for packet in maker.messages(events, 30_000, frame):
        message = fill_packet(EventPacket(), packet)
        assert message.cdr() == pack_event_packet(packet)
        read = TYPES.deserialize_cdr(pack_event_packet(packet), KIND)
        assert (read.width, read.height, read.encoding) == (16, 12, "evt3")
        assert read.header.frame_id == frame
        assert read.header.stamp.sec * 10**9 + read.header.stamp.nanosec == packet.stamp_ns
        opened = open_message(EVENT_PACKET, pack_event_packet(packet), 2)
        assert bytes(opened.payload) == packet.payload


@given(
    recordings=st.lists(
        st.tuples(
            st.integers(0, 2**61),
            st.lists(st.integers(0, 60_000_000), min_size=1, max_size=6).map(sorted),
        ),
        min_size=1,
        max_size=4,
    ),
    packet_us=st.integers(1, 1_000_000),
)
def test_time_base_and_words_give_ros_time_whatever_the_recordings(recordings, packet_us):
    maker = PacketMaker(packet_us)
    packets, ns = [], []
    for first_ns, times in recordings:
        maker.start(first_ns)
        events = EventStream.from_columns(
            [0] * len(times), [0] * len(times), times, [1] * len(times), size=SIZE
        )
        packets += maker.messages(events, times[-1] + 1, "f")
        ns += [first_ns + 1000 * t for t in times]
    assert decode(packets)["ns"] == ns


@pytest.mark.parametrize("gap_us", [16_000_000, 17_000_000, 40_000_000])
def test_words_go_on_counting_the_turns_of_their_clock(gap_us):
    maker, times = PacketMaker(10_000), [5 + gap_us * n for n in range(5)]
    maker.start(START_NS)
    zeros = np.zeros(5, int)
    events = EventStream.from_columns(zeros, zeros, times, zeros, size=SIZE)
    packets = maker.messages(events, times[-1] + 1, "f")
    assert decode(packets)["ns"] == [START_NS + 1000 * t for t in times]
    lengths = [len(one.payload) for one in packets[1:]]
    assert max(lengths) - min(lengths) <= 4 * (1 + gap_us // 2**24)  # turns since the last alone
