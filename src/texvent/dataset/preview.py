"""Preview of a data set: some samples on a page, with their liveliest 50 ms, captions and facts."""

from __future__ import annotations

import base64
import html
import json
import random
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from texvent.dataset.generation.make_sample import PREVIEW_US, preview_png
from texvent.dataset.generation.shard_files import SampleRecord
from texvent.dataset.stored.folder import StoredDataset, StoredShard
from texvent.errors import InputError, shown
from texvent.frames import MICROSECONDS
from texvent.io.atomic import atomic_file
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
from texvent.view.page.html_parts import count_text, fill_template

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
    every = [
        (shard, sample)
        for shard in dataset.shards(*variants)
        if split in (None, shard.record.split)
        for sample in shard.samples
        if label in (None, sample.label)
    ]
    if not every:
        asked = {"split": split, "label": label}
        asked_for = [f"{name} {shown(value)}" for name, value in asked.items() if value]
        which = f" with {' and '.join(asked_for)}" if asked_for else ""
        raise InputError(f"{dataset.folder} holds no samples{which}")
    chosen = random.Random(seed).sample(range(len(every)), min(count, len(every)))
    return [every[place] for place in sorted(chosen)]


def write_sample_page(
    dataset: StoredDataset, samples: Sequence[ChosenSample], path: Path, *, overwrite: bool
) -> Path:
    """An HTML file that opens offline and holds no script.

    Raises:
        OutputError: the file exists already or cannot be written.
        FileFormatError: a sample is damaged.
    """
    cards = "\n".join(map(_card, samples))
    page = fill_template(
        "document.html",
        {
            "title": html.escape(dataset.name),
            "summary": f"{len(samples)} samples, drawn by chance",
            "body": f'<div class="cards">{cards}</div>'
            f'<p class="note">Each image shows the {PREVIEW_US // 1000} ms with the most events, '
            "and the boxes at their end. Select a sample's facts to see all that made it.</p>",
        },
        palette=get_palette(DEFAULT_PALETTE),
    )
    with atomic_file(path, overwrite=overwrite) as part:
        part.write_text(page, encoding="utf-8")
    return path


def _card(sample: ChosenSample) -> str:
    shard, record = sample
    files = shard.files(record)
    events, truth = files.events(), files.truth()
    truth.check(events.size)
    image = base64.b64encode(preview_png(events, truth)).decode("ascii")
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
    source = events.metadata.get("source") or {}
    video = Path(str(source.get("source", "a scene without a sentence")))
    caption = record.prompt or "/".join(video.parts[-2:])
    doubts = "".join(f"<br>⚠ {html.escape(one)}" for one in record.warnings)
    settings = json.dumps(dict(events.metadata), indent=1, ensure_ascii=False)
    return (
        '<figure><div class="panel">'
        f'<img alt="Events of: {html.escape(caption)}" src="data:image/png;base64,{image}"></div>'
        f"<figcaption><strong>{html.escape(caption)}</strong>"
        f"{html.escape(' · '.join(facts))}{doubts}</figcaption>"
        f"<details><summary>{html.escape(record.key)}</summary>"
        f"<pre>{html.escape(settings)}</pre></details></figure>"
    )
