"""A window → the image of its events, and the image with all panels."""

from __future__ import annotations

from texvent.view.drawing.canvas import Image
from texvent.view.drawing.event_image import draw_events, draw_fading
from texvent.view.drawing.palettes import Palette
from texvent.view.drawing.panels import PanelLayout
from texvent.view.windows.event_window import EventWindow


def draw_window(window: EventWindow, palette: Palette, *, ceiling: float | None = None) -> Image:
    """The events of a window, faded by age if it has `fading`, else counted.

    Args:
        window: what happened.
        palette: the colours.
        ceiling: events per pixel at full strength, for counts; default: from the window.

    Returns:
        [H, W, 3] uint8.
    """
    if window.fading is not None:
        return draw_fading(window.fading, palette)
    return draw_events(window.counts, palette, ceiling=ceiling)


def compose_window(
    window: EventWindow,
    layout: PanelLayout,
    *,
    title: str,
    facts: str,
    ceiling: float | None = None,
) -> Image:
    """Frame, events and caption of a window, with its annotations on both panels."""
    return layout.compose(
        window.image,
        draw_window(window, layout.palette, ceiling=ceiling),
        title=title,
        facts=facts,
        annotations=window.annotations,
    )
