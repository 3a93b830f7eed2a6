"""A bag of several sensors: events, images, calibrations, an IMU and poses on one clock.

    rosbag1  dvs_msgs/EventArray               per 10 ms
    mcap     event_camera_msgs/EventPacket     per 10 ms, EVT3
    both     sensor_msgs/Image, sensor_msgs/CameraInfo, sensor_msgs/Imu,
             geometry_msgs/PoseStamped, std_msgs/String (facts of the recording)

Times in ROS are ns on the clock of the events, whose 0 is 1970. Messages are in the bag as they
were written, topic by topic; readers give them in the order of their times.

Needs rosbags: the extra `bags`.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.events import EventStream
from texvent.io.block_codec import split_by_time
from texvent.io.block_writer import Columns
from texvent.io.prophesee.evt import Evt3Encoder
from texvent.io.ros.messages import (
    EVENT_ARRAY,
    EVENT_ARRAY_TEXT,
    EVENT_PACKET,
    EVENT_PACKET_TEXT,
    EVENT_TEXT,
    FRAME,
    NS,
    NS_PER_S,
    EventPacket,
    pack_event_array,
    pack_event_packet,
)
from texvent.runtime.files.hidden_parts import hidden_folder
from texvent.sensor import SensorSize

ROSBAG1, ROSBAG2 = "rosbags.rosbag1", "rosbags.rosbag2"
EXTRA = "bags"
EVENTS_TOPIC, FACTS_TOPIC = "/dvs/events", "/texvent"
"""Topics of the events and of size and metadata."""
PACKET_US = 10_000
STRING = "std_msgs/msg/String"
IMAGE, CAMERA_INFO = "sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"
IMU, POSE = "sensor_msgs/msg/Imu", "geometry_msgs/msg/PoseStamped"
BagKind = Literal["rosbag1", "mcap"]
EXTENSIONS: dict[BagKind, str] = {"rosbag1": ".bag", "mcap": ".mcap"}
Float64Array = NDArray[np.float64]


def message_types(version: int) -> Any:
    """The message types of ROS 1 or 2, with those that hold events."""
    typesys = require("rosbags.typesys", extra=EXTRA)
    if version == 2:
        types = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)
        types.register(typesys.get_types_from_msg(EVENT_PACKET_TEXT, EVENT_PACKET))
        return types
    types = typesys.get_typestore(typesys.Stores.ROS1_NOETIC)
    types.register(typesys.get_types_from_msg(EVENT_TEXT, "dvs_msgs/msg/Event"))
    types.register(typesys.get_types_from_msg(EVENT_ARRAY_TEXT, EVENT_ARRAY))
    return types


@dataclass(frozen=True)
class CameraFacts:
    """Fields of sensor_msgs/CameraInfo, pixels."""

    size: SensorSize
    distortion_model: str
    """plumb_bob (radtan) or equidistant."""
    coefficients: Sequence[float]
    matrix: Float64Array
    """[3, 3] of the pinhole; the middle of the first pixel is (0, 0)."""


class SensorBag:
    """An open bag; see `open_sensor_bag`."""

    def __init__(self, bag: Any, kind: BagKind, types: Any) -> None:
        self._bag, self._kind, self._types = bag, kind, types

    def add_text(self, text: str, t_us: int) -> None:
        """Facts of the recording, as JSON, on `/texvent`."""
        self.text_topic(FACTS_TOPIC)(text, t_us)

    def text_topic(self, topic: str) -> Callable[[str, int], None]:
        """A new topic of std_msgs/String: writes a text at a time, µs."""
        connection = self._bag.add_connection(topic, STRING, typestore=self._types)

        def write(text: str, t_us: int) -> None:
            message = self._pack(self._types.types[STRING](text), STRING)
            self._bag.write(connection, t_us * NS, message)

        return write

    def add_events(self, topic: str, packets: Iterable[EventStream], size: SensorSize) -> None:
        """All events of a camera, from packets in time order."""
        write = self.events_topic(topic, size)
        for packet in packets:
            if len(packet):
                write(packet.columns())

    def events_topic(self, topic: str, size: SensorSize) -> Callable[[Columns], None]:
        """A new topic of events: writes columns x, y, t, p in time order, at least one event."""
        is_ros1 = self._kind == "rosbag1"
        kind = EVENT_ARRAY if is_ros1 else EVENT_PACKET
        connection = self._bag.add_connection(topic, kind, typestore=self._types)
        encoder, number = Evt3Encoder(), 0

        def write(columns: Columns) -> None:
            nonlocal number
            for part in split_by_time(columns, PACKET_US):
                first_ns = int(part["t"][0]) * NS
                if is_ros1:
                    data = pack_event_array(part, size=size, sequence=number)
                else:
                    words = bytes(encoder.encode(part))
                    words = encoder.start() + words if number == 0 else words
                    data = pack_event_packet(EventPacket(first_ns, FRAME, size, number, 0, words))
                self._bag.write(connection, first_ns, data)
                number += 1

        return write

    def add_images(
        self, topic: str, frame: str, images: Iterable[tuple[int, NDArray[np.uint8]]]
    ) -> None:
        """Images [H, W, 3] RGB or [H, W] grey with their times, µs."""

        def message(header: Any, pixels: NDArray[np.uint8]) -> Any:
            height, width = pixels.shape[:2]
            encoding, channels = ("mono8", 1) if pixels.ndim == 2 else ("rgb8", 3)
            data = np.ascontiguousarray(pixels).reshape(-1)
            make = self._types.types[IMAGE]
            return make(header, height, width, encoding, 0, width * channels, data)

        self._write(topic, IMAGE, frame, images, message)

    def add_camera_info(self, topic: str, frame: str, facts: CameraFacts, times: list[int]) -> None:
        """The calibration of a camera at each of the times, µs."""
        region = self._types.types["sensor_msgs/msg/RegionOfInterest"](0, 0, 0, 0, do_rectify=False)
        projection = np.hstack([facts.matrix, np.zeros((3, 1))])
        values = (
            facts.size.height,
            facts.size.width,
            facts.distortion_model,
            np.array(facts.coefficients, dtype=np.float64),
            facts.matrix.reshape(-1),
            np.eye(3).reshape(-1),
            projection.reshape(-1),
            0,
            0,
            region,
        )
        make = self._types.types[CAMERA_INFO]
        rows = ((t_us, values) for t_us in times)
        self._write(topic, CAMERA_INFO, frame, rows, lambda header, row: make(header, *row))

    def add_imu(
        self,
        topic: str,
        frame: str,
        t_us: NDArray[np.int64],
        acceleration: Float64Array,
        rate: Float64Array,
    ) -> None:
        """Specific force [n, 3], m/s², and angular velocity [n, 3], rad/s."""
        vector = self._types.types["geometry_msgs/msg/Vector3"]
        turn = self._types.types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0)
        make = self._types.types[IMU]
        # REP 145: −1 in the first place says that there is no orientation; zeros: not known.
        none, unknown = np.array([-1.0] + 8 * [0.0]), np.zeros(9)

        def message(header: Any, row: tuple[Float64Array, Float64Array]) -> Any:
            force, turning = (vector(*map(float, one)) for one in row)
            return make(header, turn, none, turning, unknown, force, unknown)

        rows = zip(t_us.tolist(), zip(acceleration, rate, strict=True), strict=True)
        self._write(topic, IMU, frame, rows, message)

    def add_poses(
        self,
        topic: str,
        frame: str,
        t_us: NDArray[np.int64],
        position: Float64Array,
        quaternion: Float64Array,
    ) -> None:
        """Places [n, 3] in `frame`, m, and turns to it [n, 4], x y z w."""
        types = self._types.types
        point, turn = types["geometry_msgs/msg/Point"], types["geometry_msgs/msg/Quaternion"]
        pose, make = types["geometry_msgs/msg/Pose"], types[POSE]

        def message(header: Any, row: tuple[Float64Array, Float64Array]) -> Any:
            place, rotation = row
            return make(header, pose(point(*map(float, place)), turn(*map(float, rotation))))

        rows = zip(t_us.tolist(), zip(position, quaternion, strict=True), strict=True)
        self._write(topic, POSE, frame, rows, message)

    def _write(
        self,
        topic: str,
        kind: str,
        frame: str,
        rows: Iterable[tuple[int, Any]],
        message: Callable[[Any, Any], Any],
    ) -> None:
        """A new topic of messages, each made of its header and a row; times in µs."""
        connection = self._bag.add_connection(topic, kind, typestore=self._types)
        for number, (t_us, row) in enumerate(rows):
            header = self._header(t_us * NS, frame, number)
            self._bag.write(connection, t_us * NS, self._pack(message(header, row), kind))

    def _pack(self, message: Any, kind: str) -> bytes:
        pack = self._types.serialize_ros1 if self._kind == "rosbag1" else self._types.serialize_cdr
        return bytes(pack(message, kind))

    def _header(self, time_ns: int, frame: str, sequence: int) -> Any:
        types = self._types.types
        stamp = types["builtin_interfaces/msg/Time"](time_ns // NS_PER_S, time_ns % NS_PER_S)
        header = types["std_msgs/msg/Header"]
        if self._kind == "rosbag1":
            return header(sequence, stamp, frame)
        return header(stamp, frame)


@contextmanager
def open_sensor_bag(path: Path, kind: BagKind) -> Iterator[SensorBag]:
    """A new bag to write into; it has its name when the block ends without an exception.

    rosbags makes files and folders of its own, so the bag begins in a hidden folder. A file of this
    name is replaced.

    Raises:
        MissingDependencyError: rosbags is not installed.
    """
    types = message_types(1 if kind == "rosbag1" else 2)
    with hidden_folder(path.parent) as folder:
        if kind == "rosbag1":
            made = folder / path.name
            with require(ROSBAG1, extra=EXTRA).Writer(made) as bag:
                yield SensorBag(bag, kind, types)
        else:
            rosbag2 = require(ROSBAG2, extra=EXTRA)
            made = folder / "bag" / "bag.mcap"
            storage = rosbag2.StoragePlugin.MCAP
            with rosbag2.Writer(folder / "bag", version=9, storage_plugin=storage) as bag:
                yield SensorBag(bag, kind, types)
        os.replace(made, path)
