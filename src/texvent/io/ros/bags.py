"""ROS bags: rosbag1 (.bag) with dvs_msgs/EventArray, MCAP (.mcap) with EventPacket of EVT3 words.

Topics: `/dvs/events`, one message per 10 ms; `/texvent`, one std_msgs/String with size and
metadata as JSON, which also keeps recordings without events. Of other programs' bags the first
topic with such messages is read; messages without events say the size too.

The EVT3 words of an MCAP file go on from message to message, as cameras' do: a reader that starts
in the middle has to wait for the next change of the high time bits (4 ms).

Needs rosbags: the extra `bags`. A bag whose recorder crashed has no index and is refused.
"""

from __future__ import annotations

import struct
from abc import abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

from texvent._require import require
from texvent.errors import FileFormatError, InputError, MissingDependencyError, one_line
from texvent.io.block_codec import BlockCodec, FileContents
from texvent.io.block_writer import FileTarget, FormatLimits, WriteBlock
from texvent.io.metadata import parse_sidecar, sidecar_text
from texvent.io.prophesee.evt import Evt3Codec
from texvent.io.protocol import Columns
from texvent.io.reading import ReadOptions
from texvent.io.ros.bag_writer import (
    EXTRA,
    FACTS_TOPIC,
    ROSBAG1,
    ROSBAG2,
    STRING,
    BagKind,
    open_sensor_bag,
)
from texvent.io.ros.messages import (
    EVENT_ARRAY,
    EVENT_PACKET,
    RawMessage,
    bound_chunks,
    open_event_array,
    open_event_packet,
    unpack_event_array,
)

TOPIC = "/dvs/events"
OPEN_MESSAGE = {EVENT_ARRAY: open_event_array, EVENT_PACKET: open_event_packet}
"""Type of message → what finds its parts."""


class BagCodec(BlockCodec):
    """Base of both kinds of bag."""

    kind: ClassVar[BagKind]
    module: ClassVar[str]
    """Package that reads the file."""
    message_type: ClassVar[str]
    """Type of the messages that hold events."""
    text_start: ClassVar[int]
    """Bytes before the text in a std_msgs/String."""

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Size and metadata from the message of texvent, else the size of the first events."""
        size: tuple[int, int]
        metadata: dict[str, Any] = {}
        with _open_bag(path, self.module) as bag:
            facts = _first_message(bag, STRING, FACTS_TOPIC)
            if facts is not None:
                size, metadata = parse_sidecar(path, facts[self.text_start :].rstrip(b"\0"))
            else:
                data = _first_message(bag, self.message_type)
                if data is None:
                    raise FileFormatError(
                        f"{path} holds no {self.message_type}; texvent reads bags with those"
                    )
                size = OPEN_MESSAGE[self.message_type](data).size
        return FileContents(size, metadata, partial(self.read_blocks, path))

    def check_target(self, target: FileTarget) -> None:
        """Refuse to start without rosbags."""
        require("rosbags", extra=EXTRA)

    @contextmanager
    def start(self, target: FileTarget, part: Path) -> Iterator[WriteBlock]:
        """Open a bag; size and metadata have the time of the first event, as players wait."""
        text = sidecar_text(target.size, target.metadata)
        with open_sensor_bag(part, self.kind) as bag:
            write_text = bag.text_topic(FACTS_TOPIC)
            write_events = bag.events_topic(TOPIC, target.size)
            is_begun = False

            def write(columns: Columns) -> None:
                nonlocal is_begun
                if not is_begun:
                    write_text(text, int(columns["t"][0]))
                is_begun = True
                write_events(columns)

            yield write
            if not is_begun:
                write_text(text, 0)

    @abstractmethod
    def read_blocks(self, path: Path) -> Iterator[Columns]:
        """Columns of the bag's events."""


class Rosbag1Codec(BagCodec):
    """ROS 1 bags."""

    name: ClassVar[str] = "rosbag1"
    extensions: ClassVar[tuple[str, ...]] = (".bag",)
    limits: ClassVar[FormatLimits] = FormatLimits("rosbag1", 1 << 16, (1 << 32) * 1_000_000)
    kind: ClassVar[BagKind] = "rosbag1"
    module: ClassVar[str] = ROSBAG1
    message_type: ClassVar[str] = EVENT_ARRAY
    text_start: ClassVar[int] = 4

    def read_blocks(self, path: Path) -> Iterator[Columns]:
        """Columns of the bag's events."""
        for message in _messages(self, path):
            yield unpack_event_array(message)


class McapCodec(BagCodec):
    """MCAP files of ROS 2."""

    name: ClassVar[str] = "mcap"
    extensions: ClassVar[tuple[str, ...]] = (".mcap",)
    limits: ClassVar[FormatLimits] = FormatLimits("MCAP with EVT3", 2048, 1 << 42)
    kind: ClassVar[BagKind] = "mcap"
    module: ClassVar[str] = ROSBAG2
    message_type: ClassVar[str] = EVENT_PACKET
    text_start: ClassVar[int] = 8

    def read_blocks(self, path: Path) -> Iterator[Columns]:
        """Columns of the bag's events."""
        decoder = Evt3Codec().make_decoder()
        for message in _messages(self, path):
            yield decoder.decode(message.payload)


@contextmanager
def _open_bag(path: Path, module: str) -> Iterator[Any]:
    """A reader; whatever a damaged bag makes it raise becomes a FileFormatError."""
    package = require(module, extra=EXTRA)
    try:
        with package.Reader(path) as bag:
            if module == ROSBAG1:
                bound_chunks(bag)
            yield bag
    except (InputError, MissingDependencyError) as error:
        if str(path) in str(error) or isinstance(error, MissingDependencyError):
            raise
        raise FileFormatError(f"{path}: {error}") from error
    except (package.ReaderError, *_DAMAGE) as error:
        raise FileFormatError(f"{path} is damaged or not a bag ({one_line(error)})") from error


_DAMAGE = (
    OSError,
    ValueError,
    LookupError,
    TypeError,
    AttributeError,
    AssertionError,
    EOFError,
    MemoryError,
    OverflowError,
    RuntimeError,
    struct.error,
)
"""rosbags raises any of these on a damaged bag."""


def _connections(bag: Any, kind: str, topic: str | None) -> list[Any]:
    return [one for one in bag.connections if one.msgtype == kind and topic in (None, one.topic)][
        :1
    ]


def _first_message(bag: Any, kind: str, topic: str | None = None) -> bytes | None:
    """The first message of a type, or None."""
    chosen = _connections(bag, kind, topic)
    for _, _, data in bag.messages(chosen) if chosen else ():
        message: bytes = data
        return message
    return None


def _messages(codec: BagCodec, path: Path) -> Iterator[RawMessage]:
    with _open_bag(path, codec.module) as bag:
        chosen = _connections(bag, codec.message_type, None)
        messages = bag.messages(chosen) if chosen else iter(())
        while True:
            entry = next(messages, None)
            if entry is None:
                return
            yield OPEN_MESSAGE[codec.message_type](entry[2])
