"""A labelled data set of moving bars, which a small network learns in seconds, and its weights."""

import json
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
from tests.dataset.stored.written_set import write_shard

from texvent.events import EventStream
from texvent.sensor import SensorSize

SIZE = SensorSize(16, 12)
LABELS = ("bus", "car")


def bar(label: int, seed: int) -> EventStream:
    """Events of a bar: class 0 in the left half, class 1 in the right one."""
    chance = np.random.default_rng((label, seed))
    x = chance.integers(0, 6, 60) + 10 * label
    y, p = chance.integers(0, 12, 60), chance.integers(0, 2, 60)
    return EventStream(x, y, np.sort(chance.integers(0, 10_000, 60)), p, SIZE)


def write_bars(folder: Path, shift: int = 0) -> Path:
    """24 samples to train with and 8 to test, classes in turn; others with another `shift`."""
    for split, count, first in (("train", 24, 0), ("test", 8, 100)):
        samples = {f"{split}{n:03d}": bar(n % 2, first + n + 1000 * shift) for n in range(count)}
        write_shard(folder, "paper", split, 0, samples, labels=LABELS)
    return folder


def write_recordings(folder: Path, *, per_class: int = 4, format: str = "npz") -> Path:
    """Moving bars as files: train and val, of classes bus and car."""
    for first, split in enumerate(("train", "val")):
        for label, name in enumerate(("bus", "car")):
            place = folder / split / name
            place.mkdir(parents=True, exist_ok=True)
            for number in range(per_class):
                bar(label, 100 * first + number).save(place / f"{number}.{format}")
    return folder


def write_bars_training(folder: Path, *, epochs: int, shift: int = 0) -> Path:
    """A training file, and the bars that it trains with."""
    write_bars(folder / "bars", shift)
    path = folder / "bars.toml"
    path.write_text(
        f'data = {{folder = "bars"}}\n[schedule]\nepochs = {epochs}\n'
        "batch_size = 5\nlearning_rate = 0.01\n"
    )
    return path


def as_weights(path: Path) -> Any:
    """Text of what torch wrote, with digests of tensors: equal where all bits are."""
    import torch

    content = torch.load(path, weights_only=True)
    for row in content.get("rows", ()):
        row.pop("seconds")
    return json.dumps(content, default=lambda one: sha256(one.numpy().tobytes()).hexdigest())
