"""An interval → the picture of its events, and the whole panelled picture."""

from __future__ import annotations

from texvent.view.canvas import Picture
from texvent.view.film.interval import Interval
from texvent.view.film.layout import Layout
from texvent.view.images.event_image import draw_events, draw_fading
from texvent.view.palettes import Palette


def draw_interval(interval: Interval, palette: Palette, *, ceiling: float | None = None) -> Picture:
    """The events of an interval, faded by age where it says so, else counted.

    Args:
        interval: what happened.
        palette: the colours.
        ceiling: events per pixel at full strength, for counts; default: from the interval.

    Returns:
        [H, W, 3] uint8.
    """
    if interval.fading is not None:
        return draw_fading(interval.fading, palette)
    return draw_events(interval.counts, palette, ceiling=ceiling)


def compose_interval(
    interval: Interval, layout: Layout, *, title: str, facts: str, ceiling: float | None = None
) -> Picture:
    """Frame, events and caption of an interval, with its marks on both panels."""
    return layout.compose(
        interval.picture,
        draw_interval(interval, layout.palette, ceiling=ceiling),
        title=title,
        facts=facts,
        marks=interval.marks,
    )
