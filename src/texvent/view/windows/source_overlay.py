"""The source video's frames, boxes and optical flow, added to windows of events."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from texvent.errors import ConfigError, InputError
from texvent.sensor import SensorSize
from texvent.video import Frame, FrameStream
from texvent.view.drawing.annotations import GroundTruthStream, Overlay, annotations_at
from texvent.view.drawing.canvas import Image
from texvent.view.drawing.event_image import frame_image
from texvent.view.windows.event_window import EventWindow


class SourceOverlay:
    """Frames of the source video and its ground truth, shown beside and over the events.

    Raises:
        InputError: the video has another size than the events.
        ConfigError: the video has no ground truth for the overlay.
    """

    def __init__(self, frames: FrameStream | None, overlay: Overlay, *, size: SensorSize) -> None:
        if frames is not None and frames.size != size:
            raise InputError(
                f"the video is {frames.size}, the events are {size}; give a video of the same size"
            )
        if overlay != "none" and not isinstance(frames, GroundTruthStream):
            raise ConfigError(
                f"overlay is {overlay!r}, but boxes and flow are only known where the embedded "
                "generator renders the scene again: show a file that `texvent generate` of this "
                "version wrote, or leave the overlay out"
            )
        self.frames = frames
        self._overlay: Overlay = overlay

    def add_frames(self, windows: Iterable[EventWindow]) -> Iterator[EventWindow]:
        """The windows, each with the last frame that is not after its start.

        Before the first frame it is the first, after the end the last. Frames are read once, as
        the windows come.
        """
        if self.frames is None:
            yield from windows
            return
        coming = iter(self.frames)
        shown = next(coming, None)
        following = next(coming, None)
        image = _image(shown)
        for window in windows:
            while following is not None and following.t_us <= window.start_us:
                shown, following = following, next(coming, None)
                image = None
            image = _image(shown) if image is None else image
            yield replace(window, image=image)

    def frames_during(self, extent: tuple[int, int] | None) -> Iterator[Frame]:
        """The frames shown from start to stop, µs; a video may be longer than the events.

        The first is the last frame that is not after the start. Without an extent, all frames.
        """
        earlier: Frame | None = None
        for frame in self.frames or ():
            if extent is not None and frame.t_us >= extent[1]:
                break
            if extent is not None and frame.t_us <= extent[0]:
                earlier = frame
                continue
            if earlier is not None:
                yield earlier
                earlier = None
            yield frame
        if earlier is not None:
            yield earlier

    def add_annotations(self, window: EventWindow) -> EventWindow:
        """The window with its boxes and arrows."""
        if self._overlay == "none" or not isinstance(self.frames, GroundTruthStream):
            return window
        return replace(
            window, annotations=annotations_at(self.frames, window.start_us, self._overlay)
        )


def _image(frame: Frame | None) -> Image | None:
    return None if frame is None else frame_image(frame)
