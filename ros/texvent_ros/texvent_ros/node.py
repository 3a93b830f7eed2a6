"""ROS 2 node: images of a topic, a video or a prompt in, event packets out.

Written to rclpy's published interface: `init`, `create_node`, `spin_once`, `ok`, `try_shutdown`;
`Node.get_parameters_by_prefix`, `create_subscription`, `create_publisher`, `get_logger`,
`get_clock`, `destroy_node`.
"""

from __future__ import annotations

import array
import dataclasses
import importlib
import itertools
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

import texvent
from texvent.errors import MissingDependencyError, TexventError, one_line
from texvent.events import EventStream
from texvent.io.ros.messages import EVT3, NS, NS_PER_S, EventPacket
from texvent.options.values import with_options
from texvent.represent.event_frame import count_events
from texvent.runtime.work.interrupts import raise_interrupted
from texvent.view.drawing.event_image import draw_events
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent_ros.config import RosConfig
from texvent_ros.image_events import Answer, ImageEvents
from texvent_ros.messages import PacketMaker, check_side

IMAGES, EVENTS, VIEW = "image_raw", "events", "events_image"
"""Topics; ROS remaps them: -r image_raw:=/camera/image_raw."""
VIEW_US = 33_333
"""Time that an image of the events of a video spans, µs."""
LATE_NS = 100_000_000
"""Lag of a video behind its own time that is warned of, ns."""
BUILT_IN = ("use_sim_time", "start_type_description_service")
"""Parameters that rclpy declares for every node."""


def main(words: Sequence[str] | None = None) -> int:
    """Run the node until its input ends, ROS shuts down or Ctrl-C.

    Args:
        words: the command line with ROS arguments; default: that of the process.

    Returns:
        Exit code: 0, or that of the error.
    """
    try:
        ros = Ros()
        # texvent handles signals itself: SIGTERM, which `ros2 launch` sends, too.
        with raise_interrupted(until_exit=True), _open_node(ros, words) as node:
            config, options = read_parameters(node)
            if config.source or config.prompt:
                play(ros, node, config, options)
            else:
                follow_images(ros, node, config, options)
    except TexventError as error:
        sys.stderr.write(f"error: {error}\n")
        return error.exit_code
    return 0


class Ros:
    """rclpy and the classes of the messages.

    Raises:
        MissingDependencyError: ROS 2 or a package of messages is not there.
    """

    def __init__(self) -> None:
        self.rclpy = _ros_module("rclpy", "rclpy")
        self.qos = _ros_module("rclpy.qos", "rclpy")
        self.executors = _ros_module("rclpy.executors", "rclpy")
        self.signals = _ros_module("rclpy.signals", "rclpy")
        self.Image = _ros_module("sensor_msgs.msg", "sensor-msgs").Image
        self.EventPacket = _ros_module("event_camera_msgs.msg", "event-camera-msgs").EventPacket

    def profile(self, reliability: str, depth: int) -> Any:
        """Quality of service of a topic: the last `depth` messages, volatile."""
        return self.qos.QoSProfile(
            depth=depth,
            history=self.qos.HistoryPolicy.KEEP_LAST,
            reliability=self.qos.ReliabilityPolicy[reliability.upper()],
            durability=self.qos.DurabilityPolicy.VOLATILE,
        )


def read_parameters(node: Any) -> tuple[RosConfig, dict[str, Any]]:
    """Parameters of the node, and the options of texvent among them.

    Raises:
        ConfigError: a value of the node is of another type or out of range.
    """
    given = {
        name: parameter.value
        for name, parameter in node.get_parameters_by_prefix("").items()
        if name not in BUILT_IN and "." not in name
    }
    own = {field.name for field in dataclasses.fields(RosConfig)}
    config = with_options(
        RosConfig(), {name: given[name] for name in own & given.keys()}, where="parameters"
    )
    return config, {name: value for name, value in given.items() if name not in own}


def follow_images(ros: Ros, node: Any, config: RosConfig, options: Mapping[str, Any]) -> None:
    """Publish the events of the image topic until ROS shuts down.

    Events that the simulator still holds back are published at the end, unless ROS is down.

    Raises:
        InputError: an image cannot be read; nothing is published of it.
    """
    publishers = Publishers(ros, node, config)
    logic = ImageEvents(options, config, node.get_logger().warning)
    failures: list[TexventError] = []

    def give(answer: Answer) -> None:
        publishers.publish(answer.packets)
        if answer.events is not None:
            publishers.show(answer.events, answer.stamp_ns, answer.frame_id)

    def take(message: Any) -> None:
        # An executor may swallow what a callback raises, so errors are kept for the loop.
        try:
            answer = logic.take(message, node.get_clock().now().nanoseconds)
        except TexventError as error:
            failures.append(error)
            return
        give(answer)

    node.create_subscription(ros.Image, IMAGES, take, ros.profile(config.image_qos, config.queue))
    node.get_logger().info(
        f"{IMAGES} (sensor_msgs/Image) to {EVENTS} (event_camera_msgs/EventPacket, {EVT3})"
    )
    try:
        while ros.rclpy.ok() and not failures:
            ros.rclpy.spin_once(node, timeout_sec=0.1)
    finally:
        rest = logic.finish() if ros.rclpy.ok() else None
        if rest is not None:
            give(rest)
    if failures:
        raise failures[0]


