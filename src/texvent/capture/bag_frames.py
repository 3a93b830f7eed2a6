"""Frames of ROS bags: the images of one topic, as a camera's driver publishes them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from texvent.capture.frame_source import FrameSource
from texvent.capture.given_times import FrameTimes
from texvent.errors import FileFormatError, InputError
from texvent.frames import Frame
from texvent.io.reading import choose
from texvent.io.ros.bags import Bag, open_bag
from texvent.io.ros.image_messages import IMAGE_MESSAGES, image_stamp_ns, read_image
from texvent.sensor import SensorSize, checked_size

NS = 1000


class BagFrames(FrameSource):
    """The images of one topic of a bag; every iteration opens the bag anew.

    Times are the stamps of their headers, on the clock of the bag, unless `times` are given.

    Raises:
        FileFormatError: it holds no images; while iterating: an image is damaged, of another size
            than the first, or of an encoding that is not read.
        InputError: several topics have images and none is chosen; or another number of times is
            given than there are images.
        MissingDependencyError: rosbags is not installed.
    """

    def __init__(
        self, path: Path, times: FrameTimes | None = None, *, topic: str | None = None
    ) -> None:
        self._path, self._times = path, times
        with open_bag(path) as bag:
            self._topic = _choose_topic(path, bag.reader.connections, topic)
            own = self._own(bag)
            kind, data = next(((one.msgtype, data) for one, data in bag.messages(own)), ("", b""))
            if not kind:
                raise FileFormatError(f"{path}: {self._topic} has no message")
            height, width = read_image(kind, data, bag.version).shape[:2]
            count = sum(one.msgcount for one in own)
        if times is not None:
            times.check_count(count)
        metadata = {
            "source": str(path),
            "kind": "ROS bag",
            "topic": self._topic,
            "times": "given" if times else "stamps of the headers",
        }
        super().__init__(checked_size(width, height), times.fps if times else None, count, metadata)

    @property
    def times_us(self) -> Sequence[int] | None:
        """Times of all frames, µs; pixels are passed over."""
        if self._times is not None:
            return self._times.of(self.frame_count or 0)
        with open_bag(self._path) as bag:
            messages = bag.messages(self._own(bag))
            return [image_stamp_ns(data, bag.version) // NS for _, data in messages]

    def __iter__(self) -> Iterator[Frame]:
        """Frames in order; see the class for what can go wrong."""
        last_us = None
        with open_bag(self._path) as bag:
            for index, (connection, data) in enumerate(bag.messages(self._own(bag))):
                pixels = read_image(connection.msgtype, data, bag.version)
                size = SensorSize(pixels.shape[1], pixels.shape[0])
                if size != self.size:
                    raise FileFormatError(
                        f"image {index} of {self._topic} is {size}, the first {self.size}; all "
                        "must have one size"
                    )
                if self._times is not None:
                    yield Frame(pixels, self._times(index))
                    continue
                t_us = image_stamp_ns(data, bag.version) // NS
                if last_us is not None and t_us <= last_us:
                    advice = (
                        "that of the one before; give the frame rate, --fps"
                        if t_us == last_us
                        else f"before {last_us} of the one before: the order of the recording is "
                        "not that of the stamps; sort the bag by them"
                    )
                    raise InputError(
                        f"image {index} of {self._topic} has the stamp {t_us} µs, {advice}"
                    )
                last_us = t_us
                yield Frame(pixels, t_us)

    def _own(self, bag: Bag) -> list[Any]:
        return [
            one
            for one in bag.reader.connections
            if one.topic == self._topic and one.msgtype in IMAGE_MESSAGES
        ]


def _choose_topic(path: Path, connections: Sequence[Any], wanted: str | None) -> str:
    """The topic of the images that are read.

    Raises:
        FileFormatError: none has images.
        InputError: several have, or the one that is wanted has none.
    """
    images = (str(one.topic) for one in connections if one.msgtype in IMAGE_MESSAGES)
    topics = list(dict.fromkeys(images))
    if not topics:
        kinds = ", ".join(sorted({one.msgtype for one in connections})) or "nothing"
        raise FileFormatError(
            f"{path} holds no images ({' or '.join(IMAGE_MESSAGES)}), but {kinds}; texvent render, "
            "view, convert and info take events"
        )
    if wanted is None:  # topics without messages are no choice
        sent = {str(one.topic) for one in connections if one.msgcount}
        topics = [topic for topic in topics if topic in sent] or topics[:1]
    if wanted is None and len(topics) > 1:
        raise InputError(
            f"{path} has images on {len(topics)} topics: {', '.join(topics)}; choose one as topic "
            f"(--topic {topics[0]})"
        )
    return topics[choose(path, topics, wanted)]
