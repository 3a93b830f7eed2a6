"""A bag of several sensors: events, images, calibrations, an IMU and poses on one clock.

    rosbag1  dvs_msgs/EventArray               per 10 ms
    mcap     event_camera_msgs/EventPacket     per 10 ms, EVT3
    both     sensor_msgs/Image, sensor_msgs/CameraInfo, sensor_msgs/Imu,
             geometry_msgs/PoseStamped, std_msgs/String (facts of the recording)

Times in ROS are ns on the clock of the events, whose 0 is 1970. Messages lie in the bag as they
were written, topic by topic; readers give them in the order of their times.

Needs rosbags: the extra `bags`.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.events import EventStream
from texvent.io.atomic import hidden_folder
from texvent.io.block_codec import split_by_time
from texvent.io.prophesee.evt import Evt3Codec
from texvent.io.ros.bags import (
    EXTRA,
    FACTS_TOPIC,
    NS,
    PACKET_US,
    ROSBAG1,
    ROSBAG2,
    STRING,
    message_types,
)
from texvent.io.ros.messages import (
    EVENT_ARRAY,
    EVENT_PACKET,
    FRAME,
    EventPacket,
    pack_event_array,
    pack_event_packet,
)
from texvent.sensor import SensorSize

IMAGE, CAMERA_INFO = "sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"
COMPRESSED = "sensor_msgs/msg/CompressedImage"
IMU, POSE = "sensor_msgs/msg/Imu", "geometry_msgs/msg/PoseStamped"
BagKind = Literal["rosbag1", "mcap"]
EXTENSIONS: dict[BagKind, str] = {"rosbag1": ".bag", "mcap": ".mcap"}
_NS_PER_S = 1_000_000_000
Float64Array = NDArray[np.float64]


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
        facts = self._types.types[STRING](text)
        self._write(FACTS_TOPIC, STRING, [(t_us * NS, facts)])

    def add_events(self, topic: str, packets: Iterable[EventStream], size: SensorSize) -> int:
        """All events of a camera, from packets in time order; returns how many there were."""
        messages_of, count = self.events_topic(topic, size), 0
        for packet in packets:
            count += len(packet)
            for _, write in messages_of(packet):
                write()
        return count

    def events_topic(
        self, topic: str, size: SensorSize
    ) -> Callable[[EventStream], Iterator[tuple[int, Callable[[], None]]]]:
        """A topic of events.

        Returns:
            Takes packets in time order; gives the time of each of their messages, µs, and what
            writes it.
        """
        is_ros1 = self._kind == "rosbag1"
        kind = EVENT_ARRAY if is_ros1 else EVENT_PACKET
        connection = self._bag.add_connection(topic, kind, typestore=self._types)
        encoder, number = Evt3Codec().make_encoder(), 0

        def messages(packet: EventStream) -> Iterator[tuple[int, Callable[[], None]]]:
            nonlocal number
            for part in split_by_time(packet.columns(), PACKET_US) if len(packet) else ():
                first_us = int(part["t"][0])
                if is_ros1:
                    data = pack_event_array(part, size=size, sequence=number)
                else:
                    words = bytes(encoder.encode(part))
                    words = encoder.start() + words if number == 0 else words
                    stamp_ns = first_us * NS
                    data = pack_event_packet(EventPacket(stamp_ns, FRAME, size, number, 0, words))
                yield first_us, partial(self._bag.write, connection, first_us * NS, data)
                number += 1

        return messages

    def compressed_topic(self, topic: str, frame: str, format: str) -> Callable[[int, bytes], None]:
        """A topic of sensor_msgs/CompressedImage, of files in a format such as "png".

        Returns:
            Writes an image: its time, µs, and the bytes of its file.
        """
        connection = self._bag.add_connection(topic, COMPRESSED, typestore=self._types)
        message, number = self._types.types[COMPRESSED], 0

        def write(t_us: int, data: bytes) -> None:
            nonlocal number
            header = self._header(t_us * NS, frame, number)
            image = message(header, format, np.frombuffer(data, dtype=np.uint8))
            self._bag.write(connection, t_us * NS, self._pack(image, COMPRESSED))
            number += 1

        return write

    def add_images(
        self, topic: str, frame: str, images: Iterable[tuple[int, NDArray[np.uint8]]]
    ) -> int:
        """Images [H, W, 3] RGB or [H, W] grey with their times, µs; returns how many."""
        message, count = self._types.types[IMAGE], 0

        def messages() -> Iterator[tuple[int, Any]]:
            nonlocal count
            for t_us, pixels in images:
                height, width = pixels.shape[:2]
                encoding = "mono8" if pixels.ndim == 2 else "rgb8"
                header = self._header(t_us * NS, frame, count)
                data = np.ascontiguousarray(pixels).reshape(-1)
                step = width * (1 if pixels.ndim == 2 else 3)
                yield t_us * NS, message(header, height, width, encoding, 0, step, data)
                count += 1

        self._write(topic, IMAGE, messages())
        return count

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
        message = self._types.types[CAMERA_INFO]
        self._write(
            topic,
            CAMERA_INFO,
            (
                (t_us * NS, message(self._header(t_us * NS, frame, number), *values))
                for number, t_us in enumerate(times)
            ),
        )

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
        message = self._types.types[IMU]
        # REP 145: −1 in the first place says that there is no orientation; zeros: not known.
        none, unknown = np.array([-1.0] + 8 * [0.0]), np.zeros(9)
        self._write(
            topic,
            IMU,
            (
                (
                    int(time) * NS,
                    message(
                        self._header(int(time) * NS, frame, number),
                        turn,
                        none,
                        vector(*map(float, rate[number])),
                        unknown,
                        vector(*map(float, acceleration[number])),
                        unknown,
                    ),
                )
                for number, time in enumerate(t_us)
            ),
        )

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
        pose, message = types["geometry_msgs/msg/Pose"], types[POSE]
        self._write(
            topic,
            POSE,
            (
                (
                    int(time) * NS,
                    message(
                        self._header(int(time) * NS, frame, number),
                        pose(
                            point(*map(float, position[number])),
                            turn(*map(float, quaternion[number])),
                        ),
                    ),
                )
                for number, time in enumerate(t_us)
            ),
        )

    def _write(self, topic: str, kind: str, messages: Iterable[tuple[int, Any]]) -> None:
        connection = self._bag.add_connection(topic, kind, typestore=self._types)
        for time_ns, message in messages:
            self._bag.write(connection, time_ns, self._pack(message, kind))

    def _pack(self, message: Any, kind: str) -> bytes:
        pack = self._types.serialize_ros1 if self._kind == "rosbag1" else self._types.serialize_cdr
        return bytes(pack(message, kind))

    def _header(self, time_ns: int, frame: str, sequence: int) -> Any:
        types = self._types.types
        stamp = types["builtin_interfaces/msg/Time"](time_ns // _NS_PER_S, time_ns % _NS_PER_S)
        header = types["std_msgs/msg/Header"]
        if self._kind == "rosbag1":
            return header(sequence, stamp, frame)
        return header(stamp, frame)


@contextmanager
def open_sensor_bag(path: Path, kind: BagKind) -> Iterator[SensorBag]:
    """A new bag to write into; it has its name when the block ends without an exception.

    Args:
        path: the file; it must not exist.
        kind: rosbag1 or mcap.

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
