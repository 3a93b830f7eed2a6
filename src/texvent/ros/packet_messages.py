"""Events → event_camera_msgs/EventPacket, as the driver of a camera would send them.

The words count µs on a clock of the node's own that never steps back, whatever ROS time does, for
decoders take a step back for a turn of EVT3's 24-bit counter. `time_base` brings it to ROS time:

    ROS time of an event = time_base + its time in the words        (modulo 2^64 ns)

Every message begins with both halves of the time and the row, so it can be decoded without those
before it, but for the turns of 16.78 s that its receiver has not seen; the stamp of the header, the
ROS time of the first event, tells those. The words of a camera leave more open.

Source: event_camera_msgs, EventPacket.msg; Prophesee, "EVT 3.0 Format".
"""

from __future__ import annotations

import numpy as np

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.io.block_codec import split_by_time
from texvent.io.protocol import Columns
from texvent.io.ros.messages import NS, EventPacket
from texvent.sensor import SensorSize

LARGEST_SIDE = 2048
"""EVT3 has 11 bits for a column or a row."""


class PacketMaker:
    """Makes the messages of a node, over all its recordings.

    Args:
        packet_us: no message spans a multiple of this, µs.
    """

    def __init__(self, packet_us: int) -> None:
        self._packet_us = packet_us
        self._words = _LoneWords()
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


class _LoneWords:
    """EVT3 words of one message after the other, each with its time and row in full."""

    def __init__(self) -> None:
        from texvent.io.prophesee import evt3_coding  # brings Numba

        self._coding = evt3_coding
        self._turns = 0

    def encode(self, columns: Columns) -> bytes:
        """Words of the events in columns x, y, t, p."""
        unknown = -1
        state = np.array([self._turns, unknown, unknown, unknown], dtype=np.int64)
        words = np.empty(self._coding.count_words(columns["t"], state), dtype=self._coding.WORD)
        count = self._coding.encode_events(tuple(columns[name] for name in "xytp"), state, words)
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
            f"{LARGEST_SIDE} pixels; choose a smaller --sensor, to which they are fitted"
        )
    return size
