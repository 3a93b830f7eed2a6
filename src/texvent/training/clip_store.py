"""Store of decoded clips: in memory, then on disk, both bounded, so that each is decoded once."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections import OrderedDict
from collections.abc import Sequence
from multiprocessing.util import Finalize
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import one_line, warn
from texvent.training.sources import Clip, ClipSource


class ClipStore:
    """Clips of a source by number; the folder on disk goes with the process."""

    def __init__(self, source: ClipSource, truth: Sequence[str], memory: int, disk: int) -> None:
        """An empty store.

        Args:
            source: of the clips.
            truth: that they bring.
            memory: bytes in memory.
            disk: bytes on disk.
        """
        self._source, self._truth = source, truth
        self._memory, self._disk = memory, disk
        self._forget()

    def _forget(self) -> None:
        self._held: OrderedDict[int, Clip] = OrderedDict()
        self._files: OrderedDict[int, tuple[Path, int]] = OrderedDict()
        self._folder: Path | None = None
        self._process = os.getpid()

    def __getstate__(self) -> dict[str, Any]:
        """Without clips: another process has a folder of its own."""
        kept = ("_source", "_truth", "_memory", "_disk")
        return {name: vars(self)[name] for name in kept}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """An empty store."""
        vars(self).update(state)
        self._forget()

    @property
    def memory_bytes(self) -> int:
        """Bytes held in memory."""
        return sum(clip.nbytes for clip in self._held.values())

    @property
    def disk_bytes(self) -> int:
        """Bytes held on disk."""
        return sum(size for _, size in self._files.values())

    def get(self, index: int) -> Clip:
        """A clip; on disk it is mapped, and only what is cut from it is read.

        Raises:
            TexventError: its source cannot be read.
        """
        if self._process != os.getpid():  # forked
            self._forget()
        if index in self._held:
            self._held.move_to_end(index)
            return self._held[index]
        if index in self._files:
            self._files.move_to_end(index)
            return _read(self._files[index][0])
        clip = self._source.read(index, self._truth, self._memory // 2)
        self._held[index] = clip
        while self.memory_bytes > self._memory and len(self._held) > 1:
            self._put_away(*self._held.popitem(last=False))
        return clip

    def _put_away(self, index: int, clip: Clip) -> None:
        """Keep a clip on disk, in place of those that were used longest ago."""
        if clip.nbytes > self._disk:
            return
        while self.disk_bytes + clip.nbytes > self._disk:
            _, (old, _) = self._files.popitem(last=False)
            shutil.rmtree(old)
        arrays: dict[str, NDArray[Any]] = {"frames": clip.frames, "t": clip.times_us, **clip.truth}
        try:
            folder = self._home() / str(index)
            folder.mkdir(exist_ok=True)
            for name, array in arrays.items():
                np.save(folder / f"{name}.npy", array)
        except OSError as error:
            # What is there stays; what more there is will be decoded again.
            self._disk = self.disk_bytes
            warn(f"decoded clips are no longer kept on disk: {one_line(error)}")
            return
        self._files[index] = folder, clip.nbytes

    def _home(self) -> Path:
        if self._folder is None:
            self._folder = Path(tempfile.mkdtemp(prefix="texvent-clips-"))
            # Worker processes of multiprocessing run these finalizers, and no others.
            Finalize(self, _remove, (self._folder, os.getpid()), exitpriority=0)
        return self._folder


def _remove(folder: Path, process: int) -> None:
    if process == os.getpid():  # a forked child has a copy of the store, not the folder
        shutil.rmtree(folder, ignore_errors=True)


def _read(folder: Path) -> Clip:
    arrays = {file.stem: np.load(file, mmap_mode="r") for file in folder.iterdir()}
    return Clip(arrays.pop("frames"), np.asarray(arrays.pop("t")), arrays)
