"""ROS bags: ROS 1 (.bag) and ROS 2 (.mcap, .db3, folders of them).

Read are messages of dvs_msgs/EventArray, prophesee_event_msgs/EventArray, and
event_camera_msgs/EventPacket encoded as evt3, mono or libcaer, on the one topic that has them, or
the one that is chosen; messages without events say the size too.

Written are rosbag1 with dvs_msgs/EventArray and MCAP with EventPacket of EVT3 words, on
`/dvs/events`, one message per 10 ms; and on `/texvent` one std_msgs/String with size and metadata
as JSON, which also keeps recordings without events. The EVT3 words of an MCAP file go on from
message to message, as cameras' do: a reader that starts in the middle has to wait for the next
change of the high time bits (4 ms).

Needs rosbags: the extra `bags`. A bag whose recorder crashed has no index and is refused.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

from texvent._require import require
from texvent.errors import FileFormatError, InputError, MissingDependencyError, one_line
from texvent.io.block_codec import BlockCodec, BlockReader, FileContents
from texvent.io.block_writer import Columns, FileTarget, FormatLimits, WriteBlock
from texvent.io.input_checks import begins_with
from texvent.io.metadata import parse_sidecar, sidecar_text
from texvent.io.prophesee.evt import Evt3Codec
from texvent.io.reading import ReadOptions, choose
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
    EVENT_MESSAGES,
    bound_chunks,
    open_message,
    unpack_libcaer,
    unpack_mono,
    unpack_records,
)

TOPIC = "/dvs/events"
ROSBAG1_MAGIC = b"#ROSBAG V"
ROSBAG2_MAGICS = (b"\x89MCAP", b"SQLite format 3")
FOLDER_FACTS = "metadata.yaml"
TEXT_START = {1: 4, 2: 8}
"""Version of ROS → bytes before the text in a std_msgs/String."""


class BagReader(BlockReader):
    """Bags of either ROS; the content says which."""

    takes: ClassVar[tuple[str, ...]] = ("stream",)

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Size and metadata from the message of texvent, else the size of the first events."""
        size: tuple[int, int] | None = None
        metadata: dict[str, Any] = {}
        with _open_bag(path) as (bag, version):
            facts = _first_message(bag, [one for one in bag.connections if _is_facts(one)])
            if facts is not None:
                text = facts[TEXT_START[version] :].rstrip(b"\0")
                size, metadata = parse_sidecar(path, text)
            topics = _event_topics(bag)
            if not topics:
                kinds = sorted({one.msgtype for one in bag.connections})
                raise FileFormatError(
                    f"{path} holds no messages of events ({', '.join(EVENT_MESSAGES)}); it has "
                    f"{', '.join(kinds) or 'none'}"
                )
            names = list(topics)
            chosen = names[choose(path, names, options.stream)]
            if size is None:
                kind = topics[chosen][0].msgtype
                data = _first_message(bag, topics[chosen])
                if data is None:
                    raise FileFormatError(f"{path}: {chosen} has no message")
                size = open_message(kind, data, version).size
        return FileContents(size, metadata, partial(_read_blocks, path, chosen))


def _is_facts(connection: Any) -> bool:
    return bool(connection.msgtype == STRING and connection.topic == FACTS_TOPIC)


def _event_topics(bag: Any) -> dict[str, list[Any]]:
    """Topics with messages of events → their connections."""
    topics: dict[str, list[Any]] = {}
    for one in bag.connections:
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
    limits: ClassVar[FormatLimits] = FormatLimits("MCAP with EVT3", 2048, 1 << 42)
    kind: ClassVar[BagKind] = "mcap"

    def recognises(self, path: Path) -> bool:
        """True if the file begins as MCAP or SQLite does."""
        return any(begins_with(path, magic) for magic in ROSBAG2_MAGICS)


def _read_blocks(path: Path, topic: str) -> Iterator[Columns]:
    decoder = None
    with _open_bag(path) as (bag, version):
        for connection, _, data in bag.messages(_event_topics(bag)[topic]):
            message = open_message(connection.msgtype, data, version)
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
}


@contextmanager
def _open_bag(path: Path) -> Iterator[tuple[Any, int]]:
    """A reader and the version of ROS; what a damaged bag makes it raise is a FileFormatError."""
    version = 1 if path.is_file() and begins_with(path, ROSBAG1_MAGIC) else 2
    package = require(ROSBAG1 if version == 1 else ROSBAG2, extra=EXTRA)
    try:
        with package.Reader(path) as bag:
            if version == 1:
                bound_chunks(bag)
            yield bag, version
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


def _first_message(bag: Any, connections: list[Any]) -> bytes | None:
    """The first message of some connections, or None."""
    for _, _, data in bag.messages(connections) if connections else ():
        message: bytes = data
        return message
    return None
