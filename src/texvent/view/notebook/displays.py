"""HTML of events, frames and videos in notebooks."""

from __future__ import annotations

import base64
import contextlib
import html
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import TexventError
from texvent.event_packets import EventPackets, SeekablePackets
from texvent.events import EventStream
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent.video import MICROSECONDS, Frame, FrameStream, RenderableStream, Video, describe_stream
from texvent.view.drawing.canvas import png_bytes, shrink, tile
from texvent.view.drawing.event_image import count_ceiling, draw_events, frame_image
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent.view.drawing.panels import title_of
from texvent.view.notebook.bundle import facts_grid, framed, heading, note
from texvent.view.page.html_parts import (
    DARK_BY_CLASS,
    cloud_data,
    count_text,
    fill_template,
    rate_figure,
    script_json,
)
from texvent.view.page.sample import RATE_BINS, rate_counts, spread_sample
from texvent.view.stills import find_busiest
from texvent.view.windows import still_window_us

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


LONGEST_SIDE = 480
"""Pixels; larger images are made smaller."""
MAX_PNG_BYTES = 36_000
"""Of an image of events; noise compresses badly, and is shown with fewer pixels."""
MAX_FRAME_BYTES = 120_000
MAX_WINDOWS = 100_000
"""Windows that are looked through one by one."""


def busiest_still(events: EventStream) -> str:
    """The window with the most events as an image for light and one for dark notebooks."""
    start_us, stop_us = busiest_range(events)
    window = events.cut(start_us, stop_us)
    caption = (
        f"{len(window):,} events of {start_us / MICROSECONDS:.3f} to "
        f"{stop_us / MICROSECONDS:.3f} s, the busiest {(stop_us - start_us) / 1000:.3g} ms"
    )
    return _event_figure(count_events(window), caption)


def window_still(events: EventStream, caption: str) -> str:
    """All of these events as such an image."""
    return _event_figure(count_events(events), caption)


def busiest_range(events: EventStream) -> tuple[int, int]:
    """The window with the most events, µs; windows begin at the first event, the earlier wins."""
    first_us, stop_us = int(events.t[0]), int(events.t[-1]) + 1
    window_us = still_window_us((first_us, stop_us))
    if (stop_us - first_us) // window_us > MAX_WINDOWS:  # long pauses cost nothing there
        found = find_busiest((events,), window_us)
        start_us = first_us if found is None else found.start_us
    else:
        starts = np.arange(first_us, stop_us + window_us, window_us)
        counts = np.diff(np.searchsorted(events.t, starts))
        start_us = int(starts[int(counts.argmax())])
    return start_us, start_us + window_us


