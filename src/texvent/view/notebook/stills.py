"""Images inside the HTML of a notebook, small enough to be stored with it."""

from __future__ import annotations

import base64
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.represent.event_frame import count_events
from texvent.video import MICROSECONDS, Frame
from texvent.view.drawing.canvas import png_bytes, shrink, tile
from texvent.view.drawing.event_image import count_ceiling, draw_events, frame_image
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent.view.stills.busiest_window import find_busiest
from texvent.view.windows.cut import still_window_us

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
