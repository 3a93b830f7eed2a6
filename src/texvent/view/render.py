"""An event file → film, picture, page or rerun recording, with or without its video."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

from texvent._registry import load_object
from texvent.errors import ConfigError, InputError
from texvent.events import EventPackets, EventStream
from texvent.io.atomic import atomic_file, check_output
from texvent.video import MICROSECONDS, FrameStream
from texvent.view.canvas import png_bytes
from texvent.view.film.encode import FILM_EXTENSIONS
from texvent.view.film.film import FilmWriter, title_of
from texvent.view.film.interval import Interval
from texvent.view.film.source_overlay import Companion
from texvent.view.images.contact_sheet import draw_sheet
from texvent.view.images.still import StillPicker
from texvent.view.page.page import PageWriter
from texvent.view.render_config import RenderConfig
from texvent.view.windows import (
    cut_counts,
    cut_fading,
    cut_windows,
    still_window_us,
    time_range,
)

__all__ = ["RENDER_EXTENSIONS", "RenderConfig", "render_events"]

RENDER_EXTENSIONS = (*FILM_EXTENSIONS, ".png", ".html", ".rrd")
# By name: rerun is an extra.
RERUN_EXPORT = "texvent.view.rerun_export:write_rrd"


def render_events(
    events: EventStream | EventPackets,
    path: str | Path,
    *,
    config: RenderConfig | None = None,
    frames: FrameStream | None = None,
    overwrite: bool = False,
) -> Path:
    """Show events as a film (.mp4, .gif), a picture (.png), a page (.html) or for rerun (.rrd).

    Args:
        events: a recording, whole or packet by packet; pictures read packets twice.
        path: what to write; the extension decides.
        config: how to show them.
        frames: the video beside them, of the same size and clock.
        overwrite: whether an existing file may be replaced.

    Returns:
        The path written.

    Raises:
        ConfigError: unknown extension, or an overlay without ground truth.
        InputError: there is no event to show, or the video has another size.
        OutputError: the file exists already or cannot be written.
        MissingDependencyError: .rrd without the extra "rerun".
    """
    path, config = Path(path), config or RenderConfig()
    kind = path.suffix.lower()
    if kind not in RENDER_EXTENSIONS:
        raise ConfigError(
            f"cannot render to {path}; its name must end in {', '.join(RENDER_EXTENSIONS)}"
        )
    check_output(path, overwrite=overwrite)
    packets = events if isinstance(events, EventPackets) else _as_packets(events)
    beside = Companion(frames, config.overlay, size=packets.size)
    if kind == ".png":
        picture = _contact_sheet if config.panels > 1 else _still
        data = picture(packets, config, beside)
        with atomic_file(path, overwrite=overwrite) as part:
            part.write_bytes(data)
    elif kind == ".html":
        _page(packets, path, config, beside, overwrite=overwrite)
    elif kind == ".rrd":
        load_object(RERUN_EXPORT)(packets, path, config, frames=frames, overwrite=overwrite)
    else:
        _film(packets, path, config, beside, overwrite=overwrite)
    return path


def _as_packets(events: EventStream) -> EventPackets:
    return EventPackets((events,), events.size, events.metadata)


def _no_events() -> InputError:
    return InputError("the recording, or the part asked for, holds no events to show")


def _cut(
    packets: EventPackets, config: RenderConfig, step_us: Fraction, window_us: int
) -> Iterator[Interval]:
    """Intervals as the config gathers events: by count, fading, or by time (the default)."""
    size = packets.size
    if config.events_per_picture is not None:
        return cut_counts(packets, size=size, count=config.events_per_picture)
    if config.tau_us is not None:
        return cut_fading(packets, size=size, step_us=step_us, tau_us=config.tau_us)
    return cut_windows(packets, size=size, step_us=step_us, window_us=window_us)


def _film(
    packets: EventPackets, path: Path, config: RenderConfig, beside: Companion, *, overwrite: bool
) -> None:
    step_us = config.step_us
    intervals = _cut(packets, config, step_us, config.window_us or max(1, round(step_us)))
    film = FilmWriter(
        path,
        size=packets.size,
        fps=config.render_fps,
        palette=config.palette,
        side_by_side=beside.frames is not None,
        overwrite=overwrite,
        title=title_of(packets.metadata),
    )
    shown = 0
    with film:
        for interval in beside.add_pictures(intervals):
            start_us = round(shown * MICROSECONDS / config.render_fps)
            film.show(beside.add_marks(interval), film_start_us=start_us)
            shown += 1
        if shown == 0:
            raise _no_events()


def _still(packets: EventPackets, config: RenderConfig, beside: Companion) -> bytes:
    extent = time_range(packets)
    if extent is None:
        raise _no_events()
    window_us = config.window_us or still_window_us(extent)
    picker = StillPicker(
        size=packets.size,
        palette=config.palette,
        side_by_side=beside.frames is not None,
        title=title_of(packets.metadata),
    )
    intervals = _cut(packets, config, Fraction(window_us), window_us)
    best: Interval | None = None
    for interval in beside.add_pictures(intervals):
        # Slices of equal count are equally lively by number; the shortest is the liveliest.
        if best is None or _liveliness(interval, config) > _liveliness(best, config):
            best = interval
    if best is None:
        raise _no_events()
    return picker.draw(beside.add_marks(best))


def _liveliness(interval: Interval, config: RenderConfig) -> tuple[int, int]:
    if config.events_per_picture is None:
        return interval.event_count, 0
    return interval.event_count, interval.start_us - interval.stop_us


def _contact_sheet(packets: EventPackets, config: RenderConfig, beside: Companion) -> bytes:
    """Moments evenly spaced over the recording, in reading order."""
    extent = time_range(packets)
    if extent is None:
        raise _no_events()
    step_us = Fraction(extent[1] - extent[0], config.panels)
    window_us = config.window_us or min(still_window_us(extent) * 2, max(1, int(step_us)))
    intervals = _evenly_spaced(
        beside.add_pictures(_cut(packets, config, step_us, window_us)), config, extent[0], step_us
    )
    marked = (beside.add_marks(interval) for interval in intervals)
    return png_bytes(
        draw_sheet(
            marked,
            config.panels,
            size=packets.size,
            palette=config.palette,
            side_by_side=beside.frames is not None,
        )
    )


def _evenly_spaced(
    intervals: Iterator[Interval], config: RenderConfig, first_us: int, step_us: Fraction
) -> Iterator[Interval]:
    """One interval per panel: of slices of equal count, the first that reaches its moment."""
    given = 0
    for interval in intervals:
        if given == config.panels:
            return
        due_us = first_us + round(given * step_us)
        if config.events_per_picture is None or interval.stop_us > due_us:
            given += 1
            yield interval


def _page(
    packets: EventPackets, path: Path, config: RenderConfig, beside: Companion, *, overwrite: bool
) -> None:
    extent = time_range(packets)
    still = _still(packets, config, beside) if extent is not None else None
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
        for frame in beside.frames_during(extent):
            page.append_frame(frame)
        page.still = still
