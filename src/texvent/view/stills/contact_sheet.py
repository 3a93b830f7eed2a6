"""A contact sheet: several windows of a recording in one image."""

from __future__ import annotations

import math
from collections.abc import Iterable

from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import Image, tile
from texvent.view.drawing.palettes import get_palette
from texvent.view.drawing.panels import SURROUND, TARGET_WIDTH, PanelLayout
from texvent.view.windows.draw_window import compose_window
from texvent.view.windows.event_window import EventWindow

GAP = 4
NARROWEST_PANEL = 360.0
"""So that the caption of a panel can be read."""


def draw_contact_sheet(
    windows: Iterable[EventWindow],
    panels: int,
    *,
    size: SensorSize,
    palette: str,
    side_by_side: bool,
) -> Image:
    """The windows in reading order, on a sheet of about 3:2.

    Args:
        windows: at least one, at most `panels`.
        panels: how many the sheet is laid out for.
        size: sensor size, pixels.
        palette: colours, by name.
        side_by_side: whether each panel also shows its frame.
    """
    across = size.width * (2 if side_by_side else 1)
    columns = max(1, min(panels, round(math.sqrt(panels * 1.5 * size.height / across))))
    layout = PanelLayout(
        size,
        get_palette(palette),
        side_by_side=side_by_side,
        target_width=max(NARROWEST_PANEL, TARGET_WIDTH / columns),
    )
    composed = [compose_window(one, layout, title=one.caption, facts="") for one in windows]
    return tile(composed, columns, SURROUND, gap=GAP)
