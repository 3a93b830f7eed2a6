"""Compressed ROS 1 bags of others are read; those made to fill the memory are not."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from texvent.errors import FileFormatError
from texvent.io.files import load, save
from texvent.io.ros import bag_bounds as bag_chunks
from texvent.sensor import SensorSize

from ..format_cases import random_events


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


def test_compressed_bags_are_read(compressed: tuple[Path, Any]) -> None:
    path, events = compressed
    assert load(path).equals(events)


def test_a_chunk_that_would_fill_the_memory_is_refused(
    compressed: tuple[Path, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bag_chunks, "MAX_CHUNK_BYTES", 10_000)
    with pytest.raises(FileFormatError, match="unpacks to more than 10000 bytes"):
        load(compressed[0])
