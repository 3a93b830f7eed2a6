"""Logic of the node, without ROS: images in, packets of events out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import texvent
from texvent.errors import shown
from texvent.events import EventStream
from texvent.io.ros.messages import NS, NS_PER_S, EventPacket
from texvent.sensor import SensorSize
from texvent_ros.config import RosConfig
from texvent_ros.messages import PacketMaker, check_side, read_image, stamp_ns

Notify = Callable[[str], None]


class Answer(NamedTuple):
    """Events and messages of an image."""

    packets: list[EventPacket]
    """Messages with the events since the image before; where a recording begins, with those that
    the simulator held back of the one before."""
    events: EventStream | None
    """The same events; times count from the first image. None where there are no such
    events: a recording begins, or the image is dropped."""
    stamp_ns: int
    """Time of the image at which the events end, ns."""
    frame_id: str


@dataclass
class _Recording:
    """Images that follow each other."""

    camera: texvent.EventCamera
    first_ns: int
    last_ns: int
    frame_id: str
    """Of the last image."""

    @property
    def last_us(self) -> int:
        """Time of the last image since the first, µs."""
        return (self.last_ns - self.first_ns) // NS


class ImageEvents:
    """Turns sensor_msgs/Image messages into event_camera_msgs/EventPacket.

    Times come from the headers. An image whose time does not increase is dropped. A step beyond
    `max_gap`, forwards or backwards (a bag that starts again), or another size begins a new
    recording: its first image gives no event.

    Args:
        options: options of `texvent.EventCamera`.
        config: parameters of the node.
        warn: receives a line about dropped images and new recordings.

    Raises:
        ConfigError: an option needs more than the images so far.
        InputError: weights are missing.
    """

    def __init__(self, options: Mapping[str, Any], config: RosConfig, warn: Notify) -> None:
        texvent.EventCamera((1, 1), **options).close()  # refuses bad options before any image
        self._options, self._config, self._warn = options, config, warn
        self._recording: _Recording | None = None
        self._maker = PacketMaker(config.packet_us)
        self.dropped = 0
        """Images whose time did not increase."""
        self.recordings = 0
        """Recordings begun."""

    def take(self, message: Any, now_ns: int) -> Answer:
        """The events since the image before.

        Args:
            message: a sensor_msgs/Image.
            now_ns: the node's clock, ns; used with `stamps="arrival"`.

        Raises:
            InputError: an image of an unknown encoding or with too few bytes.
            ConfigError: the sensor is too large for EVT3.
        """
        time_ns = stamp_ns(message) if self._config.stamps == "header" else now_ns
        frame_id = str(message.header.frame_id) or self._config.frame_id
        pixels = read_image(message)
        size = SensorSize(pixels.shape[1], pixels.shape[0])
        recording, reason = self._recording, self._restart_reason(time_ns, size)
        if recording is None or reason is not None:
            rest = self.finish()
            recording = self._begin(time_ns, size, reason, frame_id)
            recording.camera.step(pixels, 0)
            self._recording = recording
            return rest or Answer([], None, time_ns, frame_id)
        if time_ns - recording.last_ns < NS:
            self._drop(time_ns, recording)
            return Answer([], None, time_ns, frame_id)
        self._recording = None  # one that stops in here cannot go on, nor be finished
        recording.last_ns, recording.frame_id = time_ns, frame_id
        events = recording.camera.step(pixels, recording.last_us)
        answer = self._answer(recording, events)
        self._recording = recording
        return answer

    def finish(self) -> Answer | None:
        """The events that the simulator held back; the next image begins a recording.

        Returns:
            None where there is no such event.
        """
        recording, self._recording = self._recording, None
        if recording is None:
            return None
        events = recording.camera.finish()
        return self._answer(recording, events) if len(events) else None

    def _answer(self, recording: _Recording, events: EventStream) -> Answer:
        frame_id = recording.frame_id
        packets = self._maker.messages(events, recording.last_us, frame_id)
        return Answer(packets, events, recording.last_ns, frame_id)

    def _restart_reason(self, time_ns: int, size: SensorSize) -> str | None:
        recording = self._recording
        if recording is None:
            return None
        if size != recording.camera.frame_size:
            return f"images are {size} now, they were {recording.camera.frame_size}"
        step_ns = time_ns - recording.last_ns
        if abs(step_ns) > self._config.max_gap_ns:
            return f"time steps by {step_ns / NS_PER_S:+.3f} s, beyond max_gap"
        return None

    def _begin(
        self, time_ns: int, size: SensorSize, reason: str | None, frame_id: str
    ) -> _Recording:
        if reason is not None:
            self._warn(f"{reason}: a new recording begins")
        camera = texvent.EventCamera(size, **self._options)
        check_side(camera.size)
        self._maker.start(time_ns)
        self.recordings += 1
        return _Recording(camera, time_ns, time_ns, frame_id)

    def _drop(self, time_ns: int, recording: _Recording) -> None:
        self.dropped += 1
        if self.dropped & (self.dropped - 1) == 0:  # 1, 2, 4, 8, ...
            hint = "; images without times need stamps:=arrival" if time_ns == 0 else ""
            self._warn(
                f"dropped {self.dropped} image(s): the time {shown(time_ns)} ns does not come "
                f"after {recording.last_ns} ns{hint}"
            )
