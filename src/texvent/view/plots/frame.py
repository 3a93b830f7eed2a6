"""Events counted per pixel, as an image."""

from __future__ import annotations

from typing import Any

from texvent.events import EventStream
from texvent.represent.event_frame import count_events
from texvent.view.drawing.event_image import draw_events
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Palette, get_palette


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
