"""Events in space and time, as points in 3-D axes."""

from __future__ import annotations

from typing import Any

import numpy as np

from texvent.config import check_range, check_whole
from texvent.events import EventStream
from texvent.video import MICROSECONDS
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Palette, get_palette
from texvent.view.page.sample import spread_sample

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
    sample = spread_sample(events, max_events)
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
