"""Generated videos on disk, by the content of what made them.

The key is a digest of everything that decides the pixels and nothing else, so that changing an
option of the simulator finds the video again, and changing the seed does not.
"""

from __future__ import annotations

import atexit
import dataclasses
import functools
import hashlib
import json
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent.errors import OutputError
from texvent.generate.videos.stored_video import EXTENSION, StoredVideo, write_video
from texvent.io.atomic import atomic_file
from texvent.options.values import plain
from texvent.runtime.cache_folder import CACHE_VARIABLE, cache_folder
from texvent.sensor import SensorSize
from texvent.video import PixelArray
from texvent.video_check.measurements import VideoMeasurer, measure_video

MEASURES = "measures"
"""Key of the numbers of `texvent.video_check` in a video's metadata."""
LAYOUT = 1
"""Goes into every key; raised when the same request would be stored in another way."""


def made_folder(kind: str) -> Path:
    """The cache's folder for one kind of result, made if need be.

    Args:
        kind: "videos".

    Raises:
        OutputError: it cannot be made.
    """
    folder = cache_folder(kind)
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
    """Generated videos by content key. With `is_kept` False, videos last as long as the process.

    A video is a file and a note beside it (`KEY.json`) that says its rate, size and origin. The
    note is written last, so a video without one is unfinished and does not count.
    """

    def __init__(self, *, is_kept: bool) -> None:
        self._is_kept = is_kept

    def find(self, key: str, fps: Fraction) -> StoredVideo | None:
        """The video of that key, or None.

        Args:
            key: see `content_key`.
            fps: rate it is played at.
        """
        if not self._is_kept:
            return None
        note_path = made_folder("videos") / f"{key}.json"
        try:
            note = json.loads(note_path.read_text(encoding="utf-8"))
            path = note_path.with_name(note["file"])
            size = SensorSize(int(note["width"]), int(note["height"]))
            found = StoredVideo(path, fps, size, int(note["frames"]), note["metadata"])
        except (OSError, ValueError, KeyError, TypeError):
            return None
        return found if path.is_file() and path.stat().st_size == note["bytes"] else None

    def store(
        self, key: str, frames: Iterable[PixelArray], fps: Fraction, metadata: Mapping[str, Any]
    ) -> StoredVideo:
        """Write a video and its note; see `stored_video.write_video`.

        The measures of `texvent.video_check` are taken while the frames pass by and are noted too.
        """
        measurer = VideoMeasurer()
        path = self._path(key, EXTENSION)
        video = write_video(
            frames, path, fps, metadata, overwrite=True, on_frame=measurer.add
        ).with_metadata(**{MEASURES: measurer.measurements()})
        self._note(video)
        return video

    def adopt(self, key: str, video: StoredVideo) -> StoredVideo:
        """Copy the file of a video that another program wrote, byte by byte, and note it."""
        path = self._path(key, video.path.suffix)
        with atomic_file(path, overwrite=True) as part:
            part.write_bytes(video.path.read_bytes())
        kept = dataclasses.replace(video, path=path)
        kept = kept.with_metadata(**{MEASURES: measure_video(kept)})
        self._note(kept)
        return kept

    def _path(self, key: str, extension: str) -> Path:
        folder = made_folder("videos") if self._is_kept else _scratch_folder()
        return folder / f"{key}{extension}"

    def _note(self, video: StoredVideo) -> None:
        note = {
            "file": video.path.name,
            "bytes": video.path.stat().st_size,
            "frames": video.frame_count,
            "width": video.size.width,
            "height": video.size.height,
            "metadata": dict(video.metadata),
        }
        if self._is_kept:
            text = json.dumps(note, ensure_ascii=False, indent=1)
            with atomic_file(video.path.with_suffix(".json"), overwrite=True) as part:
                part.write_text(text, encoding="utf-8")


@functools.cache
def _scratch_folder() -> Path:
    """A folder that is removed when the process ends."""
    folder = tempfile.mkdtemp(prefix="texvent-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return Path(folder)
