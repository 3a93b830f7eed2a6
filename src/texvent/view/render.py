"""An event file → film, picture or page, without its video."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from texvent.config import check_range
from texvent.errors import ConfigError, InputError
from texvent.events import EventPackets, EventStream
from texvent.io.atomic import atomic_file, check_output
from texvent.sensor import SensorSize
from texvent.video import MICROSECONDS
from texvent.view.canvas import Picture, blank, png_bytes
from texvent.view.encode import FILM_EXTENSIONS
from texvent.view.film import FilmWriter, interval_facts, title_of
from texvent.view.interval import Interval
from texvent.view.layout import PLEASANT_WIDTH, SURROUND, Layout
from texvent.view.page import PageWriter
from texvent.view.palettes import DEFAULT_PALETTE, get_palette
from texvent.view.picture import draw_events
from texvent.view.still import StillPicker
from texvent.view.windows import cut_windows, still_window_us, time_range

RENDER_EXTENSIONS = (*FILM_EXTENSIONS, ".png", ".html")


@dataclass(frozen=True, kw_only=True)
class RenderConfig:
    """How events are made visible."""

    render_fps: Fraction = Fraction(30)
    """Pictures per second of film."""
    window: float | None = None
    """Time that one picture gathers, in ms of the recording. Without it, films show every event
    once and pictures show at most 40 ms."""
    speed: float = 1.0
    """Speed of the film: 0.1 is ten times slower than the recording."""
    palette: str = DEFAULT_PALETTE
    """Colours of ON and OFF events."""
    panels: int = 1
    """Pictures on a PNG: 1 shows the liveliest moment, more show moments evenly spaced."""

    def __post_init__(self) -> None:
        get_palette(self.palette)
        check_range("speed", self.speed, 1e-6, 1e6)
        check_range("panels", self.panels, 1, 100)
        if self.window is not None:
            check_range("window", self.window, 0.001)
        if not 0 < self.render_fps <= 1000:
            raise ConfigError(f"render_fps is {self.render_fps}; it must be above 0, at most 1000")

    @property
    def window_us(self) -> int | None:
        """The window in µs."""
        return None if self.window is None else max(1, round(self.window * 1000))

    @property
    def step_us(self) -> Fraction:
        """Time of the recording from one film frame to the next, µs, exact."""
        return Fraction(self.speed) * MICROSECONDS / self.render_fps


def render_events(
    events: EventStream | EventPackets,
    path: str | Path,
    *,
    config: RenderConfig | None = None,
    overwrite: bool = False,
) -> Path:
    """Show events as a film (.mp4, .gif), a picture (.png) or a page (.html).

    Args:
        events: a recording, whole or packet by packet; pictures read packets twice.
        path: what to write; the extension decides.
        config: how to show them.
        overwrite: whether an existing file may be replaced.

    Returns:
        The path written.

    Raises:
        ConfigError: unknown extension.
        InputError: there is no event to show.
        OutputError: the file exists already or cannot be written.
    """
    path, config = Path(path), config or RenderConfig()
    kind = path.suffix.lower()
    if kind not in RENDER_EXTENSIONS:
        raise ConfigError(
            f"cannot render to {path}; its name must end in {', '.join(RENDER_EXTENSIONS)}"
        )
    check_output(path, overwrite=overwrite)
    packets = events if isinstance(events, EventPackets) else _as_packets(events)
    if kind == ".png":
        picture = _contact_sheet if config.panels > 1 else _still
        data = picture(packets, config)
        with atomic_file(path, overwrite=overwrite) as part:
            part.write_bytes(data)
    elif kind == ".html":
        _page(packets, path, config, overwrite=overwrite)
    else:
        _film(packets, path, config, overwrite=overwrite)
    return path


def _as_packets(events: EventStream) -> EventPackets:
    return EventPackets((events,), events.size, events.metadata)


def _no_events() -> InputError:
    return InputError("the recording holds no events, so there is nothing to show")


def _film(packets: EventPackets, path: Path, config: RenderConfig, *, overwrite: bool) -> None:
    step_us = config.step_us
    window_us = config.window_us or max(1, round(step_us))
    film = FilmWriter(
        path,
        size=packets.size,
        fps=config.render_fps,
        palette=config.palette,
        side_by_side=False,
        overwrite=overwrite,
        title=title_of(packets.metadata),
    )
    shown = 0
    with film:
        for interval in cut_windows(
            packets, size=packets.size, step_us=step_us, window_us=window_us
        ):
            start_us = round(shown * MICROSECONDS / config.render_fps)
            film.show(interval, film_start_us=start_us)
            shown += 1
        if shown == 0:
            raise _no_events()


def _still(packets: EventPackets, config: RenderConfig) -> bytes:
    extent = time_range(packets)
    if extent is None:
        raise _no_events()
    window_us = config.window_us or still_window_us(extent)
    picker = StillPicker(
        size=packets.size,
        palette=config.palette,
        side_by_side=False,
        title=title_of(packets.metadata),
    )
    for interval in cut_windows(
        packets, size=packets.size, step_us=Fraction(window_us), window_us=window_us
    ):
        picker.consider(interval)
    data = picker.png()
    if data is None:
        raise _no_events()
    return data


def _contact_sheet(packets: EventPackets, config: RenderConfig) -> bytes:
    """Moments evenly spaced over the recording, in reading order."""
    extent = time_range(packets)
    if extent is None:
        raise _no_events()
    step_us = Fraction(extent[1] - extent[0], config.panels)
    window_us = config.window_us or min(still_window_us(extent) * 2, max(1, int(step_us)))
    palette = get_palette(config.palette)
    columns = _columns(config.panels, packets.size)
    layout = Layout(
        packets.size,
        palette,
        side_by_side=False,
        pleasant_width=max(360.0, PLEASANT_WIDTH / columns),
    )
    panels = [
        _panel(interval, layout)
        for interval in _first(
            config.panels,
            cut_windows(packets, size=packets.size, step_us=step_us, window_us=window_us),
        )
    ]
    return png_bytes(_grid(panels, columns))


def _columns(panels: int, size: SensorSize) -> int:
    """As many columns as make the sheet about 3:2."""
    return max(1, min(panels, round(math.sqrt(panels * 1.5 * size.height / size.width))))


def _first(count: int, intervals: Iterable[Interval]) -> Iterable[Interval]:
    for _, interval in zip(range(count), intervals, strict=False):
        yield interval


def _panel(interval: Interval, layout: Layout) -> Picture:
    events = draw_events(interval.counts, layout.palette)
    return layout.compose(None, events, title=interval_facts(interval), facts="")


def _grid(panels: list[Picture], columns: int) -> Picture:
    gap = 4
    height, width = panels[0].shape[:2]
    rows = -(-len(panels) // columns)
    sheet = blank(columns * (width + gap) - gap, rows * (height + gap) - gap, SURROUND)
    for index, panel in enumerate(panels):
        top, left = (index // columns) * (height + gap), (index % columns) * (width + gap)
        sheet[top : top + height, left : left + width] = panel
    return sheet


def _page(packets: EventPackets, path: Path, config: RenderConfig, *, overwrite: bool) -> None:
    still = _still(packets, config) if time_range(packets) is not None else None
    with PageWriter(
        path,
        size=packets.size,
        metadata=packets.metadata,
        palette=config.palette,
        overwrite=overwrite,
    ) as page:
        for packet in packets:
            page.append(packet)
        page.still = still
