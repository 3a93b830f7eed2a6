"""Decoding of video files on a GPU, by NVDEC, where torchcodec is installed.

On a CPU it is no faster than PyAV, with the luma of its frames.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.brightness import LUMA_WEIGHTS
from texvent.capture.frame_source import ChangedFrames, known_times_us
from texvent.errors import one_line, warn
from texvent.frames import FrameStream, Video, transfer_of
from texvent.transfer import Transfer

CHUNK = 32
"""Frames that are decoded at a time."""
MOST_DIFFERENCE = 1.0
"""Mean difference of a frame from PyAV's, levels: more is another range, matrix, turn or depth.
NVDEC rounds colours otherwise; on a CPU there is none."""
LEAST_CONTRAST = 8.0
"""Standard deviation of the frame that is compared, levels: black ones are alike in all videos."""


@cache
def _decoder() -> Any:
    """Decoder of torchcodec; None where it is not installed, or does not load."""
    try:
        from torchcodec.decoders import VideoDecoder
    except ModuleNotFoundError:
        return None
    except (ImportError, OSError, RuntimeError) as error:
        warn(f"torchcodec is not used, because it does not load: {one_line(error)}")
        return None
    return VideoDecoder


def decode_video(
    path: str | Path, video: FrameStream, device: str, most_bytes: int
) -> Video | None:
    """The first frames of a video file as 8-bit luma, at PyAV's times.

    Args:
        path: of the file.
        video: its frames by PyAV, checked.
        device: a GPU, or cpu.
        most_bytes: of the frames that are wanted.

    Returns:
        None where torchcodec is not installed or fails, where it would be another video
        than PyAV's, and of what is no whole video file: PyAV then decodes, or says why it cannot.
    """
    from texvent.capture.video_file import VideoFile  # brings PyAV

    file, decoder, times_us = video, _decoder(), known_times_us(video)
    while isinstance(file, ChangedFrames):
        file = file.source
    if decoder is None or not isinstance(file, VideoFile) or not times_us or file.is_cut_off:
        return None
    if transfer_of(video) is Transfer.LINEAR:
        return None
    lumas = enumerate(frame.luma for frame in video)
    place, shown = next((one for one in lumas if one[1].std() > LEAST_CONTRAST), (0, None))
    if shown is None:
        return None
    try:
        decoded = decoder(str(path), device=device)
        most = max(2, most_bytes // shown.size)
        if len(decoded) != len(times_us) or place >= most:
            return None
        luma = np.empty((min(most, len(decoded)), *shown.shape), np.uint8)
        for at in range(0, len(luma), CHUNK):
            end = min(at + CHUNK, len(luma))
            luma[at:end] = _luma_of(decoded.get_frames_in_range(at, end).data)
    except (RuntimeError, ValueError, IndexError):
        return None
    # A rounded level is half a level from PyAV's at most.
    is_alike = np.abs(luma[place] - np.asarray(shown, np.float32)).mean() <= MOST_DIFFERENCE
    return Video(luma, times_us[: len(luma)]) if is_alike else None


def _luma_of(rgb: Any) -> NDArray[np.uint8]:
    """Rounded luma of [N, 3, H, W] bytes; the twin of `brightness.luma_bt601`."""
    torch = require("torch", extra="torch")
    red, green, blue = (one.float() for one in rgb.unbind(1))
    weights = np.asarray(LUMA_WEIGHTS, np.float32).tolist()
    luma = red * weights[0]
    luma += green * weights[1]
    luma += blue * weights[2]
    made: NDArray[np.uint8] = luma.round().to(torch.uint8).cpu().numpy()
    return made
