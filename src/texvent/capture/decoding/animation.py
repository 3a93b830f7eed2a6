"""Animated images: APNG, which libav reads, and WebP, which OpenCV does."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from texvent.capture.array_frames import ArrayFrames
from texvent.capture.frame_times import FrameTimes, check_increasing
from texvent.errors import FileFormatError, InputError
from texvent.runtime.image_files import HEAD_BYTES
from texvent.runtime.memory import usable_bytes


def read_head(path: Path) -> bytes:
    """The bytes by which a file is known as an animation."""
    with path.open("rb") as file:
        return file.read(HEAD_BYTES)


def open_webp(path: Path, times: FrameTimes | None) -> ArrayFrames:
    """All frames of an animated WebP, at the times that its durations give.

    Raises:
        FileFormatError: it is damaged, or claims more than memory has room for.
        InputError: OpenCV is older than 4.11; or a frame lasts 0 ms and no times are given.
    """
    import cv2

    head = read_head(path)
    width, height = (1 + int.from_bytes(head[place : place + 3], "little") for place in (24, 27))
    if not hasattr(cv2, "imreadanimation"):
        raise InputError(f"{path} is an animated WebP, which OpenCV 4.11 and newer read; update it")
    count = cv2.imcount(str(path))
    if 4 * width * height * count > usable_bytes() // 2:
        raise FileFormatError(
            f"{path} claims {count} frames of {width}x{height}, which memory has no room for; "
            "convert it to a video"
        )
    is_read, animation = cv2.imreadanimation(str(path))
    if not is_read or len(animation.frames) != count:
        raise FileFormatError(f"{path} is an animated WebP that is damaged; repair it")
    ends_us = np.cumsum(np.asarray(animation.durations, np.int64)) * 1000
    starts_us = [0, *ends_us[:-1].tolist()]
    if times is None:
        check_increasing(starts_us, path.name, "; give their rate (`fps`)")
        times = FrameTimes(listed_us=starts_us, origin=path.name)
    frames = [np.ascontiguousarray(frame[..., 2::-1]) for frame in animation.frames]
    return ArrayFrames(frames, times, metadata={"source": str(path), "kind": "animated WebP"})
