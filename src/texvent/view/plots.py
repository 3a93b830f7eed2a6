"""Plots of events by matplotlib: frame, cloud, rate, intervals."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent._require import require
from texvent.config import check_range, check_whole
from texvent.errors import ConfigError, shown
from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.represent.event_frame import count_events
from texvent.view.drawing.event_image import draw_events
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Colour, Palette, get_palette
from texvent.view.sample import UniformSample, rate_counts


def draw_frame(
    events: EventStream,
    ax: Any,
    *,
    palette: str | Palette = DEFAULT_PALETTE,
    ceiling: float | None = None,
) -> None:
    """Draw all events; cut with `events.between(start_us, stop_us)` before.

    Args:
        events: any number.
        ax: axes; one unit is one pixel, row 0 at the top.
        palette: colours of ON and OFF, by name.
        ceiling: events per pixel at full strength; default: a high percentile.
    """
    colours = get_palette(palette)
    image = draw_events(count_events(events), colours, ceiling=ceiling)
    ax.imshow(image, interpolation="nearest")
    ax.set(xlabel="x, pixels", ylabel="y, pixels", title=f"{len(events):,} events")


CLOUD_EVENTS = 20_000


def draw_cloud(
    events: EventStream,
    ax: Any,
    *,
    palette: str | Palette = DEFAULT_PALETTE,
    max_events: int = CLOUD_EVENTS,
    point_size: float = 1.0,
) -> None:
    """Draw a point per event: time to the right, x into the depth, y up and down.

    Args:
        events: any number; of more than `max_events` an even sample is drawn, the same every time.
        ax: 3-D axes.
        palette: colours of ON and OFF, by name.
        max_events: most points, 1 or more.
        point_size: area of a point, square points.

    Raises:
        ConfigError: a value is out of range.
    """
    check_whole("max_events", max_events, 1)
    check_range("point_size", point_size, 0.0)
    colours = get_palette(palette)
    drawn = UniformSample(events.size, limit=max_events)
    drawn.append(events)
    sample = drawn.events()
    both = np.array([colours.off, colours.on]) / 255
    ax.scatter(
        sample.t / MICROSECONDS,
        sample.x,
        sample.y,
        c=both[sample.p],
        s=point_size,
        linewidths=0,
        depthshade=False,
    )
    ax.set(xlabel="time, s", ylabel="x, pixels", zlabel="y, pixels")
    ax.set(ylim=(0, events.size.width), zlim=(events.size.height, 0))
    ax.set_title(
        f"{len(events):,} events"
        if len(sample) == len(events)
        else f"{len(sample):,} of {len(events):,} events"
    )


RATE_BINS = 100
INTERVAL_BINS = 40


def draw_rate(
    events: EventStream,
    ax: Any,
    *,
    bin_us: int | None = None,
    palette: str | Palette = DEFAULT_PALETTE,
) -> None:
    """Draw the event rate: ON above the line, OFF below it.

    Args:
        events: any number.
        ax: axes, seconds across and events per second up.
        bin_us: width of a bin, µs, from the first event on; default: a hundredth of the recording.
        palette: colours of ON and OFF, by name.

    Raises:
        ConfigError: `bin_us` is below 1.
    """
    check_range("bin_us", bin_us, 1)
    colours = get_palette(palette)
    first_us, stop_us = events.time_range or (0, 1)
    width_us = bin_us or max(1, -(-(stop_us - first_us) // RATE_BINS))
    bins = -(-(stop_us - first_us) // width_us)
    off, on = rate_counts(events, (first_us, first_us + bins * width_us), bins)
    edges = (first_us + width_us * np.arange(bins + 1)) / MICROSECONDS
    per_second = MICROSECONDS / width_us
    ax.stairs(on * per_second, edges, fill=True, color=_unit(colours.on), label="ON")
    ax.stairs(-off * per_second, edges, fill=True, color=_unit(colours.off), label="OFF")
    ax.axhline(0, color="0.5", linewidth=0.8)
    ax.set(xlabel="time, s", ylabel="events per second", title=f"bins of {width_us / 1000:g} ms")
    ax.yaxis.set_major_formatter(lambda value, _: f"{abs(value):,.0f}")
    ax.margins(y=0.2)
    ax.legend(loc="upper right", ncols=2)


def draw_intervals(events: EventStream, ax: Any, *, bins: int = INTERVAL_BINS) -> None:
    """Draw how long pixels wait between two events (inter-spike intervals), on a log scale.

    Args:
        events: any number.
        ax: axes, µs across and intervals up.
        bins: how many, from the shortest to the longest interval. Events of one pixel in the same
            µs count as 1 µs apart.

    Raises:
        ConfigError: there is no bin.
    """
    check_range("bins", bins, 1)
    intervals = np.maximum(pixel_intervals(events), 1)
    ax.set(xscale="log", xlabel="time between events of a pixel, µs", ylabel="intervals")
    ax.set_title(f"{len(intervals):,} intervals")
    if len(intervals):
        low, high = int(intervals.min()), int(intervals.max())
        edges = np.geomspace(low, max(high, low + 1), bins + 1)
        edges[-1] = max(edges[-1], high)
        ax.stairs(np.histogram(intervals, edges)[0], edges, fill=True)


def pixel_intervals(events: EventStream) -> NDArray[np.int64]:
    """Times between each event of a pixel and the next one of the same pixel, µs, [k] int64."""
    pixel = events.y.astype(np.int64) * events.size.width + events.x
    order = np.argsort(pixel, kind="stable")
    is_same = np.diff(pixel[order]) == 0
    return np.asarray(np.diff(events.t[order])[is_same])


def _unit(colour: Colour) -> tuple[float, float, float]:
    """Red, green and blue, 0..1."""
    red, green, blue = colour
    return red / 255, green / 255, blue / 255


KINDS: dict[str, Callable[..., None]] = {
    "frame": draw_frame,
    "cloud": draw_cloud,
    "rate": draw_rate,
    "isi": draw_intervals,
}


def plot(events: EventStream, kind: str = "frame", *, ax: Any = None, **options: Any) -> Any:
    """Draw events; see `EventStream.plot`.

    Raises:
        ConfigError: unknown kind or option, or axes that do not fit it.
        MissingDependencyError: matplotlib is not installed.
    """
    if kind not in KINDS:
        raise ConfigError(f"unknown kind of plot {shown(kind)}; {suggest(kind, tuple(KINDS))}")
    draw = KINDS[kind]
    known = tuple(inspect.signature(draw).parameters)[2:]
    for name in options:
        if name not in known:
            raise ConfigError(f"plot {kind} has no option {shown(name)}; {suggest(name, known)}")
    if ax is None:
        pyplot = require("matplotlib.pyplot", extra="plot")
        ax = pyplot.subplots(subplot_kw={"projection": "3d"} if kind == "cloud" else None)[1]
    elif (getattr(ax, "name", "") == "3d") != (kind == "cloud"):
        wanted = 'subplots(subplot_kw={"projection": "3d"})' if kind == "cloud" else "subplots()"
        raise ConfigError(f"plot {kind} cannot be drawn into these axes; make them by {wanted}")
    draw(events, ax, **options)
    return ax
