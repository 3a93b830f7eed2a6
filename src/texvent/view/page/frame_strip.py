"""A few frames of a video, evenly spaced and small, for the page."""

from __future__ import annotations

from texvent.video import Frame
from texvent.view.drawing.canvas import jpeg_bytes, shrink
from texvent.view.drawing.event_image import frame_image

STRIP_FRAMES = 64
STRIP_WIDTH = 360
JPEG_QUALITY = 78


class FrameStrip:
    """At most `limit` frames of a video of any length: every one, else every second, fourth, ...

    Memory holds their JPEG files only.
    """

    def __init__(self, *, limit: int = STRIP_FRAMES) -> None:
        self._limit = limit
        self._stride = 1
        self.seen = 0
        """Source frames offered so far."""
        self.images: list[tuple[int, bytes]] = []
        """Time, µs, and JPEG file of the frames kept, in time order."""

    def append(self, frame: Frame) -> None:
        """Offer a frame; interpolated ones are left out."""
        if not frame.is_source:
            return
        index = self.seen
        self.seen += 1
        if index % self._stride:
            return
        if len(self.images) == self._limit:
            self.images = self.images[::2]
            self._stride *= 2
            if index % self._stride:
                return
        small = shrink(frame_image(frame), STRIP_WIDTH)
        self.images.append((frame.t_us, jpeg_bytes(small, quality=JPEG_QUALITY)))
