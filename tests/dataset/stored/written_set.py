"""A data set folder of random events, written by the code of `texvent dataset make`."""

import hashlib
import json
from pathlib import Path

import numpy as np

from texvent.dataset.generation.make_sample import SimulatedClip, sample_members
from texvent.dataset.generation.shard_files import (
    FILTERED,
    SampleRecord,
    ShardRecord,
    TarShardWriter,
    write_record,
)
from texvent.events import EventStream
from texvent.sensor import SensorSize

SIZE = SensorSize(16, 12)
DURATION_US = 10_000
LABELS = ("bus", "car")


def random_events(seed: int, count: int = 40, *, start_us: int = 0) -> EventStream:
    chance = np.random.default_rng(seed)
    t = np.sort(chance.integers(start_us, start_us + DURATION_US, count))
    x, y, p = (chance.integers(0, end, count) for end in (SIZE.width, SIZE.height, 2))
    return EventStream(x, y, t, p, SIZE)


def write_shard(
    folder: Path,
    variant: str,
    split: str,
    number: int,
    samples: dict[str, EventStream],
    *,
    labels: tuple[str, ...] = LABELS,
    start_us: int = 0,
) -> Path:
    """A shard of these samples, one that was filtered out, and its record."""
    path = folder / variant / f"{split}-{number:06d}.tar"
    path.parent.mkdir(parents=True, exist_ok=True)
    facts = {"identity": "", "labels": [*LABELS, "dog"], "specification": SPECIFICATION}
    (folder / "specification.json").write_text(json.dumps(facts))
    records = [SampleRecord(key="gone", clip="gone", status=FILTERED, seed=0)]
    with path.open("wb") as file:
        writer = TarShardWriter(file)
        for place, (key, events) in enumerate(samples.items()):
            label = labels[place % len(labels)] if labels else None
            facts = {"prompt": f"a {label} drives left", "key": key, "label": label}
            members = sample_members(
                SimulatedClip(events, start_us, DURATION_US, len(events)),
                facts,
                class_number=None if label is None else labels.index(label),
                preview=False,
            )
            records.append(
                SampleRecord(
                    key=key,
                    clip=key,
                    status="made",
                    seed=place,
                    prompt=facts["prompt"],
                    label=label,
                    events=len(events),
                    start_us=start_us,
                    duration_us=DURATION_US,
                    width=SIZE.width,
                    height=SIZE.height,
                    members=writer.add(key, members),
                )
            )
        writer.close()
    content = path.read_bytes()
    write_record(
        path,
        ShardRecord(
            name=path.stem,
            split=split,
            variant=variant,
            identity="",
            sha256=hashlib.sha256(content).hexdigest(),
            bytes=len(content),
            samples=tuple(records),
            seconds=0.0,
        ),
    )
    return path


SPECIFICATION = {
    "name": "random",
    "splits": {"test": 0.5, "train": 0.5},
    "variants": [{"name": "esim"}, {"name": "paper"}],
}


def write_set(folder: Path) -> dict[str, EventStream]:
    """Two variants, two splits; key → events, in the order of `texvent.dataset.open`."""
    written: dict[str, EventStream] = {}
    for variant in ("esim", "paper"):
        for split in ("test", "train"):
            for number in range(2):
                names = range(len(written), len(written) + 3)
                samples = {f"k{name:03d}": random_events(name) for name in names}
                write_shard(folder, variant, split, number, samples)
                written |= samples
    return written
