"""Tiny copies of N-ImageNet in its real layout."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import cv2
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


def write_images(folder: Path, numbers: Sequence[int], wnid: str = WNIDS[0]) -> Path:
    """ImageNet's validation images by class, as noise that grows brighter with the number."""
    for number in numbers:
        levels = np.random.default_rng(number).integers(0, 40 * number, (20, 30, 3), np.uint8)
        path = folder / wnid / f"{stream_id(number)}.JPEG"
        path.parent.mkdir(parents=True, exist_ok=True)
        assert cv2.imwrite(str(path.with_suffix(".jpg")), levels)
        path.with_suffix(".jpg").rename(path)
    return folder


def write_n_imagenet(folder: Path, counts: Mapping[str, Mapping[int, int]]) -> Path:
    """Counts of events: class → number of the image → events."""
    for wnid, streams in counts.items():
        for number, count in streams.items():
            path = folder / "extracted_val" / wnid / f"{stream_id(number)}.npz"
            write_stream(path, count, number)
    (folder / "val_list.txt").write_text("as in the data set\n")
    return folder
