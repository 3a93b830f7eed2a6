"""ROS bags: ROS 1 (.bag) and ROS 2 (.mcap, .db3, folders of them).

Read are EventArray of dvs_msgs, prophesee_event_msgs and dv_ros_msgs, and EventPacket of
event_camera_msgs (EventArray of event_array_msgs) encoded as evt3, mono, libcaer or libcaer_cmp, on
the one topic that has them, or the one that is chosen. Messages without events say the size too;
one that says 0x0 says none.

Written are rosbag1 with dvs_msgs/EventArray and MCAP with EventPacket of EVT3 words, on
`/dvs/events`, one message per 10 ms; and on `/texvent` one std_msgs/String with size and metadata
as JSON, which also keeps recordings without events. The EVT3 words of an MCAP file go on from
message to message, as cameras' do: a reader that starts in the middle has to wait for the next
change of the high time bits (4 ms).

Needs rosbags: the extra `bags`. A bag whose recorder crashed has no index and is refused.
"""

from __future__ import annotations

import itertools
import re
import struct
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

from texvent._require import require
from texvent.errors import FileFormatError, InputError, MissingDependencyError, one_line
from texvent.io.aedat.aedat4_container import unpack_zstd
from texvent.io.block_codec import BlockCodec, BlockReader, FileContents
from texvent.io.block_writer import Columns, FileTarget, FormatLimits, WriteBlock
from texvent.io.input_checks import begins_with
from texvent.io.metadata import parse_sidecar, sidecar_text
from texvent.io.prophesee.evt import Evt3Codec
from texvent.io.reading import ReadOptions, choose
from texvent.io.ros.bag_bounds import (
    bound_chunks,
    bounded_bag,
    check_total,
)
from texvent.io.ros.bag_kind import FOLDER_FACTS, ROSBAG1_MAGIC, ROSBAG2_MAGICS
from texvent.io.ros.bag_writer import (
    EVENTS_TOPIC,
    EXTRA,
    FACTS_TOPIC,
    ROSBAG1,
    ROSBAG2,
    STRING,
    BagKind,
    open_sensor_bag,
)
from texvent.io.ros.messages import (
    EVENT_MESSAGES,
    RawMessage,
    open_message,
    unpack_libcaer,
    unpack_libcaer_cmp,
    unpack_mono,
    unpack_records,
)
from texvent.sensor import SensorSize

TEXT_START = {1: 4, 2: 8}
"""Version of ROS → bytes before the text in a std_msgs/String."""


