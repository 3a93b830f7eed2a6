"""Tiny copies of N-ImageNet in its real layout."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

WNIDS = ("n01440764", "n01443537", "n01484850")
EVENT = np.dtype([("x", "<u2"), ("y", "<u2"), ("t", "<i8"), ("p", "?")])


def stream_id(number: int) -> str:
    return f"ILSVRC2012_val_{number:08d}"


def write_stream(path: Path, count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    events = np.zeros(count, EVENT)
    events["x"], events["y"] = rng.integers(0, 640, count), rng.integers(0, 480, count)
    events["t"] = np.sort(rng.integers(0, 50_000, count))
    events["p"] = rng.integers(0, 2, count)
    path.parent.mkdir(parents=True, exist_ok=True)
    np.savez_compressed(path, event_data=events)


def write_n_imagenet(folder: Path, counts: Mapping[str, Mapping[int, int]]) -> Path:
    """Counts of events: class → number of the image → events."""
    for wnid, streams in counts.items():
        for number, count in streams.items():
            path = folder / "extracted_val" / wnid / f"{stream_id(number)}.npz"
            write_stream(path, count, number)
    (folder / "val_list.txt").write_text("as in the data set\n")
    return folder
