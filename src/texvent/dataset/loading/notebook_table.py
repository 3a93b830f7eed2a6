"""What a notebook shows of a data set, and of one of its samples."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from texvent.errors import few
from texvent.video import MICROSECONDS
from texvent.view.notebook.bundle import facts_grid, framed, heading
from texvent.view.notebook.displays import stream_html

if TYPE_CHECKING:
    from texvent.dataset.loading.stored_samples import StoredSample, StoredSamples

MOST_NAMES = 12


def samples_html(samples: StoredSamples) -> str:
    """Counts of classes, splits and events, from the index alone: no shard is read."""
    index = samples.index
    sizes = sorted({f"{width} × {height}" for width, height in np.unique(index.size, axis=0)})
    facts = {
        "Classes": _counts(index.labels[number] or "none" for number in index.label),
        "Splits": _counts(index.splits[shard] for shard in index.shard),
        "Variants": _counts(index.variants[shard] for shard in index.shard),
        "Sensor": few(sizes),
        "Events": f"{int(index.events.sum()):,}",
        "Duration": f"{int(index.duration_us.sum()) / MICROSECONDS:,.1f} s",
        "make(number) gives": samples.representation or "events",
    }
    return framed(
        heading(samples.folder.name, f"StoredSamples · {len(samples):,} samples"), facts_grid(facts)
    )


def sample_html(sample: StoredSample) -> str:
    """The events of a sample, with its class and place in the data set."""
    facts = {
        "Class": sample.label,
        "Caption": sample.caption,
        "Sample": sample.key,
        "Split": sample.split,
        "Variant": sample.variant,
    }
    return stream_html(sample.events, facts)


def _counts(names: Iterable[str]) -> str:
    """Such as "ball 30, car 30"."""
    counted = sorted(Counter(names).items())
    return few([f"{name} {count:,}" for name, count in counted], MOST_NAMES)
