"""Samples as a contact sheet and as an HTML page: their liveliest 40 ms, captions, facts."""

from __future__ import annotations

import base64
import html
import json
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from texvent.dataset.contents.made_set import MadeSet
from texvent.dataset.looking.chosen_samples import ChosenSample
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent.video import MICROSECONDS
from texvent.view.drawing.canvas import Image, blank, png_bytes, shrink, tile
from texvent.view.drawing.event_image import draw_events
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Palette, get_palette
from texvent.view.drawing.panels import SURROUND, PanelLayout
from texvent.view.page.html_parts import count_text, fill_template
from texvent.view.stills import busiest_start

SHEET_WIDTH, NARROWEST_PANEL, GAP = 1600.0, 300.0, 4
IMAGE_WIDTH = 480


WINDOW_US = 40_000


def write_contact_sheet(samples: Sequence[ChosenSample], path: Path, *, overwrite: bool) -> Path:
    """One PNG of all samples under their captions.

    Raises:
        OutputError: the file exists already or cannot be written.
        FileFormatError: a sample is damaged.
    """
    columns = max(1, min(len(samples), round(math.sqrt(len(samples) * 1.5))))
    width = max(NARROWEST_PANEL, SHEET_WIDTH / columns)
    panels = [_panel(sample, width) for sample in samples]
    tallest, widest = (max(panel.shape[axis] for panel in panels) for axis in (0, 1))
    sheet = tile([_padded(one, widest, tallest) for one in panels], columns, SURROUND, gap=GAP)
    with atomic_file(path, overwrite=overwrite) as part:
        part.write_bytes(png_bytes(sheet))
    return path


def write_sample_page(
    made: MadeSet, samples: Sequence[ChosenSample], path: Path, *, overwrite: bool
) -> Path:
    """An HTML file that opens offline and holds no script.

    Raises:
        OutputError: the file exists already or cannot be written.
        FileFormatError: a sample is damaged.
    """
    palette = get_palette(DEFAULT_PALETTE)
    cards = "\n".join(_card(sample, palette) for sample in samples)
    page = fill_template(
        "document.html",
        {
            "title": html.escape(made.name),
            "summary": f"{len(samples)} samples, drawn by chance",
            "body": f'<div class="cards">{cards}</div>'
            f'<p class="note">Each image shows the {WINDOW_US // 1000} ms with the most events. '
            "Select a sample's facts to see all that made it.</p>",
        },
        palette=palette,
    )
    with atomic_file(path, overwrite=overwrite) as part:
        part.write_text(page, encoding="utf-8")
    return path


def _liveliest(events: EventStream, palette: Palette) -> Image:
    start = busiest_start(events, WINDOW_US)
    return draw_events(count_events(events.cut(start, start + WINDOW_US)), palette)


def _panel(sample: ChosenSample, width: float) -> Image:
    record = sample.record
    size = SensorSize(record.width, record.height)
    layout = PanelLayout(size, get_palette(DEFAULT_PALETTE), side_by_side=False, target_width=width)
    image = _liveliest(sample.events(), layout.palette)
    title = record.prompt or record.label or record.key
    return shrink(
        layout.compose(None, image, title=title, facts=sample.shard.record.variant), int(width)
    )


def _padded(panel: Image, width: int, height: int) -> Image:
    """The panel on a ground of one size for all."""
    ground = blank(width, height, SURROUND)
    ground[: panel.shape[0], : panel.shape[1]] = panel
    return ground


def _card(sample: ChosenSample, palette: Palette) -> str:
    record, events = sample.record, sample.events()
    light, dark = (_data(_liveliest(events, one)) for one in (palette, palette.dark))
    seconds = record.duration_us / MICROSECONDS
    on_share = float(np.mean(events.p)) if len(events) else 0.0
    facts = [
        sample.shard.record.variant,
        sample.shard.record.split,
        *([record.label] if record.label else []),
        f"{count_text(record.events)} events, {on_share:.0%} ON",
        f"{seconds:.3g} s",
        f"{record.width}×{record.height}",
    ]
    caption = record.prompt or "(no caption)"
    doubts = "".join(f"<br>⚠ {html.escape(one)}" for one in record.warnings)
    settings = json.dumps(dict(events.metadata), indent=1, ensure_ascii=False)
    return (
        '<figure><div class="panel"><picture>'
        f'<source media="(prefers-color-scheme: dark)" srcset="{dark}">'
        f'<img alt="Events of: {html.escape(caption)}" src="{light}"></picture></div>'
        f"<figcaption><strong>{html.escape(caption)}</strong>"
        f"{html.escape(' · '.join(facts))}{doubts}</figcaption>"
        f"<details><summary>{html.escape(record.key)}</summary>"
        f"<pre>{html.escape(settings)}</pre></details></figure>"
    )


def _data(image: Image) -> str:
    png = png_bytes(shrink(image, IMAGE_WIDTH))
    return "data:image/png;base64," + base64.b64encode(png).decode("ascii")
