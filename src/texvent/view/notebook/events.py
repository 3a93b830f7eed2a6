"""Events in a notebook: still, cloud, event rate, facts."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice
from typing import Any

from texvent.errors import TexventError
from texvent.event_packets import EventPackets, SeekablePackets
from texvent.events import EventStream
from texvent.video import MICROSECONDS
from texvent.view.notebook.bundle import facts_grid, framed, heading, note
from texvent.view.notebook.cloud import cloud_frame
from texvent.view.notebook.facts import event_facts, made_by, size_text, title_text
from texvent.view.notebook.stills import busiest_still, window_still
from texvent.view.page.html_parts import rate_figure
from texvent.view.page.sample import RATE_BINS
from texvent.view.rates import rate_counts

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
    """What is known of packets without going through them; of a file that seeks, a glance."""
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
