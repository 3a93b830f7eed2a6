"""Frames of ROS bags: the images of one topic, as a camera's driver publishes them.

Messages are sensor_msgs/Image and CompressedImage:

    Image            header · u32 height · u32 width · string encoding · u8 is_bigendian ·
                     u32 step · bytes, rows of `step` bytes
    CompressedImage  header · string format · bytes of a JPEG, PNG or other image file

Source: sensor_msgs, message definitions and image_encodings.h; cv_bridge, order of Bayer patterns.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from texvent.capture.frame_source import FrameSource
from texvent.capture.given_times import FrameTimes
from texvent.errors import FileFormatError, InputError, shown
from texvent.frames import Frame, PixelArray
from texvent.io.reading import choose
from texvent.io.ros.bags import Bag, open_bag
from texvent.io.ros.messages import MessageFields
from texvent.runtime.files.image_files import decode_bytes
from texvent.sensor import SensorSize, checked_size

IMAGE = "sensor_msgs/msg/Image"
COMPRESSED = "sensor_msgs/msg/CompressedImage"
IMAGE_MESSAGES = (IMAGE, COMPRESSED)
ENCODINGS: Mapping[str, tuple[str, int, slice]] = {
    **dict.fromkeys(("mono8", "8UC1"), ("u1", 1, slice(None))),
    "mono16": ("u2", 1, slice(None)),
    "rgb8": ("u1", 3, slice(None)),
    "rgb16": ("u2", 3, slice(None)),
    "rgba8": ("u1", 4, slice(3)),
    **dict.fromkeys(("bgr8", "8UC3"), ("u1", 3, slice(None, None, -1))),
    **dict.fromkeys(("bgr16", "16UC3"), ("u2", 3, slice(None, None, -1))),
    **dict.fromkeys(("bgra8", "8UC4"), ("u1", 4, slice(2, None, -1))),
}
"""Encoding → type of its values, their number per pixel, and those of them that are red, green and
blue, or grey. 16UC1 is not among them: in bags it is depth, mostly."""
DEPTH = ("16UC1", "32FC1")
BAYER = {"rggb": "BG", "bggr": "RG", "gbrg": "GR", "grbg": "GB"}
"""Pattern of a Bayer encoding such as bayer_rggb8, by its first two rows → OpenCV's name of it, by
the second pixel of the second row."""


def image_stamp_ns(data: bytes, version: int) -> int:
    """Time in the header of a serialised image message, ns.

    Raises:
        FileFormatError: it is damaged.
    """
    try:
        return MessageFields(data, version).header()
    except struct.error as error:
        raise FileFormatError("a message of an image is cut off") from error


def read_image(kind: str, data: bytes, version: int) -> PixelArray:
    """[H, W] grey or [H, W, 3] RGB of a serialised image message, uint8 or uint16.

    Raises:
        FileFormatError: it is damaged, or its encoding is not read.
    """
    try:
        fields = MessageFields(data, version)
        fields.header()
        if kind == COMPRESSED:
            return _decompressed(fields)
        height, width = fields.number("I"), fields.number("I")
        encoding = fields.text().decode("latin-1")
        is_big_endian, step = bool(fields.number("B")), fields.number("I")
        rows = fields.data()
    except struct.error as error:
        raise FileFormatError("a message of an image is cut off") from error
    pattern = encoding.removeprefix("bayer_").removesuffix("8")
    is_bayer = f"bayer_{pattern}8" == encoding and pattern in BAYER
    if not is_bayer and encoding not in ENCODINGS:
        raise FileFormatError(
            f"an image is encoded as {shown(encoding)}; texvent reads {', '.join(ENCODINGS)} and "
            f"bayer_ {', '.join(f'{one}8' for one in BAYER)}; republish it as one of these"
        )
    kind, count, channels = ENCODINGS["mono8" if is_bayer else encoding]
    dtype = np.dtype(kind).newbyteorder(">" if is_big_endian else "<")
    used = width * count * dtype.itemsize
    if not width or not height or step < used or len(rows) < step * (height - 1) + used:
        raise FileFormatError(
            f"an image of {width}x{height} {encoding} has {len(rows)} bytes in rows of {step}"
        )
    whole = np.zeros(step * height, np.uint8)  # the last row may end with its pixels
    whole[: len(rows)] = np.frombuffer(rows, np.uint8)[: len(whole)]
    pixels = np.ascontiguousarray(whole.reshape(height, step)[:, :used]).view(dtype)
    pixels = pixels.astype(dtype.newbyteorder("="), copy=False)
    if is_bayer:
        return _without_mosaic(pixels, pattern)
    if count == 1:
        return pixels
    return np.ascontiguousarray(pixels.reshape(height, width, count)[..., channels])


def _without_mosaic(pixels: PixelArray, pattern: str) -> PixelArray:
    import cv2

    code = getattr(cv2, f"COLOR_Bayer{BAYER[pattern]}2RGB")
    return np.asarray(cv2.cvtColor(pixels, code), np.uint8)


def _decompressed(fields: MessageFields) -> PixelArray:
    import cv2

    form = fields.text().decode("latin-1")
    if "compressedDepth" in form or form.startswith(DEPTH):
        raise FileFormatError(f"an image is of depth ({shown(form)}); choose a topic of pictures")
    flags = cv2.IMREAD_ANYCOLOR | cv2.IMREAD_ANYDEPTH | cv2.IMREAD_IGNORE_ORIENTATION
    pixels = decode_bytes(bytes(fields.data()), f"of a message ({shown(form)})", flags)
    if pixels.dtype.kind != "u":
        raise FileFormatError(f"an image has values of {pixels.dtype}; texvent reads 8 or 16 bits")
    return np.ascontiguousarray(pixels[..., 2::-1]) if pixels.ndim == 3 else pixels


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
