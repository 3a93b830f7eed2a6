"""A contact sheet: several moments of a recording on one picture."""

from __future__ import annotations

import math
from collections.abc import Iterable

from texvent.sensor import SensorSize
from texvent.view.canvas import Picture, blank
from texvent.view.film.draw import compose_interval
from texvent.view.film.film import interval_facts
from texvent.view.film.interval import Interval
from texvent.view.film.layout import PLEASANT_WIDTH, SURROUND, Layout
from texvent.view.palettes import get_palette

GAP = 4
NARROWEST_PANEL = 360.0
"""So that the caption of a panel can be read."""


def draw_sheet(
    intervals: Iterable[Interval],
    panels: int,
    *,
    size: SensorSize,
    palette: str,
    side_by_side: bool,
) -> Picture:
    """The intervals in reading order, on a sheet of about 3:2.

    Args:
        intervals: at least one, at most `panels`.
        panels: how many the sheet is laid out for.
        size: sensor size, pixels.
        palette: colours, by name.
        side_by_side: whether each panel also shows its frame.
    """
    across = size.width * (2 if side_by_side else 1)
    columns = max(1, min(panels, round(math.sqrt(panels * 1.5 * size.height / across))))
    layout = Layout(
        size,
        get_palette(palette),
        side_by_side=side_by_side,
        pleasant_width=max(NARROWEST_PANEL, PLEASANT_WIDTH / columns),
    )
    return _grid(
        [
            compose_interval(interval, layout, title=interval_facts(interval), facts="")
            for interval in intervals
        ],
        columns,
    )


def _grid(panels: list[Picture], columns: int) -> Picture:
    height, width = panels[0].shape[:2]
    rows = -(-len(panels) // columns)
    sheet = blank(columns * (width + GAP) - GAP, rows * (height + GAP) - GAP, SURROUND)
    for index, panel in enumerate(panels):
        top, left = (index // columns) * (height + GAP), (index % columns) * (width + GAP)
        sheet[top : top + height, left : left + width] = panel
    return sheet
