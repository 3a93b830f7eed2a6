"""An event file rendered as a video, image or page, with or without its source video."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import ClassVar, Literal

import numpy as np

from texvent.config import IdleOptions, check_choices, check_range
from texvent.errors import ConfigError, InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.frames import MICROSECONDS, FrameStream
from texvent.io.atomic import atomic_file, check_output
from texvent.represent.contrast_maximisation import find_flow, flow_warp_loss, warp_events
from texvent.represent.event_frame import count_events
from texvent.runtime.progress import NO_PROGRESS, Progress
from texvent.view.drawing.event_image import draw_events, draw_flow
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent.view.drawing.panels import Overlay, title_of
from texvent.view.page.writer import PageWriter
from texvent.view.sample import SAMPLE_EVENTS
from texvent.view.stills import BusiestWindow, find_busiest
from texvent.view.video_encoder import VIDEO_EXTENSIONS
from texvent.view.video_writer import VideoWriter
from texvent.view.windows import (
    EventWindow,
    SourceOverlay,
    cut_counts,
    cut_windows,
    still_window_us,
)


@dataclass(frozen=True, kw_only=True)
class RenderConfig:
    """Options of rendering."""

    idle_with: ClassVar[IdleOptions] = {
        **dict.fromkeys(("render_fps", "speed"), ("out", (".png", ".html"))),
        **dict.fromkeys(("window", "events_per_image"), ("out", (".html",))),
        "points": ("out", (".png", ".mp4", ".gif")),
        "patch": ("show", ("events",)),
    }

    render_fps: Fraction = Fraction(30)
    """Images per second of video."""
    window: float | None = None
    """Time that one image gathers, in ms of the recording. Without it, videos show every event
    once and images show at most 40 ms."""
    events_per_image: int | None = None
    """Fixed count instead of fixed time: every image gathers this many events, however long
    that takes; a video shows one such slice after the other."""
    speed: float = 1.0
    """Speed of the video: 0.1 is ten times slower than the recording."""
    palette: str = DEFAULT_PALETTE
    """Colours of ON and OFF events."""
    overlay: Overlay = "none"
    """Boxes with class names, optical flow (arrows as long as the motion in 50 ms), or both, for
    scenes that the embedded generator renders again."""
    show: Literal["events", "warped", "flow"] = "events"
    """Events, events warped along their motion, or this motion. Warped, they are where they were
    when the image began; the caption has the flow warp loss (FWL)."""
    patch: int = 32
    """Side of the squares whose motion is found, px; one as large as the sensor: one motion."""
    points: int = SAMPLE_EVENTS
    """Most events in the cloud of a page; more are drawn uniformly at random."""

    def __post_init__(self) -> None:
        get_palette(self.palette)
        check_range("speed", self.speed, 1e-6, 1e6)
        check_choices(self)
        check_range("patch", self.patch, 4, 65_535)
        check_range("points", self.points, 1, 20_000_000)
        if self.window is not None and self.events_per_image is not None:
            raise ConfigError("window and events_per_image exclude each other; give one of them")
        check_range("window", self.window, 0.001, 1e12)
        check_range("events_per_image", self.events_per_image, 1, 1e12)
        if not 0 < self.render_fps <= 1000:
            raise ConfigError(f"render_fps is {self.render_fps}; it must be above 0, at most 1000")

    @property
    def window_us(self) -> int | None:
        """The window in µs."""
        return None if self.window is None else max(1, round(self.window * 1000))

    @property
    def step_us(self) -> Fraction:
        """Time of the recording from one video frame to the next, µs, exact."""
        return Fraction(self.speed) * MICROSECONDS / self.render_fps


__all__ = ["RENDER_EXTENSIONS", "RenderConfig", "render_events"]

RENDER_EXTENSIONS = (*VIDEO_EXTENSIONS, ".png", ".html")


def render_events(
    events: EventStream | EventPackets,
    path: str | Path,
    *,
    config: RenderConfig | None = None,
    frames: FrameStream | None = None,
    overwrite: bool = False,
    progress: Progress = NO_PROGRESS,
) -> Path:
    """Show events as a video, an image or a page.

    Args:
        events: a recording, whole or packet by packet; images read packets twice.
        path: file to write; its extension decides: .mp4, .gif, .png or .html.
        config: how to show them.
        frames: the source video, of the same size and clock.
        overwrite: whether an existing file may be replaced.
        progress: receives events that are read, and images of a video.

    Returns:
        The path written.

    Raises:
        ConfigError: unknown extension, or an overlay without ground truth.
        InputError: there is no event to show, or the video has another size.
        OutputError: the file exists already or cannot be written.
    """
    path, config = Path(path), config or RenderConfig()
    kind = path.suffix.lower()
    if kind not in RENDER_EXTENSIONS:
        raise ConfigError(
            f"cannot render to {path}; its name must end in {', '.join(RENDER_EXTENSIONS)}"
        )
    if kind == ".html" and config.show != "events":
        raise ConfigError(
            f"show is {config.show}; a page shows events: render to .mp4, .gif or .png"
        )
    check_output(path, overwrite=overwrite)
    packets = events if isinstance(events, EventPackets) else _as_packets(events)
    packets = packets.reporting_to(progress)
    source = SourceOverlay(frames, config.overlay, size=packets.size)
    if kind == ".png":
        data = _still(packets, config, source)
        with atomic_file(path, overwrite=overwrite) as part:
            part.write_bytes(data)
    elif kind == ".html":
        _page(packets, path, config, source, overwrite=overwrite)
    else:
        _video(packets, path, config, source, overwrite=overwrite)
    return path


def _as_packets(events: EventStream) -> EventPackets:
    return EventPackets((events,), events.size, events.metadata)


def _no_events() -> InputError:
    return InputError("the recording, or the part asked for, holds no events to show")


def _video(
    packets: EventPackets,
    path: Path,
    config: RenderConfig,
    source: SourceOverlay,
    *,
    overwrite: bool,
) -> None:
    step_us = config.step_us
    if config.events_per_image is not None:
        windows = cut_counts(packets, size=packets.size, count=config.events_per_image)
    else:
        windows = cut_windows(packets, step_us=step_us, window_us=config.window_us)
    video = VideoWriter(
        path,
        size=packets.size,
        fps=config.render_fps,
        palette=config.palette,
        side_by_side=source.frames is not None,
        overwrite=overwrite,
        title=title_of(packets.metadata),
    )
    shown = 0
    with video:
        for window in source.add_frames(windows):
            start_us = round(shown * MICROSECONDS / config.render_fps)
            window = _with_motion(source.add_annotations(window), config)
            video.show(window, video_start_us=start_us)
            shown += 1
        if shown == 0:
            raise _no_events()


def _still(packets: EventPackets, config: RenderConfig, source: SourceOverlay) -> bytes:
    extent = packets.time_range
    if extent is None:
        raise _no_events()
    window_us = config.window_us or still_window_us(extent)
    still = BusiestWindow(
        size=packets.size,
        palette=config.palette,
        side_by_side=source.frames is not None,
        title=title_of(packets.metadata),
    )
    windows: Iterable[EventWindow]
    if config.events_per_image is not None:
        windows = cut_counts(packets, size=packets.size, count=config.events_per_image)
    else:
        found = find_busiest(packets, window_us)
        windows = () if found is None else (found,)
    best: EventWindow | None = None
    for window in source.add_frames(windows):
        # Windows of equal count differ in length: the shortest is the busiest.
        if best is None or _activity(window, config) > _activity(best, config):
            best = window
    if best is None:
        raise _no_events()
    return still.draw(_with_motion(source.add_annotations(best), config))


def _with_motion(window: EventWindow, config: RenderConfig) -> EventWindow:
    """The window with its motion, or its events warped along it, in place of the events."""
    if config.show == "events" or window.events is None:
        return window
    flow = find_flow(window.events, patch_px=config.patch)
    loss = flow_warp_loss(window.events, flow)
    note = "" if np.isnan(loss) else f", FWL {loss:.2f}"
    if config.show == "flow":
        return replace(window, panel=draw_flow(flow), note=note)
    counts = count_events(warp_events(window.events, flow))
    return replace(window, panel=draw_events(counts, get_palette(config.palette)), note=note)


def _activity(window: EventWindow, config: RenderConfig) -> tuple[int, int]:
    if config.events_per_image is None:
        return window.event_count, 0
    return window.event_count, window.start_us - window.stop_us


def _page(
    packets: EventPackets,
    path: Path,
    config: RenderConfig,
    source: SourceOverlay,
    *,
    overwrite: bool,
) -> None:
    extent = packets.time_range
    still = _still(packets, config, source) if extent is not None else None
    with PageWriter(
        path,
        size=packets.size,
        metadata=packets.metadata,
        palette=config.palette,
        overwrite=overwrite,
        sample_limit=config.points,
    ) as page:
        for packet in packets:
            page.append(packet)
        for frame in source.frames_during(extent):
            page.append_frame(frame)
        page.still = still
