"""Parts of shards, read at their offsets by any number of threads and processes."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import lru_cache
from pathlib import Path

from texvent.errors import FileFormatError, one_line
from texvent.io.positioned import FLAGS, read_at

MAX_OPEN = 64
"""Shards kept open per process; the one unused for longest is closed."""


class ShardFiles:
    """The shards of a data set, opened when they are first read.

    Reads name their offset, so forked processes and threads share the open files. A pickled copy
    opens its own.
    """

    def __init__(self, folder: Path, paths: Sequence[str]) -> None:
        """Nothing is opened yet.

        Args:
            folder: of the data set.
            paths: of its shards, relative to the folder.
        """
        self._folder, self._paths = folder, tuple(paths)
        # No lock of ours: a process forked while a thread holds one would wait for ever. Two
        # threads may open a file twice, and a file closed here stays open for who reads it.
        self._file = lru_cache(MAX_OPEN)(_OpenFile)

    def __reduce__(self) -> tuple[type[ShardFiles], tuple[Path, tuple[str, ...]]]:
        return ShardFiles, (self._folder, self._paths)

    def path(self, shard: int) -> Path:
        """Path of a shard."""
        return self._folder / self._paths[shard]

    def read(self, shard: int, begin: int, size: int) -> bytes:
        """`size` bytes of a shard from `begin` on.

        Raises:
            FileFormatError: the file is gone, or shorter than its record says.
        """
        try:
            file = self._file(self.path(shard))
            content = read_at(file.descriptor, size, begin)
            while 0 < len(content) < size:  # a read is at most 2 GiB, or interrupted
                more = read_at(file.descriptor, size - len(content), begin + len(content))
                if not more:
                    break
                content += more
        except OSError as error:
            raise FileFormatError(f"cannot read {self.path(shard)}: {one_line(error)}") from error
        if len(content) < size:
            raise FileFormatError(
                f"{self.path(shard)} is shorter than its record says; run texvent dataset verify"
            )
        return content


class _OpenFile:
    """A descriptor that is closed when nothing reads it any more."""

    def __init__(self, path: Path) -> None:
        self.descriptor = os.open(path, os.O_RDONLY | FLAGS)

    # A default value: at the end of the process, modules go before objects do.
    def __del__(self, close: Callable[[int], None] = os.close) -> None:
        if hasattr(self, "descriptor"):
            close(self.descriptor)
