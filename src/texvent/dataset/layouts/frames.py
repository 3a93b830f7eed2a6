"""Frames of a sample as a folder of images."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.video import FrameStream


def write_frames(frames: FrameStream, folder: Path) -> NDArray[np.int64]:
    """Write 000000.png and so on, 8-bit RGB, into a new folder.

    Returns:
        Their times, µs.
    """
    from texvent.view.drawing.canvas import png_bytes  # brings OpenCV
    from texvent.view.drawing.event_image import frame_image

    folder.mkdir(parents=True)
    times = []
    for index, frame in enumerate(frames):
        (folder / f"{index:06d}.png").write_bytes(png_bytes(frame_image(frame)))
        times.append(frame.t_us)
    return np.array(times, np.int64)