def _event_figure(counts: NDArray[np.int32], caption: str) -> str:
    """Counted events, [2, H, W], drawn on white and on black; a notebook's theme chooses."""
    palette = get_palette(DEFAULT_PALETTE)
    counts = shrink_counts(counts, -(-max(counts.shape[1:]) // LONGEST_SIDE))
    while True:
        ceiling = count_ceiling(counts)
        pngs = [
            png_bytes(draw_events(counts, one, ceiling=ceiling)) for one in (palette, palette.dark)
        ]
        if max(map(len, pngs)) <= MAX_PNG_BYTES or min(counts.shape[1:]) < 2:
            break
        counts = shrink_counts(counts, 2)
    light, dark = map(_source, pngs)
    return (
        f'<figure class="still"><img class="light" style="display:block" alt="{caption}" '
        f'src="{light}"><img class="dark" style="display:none" alt="{caption}" src="{dark}">'
        f"<figcaption>{caption}</figcaption></figure>"
    )


def shrink_counts(counts: NDArray[np.int32], factor: int) -> NDArray[np.int32]:
    """The sum of each block of `factor` × `factor` pixels; the last ones may be smaller."""
    if factor == 1:
        return counts
    for axis in (1, 2):
        counts = np.add.reduceat(counts, np.arange(0, counts.shape[axis], factor), axis=axis)
    return counts


def frame_figure(frames: Sequence[Frame], caption: str) -> str:
    """Frames side by side."""
    images = [frame_image(frame) for frame in frames]
    width = LONGEST_SIDE if len(images) == 1 else LONGEST_SIDE // 2
    while True:
        sheet = tile([shrink(one, width) for one in images], len(images), (128, 128, 128), gap=2)
        png = png_bytes(sheet)
        if len(png) <= MAX_FRAME_BYTES or width < 16:
            break
        width = width * 3 // 4
    classes = ["still"]
    if images[0].shape[1] > width:
        classes.append("smooth")
    if len(images) > 1:
        classes.append("strip")
    return (
        f'<figure class="{" ".join(classes)}"><img alt="{caption}" '
        f'src="{_source(png)}"><figcaption>{caption}</figcaption></figure>'
    )


def _source(png: bytes) -> str:
    return f"data:image/png;base64,{base64.b64encode(png).decode('ascii')}"


CLOUD_EVENTS = 10_000
"""Most events of a cloud: 120 kB."""
CLOUD_SCRIPTS = ("state.js", "cloud.js", "controls.js")


def cloud_frame(events: EventStream) -> str:
    """An iframe that holds its page in itself and asks nothing of the network.

    Where scripts do not run, or frames are taken out, the still beside it stays.
    """
    palette = get_palette(DEFAULT_PALETTE)
    sample = spread_sample(events, CLOUD_EVENTS)
    extent = (int(events.t[0]), int(events.t[-1]))
    data = cloud_data(sample, extent, palette=palette, seen=len(events)) | {"is_embedded": True}
    note = "Drag to turn; after a click, the wheel zooms."
    if len(sample) < len(events):
        note += f" {len(sample):,} of {len(events):,} events, evenly drawn."
    page = fill_template(
        "frame.html",
        {"note": note, "data": script_json(data)},
        palette=palette,
        style="frame.css",
        scripts=CLOUD_SCRIPTS,
        dark=DARK_BY_CLASS,
    )
    return (
        f'<iframe title="Events in space and time" loading="lazy" '
        f'srcdoc="{html.escape(page)}"></iframe>'
    )


STRIP_FRAMES = 4
MOST_RENDERED_PIXELS = 640 * 480
"""A rendered scene of more pixels is not drawn only to be shown."""


def frame_html(frame: Frame) -> str:
    """One frame with its time."""
    summary = f"{frame!r} · {size_text(frame.size)}"
    return framed(
        heading("", summary),
        f'<div class="views">{frame_figure([frame], f"{frame.t_us / MICROSECONDS:.6f} s")}</div>',
        facts_grid({"Motion vectors": "yes" if frame.motion is not None else None}),
    )


def video_html(frames: FrameStream) -> str:
    """Frames of a stream: four of those in memory, the first of those that can be read again.

    Nothing is taken from a stream that can be read once.
    """
    strip: list[Frame] = []
    why = ""
    if isinstance(frames, Video):
        chosen = np.unique(np.linspace(0, len(frames) - 1, STRIP_FRAMES).round().astype(int))
        strip = [frames[int(index)] for index in chosen]
    elif frames.is_live:
        why = "A live source can be read once; no frame was taken to show it."
    elif (
        isinstance(frames, RenderableStream)
        and frames.size.width * frames.size.height > MOST_RENDERED_PIXELS
    ):
        why = "Frames are rendered when they are asked for."
    else:
        strip, why = _first_frame(frames)
    times = ", ".join(f"{one.t_us / MICROSECONDS:.3f}" for one in strip)
    caption = f"{'Frames' if len(strip) > 1 else 'Frame'} at {times} s"
    figure = frame_figure(strip, caption) if strip else ""
    return framed(
        heading(title_text(frames.metadata), describe_stream(frames)),
        f'<div class="views">{figure}</div>' if figure else "",
        note(why) if why else "",
        facts_grid(made_by(frames.metadata) | _times(frames)),
    )


def _first_frame(frames: FrameStream) -> tuple[list[Frame], str]:
    """The first frame, or why there is none."""
    reader = iter(frames)
    try:
        return [next(reader)], ""
    except StopIteration:
        return [], "The stream has no frame."
    except (TexventError, OSError) as error:
        return [], f"No frame could be read: {error}"
    finally:
        _close(reader)


def _close(reader: Iterator[Frame]) -> None:
    """Let go of the file that the reader holds open."""
    close = getattr(reader, "close", None)
    if close is not None:
        with contextlib.suppress(TexventError):
            close()


def _times(frames: FrameStream) -> dict[str, str]:
    if frames.fps is None or not frames.frame_count:
        return {}
    return {"Duration": f"{float(frames.frame_count / frames.fps):.3f} s"}


GLANCE_US = 40_000
GLANCE_EVENTS = 200_000
GLANCE_PACKETS = 16
"""Of a file no more than this is read to show it."""


def stream_html(events: EventStream, more: Mapping[str, Any] | None = None) -> str:
    """All that is shown of events in memory; `more` facts come first."""
    title = title_text(events.metadata)
    if len(events) == 0:
        summary = f"EventStream · {size_text(events.size)} · no events"
        return framed(
            heading(title, summary), facts_grid({**(more or {}), **made_by(events.metadata)})
        )
    start_us, stop_us = int(events.t[0]), int(events.t[-1]) + 1
    summary = (
        f"EventStream · {len(events):,} events · {size_text(events.size)} · "
        f"{(stop_us - start_us) / MICROSECONDS:.3f} s"
    )
    bins = min(RATE_BINS, stop_us - start_us)
    curve = rate_figure(
        rate_counts(events, (start_us, stop_us), bins),
        start_us=start_us,
        bin_us=(stop_us - start_us) / bins,
    )
    return framed(
        heading(title, summary),
        f'<div class="views">{busiest_still(events)}{cloud_frame(events)}</div>',
        curve,
        facts_grid({**(more or {}), **event_facts(events), **made_by(events.metadata)}),
    )


def packets_html(packets: EventPackets) -> str:
    """HTML of packets without reading them through; of a seekable file, one window."""
    span, still = None, ""
    try:
        if isinstance(packets.packets, SeekablePackets):  # this alone may read the file
            span, still = _glance(packets)
    except (TexventError, OSError) as error:
        still = note(f"The file could not be read: {error}")
    summary = f"EventPackets · {size_text(packets.size)}"
    if span is not None:
        summary += f" · {(span[1] - span[0]) / MICROSECONDS:.3f} s"
    return framed(
        heading(title_text(packets.metadata), summary),
        f'<div class="views">{still}</div>' if still else "",
        note(
            "The packets were not read through. collect() gives all events in memory, "
            "between(start_us, stop_us) a part of them, save(path) a file."
        ),
        facts_grid(made_by(packets.metadata)),
    )


def _glance(packets: EventPackets) -> tuple[tuple[int, int] | None, str]:
    """Range of time, and an image of a moment in its middle."""
    span = packets.time_range
    if span is None:
        return None, note("No events.")
    start_us = max(span[0], (span[0] + span[1] - GLANCE_US) // 2)
    found: list[EventStream] = []
    for packet in islice(packets.cut(start_us, start_us + GLANCE_US), GLANCE_PACKETS):
        found.append(packet)
        if sum(map(len, found)) >= GLANCE_EVENTS:
            break
    moment = EventStream.concat([EventStream.empty(packets.size), *found])
    moment = moment.without_label()[:GLANCE_EVENTS]
    shown_us = int(moment.t[-1]) + 1 - start_us if len(moment) else 0
    caption = (
        f"{len(moment):,} events from {start_us / MICROSECONDS:.3f} s on, "
        f"in {shown_us / 1000:.3g} ms"
    )
    return span, window_still(moment, caption)
