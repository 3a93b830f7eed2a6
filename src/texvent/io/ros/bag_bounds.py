"""Bags made to fill memory or disk: rosbags unpacks them without a bound, so they are checked here.

ROS 1            chunks, bz2 or lz4
MCAP             chunks, lz4 or Zstandard
folders, ROS 2   metadata.yaml; files or messages, Zstandard
.db3             SQLite, which computes generated columns, views and virtual tables
"""

from __future__ import annotations

import bz2
import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import lz4.frame
import yaml

from texvent._require import require
from texvent.errors import FileFormatError, one_line, shown
from texvent.io.aedat.aedat4_container import unpack_bz2, unpack_lz4, unpack_zstd
from texvent.io.compressed import load_zstd
from texvent.io.input_checks import begins_with
from texvent.io.metadata import MAX_HEADER_BYTES
from texvent.io.ros.bag_kind import FACTS_KEY, FOLDER_FACTS, MCAP_MAGIC, SQLITE_MAGIC
from texvent.runtime.files.hidden_parts import temporary_folder
from texvent.runtime.memory import check_proportion, most_unpacked

PIECE_BYTES = 2**20


def bound_chunks(bag: Any) -> None:
    """Let rosbags' reader of an open ROS 1 bag unpack chunks only as far as packets go."""
    bounded = {bz2.decompress: unpack_bz2, lz4.frame.decompress: unpack_lz4}
    for position, chunk in bag.chunks.items():
        unpack = bounded.get(chunk.decompressor, chunk.decompressor)
        bag.chunks[position] = chunk._replace(decompressor=unpack)


@contextmanager
def bounded_bag(path: Path, extra: str) -> Iterator[tuple[Path, bool]]:
    """A bag of ROS 2 that rosbags may open, and whether its messages are still packed.

    Of a folder whose files are packed it is a folder of the unpacked ones, for the block.

    Raises:
        FileFormatError: it is made to fill memory or disk, or of another profile than ROS 2.
    """
    if not path.is_dir():
        _check_file(path, extra)
        suffix = ".mcap" if begins_with(path, MCAP_MAGIC) else ".db3"
        if path.suffix == suffix:
            yield path, False
            return
        # rosbags goes by the extension.
        with temporary_folder() as folder:
            named = folder / f"bag{suffix}"
            named.symlink_to(path.absolute())
            yield named, False
        return
    facts = _read_facts(path)
    mode = str(facts.get("compression_mode") or "").lower()
    if mode != "file":
        for file in path.iterdir():
            if file.is_file():
                _check_file(file, extra)
        yield path, mode == "message"
        return
    with temporary_folder() as folder:
        names = [Path(str(name)).name for name in facts.get("relative_file_paths") or ()]
        for name in names:
            _unpack_file(path / name, folder / Path(name).stem)
            _check_file(folder / Path(name).stem, extra)
        facts["relative_file_paths"] = [Path(name).stem for name in names]
        facts["compression_mode"] = facts["compression_format"] = ""
        (folder / FOLDER_FACTS).write_text(yaml.safe_dump({FACTS_KEY: facts}), encoding="utf-8")
        yield folder, False


def _read_facts(path: Path) -> dict[str, Any]:
    """The facts of a folder.

    Raises:
        FileFormatError: they are no YAML, or of aliases, which can grow without bound.
    """
    file = path / FOLDER_FACTS
    if file.stat().st_size > MAX_HEADER_BYTES:
        raise FileFormatError(f"{file} is longer than {MAX_HEADER_BYTES} bytes; it is damaged")
    text = file.read_text(encoding="utf-8", errors="replace")
    has_aliases = False
    facts: Any = None
    try:
        events = yaml.parse(text, yaml.SafeLoader)
        has_aliases = any(isinstance(one, yaml.AliasEvent) for one in events)
        facts = None if has_aliases else yaml.safe_load(text)[FACTS_KEY]
    except (yaml.YAMLError, LookupError, TypeError, RecursionError, ValueError) as error:
        raise FileFormatError(f"{file} holds no facts of a bag ({one_line(error)})") from error
    if not isinstance(facts, dict):
        what = "has aliases, which no recorder writes" if has_aliases else "holds no facts of a bag"
        raise FileFormatError(f"{file} {what}")
    return facts


def _unpack_file(source: Path, target: Path) -> None:
    """Unpack a file as far as packed recordings go.

    Raises:
        FileFormatError: it is damaged, or unpacks to more than 100 times its size.
    """
    most = min(most_unpacked(source), shutil.disk_usage(target.parent).free)
    zstd = load_zstd()
    with source.open("rb") as packed, zstd.open(packed, "rb") as unpacked, target.open("wb") as out:
        try:
            while piece := unpacked.read(PIECE_BYTES):
                out.write(piece)
                if out.tell() > most:
                    raise FileFormatError(
                        f"{source} has {source.stat().st_size} bytes and unpacks to more than "
                        f"{most}; it is damaged, made to fill the disk, or {target.parent} is full"
                    )
        except (zstd.ZstdError, EOFError) as error:
            raise FileFormatError(f"{source} is damaged ({one_line(error)})") from error


def _check_file(path: Path, extra: str) -> None:
    if begins_with(path, MCAP_MAGIC):
        _check_mcap(path, extra)
    elif begins_with(path, SQLITE_MAGIC):
        _check_tables(path)


def _check_mcap(path: Path, extra: str) -> None:
    """Refuse other profiles than ROS 2, and bound the chunks that rosbags unpacks."""
    with path.open("rb") as file:
        # Magic, kind and length of the header, length of the profile.
        file.seek(8 + 1 + 8)
        profile = file.read(min(int.from_bytes(file.read(4), "little"), 16))
    if profile == b"ros1":
        raise FileFormatError(f"{path} holds ROS 1 messages, which texvent reads from .bag only")
    # rosbags has no place for this in a reader.
    storage = require("rosbags.rosbag2.storage_mcap", extra=extra)
    storage.DECOMPRESSORS.update(
        lz4=lambda data, _: unpack_lz4(data), zstd=lambda data, _: unpack_zstd(data)
    )


def check_total(bag: Any) -> None:
    """Refuse an open bag of MCAP files whose chunks, which may all be open at once, are too large.

    Raises:
        FileFormatError: those of a file unpack to more than 100 times its size.
    """
    for storage in getattr(bag.storage, "storages", [bag.storage]):
        total = sum(chunk.uncompressed_size for chunk in getattr(storage, "chunks", ()))
        check_proportion(total, storage.path)


def _check_tables(path: Path) -> None:
    """Refuse a database whose values are computed, not stored.

    Raises:
        FileFormatError: it has a view, a virtual table or a generated column.
    """
    address = f"{path.absolute().as_uri()}?mode=ro&immutable=1"
    try:
        with closing(sqlite3.connect(address, uri=True)) as database:
            computed = database.execute(
                "SELECT name FROM pragma_table_list WHERE type IN ('view', 'virtual') UNION ALL "
                "SELECT l.name FROM pragma_table_list l, pragma_table_xinfo(l.name) x "
                "WHERE x.hidden > 1"
            ).fetchone()
    except sqlite3.Error as error:
        raise FileFormatError(f"{path} is damaged or not a bag ({one_line(error)})") from error
    if computed:
        raise FileFormatError(f"{path} computes the values of {shown(computed[0])}; no bag does")
