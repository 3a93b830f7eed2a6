"""The x-y-t cloud in a frame of its own: the viewer's script, apart from the notebook's page."""

from __future__ import annotations

import html

from texvent.events import EventStream
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent.view.page.html_parts import cloud_data, script_json
from texvent.view.page.sample import spread_sample
from texvent.view.page.template import DARK_BY_CLASS, fill_template

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
