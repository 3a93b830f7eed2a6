"""A few instants of a scene side by side, rendered at once: a look before a run."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from texvent.video import RenderableStream
from texvent.view.drawing.canvas import png_bytes
from texvent.view.drawing.event_image import frame_image

GAP_PX = 4


def draw_stills(video: RenderableStream, times_us: Sequence[int]) -> bytes:
    """The frames at some instants in a row, as a PNG file in memory.

    Args:
        video: one that can be rendered at any instant.
        times_us: the instants, µs, at least one.
    """
    size = video.size
    width = len(times_us) * (size.width + GAP_PX) - GAP_PX
    row = np.full((size.height, width, 3), 255, np.uint8)
    for number, t_us in enumerate(times_us):
        left = number * (size.width + GAP_PX)
        row[:, left : left + size.width] = frame_image(video.at(t_us))
    return png_bytes(row)
