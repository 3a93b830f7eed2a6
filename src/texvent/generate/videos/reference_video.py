"""The video that a model follows (`--reference-video`): its first frames, upright, at 8 bits."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
from av.error import FFmpegError
from av.video.frame import VideoFrame
from av.video.reformatter import ColorRange

from texvent.errors import FileFormatError, InputError, warn
from texvent.generate.videos.stored_video import reopen
from texvent.io.wrong_kind import refuse_missing
from texvent.transfer import Transfer
from texvent.video import PixelArray, transfer_of

LIGHT = {8: "linear light", 16: "PQ (HDR10)", 18: "HLG"}
"""libav's number of a transfer characteristic (ISO/IEC 23091-2) → what is no ordinary video."""
TEXT_ART = "tty"
"""libav "plays" text files as terminal art."""
QUARTER_TURN = 90
SLOWER = 0.01
"""Share by which two frame rates may differ without a word: 23.976 and 24 play alike."""


def read_reference(path: Path, frames: int) -> Iterator[PixelArray]:
    """The first frames of a video, [H, W, 3] uint8 RGB, one at a time.

    Args:
        path: any video file that PyAV reads.
        frames: how many.

    Raises:
        InputError: it is missing, too short, or no ordinary (gamma-coded) video.
        FileFormatError: it is no video, or damaged.
    """
    refuse_missing(path, "video")
    stored = reopen(path) if path.is_file() else None
    if stored is not None and transfer_of(stored) is Transfer.LINEAR:
        raise _refuse_light(path, LIGHT[8])
    count = 0
    try:
        with av.open(f"file:{path}", metadata_errors="replace") as container:
            if not container.streams.video or container.format.name == TEXT_ART:
                raise FileFormatError(f"the reference video {path} holds no video")
            stream = container.streams.video[0]
            stream.thread_type = "AUTO"
            for decoded in container.decode(stream):
                # PyAV 16 and older do not tell.
                if (coding := LIGHT.get(int(getattr(decoded, "color_trc", 0)))) is not None:
                    raise _refuse_light(path, coding)
                yield _upright(decoded)
                count += 1
                if count == frames:
                    return
    except (FFmpegError, OSError) as error:
        raise FileFormatError(
            f"the reference video {path} cannot be read ({error.strerror}); name a video file"
        ) from error
    fewer = f", or frames={count}" if count > 1 else ""
    raise InputError(
        f"the reference video {path} has {count} frames, and {frames} are to be made; give a "
        f"longer one{fewer}"
    )


def check_reference_file(path: Path, frames: int) -> None:
    """Refuse what `read_reference` could not read to the end."""
    for _ in read_reference(path, frames):
        pass


def warn_of_rate(path: Path, fps: Fraction) -> None:
    """Say that a reference plays at another rate than the video that follows it frame by frame.

    Args:
        path: of a file that `check_reference_file` passed.
        fps: of the video.

    Warns:
        TexventWarning: motion would be faster or slower.
    """
    with av.open(f"file:{path}", metadata_errors="replace") as container:
        rate = container.streams.video[0].average_rate
    if rate and abs(rate / fps - 1) > SLOWER:
        warn(
            f"{path} has {float(rate):g} frames per second, and its frames are taken as those of "
            f"{float(fps):g}, so motion changes its speed; give fps={float(rate):g} to keep it"
        )


def _upright(frame: VideoFrame) -> PixelArray:
    pixels = frame.reformat(format="rgb24", dst_color_range=ColorRange.JPEG).to_ndarray()
    turns = round(frame.rotation / QUARTER_TURN) % 4
    return np.ascontiguousarray(np.rot90(pixels, turns))


def _refuse_light(path: Path, coding: str) -> InputError:
    return InputError(
        f"the reference video {path} is {coding}; the model follows ordinary video, and this one "
        "needs no model: texvent simulate makes its events"
    )
