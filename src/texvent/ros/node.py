"""The node: what joins `ImageEvents` and `texvent.pipeline` to rclpy.

Written to rclpy's published interface: `init`, `create_node`, `spin_once`, `ok`, `try_shutdown`;
`Node.create_subscription`, `create_publisher`, `get_logger`, `get_clock`, `destroy_node`.
"""

from __future__ import annotations

import array
import importlib
import itertools
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, MissingDependencyError, TexventError, one_line
from texvent.events import EventStream
from texvent.io.ros.messages import EVT3, NS, NS_PER_S, EventPacket
from texvent.pipeline import Simulation
from texvent.represent.event_frame import count_events
from texvent.ros.config import RosConfig
from texvent.ros.image_events import Answer, ImageEvents
from texvent.ros.packet_messages import PacketMaker, check_side
from texvent.settings.resolution import Settings

LATE_NS = 100_000_000
"""A video that lags by more than this is warned of."""


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
        """The quality of service of a topic: the last `depth` messages, volatile."""
        return self.qos.QoSProfile(
            depth=depth,
            history=self.qos.HistoryPolicy.KEEP_LAST,
            reliability=self.qos.ReliabilityPolicy[reliability.upper()],
            durability=self.qos.DurabilityPolicy.VOLATILE,
        )


def run_image_node(
    ros: Ros, settings: Settings, config: RosConfig, ros_arguments: Sequence[str]
) -> int:
    """Publish the events of an image topic until ROS shuts down or Ctrl-C.

    Events that the simulator still holds back are published at the end, unless ROS is down.

    Args:
        ros: rclpy and the messages.
        settings: options of the simulation.
        config: options of the node.
        ros_arguments: words for rclpy, beginning with --ros-args, or none.

    Returns:
        Exit code 0.

    Raises:
        InputError: an image cannot be read; nothing is published of it.
    """
    with _open_node(ros, config, ros_arguments) as node:
        publishers = Publishers(ros, node, config)
        logic = ImageEvents(settings, config, node.get_logger().warning)
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

        node.create_subscription(
            ros.Image, config.image_topic, take, ros.profile(config.image_qos, config.queue)
        )
        if not config.quiet:
            node.get_logger().info(
                f"{config.image_topic} (sensor_msgs/Image) to {config.events_topic} "
                f"(event_camera_msgs/EventPacket, {EVT3}), simulator {settings.run.simulator}"
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
    return 0


def run_source_node(
    ros: Ros, simulation: Simulation, config: RosConfig, ros_arguments: Sequence[str]
) -> int:
    """Publish the events of a video or a prompt at its own speed.

    Args:
        ros: rclpy and the messages.
        simulation: the run.
        config: options of the node.
        ros_arguments: words for rclpy, beginning with --ros-args, or none.

    Returns:
        Exit code 0.

    Raises:
        InputError: the frames cannot be used.
    """
    check_side(simulation.video.size)
    if config.loop and simulation.video.is_live:
        raise InputError("a live source cannot begin again; leave --loop out")
    with _open_node(ros, config, ros_arguments) as node:
        publishers = Publishers(ros, node, config)
        maker = PacketMaker(config.packet_us)
        start_ns = 0
        for _ in itertools.count() if config.loop else range(1):
            # A pass that ends before its own time, as with a rate above 1, delays the next stamps.
            start_ns = max(node.get_clock().now().nanoseconds, start_ns)
            maker.start(start_ns)
            end_us = _play(simulation, config, node, publishers, maker, start_ns, ros.rclpy.ok)
            if end_us is None:
                break
            start_ns += (end_us + 1) * NS
    return 0


def _play(
    simulation: Simulation,
    config: RosConfig,
    node: Any,
    publishers: Publishers,
    maker: PacketMaker,
    start_ns: int,
    is_ok: Callable[[], bool],
) -> int | None:
    """Publish all events once; how long they are, µs, or None if ROS shut down."""
    began_ns, first_us, t_us, warned = time.monotonic_ns(), None, 0, False
    shown = [EventStream.empty(simulation.video.size)]
    for frame, packet in simulation.steps():
        first_us = frame.t_us if first_us is None else first_us
        t_us = frame.t_us - first_us
        events = _shifted(packet, -first_us)
        if config.rate:
            lag_ns = time.monotonic_ns() - began_ns - round(t_us * NS / config.rate)
            if lag_ns < 0:
                time.sleep(-lag_ns / NS_PER_S)
            elif lag_ns > LATE_NS and not warned:
                node.get_logger().warning("the simulation is slower than --rate; events come late")
                warned = True
        if not is_ok():
            return None
        publishers.publish(maker.messages(events, t_us, config.frame_id))
        shown.append(events)
        if frame.is_source:
            publishers.show(EventStream.concat(shown), start_ns + t_us * NS, config.frame_id)
            shown = shown[:1]
    return t_us


class Publishers:
    """Publishes packets, and images of them where a topic is named."""

    def __init__(self, ros: Ros, node: Any, config: RosConfig) -> None:
        self._ros = ros
        profile = ros.profile(config.events_qos, config.queue)
        self._events = node.create_publisher(ros.EventPacket, config.events_topic, profile)
        self._view = None
        if config.view_topic is not None:
            self._view = node.create_publisher(ros.Image, config.view_topic, profile)

    def publish(self, packets: Sequence[EventPacket]) -> None:
        """Send the packets, in order."""
        for packet in packets:
            self._events.publish(fill_packet(self._ros.EventPacket(), packet))

    def show(self, events: EventStream, stamp_ns: int, frame_id: str) -> None:
        """Send an image of the events, if images are wanted."""
        if self._view is None:
            return
        from texvent.view.drawing.event_image import draw_events
        from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette

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
def _open_node(ros: Ros, config: RosConfig, ros_arguments: Sequence[str]) -> Iterator[Any]:
    """A node; Ctrl-C and the shutdown of ROS end the block quietly."""
    # texvent handles signals itself; SIGTERM, which `ros2 launch` sends, too.
    no_handlers = ros.signals.SignalHandlerOptions.NO
    ros.rclpy.init(args=list(ros_arguments), signal_handler_options=no_handlers)
    node = None
    try:
        node = ros.rclpy.create_node(config.node)
        yield node
    except (KeyboardInterrupt, ros.executors.ExternalShutdownException):
        pass
    finally:
        if node is not None:
            node.destroy_node()
        ros.rclpy.try_shutdown()


def _shifted(packet: EventStream, shift_us: int) -> EventStream:
    return EventStream(packet.x, packet.y, packet.t + shift_us, packet.p, packet.size)


def _ros_module(name: str, package: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise MissingDependencyError(
            f"{name} is needed here and could not be imported ({one_line(error)}); it comes with "
            f"ROS 2, not with pip: source /opt/ros/DISTRO/setup.bash, and install "
            f"ros-DISTRO-{package} if it is missing"
        ) from error
