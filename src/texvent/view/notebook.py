"""Notebook displays of events, frames and videos: an image, the event rate and facts."""

from __future__ import annotations

import base64
import html
import sys
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.frames import MICROSECONDS, Frame, FrameStream, Video, describe_stream
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import jpeg_bytes, shrink, tile
from texvent.view.drawing.event_image import frame_image
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent.view.drawing.panels import title_of
from texvent.view.page.html_parts import (
    count_text,
    facts_html,
    palette_properties,
    rate_figure,
    viewer_file,
)
from texvent.view.sample import RATE_BINS, rate_counts
from texvent.view.stills import busiest_window_png

MAX_TITLE = 300
"""Characters of a prompt that are shown."""
LONGEST_SIDE = 480
"""Longest side of a frame, pixels; larger ones are made smaller."""
STRIP_FRAMES = 4
JPEG_QUALITY = 90


def mime_bundle(
    shown: EventStream | EventPackets | Frame | FrameStream,
    include: Collection[str] | None = None,
    exclude: Collection[str] | None = None,
) -> dict[str, str]:
    """Result of `_repr_mimebundle_`: text always, HTML where it can be seen.

    Args:
        shown: the value. In a terminal, which shows text alone, its HTML is not made.
        include: types that are wanted; None: all.
        exclude: types that are not.
    """
    bundle = {"text/plain": repr(shown)}
    is_wanted = include is None or "text/html" in include
    if is_wanted and "text/html" not in (exclude or ()) and not _is_terminal():
        bundle["text/html"] = _html_of(shown)
    return bundle


def _is_terminal() -> bool:
    """Whether this is IPython in a terminal."""
    ipython = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    return shell is not None and "text/html" not in shell.display_formatter.active_types


def _html_of(shown: EventStream | EventPackets | Frame | FrameStream) -> str:
    if isinstance(shown, EventStream):
        return stream_html(shown)
    if isinstance(shown, EventPackets):
        return packets_html(shown)
    return frame_html(shown) if isinstance(shown, Frame) else video_html(shown)


def stream_html(events: EventStream) -> str:
    """The busiest moment, the event rate and the facts of events in memory."""
    summary = f"EventStream · {len(events):,} events · {_size_text(events.size)}"
    extent = events.time_range
    if extent is None:
        return _display(events.metadata, summary)
    start_us, stop_us = extent
    seconds = (stop_us - start_us) / MICROSECONDS
    png = busiest_window_png(events, title="") or b""
    bins = min(RATE_BINS, stop_us - start_us)
    curve = rate_figure(
        rate_counts(events, extent, bins), start_us=start_us, bin_us=(stop_us - start_us) / bins
    )
    facts = {
        "mean_rate": f"{count_text(len(events) / seconds)} events/s",
        "ON": f"{int(events.p.view(bool).sum()) / len(events):.1%}",
        "first_event": f"{start_us / MICROSECONDS:.6f} s",
    }
    return _display(
        events.metadata,
        f"{summary} · {seconds:.3f} s",
        _figure(png, "png", "The busiest moment") + curve,
        facts,
    )


def packets_html(packets: EventPackets) -> str:
    """The facts of packets, which are not read."""
    note = (
        '<p class="note">The packets were not read. collect() gives all events in memory, '
        "between(start_us, stop_us) a part of them, save(path) a file.</p>"
    )
    return _display(packets.metadata, f"EventPackets · {_size_text(packets.size)}", note)


def frame_html(frame: Frame) -> str:
    """One frame with its time."""
    motion = {"motion_vectors": "yes"} if frame.motion is not None else {}
    summary = f"{frame!r} · {_size_text(frame.size)}"
    return _display({}, summary, _frame_figure([frame]), motion)


def video_html(frames: FrameStream) -> str:
    """The facts of a stream, and four frames of one in memory; no other one is read."""
    figure = ""
    if isinstance(frames, Video):
        chosen = np.unique(np.linspace(0, len(frames) - 1, STRIP_FRAMES).round().astype(int))
        figure = _frame_figure([frames[int(index)] for index in chosen])
    facts = {}
    if frames.fps is not None and frames.frame_count:
        facts = {"duration": f"{float(frames.frame_count / frames.fps):.3f} s"}
    return _display(frames.metadata, describe_stream(frames), figure, facts)


def _display(
    metadata: Mapping[str, Any],
    summary: str,
    body: str = "",
    facts: Mapping[str, Any] | None = None,
) -> str:
    """Title and summary, both escaped, the body, and a table of facts; with its own style."""
    title = title_of(metadata)
    title = title if len(title) <= MAX_TITLE else f"{title[: MAX_TITLE - 3]}..."
    bold = f"<b>{html.escape(title)}</b><br>" if title else ""
    rows = facts_html(
        {
            name: value
            for name, value in {**(facts or {}), **_made_by(metadata)}.items()
            if value not in (None, "")
        }
    )
    style = f".texvent-view {{{palette_properties(get_palette(DEFAULT_PALETTE))}}}"
    return (
        f'<div class="texvent-view"><style>{style}\n{viewer_file("notebook.css")}</style>'
        f'<p class="head">{bold}{html.escape(summary)}</p>{body}'
        f'<table class="facts"><tbody>{rows}</tbody></table></div>'
    )


def _made_by(metadata: Mapping[str, Any]) -> dict[str, Any]:
    """Generator, pixel model, seed, source and version of the provenance, where they are known."""
    source = metadata.get("source")
    if isinstance(source, Mapping):
        source = source.get("source")
    model = metadata.get("simulator")
    if model and metadata.get("preset"):
        model = f"{model}, preset {metadata['preset']}"
    return {
        "generator": metadata.get("generator"),
        "pixel_model": model,
        "seed": metadata.get("seed"),
        "source": Path(source).name if isinstance(source, str) else None,
        "texvent_version": metadata.get("texvent_version"),
    }


def _frame_figure(frames: Sequence[Frame]) -> str:
    """Frames side by side, with their times."""
    width = LONGEST_SIDE if len(frames) == 1 else LONGEST_SIDE // 2
    images = [shrink(frame_image(frame), width) for frame in frames]
    sheet = tile(images, len(images), (128, 128, 128), gap=2)
    times = ", ".join(f"{one.t_us / MICROSECONDS:.3f}" for one in frames)
    return _figure(jpeg_bytes(sheet, quality=JPEG_QUALITY), "jpeg", f"At {times} s")


def _figure(image: bytes, kind: str, caption: str) -> str:
    data = base64.b64encode(image).decode("ascii")
    return (
        f'<figure class="still"><img alt="{caption}" src="data:image/{kind};base64,{data}">'
        f"<figcaption>{caption}</figcaption></figure>"
    )


def _size_text(size: SensorSize) -> str:
    """Such as 346 × 260 pixels."""
    return f"{size.width} × {size.height} pixels"
