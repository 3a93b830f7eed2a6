"""Preview of a data set: some samples on a page, with their liveliest 40 ms, captions and facts."""

from __future__ import annotations

import base64
import html
import json
import random
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from texvent.dataset.generation.shards import SampleRecord
from texvent.dataset.reading.stored_dataset import StoredDataset, StoredShard
from texvent.dataset.reading.stored_events import read_events
from texvent.errors import InputError, shown
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.represent.event_frame import count_events
from texvent.video import MICROSECONDS
from texvent.view.drawing.canvas import Image, png_bytes, shrink
from texvent.view.drawing.event_image import draw_events
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Palette, get_palette
from texvent.view.page.html_parts import count_text, fill_template
from texvent.view.stills import find_busiest

IMAGE_WIDTH, WINDOW_US = 480, 40_000
ChosenSample = tuple[StoredShard, SampleRecord]


def choose_samples(
    dataset: StoredDataset,
    count: int = 24,
    *,
    variant: str | None = None,
    split: str | None = None,
    label: str | None = None,
    seed: int = 0,
) -> list[ChosenSample]:
    """Samples drawn by chance, the same every time, in the order of the data set.

    Raises:
        InputError: there are none such.
    """
    variants = [] if variant is None else [dataset.check_variant(variant)]
    chance = random.Random(seed)
    chosen: list[tuple[int, ChosenSample]] = []
    seen = 0
    for shard in dataset.shards(*variants):
        if split not in (None, shard.record.split):
            continue
        for record in shard.samples:
            if label not in (None, record.label):
                continue
            # Each sample has the same chance, and no more than those chosen are held.
            place = seen if seen < count else chance.randrange(seen + 1)
            if place < count:
                chosen[place : place + 1] = [(seen, (shard, record))]
            seen += 1
    if not chosen:
        asked = {"split": split, "label": label}
        asked_for = [f"{name} {shown(value)}" for name, value in asked.items() if value]
        which = f" with {' and '.join(asked_for)}" if asked_for else ""
        raise InputError(f"{dataset.folder} holds no samples{which}")
    return [sample for _, sample in sorted(chosen, key=lambda pair: pair[0])]


def write_sample_page(
    dataset: StoredDataset, samples: Sequence[ChosenSample], path: Path, *, overwrite: bool
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
            "title": html.escape(dataset.name),
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
    found = find_busiest((events,), WINDOW_US)
    return draw_events(count_events(events) if found is None else found.counts, palette)


def _card(sample: ChosenSample, palette: Palette) -> str:
    shard, record = sample
    events = read_events(shard.path, record)
    light, dark = (_data(_liveliest(events, one)) for one in (palette, palette.dark))
    seconds = record.duration_us / MICROSECONDS
    on_share = float(np.mean(events.p)) if len(events) else 0.0
    facts = [
        shard.record.variant,
        shard.record.split,
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
