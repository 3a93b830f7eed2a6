"""Messages: sensor_msgs/Image → pixels, events → event_camera_msgs/EventPacket.

The EVT3 words of a packet count µs on a clock of the node's own that never steps back, whatever
ROS time does, for decoders take a step back for a turn of EVT3's 24-bit counter.
`time_base` brings it to ROS time:

    ROS time of an event = time_base + its time in the words        (modulo 2^64 ns)

Every message begins with both halves of the time and the row, so it can be decoded without those
before it, but for the turns of 16.78 s that its receiver has not seen; the stamp of the header, the
ROS time of the first event, tells those. The words of a camera leave more open.

Source: event_camera_msgs, EventPacket.msg; Prophesee, "EVT 3.0 Format";
sensor_msgs, Image.msg and image_encodings.hpp; cv_bridge, which takes plain 8UC3 as BGR.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, InputError, few, shown
from texvent.events import EventStream
from texvent.io.block_codec import split_by_time
from texvent.io.block_writer import Columns
from texvent.io.prophesee import evt3_coding
from texvent.io.ros.messages import NS, NS_PER_S, EventPacket
from texvent.sensor import SensorSize


class Encoding(NamedTuple):
    """Layout of the pixels of an Image."""

    dtype: str
    """NumPy type of a channel, little-endian."""
    channels: int
    order: tuple[int, ...] | None
    """Channels of red, green and blue; None for grey."""


_RGB, _BGR = (0, 1, 2), (2, 1, 0)
ENCODINGS = {
    "mono8": Encoding("u1", 1, None),
    "8UC1": Encoding("u1", 1, None),
    "mono16": Encoding("<u2", 1, None),
    "16UC1": Encoding("<u2", 1, None),
    "rgb8": Encoding("u1", 3, _RGB),
    "bgr8": Encoding("u1", 3, _BGR),
    "8UC3": Encoding("u1", 3, _BGR),
    "rgba8": Encoding("u1", 4, _RGB),
    "bgra8": Encoding("u1", 4, _BGR),
    "8UC4": Encoding("u1", 4, _BGR),
    "rgb16": Encoding("<u2", 3, _RGB),
    "bgr16": Encoding("<u2", 3, _BGR),
    "16UC3": Encoding("<u2", 3, _BGR),
}
"""Name in the message → layout. Others have no agreed white, or are not images of light."""
ADVICE = {
    "bayer": "publish a demosaiced image, such as that of image_proc",
    "yuv": "let the camera's driver publish mono8 or rgb8",
    "nv": "let the camera's driver publish mono8 or rgb8",
    "32F": "floats have no agreed white; publish mono16",
    "64F": "floats have no agreed white; publish mono16",
}
"""Beginning of an encoding → advice."""


def read_image(message: Any) -> NDArray[Any]:
    """Pixels of a sensor_msgs/Image.

    Args:
        message: anything with the fields of the message.

    Returns:
        [H, W] grey or [H, W, 3] RGB, uint8 or uint16; alpha is left out. A view of the message's
        bytes where these need no change.

    Raises:
        InputError: an encoding that is not in `ENCODINGS`, no pixel, a step shorter than a row, or
            fewer bytes than the rows take.
    """
    encoding = _encoding(str(message.encoding))
    height, width, step = int(message.height), int(message.width), int(message.step)
    if height < 1 or width < 1:
        raise InputError(f"an image of {width}x{height} pixels has none; check who publishes it")
    dtype = np.dtype(encoding.dtype)
    if message.is_bigendian:
        dtype = dtype.newbyteorder(">")
    row_bytes = width * encoding.channels * dtype.itemsize
    if step < row_bytes:
        raise InputError(
            f"an image states step {step}; a row of {width} pixels in {message.encoding} takes "
            f"{row_bytes} bytes"
        )
    data = np.frombuffer(message.data, dtype=np.uint8)
    needed = step * (height - 1) + row_bytes
    if data.size < needed:
        raise InputError(
            f"an image of {width}x{height} in {message.encoding} has {data.size} bytes; it needs "
            f"{needed}"
        )
    rows = np.lib.stride_tricks.as_strided(data, (height, row_bytes), (step, 1), writeable=False)
    values = np.ascontiguousarray(rows).view(dtype).astype(dtype.newbyteorder("="), copy=False)
    if encoding.order is None:
        return values.reshape(height, width)
    return values.reshape(height, width, encoding.channels)[:, :, list(encoding.order)]


def stamp_ns(message: Any) -> int:
    """Time of a message's header, ns."""
    stamp = message.header.stamp
    return int(stamp.sec) * NS_PER_S + int(stamp.nanosec)


def _encoding(name: str) -> Encoding:
    if name in ENCODINGS:
        return ENCODINGS[name]
    known = f"texvent takes {few(list(ENCODINGS), len(ENCODINGS))}"
    advice = next((text for start, text in ADVICE.items() if name.startswith(start)), None)
    raise InputError(f"an image is encoded as {shown(name)}; {advice or known}")


LARGEST_SIDE = 2048
"""EVT3 has 11 bits for a column or a row."""


class PacketMaker:
    """Encoder of the messages of a node, over all its recordings.

    Args:
        packet_us: no message spans a multiple of this, µs.
    """

    def __init__(self, packet_us: int) -> None:
        self._packet_us = packet_us
        self._words = _SelfContainedEvt3Words()
        self._sequence = 0
        self._clock_us = self._offset_us = 0
        self._first_ns = self._time_base_ns = 0

    def start(self, first_ns: int) -> None:
        """Begin a recording, whose time 0 is `first_ns` in ROS time."""
        self._offset_us = self._clock_us
        self._time_base_ns = (first_ns - self._offset_us * NS) % 2**64
        self._first_ns = first_ns

    def messages(self, events: EventStream, end_us: int, frame: str) -> list[EventPacket]:
        """The messages of some events, which follow those of the call before.

        Args:
            events: times count from the start of the recording, µs.
            end_us: end of the time that they cover, µs on the same clock.
            frame: coordinate frame of the headers.
        """
        size = check_side(events.size)
        columns = dict(events.columns())
        columns["t"] = columns["t"] + np.int64(self._offset_us)
        made = []
        for part in split_by_time(columns, self._packet_us) if len(events) else ():
            first_us = int(part["t"][0]) - self._offset_us
            stamp_ns = self._first_ns + first_us * NS
            words = self._words.encode(part)
            made.append(
                EventPacket(stamp_ns, frame, size, self._sequence, self._time_base_ns, words)
            )
            self._sequence += 1
        self._clock_us = self._offset_us + end_us
        return made


class _SelfContainedEvt3Words:
    """EVT3 words of successive messages, each with its time and row in full."""

    def __init__(self) -> None:
        self._turns = 0

    def encode(self, columns: Columns) -> bytes:
        """Words of the events in columns x, y, t, p."""
        unknown = -1
        state = np.array([self._turns, unknown, unknown, unknown], dtype=np.int64)
        words = np.empty(evt3_coding.count_words(columns["t"], state), dtype=evt3_coding.WORD)
        count = evt3_coding.encode_events(tuple(columns[name] for name in "xytp"), state, words)
        self._turns = int(state[0])
        return words[:count].tobytes()


def check_side(size: SensorSize) -> SensorSize:
    """The size, if EVT3 can hold it.

    Raises:
        ConfigError: a side is too long.
    """
    if max(size) > LARGEST_SIDE:
        raise ConfigError(
            f"the images are {size}; EVT3, in which EventPacket holds events, ends at "
            f"{LARGEST_SIDE} pixels; set a smaller sensor, to which they are fitted"
        )
    return size
