"""Bags of either ROS told apart from other files, without the packages that read them."""

from __future__ import annotations

from pathlib import Path

from texvent.io.input_checks import begins_with

ROSBAG1_MAGIC = b"#ROSBAG V"
MCAP_MAGIC, SQLITE_MAGIC = b"\x89MCAP", b"SQLite format 3"
ROSBAG2_MAGICS = (MCAP_MAGIC, SQLITE_MAGIC)
FOLDER_FACTS, FACTS_KEY = "metadata.yaml", "rosbag2_bagfile_information"


def is_bag(path: Path) -> bool:
    """Whether a file is a bag, by its first bytes, or a folder one, by the facts in it."""
    if path.is_dir():
        return begins_with(path / FOLDER_FACTS, FACTS_KEY.encode())
    return any(begins_with(path, magic) for magic in (ROSBAG1_MAGIC, *ROSBAG2_MAGICS))
