"""Parameters of the node."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from texvent.config import check_choices, check_range
from texvent.errors import ConfigError

Reliability = Literal["reliable", "best_effort"]


@dataclass(frozen=True, kw_only=True)
class RosConfig:
    """Parameters of the node itself; all others are options of texvent.

    Raises:
        ConfigError: a value is out of range, or both a source and a prompt are given.
    """

    source: str = ""
    """Video file, image folder or camera to publish, instead of the images of a topic."""
    prompt: str = ""
    """Sentence whose scene is published, instead of the images of a topic."""
    view: bool = False
    """Publish images of the events on `events_image`: sensor_msgs/Image, rgb8."""
    frame_id: str = "event_camera"
    """Coordinate frame in the headers; images that state one keep theirs."""
    packet_ms: float = 10.0
    """Longest time that a message spans, ms."""
    stamps: Literal["header", "arrival"] = "header"
    """Time of an image: that of its header, or the node's clock when it arrives."""
    max_gap: float = 1.0
    """Step of time, s, forwards or backwards, beyond which a new recording begins."""
    image_qos: Reliability = "best_effort"
    """Reliability asked of the images; best_effort takes those of every publisher."""
    events_qos: Reliability = "reliable"
    """Reliability offered with the events; reliable serves every subscriber."""
    queue: int = 10
    """Length of the queues, messages; older ones are dropped."""
    rate: float = 1.0
    """Speed of a source or prompt: 1 is real time, 0.1 ten times slower, 0 as fast as possible.
    Stamps keep the recording's time."""
    loop: bool = False
    """Play a source or prompt again when it ends."""

    def __post_init__(self) -> None:
        check_choices(self)
        check_range("packet_ms", self.packet_ms, 0.001, 1000.0)
        check_range("max_gap", self.max_gap, 0.001, 86_400.0)
        check_range("queue", self.queue, 1, 10_000)
        check_range("rate", self.rate, 0.0, 1000.0)
        if self.source and self.prompt:
            raise ConfigError("source and prompt are both given; one of them is published")

    @property
    def packet_us(self) -> int:
        """Longest time that a message spans, µs."""
        return max(1, round(self.packet_ms * 1000))

    @property
    def max_gap_ns(self) -> int:
        """Longest step of time within a recording, ns."""
        return round(self.max_gap * 1_000_000_000)
