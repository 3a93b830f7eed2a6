"""How many events: over time, by the time between them, and by polarity."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.events import EventStream
from texvent.video import MICROSECONDS
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Colour, Palette, get_palette
from texvent.view.rates import rate_counts

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


def draw_polarity(
    events: EventStream, ax: Any, *, palette: str | Palette = DEFAULT_PALETTE
) -> None:
    """Draw how many events are ON and how many OFF, as two bars with their shares.

    Args:
        events: any number.
        ax: axes.
        palette: colours of ON and OFF, by name.
    """
    colours = get_palette(palette)
    on = int(np.count_nonzero(events.p))
    counts = [on, len(events) - on]
    edge = _unit(colours.ink)
    bars = ax.bar(
        ["ON", "OFF"],
        counts,
        color=[_unit(colours.on), _unit(colours.off)],
        edgecolor=edge,
        linewidth=0.8,
    )
    share = max(1, len(events))
    ax.bar_label(bars, labels=[f"{count:,} ({count / share:.1%})" for count in counts])
    ax.set(ylabel="events", title=f"{len(events):,} events")
    ax.margins(y=0.1)


def _unit(colour: Colour) -> tuple[float, float, float]:
    """Red, green and blue, 0..1."""
    red, green, blue = colour
    return red / 255, green / 255, blue / 255
