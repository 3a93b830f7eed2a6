"""Clips with boxes, read by evlib from the layout of RVT's preprocessing.

Histograms are nearly empty, so a clip is kept as the places and counts of its filled cells: 2,000
clips take less than 1 GB, and become dense on the device that computes.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, few, one_line
from texvent.extending import require
from texvent.networks import Tensor
from texvent.truth.boxes import BOX_RECORD
from texvent_lab.bench.detection.config import EXTRA
from texvent_lab.bench.detection.labels import COUNTED, IGNORED

REPRESENTATION = "stacked_histogram_dt=50_nbins=10"
WINDOW_US = 50_000
LEAST_MOTION_PX = 0.5
"""Motion of an edge of a box from one window to the next; a box that moves less makes no events."""
NOTE_FILE = "texvent-export.json"


@dataclass(frozen=True, eq=False)
class BoxedClip:
    """Histograms of successive windows, and the boxes at their ends, in cells of some pixels."""

    key: str
    shape: tuple[int, int, int, int]
    """Windows, channels, height and width."""
    places: NDArray[np.int64]
    """[n] filled cells, in the flat array of that shape."""
    counts: NDArray[np.uint8]
    """[n] their events."""
    boxes: tuple[NDArray[np.void], ...]
    """`BOX_RECORD` of each window; a confidence of 0 marks boxes at rest."""

    @classmethod
    def of(
        cls, key: str, histograms: Sequence[NDArray[np.uint8]], boxes: Sequence[NDArray[np.void]]
    ) -> BoxedClip:
        """A clip of dense histograms, [channels, height, width] each."""
        places, counts, size = [], [], histograms[0].size
        for number, one in enumerate(histograms):
            flat = one.ravel()
            filled = np.flatnonzero(flat)
            places.append(filled + number * size)
            counts.append(flat[filled])
        channels, height, width = histograms[0].shape
        shape = (len(histograms), channels, height, width)
        return cls(key, shape, np.concatenate(places), np.concatenate(counts), tuple(boxes))

    def part(self, first: int, count: int) -> BoxedClip:
        """`count` windows from number `first` on, or as many as there are."""
        boxes, size = self.boxes[first : first + count], int(np.prod(self.shape[1:]))
        start, stop = np.searchsorted(self.places, [first * size, (first + count) * size])
        places = self.places[start:stop] - first * size
        return BoxedClip(
            self.key, (len(boxes), *self.shape[1:]), places, self.counts[start:stop], boxes
        )

    @property
    def learnable(self) -> list[int]:
        """Windows with a box that counts."""
        return [n for n, one in enumerate(self.boxes) if (one["class_confidence"] > IGNORED).any()]


def read_classes(folder: Path) -> tuple[str, ...]:
    """Names of the classes of an exported data set, in the order of their numbers.

    Raises:
        InputError: the folder is no export, or one of another layout.
        FileFormatError: its note is damaged.
    """
    path = folder / NOTE_FILE
    try:
        note = json.loads(path.read_text(encoding="utf-8"))
        classes = tuple(map(str, note["classes"]))
        layout = note["layout"]
    except OSError as error:
        raise InputError(
            f"{folder} has no {NOTE_FILE}; write it with texvent dataset export --layout rvt"
        ) from error
    except (ValueError, KeyError, TypeError) as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)})") from error
    if layout != "rvt":
        raise InputError(f"{folder} has the layout {layout}; export it with --layout rvt")
    return classes


def read_clips(folder: Path, split: str, binning: int) -> list[BoxedClip]:
    """All clips of a split, in the order of their names, in cells of `binning` pixels a side.

    Raises:
        InputError: there are none.
        FileFormatError: one is damaged.
        MissingDependencyError: evlib is not installed.
    """
    place = folder / split
    paths = sorted(one for one in place.iterdir() if one.is_dir()) if place.is_dir() else []
    if not paths:
        there = [one.name for one in sorted(folder.iterdir()) if one.is_dir()]
        raise InputError(
            f"there are no clips in {place}; make and export the split {split} first"
            + (f", or name one of {few(there)} (rvt calls validation val)" if there else "")
        )
    source_type = require("evlib.data.sources", extra=EXTRA).PreprocessedH5Source
    return [_read(source_type, path, binning) for path in paths]


def _read(source_type: Any, path: Path, binning: int) -> BoxedClip:
    source = source_type(path, REPRESENTATION, downsample_by_2=False)
    try:
        count = source.window_count()
        histograms = [one.numpy() for one in source.read_windows(0, count)[0]]
        rows = [source.read_window_gt(number) for number in range(count)]
    except (OSError, ValueError, KeyError) as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)})") from error
    boxes = [scale(one, 1 / binning) for one in mark_resting([_as_boxes(one) for one in rows])]
    return BoxedClip.of(path.name, [bin_pixels(one, binning) for one in histograms], boxes)


def bin_pixels(histogram: NDArray[np.uint8], binning: int) -> NDArray[np.uint8]:
    """A histogram [channels, height, width] of cells, whose counts are added, up to 255."""
    margins = ((0, 0), *((0, -side % binning) for side in histogram.shape[1:]))
    padded = np.pad(histogram, margins)
    channels, height, width = padded.shape
    cells = padded.reshape(channels, height // binning, binning, width // binning, binning)
    return np.asarray(np.minimum(cells.sum(axis=(2, 4)), 255), np.uint8)


def scale(boxes: NDArray[np.void], factor: float) -> NDArray[np.void]:
    """Boxes in other units of length."""
    scaled = boxes.copy()
    for side in "xywh":
        scaled[side] *= factor
    return scaled


def _as_boxes(rows: NDArray[np.void] | None) -> NDArray[np.void]:
    if rows is None:
        return np.zeros(0, BOX_RECORD)
    boxes = np.zeros(len(rows), BOX_RECORD)
    for name in BOX_RECORD.names or ():
        boxes[name] = rows[name]
    return boxes


def mark_resting(windows: Sequence[NDArray[np.void]]) -> list[NDArray[np.void]]:
    """Boxes with `COUNTED` as confidence, and `IGNORED` where all edges rest.

    An object that rests before a standing camera makes no events: no network can find it, and one
    that remembers it is not wrong. What rests follows from the boxes alone, so that all simulators
    are asked for the same ones. Where no neighbouring window has the object, it counts as moving.

    Args:
        windows: boxes at the ends of successive windows.
    """
    marked = []
    for number, boxes in enumerate(windows):
        neighbour = windows[abs(number - 1)] if len(windows) > 1 else boxes[:0]
        before = {int(one["track_id"]): _edges(one) for one in neighbour}
        found = boxes.copy()
        for box in found:
            other = before.get(int(box["track_id"]))
            moved = other is None or np.abs(_edges(box) - other).max() >= LEAST_MOTION_PX
            box["class_confidence"] = COUNTED if moved else IGNORED
        marked.append(found)
    return marked


def _edges(box: NDArray[np.void]) -> NDArray[np.float64]:
    x, y, w, h = (float(box[name]) for name in "xywh")
    return np.array([x, y, x + w, y + h])


def dense(clips: Sequence[BoxedClip], device: Any) -> Tensor:
    """Histograms of clips of one size, [clips, windows, channels, height, width] uint8.

    Shorter clips end with empty windows.
    """
    torch = require("torch", extra=EXTRA)
    longest = max(one.shape[0] for one in clips)
    shape = (len(clips), longest, *clips[0].shape[1:])
    size = int(np.prod(shape[1:]))
    places = np.concatenate([one.places + n * size for n, one in enumerate(clips)])
    counts = np.concatenate([one.counts for one in clips])
    flat = torch.zeros(len(clips) * size, dtype=torch.uint8, device=device)
    flat[torch.from_numpy(places).to(device)] = torch.from_numpy(counts).to(device)
    return flat.view(shape)
