"""Compressed bags of others are read; those made to fill memory or disk are not."""

import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
import yaml

from texvent.errors import FileFormatError
from texvent.io.aedat import aedat4_container
from texvent.io.aedat.aedat4_container import load_zstd
from texvent.io.files import load, save
from texvent.io.ros.messages import EVENT_PACKET
from texvent.runtime import memory
from texvent.sensor import SensorSize

from ..format_cases import random_events
from .test_bags import MONO, packet_message, types_of, write_bag


@pytest.fixture(params=["BZ2", "LZ4"])
def compressed(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Path, Any]:
    """A bag as texvent writes it, its chunks compressed, and its events."""
    rosbag1 = pytest.importorskip("rosbags.rosbag1", reason="rosbags is not installed")
    events = random_events(3_000, SensorSize(64, 48), span_us=50_000)
    path = tmp_path / "compressed.bag"
    writer = rosbag1.Writer(path)
    writer.set_compression(rosbag1.Writer.CompressionFormat[request.param])
    with rosbag1.Reader(save(tmp_path / "plain.bag", events)) as plain, writer:
        known = {
            one.id: writer.add_connection(
                one.topic, one.msgtype, msgdef=one.msgdef.data, md5sum=one.digest
            )
            for one in plain.connections
        }
        for one, time, data in plain.messages():
            writer.write(known[one.id], time, data)
    return path, events


def test_compressed_bags_are_read(compressed):
    path, events = compressed
    assert load(path).equals(events)


def test_a_chunk_that_would_fill_the_memory_is_refused(compressed, monkeypatch):
    monkeypatch.setattr(aedat4_container, "MAX_PACKET_BYTES", 10_000)
    with pytest.raises(FileFormatError, match="unpacks to more than 0 MiB"):
        load(compressed[0])


def damage_facts(folder: Path, **changes: str) -> None:
    path = folder / "metadata.yaml"
    facts = yaml.safe_load(path.read_text("utf-8"))
    facts["rosbag2_bagfile_information"].update(changes)
    path.write_text(yaml.safe_dump(facts), "utf-8")


def database(folder: Path) -> Path:
    (path,) = folder.glob("*.db3")
    return path


@pytest.fixture
def plain(tmp_path: Path) -> Path:
    """A folder of ROS 2 with the events of `packet_message`."""
    message = packet_message(types_of(2), 2, "mono", MONO)
    return write_bag(tmp_path / "plain", 2, {"/e": (EVENT_PACKET, [message])})


def pack_file(folder: Path, content: bytes) -> None:
    path = database(folder)
    path.with_name(path.name + ".zstd").write_bytes(load_zstd().compress(content))
    path.unlink()
    damage_facts(folder, compression_mode="FILE", compression_format="zstd")
    text = (folder / "metadata.yaml").read_text("utf-8")
    (folder / "metadata.yaml").write_text(text.replace(path.name, path.name + ".zstd"), "utf-8")


def pack_messages(folder: Path) -> None:
    with closing(sqlite3.connect(database(folder))) as file, file:
        ((data,),) = file.execute("SELECT data FROM messages").fetchall()
        file.execute("UPDATE messages SET data = ?", (load_zstd().compress(data + bytes(200_000)),))
    damage_facts(folder, compression_mode="MESSAGE", compression_format="zstd")


@pytest.mark.parametrize("mode", ["file", "message"])
def test_packed_folders_are_read_and_bounded(plain, monkeypatch, mode):
    expected = load(plain)
    if mode == "file":
        pack_file(plain, database(plain).read_bytes())
    else:
        pack_messages(plain)
    assert load(plain).equals(expected)
    for module, name in (
        (memory, "SMALL_BYTES"),
        (memory, "MOST_EXPANSION"),
        (aedat4_container, "MAX_PACKET_BYTES"),
    ):
        monkeypatch.setattr(module, name, 1)
    with pytest.raises(FileFormatError, match=r"unpacks to more than"):
        load(plain)


@pytest.mark.parametrize(
    "change",
    [
        "CREATE VIEW messages AS SELECT id, topic_id, timestamp, data FROM old",
        "CREATE TABLE messages(id, topic_id, timestamp, data GENERATED ALWAYS AS (zeroblob(9)))",
    ],
)
def test_values_that_a_database_computes_are_refused(plain, change):
    path = database(plain)
    with closing(sqlite3.connect(path)) as file, file:
        file.execute("ALTER TABLE messages RENAME TO old")
        file.execute(change)
    content = path.read_bytes()
    for one in (plain, path):
        with pytest.raises(FileFormatError, match="computes the values of 'messages'"):
            load(one)
    pack_file(plain, content)
    with pytest.raises(FileFormatError, match="computes the values of 'messages'"):
        load(plain)


def test_facts_of_aliases_are_refused(plain):
    facts = plain / "metadata.yaml"
    facts.write_text("a: &a [x, x]\nb: *a\n" + facts.read_text("utf-8"), "utf-8")
    with pytest.raises(FileFormatError, match="has aliases, which no recorder writes"):
        load(plain)


def test_chunks_of_mcap_are_bounded_and_ros1_in_it_is_named(tmp_path, monkeypatch):
    rosbag2 = pytest.importorskip("rosbags.rosbag2", reason="rosbags is not installed")
    writer = rosbag2.Writer(tmp_path / "b", version=9, storage_plugin=rosbag2.StoragePlugin.MCAP)
    writer.set_compression(rosbag2.CompressionMode.STORAGE, rosbag2.CompressionFormat.ZSTD)
    types = types_of(2)
    with writer as bag:
        connection = bag.add_connection("/e", EVENT_PACKET, typestore=types)
        message = packet_message(types, 2, "mono", MONO * 20_000)
        bag.write(connection, 1, types.serialize_cdr(message, EVENT_PACKET))
    (path,) = (tmp_path / "b").glob("*.mcap")
    with pytest.raises(FileFormatError, match="time decreases"):
        load(path)
    monkeypatch.setattr(memory, "SMALL_BYTES", 1)
    monkeypatch.setattr(memory, "MOST_EXPANSION", 1)
    with pytest.raises(FileFormatError, match="claims to unpack to"):
        load(path)
    monkeypatch.undo()
    monkeypatch.setattr(aedat4_container, "MAX_PACKET_BYTES", 1)
    with pytest.raises(FileFormatError, match="unpacks to more than"):
        load(path)
    path.write_bytes(path.read_bytes().replace(b"ros2", b"ros1", 1))
    with pytest.raises(FileFormatError, match=r"holds ROS 1 messages, which .* from \.bag only"):
        load(path)
