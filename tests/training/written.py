"""Sources of training clips, written by the tests."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from texvent.training.sources import Clip
from texvent.truth.boxes import BOX_RECORD

FRAMES, HEIGHT, WIDTH = 12, 20, 30
STEP = 2
"""Pixels that `Sliding` moves right per frame."""


def write_folders(folder: Path, count: int = 4, frames: int = FRAMES) -> Path:
    """Folders of images, 30 per second."""
    import cv2

    for number in range(count):
        place = folder / f"clip{number}"
        place.mkdir(parents=True)
        rng = np.random.default_rng(number)
        wander = rng.normal(0, 20, (frames, HEIGHT, WIDTH)).cumsum(axis=0)
        for index, image in enumerate(np.clip(100 + wander, 0, 255).astype(np.uint8)):
            cv2.imwrite(str(place / f"{index:03d}.png"), image)
        lines = "".join(f"{index / 30:.6f}\n" for index in range(frames))
        (place / "timestamps.txt").write_text(lines)
    return folder


class Sliding:
    """A texture that slides to the right by whole pixels, with its exact truth."""

    known_truth = ("flow", "depth", "boxes")

    def __len__(self) -> int:
        return 3

    def name(self, index: int) -> str:
        return f"texture {index}"

    def read(self, index: int, truth: Sequence[str], most_bytes: int) -> Clip:
        rng = np.random.default_rng(index)
        film = rng.integers(0, 256, (HEIGHT, WIDTH + STEP * FRAMES)).astype(np.uint8)
        lefts = [STEP * (FRAMES - 1 - n) for n in range(FRAMES)]
        frames = np.stack([film[:, left : left + WIDTH] for left in lefts])
        flow = np.zeros((FRAMES - 1, 2, HEIGHT, WIDTH), np.float32)
        flow[:, 0] = STEP
        times_us = np.arange(FRAMES) * 10_000 + 77
        boxes = np.zeros(FRAMES, BOX_RECORD)
        boxes["t"], boxes["x"], boxes["y"] = times_us, STEP * np.arange(FRAMES), 3
        boxes["w"] = boxes["h"] = 8
        known = {"flow": flow, "depth": frames.astype(np.float32), "boxes": boxes}
        return Clip(frames, times_us, {name: known[name] for name in truth})