class BagReader(BlockReader):
    """Bags of either ROS; the content says which."""

    takes: ClassVar[tuple[str, ...]] = ("stream",)

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Size and metadata from the message of texvent, else the size of the first events."""
        size: tuple[int, int] | None = None
        metadata: dict[str, Any] = {}
        with open_bag(path) as bag:
            connections = bag.reader.connections
            facts = bag.messages([one for one in connections if _is_facts(one)])
            for _, data in itertools.islice(facts, 1):
                text = data[TEXT_START[bag.version] :].rstrip(b"\0")
                size, metadata = parse_sidecar(path, text)
            topics = _event_topics(connections)
            if not topics:
                kinds = sorted({one.msgtype for one in connections})
                raise FileFormatError(
                    f"{path} holds no messages of events ({', '.join(EVENT_MESSAGES)}); it has "
                    f"{', '.join(kinds) or 'none'}"
                )
            names = list(topics)
            chosen = names[choose(path, names, options.stream)]
            if size is None:
                sizes = [one.size for one in itertools.islice(_sized(bag, topics[chosen]), 1)]
                size = sizes[0] if sizes else None
        return FileContents(size, metadata, partial(_read_blocks, path, chosen))

    def beside(self, path: Path) -> Iterator[str]:
        """Topics of images and of an IMU."""
        with open_bag(path) as bag:
            for one in bag.reader.connections:
                if re.search("sensor_msgs/.*(Image|Imu)$", one.msgtype) and one.msgcount:
                    yield one.topic


def _is_facts(connection: Any) -> bool:
    return bool(connection.msgtype == STRING and connection.topic == FACTS_TOPIC)


def _event_topics(connections: Iterable[Any]) -> dict[str, list[Any]]:
    """Topics with messages of events → their connections."""
    topics: dict[str, list[Any]] = {}
    for one in connections:
        if one.msgtype in EVENT_MESSAGES:
            topics.setdefault(one.topic, []).append(one)
    return topics


class Rosbag2FolderCodec(BagReader):
    """Folders of ROS 2 bags."""

    name: ClassVar[str] = "rosbag2"
    is_folder: ClassVar[bool] = True

    def recognises(self, path: Path) -> bool:
        """True if it is a folder with the facts of a bag."""
        return path.is_dir() and (path / FOLDER_FACTS).is_file()


class BagCodec(BagReader, BlockCodec):
    """Base of both kinds of bag that are written."""

    kind: ClassVar[BagKind]

    def check_target(self, target: FileTarget) -> None:
        """Refuse to start without rosbags."""
        require("rosbags", extra=EXTRA)

    @contextmanager
    def start(self, target: FileTarget, part: Path) -> Iterator[WriteBlock]:
        """Open a bag; size and metadata have the time of the first event, as players wait."""
        text = sidecar_text(target.size, target.metadata)
        with open_sensor_bag(part, self.kind) as bag:
            write_text = bag.text_topic(FACTS_TOPIC)
            write_events = bag.events_topic(EVENTS_TOPIC, target.size)
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


class Rosbag1Codec(BagCodec):
    """ROS 1 bags."""

    name: ClassVar[str] = "rosbag1"
    extensions: ClassVar[tuple[str, ...]] = (".bag",)
    limits: ClassVar[FormatLimits] = FormatLimits("rosbag1", 1 << 16, (1 << 32) * 1_000_000)
    kind: ClassVar[BagKind] = "rosbag1"

    def recognises(self, path: Path) -> bool:
        """True if the file begins as bags of ROS 1 do."""
        return begins_with(path, ROSBAG1_MAGIC)


class McapCodec(BagCodec):
    """Files of ROS 2; written as MCAP."""

    name: ClassVar[str] = "mcap"
    extensions: ClassVar[tuple[str, ...]] = (".mcap", ".db3")
    only_read: ClassVar[tuple[str, ...]] = (".db3",)
    limits: ClassVar[FormatLimits] = FormatLimits("MCAP with EVT3", 2048, 1 << 42)
    kind: ClassVar[BagKind] = "mcap"

    def recognises(self, path: Path) -> bool:
        """True if the file begins as MCAP or SQLite does."""
        return any(begins_with(path, magic) for magic in ROSBAG2_MAGICS)


def _opened(bag: Bag, connections: list[Any]) -> Iterator[RawMessage]:
    for connection, data in bag.messages(connections):
        yield open_message(connection.msgtype, data, bag.version)


def _sized(bag: Bag, connections: list[Any]) -> Iterator[RawMessage]:
    """Messages that say the size of the sensor.

    Raises:
        FileFormatError: there is no message at all.
    """
    messages = _opened(bag, connections)
    first = next(messages, None)
    if first is None:
        raise FileFormatError(f"{bag.path}: {connections[0].topic} has no message")
    return (one for one in itertools.chain([first], messages) if any(one.size))


def _read_blocks(path: Path, topic: str) -> Iterator[Columns]:
    decoder = None
    with open_bag(path) as bag:
        size: SensorSize | None = None
        for message in _opened(bag, _event_topics(bag.reader.connections)[topic]):
            if any(message.size):
                size = size or message.size
                if message.size != size:
                    raise FileFormatError(
                        f"{path}: the sensor of {topic} changes from {size} to {message.size}"
                    )
            if message.encoding == "evt3":
                decoder = decoder or Evt3Codec().make_decoder()
                yield decoder.decode(message.payload)
            else:
                yield UNPACK[message.encoding](message)


UNPACK = {
    "records": unpack_records,
    "records-2": unpack_records,
    "mono": unpack_mono,
    "libcaer": unpack_libcaer,
    "libcaer_cmp": unpack_libcaer_cmp,
}


@dataclass(frozen=True)
class Bag:
    """An open bag."""

    path: Path
    reader: Any
    version: int
    """Version of ROS."""
    is_packed: bool = False
    """Whether each message is a Zstandard frame."""

    def messages(self, connections: list[Any]) -> Iterator[tuple[Any, bytes]]:
        """The messages of some connections, by the time at which they were recorded."""
        for connection, _, data in self.reader.messages(connections) if connections else ():
            yield connection, unpack_zstd(data) if self.is_packed else data


@contextmanager
def open_bag(path: Path) -> Iterator[Bag]:
    """An open bag; what a damaged one makes rosbags raise is a FileFormatError."""
    version = 1 if path.is_file() and begins_with(path, ROSBAG1_MAGIC) else 2
    package = require(ROSBAG1 if version == 1 else ROSBAG2, extra=EXTRA)
    damage: tuple[type[Exception], ...] = (package.ReaderError, *_DAMAGE)
    try:
        if version == 1:
            with package.Reader(path) as reader:
                bound_chunks(reader)
                yield Bag(path, reader, version)
            return
        damage = (*damage, require("apsw", extra=EXTRA).Error)
        with bounded_bag(path, EXTRA) as (bounded, is_packed), package.Reader(bounded) as reader:
            check_total(reader)
            if is_packed:
                # rosbags would unpack messages without a bound.
                facts = reader.storage.metadata._replace(compression_mode=None)
                reader.storage.metadata = facts
            yield Bag(path, reader, version, is_packed)
    except (InputError, MissingDependencyError) as error:
        if str(path) in str(error) or isinstance(error, MissingDependencyError):
            raise
        raise FileFormatError(f"{path}: {error}") from error
    except damage as error:
        way = "rosbag reindex" if version == 1 else "ros2 bag reindex (of MCAP: mcap recover)"
        raise FileFormatError(
            f"{path} is damaged or not a bag ({one_line(error)}); of one whose recorder crashed, "
            f"{way} makes the index"
        ) from error


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
