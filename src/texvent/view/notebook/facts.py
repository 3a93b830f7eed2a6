"""What a notebook says of a recording: size, times, how it was made."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.video import MICROSECONDS
from texvent.view.drawing.caption import title_of
from texvent.view.page.html_parts import count_text

MAX_TITLE = 300
"""Characters of a prompt that are shown."""


def title_text(metadata: Mapping[str, Any]) -> str:
    """The prompt or the name of the source, bounded."""
    title = title_of(metadata)
    return title if len(title) <= MAX_TITLE else f"{title[: MAX_TITLE - 3]}..."


def size_text(size: SensorSize) -> str:
    """Such as 346 × 260 pixels."""
    return f"{size.width} × {size.height} pixels"


def event_facts(events: EventStream) -> dict[str, str]:
    """Numbers of a recording that has events."""
    seconds = (int(events.t[-1]) + 1 - int(events.t[0])) / MICROSECONDS
    return {
        "Mean rate": f"{count_text(len(events) / seconds)} events/s",
        "ON": f"{int(events.p.view(bool).sum()) / len(events):.1%}",
        "First event": f"{int(events.t[0]) / MICROSECONDS:.6f} s",
    }


def made_by(metadata: Mapping[str, Any]) -> dict[str, Any]:
    """Generator, pixel model, seed, source and version of the provenance, where they are known."""
    source = metadata.get("source")
    if isinstance(source, Mapping):
        source = source.get("source")
    model = metadata.get("simulator")
    if model and metadata.get("preset"):
        model = f"{model}, preset {metadata['preset']}"
    return {
        "Generator": metadata.get("generator"),
        "Pixel model": model,
        "Seed": metadata.get("seed"),
        "Source": Path(source).name if isinstance(source, str) else None,
        "texvent": metadata.get("texvent_version"),
    }