def play(ros: Ros, node: Any, config: RosConfig, options: Mapping[str, Any]) -> None:
    """Publish the events of a video or a prompt at its own speed.

    Raises:
        InputError: the frames cannot be used.
        ConfigError: an option is wrong, or the sensor is too large for EVT3.
    """
    subject, run = (config.prompt, texvent.generate)
    if config.source:
        subject, run = (config.source, texvent.simulate)
    packets = run(subject, as_packets=True, progress=False, **options)
    check_side(packets.size)
    publishers, maker = Publishers(ros, node, config), PacketMaker(config.packet_us)
    start_ns = 0
    for _ in itertools.count() if config.loop else range(1):
        # A pass that ends before its own time, as with a rate above 1, delays the next stamps.
        start_ns = max(node.get_clock().now().nanoseconds, start_ns)
        maker.start(start_ns)
        end_us = _play_once(packets, config, node, publishers, maker, start_ns, ros.rclpy.ok)
        if end_us is None:
            return
        start_ns += (end_us + 1) * NS


def _play_once(
    packets: texvent.EventPackets,
    config: RosConfig,
    node: Any,
    publishers: Publishers,
    maker: PacketMaker,
    start_ns: int,
    is_ok: Callable[[], bool],
) -> int | None:
    """Publish all events once; time of the last one, µs, or None if ROS shut down."""
    began_ns, t_us, shown_us, warned = time.monotonic_ns(), 0, 0, False
    shown = [EventStream.empty(packets.size)]
    for packet in packets:
        if not len(packet):
            continue
        t_us = int(packet.t[-1])
        if config.rate:
            lag_ns = time.monotonic_ns() - began_ns - round(t_us * NS / config.rate)
            if lag_ns < 0:
                time.sleep(-lag_ns / NS_PER_S)
            elif lag_ns > LATE_NS and not warned:
                node.get_logger().warning("the simulation is slower than rate; events come late")
                warned = True
        if not is_ok():
            return None
        publishers.publish(maker.messages(packet, t_us, config.frame_id))
        shown.append(packet)
        if t_us - shown_us >= VIEW_US:
            publishers.show(EventStream.concat(shown), start_ns + t_us * NS, config.frame_id)
            shown, shown_us = shown[:1], t_us
    if len(shown) > 1:
        publishers.show(EventStream.concat(shown), start_ns + t_us * NS, config.frame_id)
    return t_us


class Publishers:
    """Publishers of packets and, if wanted, of images of the events."""

    def __init__(self, ros: Ros, node: Any, config: RosConfig) -> None:
        self._ros = ros
        profile = ros.profile(config.events_qos, config.queue)
        self._events = node.create_publisher(ros.EventPacket, EVENTS, profile)
        self._view = node.create_publisher(ros.Image, VIEW, profile) if config.view else None

    def publish(self, packets: Sequence[EventPacket]) -> None:
        """Send the packets, in order."""
        for packet in packets:
            self._events.publish(fill_packet(self._ros.EventPacket(), packet))

    def show(self, events: EventStream, stamp_ns: int, frame_id: str) -> None:
        """Send an image of the events, if images are wanted."""
        if self._view is not None:
            image = draw_events(count_events(events), get_palette(DEFAULT_PALETTE))
            self._view.publish(fill_image(self._ros.Image(), image, stamp_ns, frame_id))


def fill_packet(message: Any, packet: EventPacket) -> Any:
    """Set the fields of an event_camera_msgs/EventPacket; returns the message."""
    _fill_header(message, packet.stamp_ns, packet.frame)
    message.height, message.width = packet.size.height, packet.size.width
    message.seq, message.time_base = packet.sequence, packet.time_base_ns
    message.encoding, message.is_bigendian = EVT3, False
    # rclpy takes an array of bytes as it is; of a list it looks at each.
    message.events = array.array("B", packet.payload)
    return message


def fill_image(message: Any, image: NDArray[np.uint8], stamp_ns: int, frame_id: str) -> Any:
    """Set the fields of a sensor_msgs/Image of RGB pixels [H, W, 3]; returns the message."""
    _fill_header(message, stamp_ns, frame_id)
    message.height, message.width = image.shape[:2]
    message.encoding, message.is_bigendian = "rgb8", 0
    message.step = image.shape[1] * 3
    message.data = array.array("B", image.tobytes())
    return message


def _fill_header(message: Any, stamp_ns: int, frame_id: str) -> None:
    stamp = message.header.stamp
    stamp.sec, stamp.nanosec = divmod(stamp_ns, NS_PER_S)
    message.header.frame_id = frame_id


@contextmanager
def _open_node(ros: Ros, words: Sequence[str] | None) -> Iterator[Any]:
    """A node; Ctrl-C and the shutdown of ROS end the block quietly."""
    ros.rclpy.init(
        args=None if words is None else list(words),
        signal_handler_options=ros.signals.SignalHandlerOptions.NO,
    )
    node = None
    try:
        node = ros.rclpy.create_node(
            "texvent",
            allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True,
        )
        yield node
    except (KeyboardInterrupt, ros.executors.ExternalShutdownException):
        pass
    finally:
        if node is not None:
            node.destroy_node()
        ros.rclpy.try_shutdown()


def _ros_module(name: str, package: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise MissingDependencyError(
            f"{name} is needed here and could not be imported ({one_line(error)}); it comes with "
            f"ROS 2, not with pip: source /opt/ros/DISTRO/setup.bash, and install "
            f"ros-DISTRO-{package} if it is missing"
        ) from error


if __name__ == "__main__":
    sys.exit(main())
