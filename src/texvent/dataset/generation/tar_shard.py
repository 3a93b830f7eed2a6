"""Shards as WebDataset tars whose bytes depend on their samples alone.

USTAR, no owner, mode 0444, time 0. `webdataset`, Hugging Face `datasets` and `tar` read them: the
members of a sample stand together and share the name before the first dot.
"""

from __future__ import annotations

import io
import tarfile
from collections.abc import Mapping
from pathlib import Path
from typing import BinaryIO

from texvent.errors import FileFormatError, one_line

EXTENSION = ".tar"
MODE = 0o444


class TarShardWriter:
    """Adds samples to a tar."""

    def __init__(self, file: BinaryIO) -> None:
        self._tar = tarfile.TarFile(fileobj=file, mode="w", format=tarfile.USTAR_FORMAT)

    def add(self, key: str, members: Mapping[str, bytes]) -> dict[str, tuple[int, int]]:
        """Write the members of a sample.

        Args:
            key: name before the first dot.
            members: extension → content.

        Returns:
            Extension → position of the content in the file, and bytes.
        """
        places = {}
        for extension, content in members.items():
            info = tarfile.TarInfo(f"{key}.{extension}")
            info.size, info.mode = len(content), MODE
            self._tar.addfile(info, io.BytesIO(content))
            begin = self._tar.offset - size_in_tar(len(content)) + tarfile.BLOCKSIZE
            places[extension] = (begin, len(content))
        return places

    def close(self) -> None:
        """Write the end of the tar."""
        self._tar.close()


def size_in_tar(size: int) -> int:
    """Bytes that a member takes: its header, and its content in whole blocks of 512 bytes."""
    return tarfile.BLOCKSIZE * (1 - (-size // tarfile.BLOCKSIZE))


def read_members(
    shard: Path, places: Mapping[str, tuple[int, int]], only: tuple[str, ...] | None = None
) -> dict[str, bytes]:
    """The members of one sample.

    Args:
        shard: the tar.
        places: as `TarShardWriter.add` returned them.
        only: extensions that are wanted; None: all.

    Raises:
        FileFormatError: the file is gone or shorter than it was.
    """
    try:
        with shard.open("rb") as file:
            members = {}
            for extension, (begin, size) in places.items():
                if only is None or extension in only:
                    file.seek(begin)
                    members[extension] = file.read(size)
    except OSError as error:
        raise FileFormatError(f"cannot read {shard}: {one_line(error)}") from error
    if any(len(members[name]) < places[name][1] for name in members):
        raise FileFormatError(f"{shard} is shorter than it was; run texvent dataset verify")
    return members
