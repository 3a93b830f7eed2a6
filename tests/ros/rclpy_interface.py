"""rclpy's published interface, as far as the node uses it, over the message types of rosbags.

Not ROS: no middleware, no executor. Names, arguments and what they return follow rclpy's sources.
Messages have the fields of the registered definitions, refuse others as rosidl's classes do, and
are checked when rosbags serialises them.
"""

import enum
from collections import defaultdict, deque
from types import ModuleType, SimpleNamespace

import numpy as np
import yaml

from texvent.io.ros.bag_writer import message_types

TYPES = message_types(2)
BASE, NAME = 1, 2
DEFAULTS = {"string": "", "bool": False}


class Message:
    """A message with default values; only its fields can be set."""

    def __init__(self, kind: str) -> None:
        object.__setattr__(self, "kind", kind)
        for name, (node, what) in TYPES.fielddefs[kind][1]:
            if int(node) == BASE:
                value = DEFAULTS.get(what[0], 0)
            elif int(node) == NAME:
                value = Message(what)
            else:
                value = []
            object.__setattr__(self, name, value)

    def __setattr__(self, name: str, value: object) -> None:
        if name not in {field for field, _ in TYPES.fielddefs[self.kind][1]}:
            raise AttributeError(f"{self.kind} has no field {name}")
        object.__setattr__(self, name, value)

    def typed(self) -> object:
        """The same as rosbags holds it."""
        values = []
        for name, _ in TYPES.fielddefs[self.kind][1]:
            value = getattr(self, name)
            if isinstance(value, Message):
                value = value.typed()
            elif not isinstance(value, (str, int)):
                value = np.frombuffer(bytes(value), dtype=np.uint8)
            values.append(value)
        return TYPES.types[self.kind](*values)

    def cdr(self) -> bytes:
        """The message as it goes over the wire."""
        return bytes(TYPES.serialize_cdr(self.typed(), self.kind))


class Image(Message):
    def __init__(self) -> None:
        super().__init__("sensor_msgs/msg/Image")


class EventPacket(Message):
    def __init__(self) -> None:
        super().__init__("event_camera_msgs/msg/EventPacket")


class Policy(enum.IntEnum):
    KEEP_LAST = 1
    RELIABLE = 11
    BEST_EFFORT = 12
    VOLATILE = 22


class ExternalShutdownException(Exception):  # noqa: N818  (its name in rclpy)
    pass


class Node:
    def __init__(self, world, name: str) -> None:
        self.world, self.name, self.is_destroyed = world, name, False
        self.parameters = {"use_sim_time": False, "qos_overrides./tf.depth": 1}
        words = iter(world.init_arguments or ())
        for word in words:
            if word == "-p":
                key, _, value = next(words).partition(":=")
                self.parameters[key] = yaml.safe_load(value)

    def get_parameters_by_prefix(self, prefix):
        return {
            name.removeprefix(prefix): SimpleNamespace(name=name, value=value)
            for name, value in self.parameters.items()
            if name.startswith(prefix)
        }

    def create_publisher(self, msg_type, topic, qos_profile):
        def publish(message):
            assert isinstance(message, msg_type)
            self.world.published[topic].append(message)

        self.world.profiles[topic] = qos_profile
        return SimpleNamespace(publish=publish)

    def create_subscription(self, msg_type, topic, callback, qos_profile):
        self.world.profiles[topic] = qos_profile
        self.world.callbacks[topic] = callback

    def get_logger(self):
        def log(level):
            return lambda text: self.world.log.append((level, text))

        return SimpleNamespace(info=log("info"), warning=log("warning"))

    def get_clock(self):
        return SimpleNamespace(now=lambda: SimpleNamespace(nanoseconds=self.world.now_ns))

    def destroy_node(self):
        self.is_destroyed = True


class World:
    """What would be outside the node: images that wait, everything published."""

    def __init__(self) -> None:
        self.published, self.profiles, self.callbacks = defaultdict(list), {}, {}
        self.log, self.waiting, self.nodes = [], deque(), []
        self.is_up, self.now_ns, self.init_arguments, self.ends_by = (
            False,
            5_000_000_000,
            None,
            None,
        )

    def send(self, topic: str, message: Message) -> None:
        self.waiting.append((topic, message))

    def modules(self) -> dict[str, ModuleType]:
        """The modules by name."""

        def init(*, args=None, signal_handler_options=None):
            self.is_up, self.init_arguments = True, args

        def create_node(
            node_name,
            *,
            allow_undeclared_parameters=False,
            automatically_declare_parameters_from_overrides=False,
        ):
            assert allow_undeclared_parameters
            assert automatically_declare_parameters_from_overrides
            self.nodes.append(Node(self, node_name))
            return self.nodes[-1]

        def spin_once(node, *, executor=None, timeout_sec=None):
            if self.waiting:
                topic, message = self.waiting.popleft()
                self.callbacks[topic](message)
            elif self.ends_by is not None:
                raise self.ends_by
            else:
                self.is_up = False

        def try_shutdown():
            self.is_up = False

        rclpy = _module("rclpy", init=init, create_node=create_node, spin_once=spin_once)
        vars(rclpy).update(ok=lambda: self.is_up, try_shutdown=try_shutdown)
        options = SimpleNamespace(NO=0)
        qos = {"HistoryPolicy": Policy, "ReliabilityPolicy": Policy, "DurabilityPolicy": Policy}
        return {
            "rclpy": rclpy,
            "rclpy.qos": _module("rclpy.qos", QoSProfile=SimpleNamespace, **qos),
            "rclpy.executors": _module(
                "rclpy.executors", ExternalShutdownException=ExternalShutdownException
            ),
            "rclpy.signals": _module("rclpy.signals", SignalHandlerOptions=options),
            "sensor_msgs": _module("sensor_msgs"),
            "sensor_msgs.msg": _module("sensor_msgs.msg", Image=Image),
            "event_camera_msgs": _module("event_camera_msgs"),
            "event_camera_msgs.msg": _module("event_camera_msgs.msg", EventPacket=EventPacket),
        }


def image(pixels, time_ns: int, encoding: str = "mono8", frame_id: str = "cam") -> Image:
    """A sensor_msgs/Image of uint8 or uint16 pixels."""
    message = Image()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(time_ns, 10**9)
    message.header.frame_id = frame_id
    message.height, message.width = pixels.shape[:2]
    message.encoding, message.is_bigendian = encoding, 0
    message.step = pixels[0].nbytes
    message.data = pixels.tobytes()
    return message


def _module(name: str, **contents) -> ModuleType:
    module = ModuleType(name)
    vars(module).update(contents)
    return module
