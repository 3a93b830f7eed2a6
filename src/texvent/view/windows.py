"""Windows of events: cut by time or by count, with their source frame and ground truth."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.frames import MICROSECONDS, Frame, FrameStream, RenderableStream, frame_time_us
from texvent.represent.event_frame import count_events
from texvent.represent.slices import slice_windows
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import Image
from texvent.view.drawing.event_image import draw_events, frame_image
from texvent.view.drawing.panels import (
    Annotations,
    GroundTruthStream,
    Overlay,
    PanelLayout,
    annotations_at,
)
from texvent.view.sample import STRIP_FRAMES

MOST_DRAWN = 2 * STRIP_FRAMES
"""Frames of a scene that are drawn for a page."""


@dataclass(frozen=True, eq=False)
class EventWindow:
    """The events of `[start_us, stop_us)` and the frame that the video shows during it."""

    start_us: int
    stop_us: int
    counts: NDArray[np.int32]
    """OFF and ON events per pixel, [2, H, W]."""
    image: Image | None = None
    """The frame at `start_us`, [H, W, 3] RGB, or None if there are only events."""
    annotations: Annotations | None = None
    """Boxes and arrows drawn over the panels."""
    events: EventStream | None = None
    """The events themselves, of windows cut from a recording."""
    panel: Image | None = None
    """Picture in place of the events, [H, W, 3] RGB."""
    note: str = ""
    """End of the caption."""

    @property
    def event_count(self) -> int:
        """Number of events."""
        return int(self.counts.sum())

    @property
    def caption(self) -> str:
        """Time and number of events.

        Example:
            >>> EventWindow(1_500_000, 1_540_000, np.ones((2, 1, 3), dtype=np.int32)).caption
            '1.500 s  6 events in 40.0 ms'
        """
        length_ms = (self.stop_us - self.start_us) / 1000
        return (
            f"{self.start_us / MICROSECONDS:.3f} s  "
            f"{self.event_count:,} events in {length_ms:.1f} ms{self.note}"
        )


class WindowCollector:
    """Gathers the packets of a dense stream into one window per source frame.

    Memory holds one source frame and the events since.
    """

    def __init__(self, size: SensorSize) -> None:
        self._size = size
        self._image: Image | None = None
        self._start_us: int | None = None
        self._packets: list[EventStream] = []

    def append(self, frame: Frame, packet: EventStream) -> EventWindow | None:
        """Add the events before `frame`.

        Args:
            frame: a source or intermediate frame.
            packet: events in `[time of the frame before, frame.t_us)`.

        Returns:
            The window that ends at `frame`, if it is a source frame and not the first.
        """
        if len(packet):
            self._packets.append(packet)
        if not frame.is_source:
            return None
        ended = None
        if self._start_us is not None:
            counts = count_events(
                EventStream.concat([EventStream.empty(self._size), *self._packets])
            )
            ended = EventWindow(self._start_us, frame.t_us, counts, self._image)
        self._start_us, self._image = frame.t_us, frame_image(frame)
        self._packets = []
        return ended

    def single_frame(self) -> EventWindow | None:
        """The last source frame, without events: for an input of one frame."""
        if self._start_us is None:
            return None
        counts = np.zeros((2, *self._size.shape), dtype=np.int32)
        return EventWindow(self._start_us, self._start_us + 1, counts, self._image)


BUSIEST_WINDOWS = 50
"""A recording is cut into this many windows to find the busiest one ..."""
MOST_EMPTY = 18_000
"""Windows without an event, one after another, that are shown: ten minutes of a video."""
LONGEST_STILL_US = 40_000
"""... but none is longer than this, so that moving edges stay sharp."""


def cut_windows(
    packets: Iterable[EventStream], *, step_us: Fraction, window_us: int | None
) -> Iterator[EventWindow]:
    """Windows `[s, s + window_us)` for s = first event, + step, + 2 steps, ...

    Memory holds the events of one window and one packet. Step times are rounded to whole µs,
    never accumulated.

    Args:
        packets: events in time order.
        step_us: from one window's start to the next, µs; may be shorter than the window
            (windows overlap) or a fraction.
        window_us: length of each window, µs; None: up to the next, so that each event is in one.

    Raises:
        ConfigError: step or window is not above 0.
        InputError: a pause would be more than `MOST_EMPTY` windows.
    """
    if step_us <= 0 or (window_us is not None and window_us <= 0):
        raise ConfigError(
            f"window {window_us} µs, step {float(step_us):g} µs; both must be above 0"
        )
    checked = _refuse_pauses(packets, step_us)
    for start_us, stop_us, part in slice_windows(checked, step_us=step_us, window_us=window_us):
        yield EventWindow(start_us, stop_us, count_events(part), events=part)


def _refuse_pauses(packets: Iterable[EventStream], step_us: Fraction) -> Iterator[EventStream]:
    """The packets, up to a pause of hours of empty images, such as a clock that was set.

    Raises:
        InputError: there is such a pause.
    """
    last_us: int | None = None
    for packet in packets:
        if not len(packet):
            continue
        times = packet.t if last_us is None else np.concatenate([[last_us], packet.t])
        last_us = int(packet.t[-1])
        pauses = np.diff(times)
        if len(pauses) and pauses.max() > MOST_EMPTY * step_us:
            at = int(pauses.argmax())
            begin, end = (times[at : at + 2] / MICROSECONDS).tolist()
            images = int(pauses[at] // step_us)
            raise InputError(
                f"no event from {begin:g} to {end:g} s: {images:,} images would be empty; show a "
                "part (--time START,STOP), or speed the video up (--speed)"
            )
        yield packet


def cut_counts(
    packets: Iterable[EventStream], *, size: SensorSize, count: int
) -> Iterator[EventWindow]:
    """Windows of `count` events each, however long they take; the last may have fewer.

    Args:
        packets: events in time order.
        size: sensor size, pixels.
        count: events per window.
    """
    held = EventStream.empty(size)
    for packet in packets:
        held = EventStream.concat([held, packet])
        # A window lasts until the event after it, so one more must be known.
        while len(held) > count:
            part, held = held[:count], held[count:]
            stop_us = max(int(held.t[0]), int(part.t[0]) + 1)
            yield EventWindow(int(part.t[0]), stop_us, count_events(part), events=part)
    if len(held):
        yield EventWindow(int(held.t[0]), int(held.t[-1]) + 1, count_events(held), events=held)


def still_window_us(extent: tuple[int, int]) -> int:
    """A window short enough that moving edges stay sharp, µs."""
    return max(1, min(LONGEST_STILL_US, (extent[1] - extent[0]) // BUSIEST_WINDOWS))


def compose_window(
    window: EventWindow,
    layout: PanelLayout,
    *,
    title: str,
    facts: str,
    ceiling: float | None = None,
) -> Image:
    """Frame, events and caption of a window, with its annotations on both panels."""
    panel = window.panel
    if panel is None:
        panel = draw_events(window.counts, layout.palette, ceiling=ceiling)
    return layout.compose(
        window.image,
        panel,
        title=title,
        facts=facts,
        annotations=window.annotations,
    )


@runtime_checkable
class DrawnFrames(RenderableStream, Protocol):
    """Frames at `frame_time_us` of their rate, each drawn by itself: a rendered scene."""

    def from_frame(self, first: int) -> Iterator[Frame]:
        """The frames from number `first` on."""
        ...


def _last_frame(video: DrawnFrames, t_us: int) -> int:
    """Number of the last frame that is not after `t_us`, else of the first."""
    fps, last = video.fps or Fraction(1), (video.frame_count or 1) - 1
    number = min(max(0, int((t_us + 1) * fps / MICROSECONDS)), last)
    return number - 1 if number and frame_time_us(number, fps) > t_us else number


def _shown(video: DrawnFrames, extent: tuple[int, int] | None) -> range:
    """Numbers of the frames that a page is given of a scene: all of its part, or every n-th."""
    first, last = 0, (video.frame_count or 1) - 1
    if extent is not None:
        first, last = (_last_frame(video, t_us) for t_us in (extent[0], extent[1] - 1))
    return range(first, last + 1, (last - first) // MOST_DRAWN + 1)


def _draw(video: DrawnFrames, number: int) -> Frame:
    return replace(video.at(frame_time_us(number, video.fps or Fraction(1))), is_source=True)


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
        if isinstance(self.frames, DrawnFrames):
            # Only what is shown is drawn: the file that says the rate may come from anybody.
            number, drawn = -1, None
            for window in windows:
                if number != (number := _last_frame(self.frames, window.start_us)):
                    drawn = frame_image(_draw(self.frames, number))
                yield replace(window, image=drawn)
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
        if isinstance(self.frames, DrawnFrames):
            yield from (_draw(self.frames, number) for number in _shown(self.frames, extent))
            return
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
