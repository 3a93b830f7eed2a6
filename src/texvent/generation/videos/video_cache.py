"""Generated videos on disk, by the content of what made them.

The key is a digest of everything that decides the pixels and nothing else, so that changing an
option of the simulator finds the video again, and changing the seed does not.
"""

from __future__ import annotations

import atexit
import contextlib
import dataclasses
import functools
import hashlib
import json
from collections.abc import Iterable, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent.errors import OutputError, TexventError, one_line, warn
from texvent.frames import PixelArray
from texvent.generation.videos.stored_video import EXTENSION, StoredVideo, reopen, write_video
from texvent.io.atomic import atomic_file
from texvent.options.values import plain
from texvent.runtime.files.cache_folder import CACHE_VARIABLE, cache_folder
from texvent.runtime.files.hidden_parts import temporary_folder
from texvent.runtime.work.side_work import begin_side_work, finish_side_work

LAYOUT = 1
"""Goes into every key; raised when the same request would be stored in another way."""


def kept_folder() -> Path:
    """The cache's folder of videos, made if need be.

    Raises:
        OutputError: it cannot be made.
    """
    folder = cache_folder("videos")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"cannot make the cache folder {folder}: {error.strerror}; set {CACHE_VARIABLE} to "
            "another folder"
        ) from error
    return folder


def content_key(facts: Mapping[str, Any]) -> str:
    """Digest of the facts that decide a result, whatever their order.

    Example:
        >>> content_key({"seed": 0, "steps": 2}) == content_key({"steps": 2, "seed": 0})
        True
    """
    text = json.dumps({"layout": LAYOUT, **plain(facts)}, sort_keys=True, ensure_ascii=False)
    return hashlib.sha256(text.encode("utf-8")).hexdigest()


class VideoCache:
    """Generated videos by content key. With `is_kept` False, videos last as long as the process."""

    def __init__(self, *, is_kept: bool) -> None:
        self._is_kept = is_kept

    def path(self, key: str, extension: str = EXTENSION) -> Path:
        """File of the video of that key, whether it exists or not."""
        folder = kept_folder() if self._is_kept else _scratch_folder()
        return folder / f"{key}{extension}"

    def has(self, key: str, extension: str = EXTENSION) -> bool:
        """Whether a video of that key is kept, byte for byte as it was made.

        Warns:
            TexventWarning: it has changed since.
        """
        path = self.path(key, extension)
        finish_side_work(path)
        if not (self._is_kept and path.is_file()):
            return False
        seal = _seal_of(path)
        is_whole = not seal.is_file() or seal.read_text(errors="replace") == _digest(path)
        if not is_whole:
            warn(f"{path} is damaged: it has changed since it was made, and is made again")
        return is_whole

    def find(self, key: str, fps: Fraction) -> StoredVideo | None:
        """The video of that `content_key`, or None."""
        found = reopen(self.path(key)) if self.has(key) else None
        return found and dataclasses.replace(found, fps=fps)

    def store(
        self, key: str, frames: Iterable[PixelArray], fps: Fraction, metadata: Mapping[str, Any]
    ) -> StoredVideo:
        """Write a video and seal it; see `stored_video.write_video`."""
        video = write_video(frames, self.path(key), fps, metadata, overwrite=True)
        self.seal(video.path)
        return video

    def store_beside(
        self, key: str, frames: Iterable[PixelArray], fps: Fraction, metadata: Mapping[str, Any]
    ) -> None:
        """Store a video in a thread of its own, for later runs; `has` and `find` wait for it.

        Nothing is written where videos are not kept. A failure is a warning, as the frames are
        there without the file.
        """
        if not self._is_kept:
            return
        path = self.path(key)

        def store() -> None:
            try:
                self.store(key, frames, fps, metadata)
            except (TexventError, OSError, ValueError, RuntimeError, MemoryError) as error:
                reason = str(error) if isinstance(error, TexventError) else one_line(error)
                warn(f"the video is not kept for later runs: {reason}")

        begin_side_work(path, store)

    def seal(self, path: Path) -> None:
        """Note the digest of a video of this cache, by which `has` finds damage."""
        with atomic_file(_seal_of(path), overwrite=True) as part:
            part.write_text(_digest(path))


def _seal_of(path: Path) -> Path:
    return path.with_name(f"{path.name}.sha256")


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@functools.cache
def _scratch_folder() -> Path:
    """A folder that is removed when the process ends."""
    ended = contextlib.ExitStack()
    atexit.register(ended.close)
    return ended.enter_context(temporary_folder())
