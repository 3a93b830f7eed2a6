"""`events.plot(kind)`: which function draws a kind, and the axes that it draws into."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

from texvent._registry import suggest
from texvent._require import require
from texvent.errors import ConfigError, shown
from texvent.events import EventStream
from texvent.view.plots.cloud import draw_cloud
from texvent.view.plots.curves import draw_intervals, draw_polarity, draw_rate
from texvent.view.plots.frame import draw_frame

KINDS: dict[str, Callable[..., None]] = {
    "frame": draw_frame,
    "cloud": draw_cloud,
    "rate": draw_rate,
    "isi": draw_intervals,
    "polarity": draw_polarity,
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
