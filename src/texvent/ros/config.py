"""Options of the ROS 2 node."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from texvent.config import check_choices, check_range
from texvent.errors import ConfigError, shown

TOPIC = re.compile(r"(~?/)?[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*")
"""Names of topics, absolute, relative or private, and of nodes without a slash."""
Reliability = Literal["reliable", "best_effort"]


@dataclass(frozen=True, kw_only=True)
class RosConfig:
    """Topics, messages and quality of service."""

    outputs: ClassVar[tuple[str, ...]] = ()
    short_flags: ClassVar[Mapping[str, str]] = {"quiet": "-q"}

    node: str = "texvent"
    """Name of the node."""
    image_topic: str = "image_raw"
    """Topic of sensor_msgs/Image to read, where no video or prompt is given."""
    events_topic: str = "events"
    """Topic on which event_camera_msgs/EventPacket is published."""
    view_topic: str | None = None
    """Topic for images of the events, one per source frame: sensor_msgs/Image, rgb8. Without it,
    none is published."""
    frame_id: str = "event_camera"
    """Coordinate frame in the headers; of images that state one, theirs is used instead."""
    packet_ms: float = 10.0
    """Longest time that a message spans, ms."""
    stamps: Literal["header", "arrival"] = "header"
    """Where the time of an image comes from: its header, or the node's clock when it arrives."""
    max_gap: float = 1.0
    """A step of time beyond this, forwards or backwards, begins a new recording, s: the pixels
    forget what they saw."""
    image_qos: Reliability = "best_effort"
    """Reliability asked of the images; best_effort takes those of every publisher."""
    events_qos: Reliability = "reliable"
    """Reliability offered with the events; reliable serves every subscriber."""
    queue: int = 10
    """Messages that wait in a queue; older ones are dropped."""
    rate: float = 1.0
    """Speed of a video or prompt: 1 is real time, 0.1 ten times slower, 0 as fast as it can be.
    Stamps keep the recording's time within a pass, whatever the speed."""
    loop: bool = False
    """Begin the video or prompt again when it ends."""
    quiet: bool = False
    """Log warnings only."""

    def __post_init__(self) -> None:
        check_choices(self)
        check_range("packet_ms", self.packet_ms, 0.001, 1000.0)
        check_range("max_gap", self.max_gap, 0.001, 86_400.0)
        check_range("queue", self.queue, 1, 10_000)
        check_range("rate", self.rate, 0.0, 1000.0)
        for name in ("image_topic", "events_topic", "view_topic"):
            topic = getattr(self, name)
            if topic is not None and not TOPIC.fullmatch(topic):
                raise ConfigError(
                    f"{name} is {shown(topic)}; a topic has letters, digits and _ between slashes, "
                    "such as camera/events"
                )
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", self.node):
            raise ConfigError(f"node is {shown(self.node)}; it must be letters, digits and _")

    @property
    def packet_us(self) -> int:
        """Longest time that a message spans, µs."""
        return max(1, round(self.packet_ms * 1000))

    @property
    def max_gap_ns(self) -> int:
        """The longest step of time, ns."""
        return round(self.max_gap * 1_000_000_000)
