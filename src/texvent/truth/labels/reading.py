"""Labels of a video read from a file or folder of any format, and checked."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

import numpy as np

from texvent.errors import FileFormatError, InputError
from texvent.sensor import SensorSize
from texvent.truth.labels.coco import read_coco
from texvent.truth.labels.labels import Labels
from texvent.truth.labels.mot import read_mot
from texvent.truth.labels.yolo import read_yolo

READERS: Mapping[str, Callable[[Path], Labels]] = MappingProxyType(
    {".json": read_coco, ".txt": read_mot, "": read_yolo}
)
"""Extension of the file, none for a folder → reader."""
FARTHEST = 3.0
"""A box that moves by more of its diagonals from frame to frame is that of another object; cars
that cross the picture in a quarter of a second move by less than one."""


def read_labels(path: Path) -> Labels:
    """Labels of a video, checked as far as they can be without it.

    Args:
        path: COCO, .json; MOT, .txt; or YOLO, a folder with a .txt for each frame.

    Raises:
        InputError: there is no such file, no box in it, a class that it does not name, a box
            outside the picture, or a track that jumps.
        FileFormatError: it is of no such format.
    """
    if not path.exists():
        raise InputError(f"no such labels: {path}; boxes names COCO .json, MOT .txt, a YOLO folder")
    reader = READERS.get("" if path.is_dir() else path.suffix.lower() or "file")
    if reader is None:
        raise FileFormatError(f"{path} is neither COCO (.json) nor MOT (.txt) nor a YOLO folder")
    labels = reader(path)
    size = SensorSize(1, 1) if labels.is_relative else labels.size
    if size is not None:
        labels.inside(size)
    _refuse_jumps(labels)
    return labels


def _refuse_jumps(labels: Labels) -> None:
    """Refuse a track that is twice in a frame, or moves farther than an object can."""
    tracked = labels.boxes[labels.boxes["track_id"] > 0]
    boxes = tracked[np.lexsort((tracked["frame"], tracked["track_id"]))]
    before, after = boxes[:-1], boxes[1:]
    steps = after["frame"] - before["frame"]
    same = before["track_id"] == after["track_id"]
    centres = [(one["x"] + one["w"] / 2, one["y"] + one["h"] / 2) for one in (before, after)]
    moved = np.hypot(centres[1][0] - centres[0][0], centres[1][1] - centres[0][1])
    largest = np.maximum(*(np.hypot(one["w"], one["h"]) for one in (before, after)))
    is_twice, is_far = same & (steps == 0), same & (moved > FARTHEST * largest * steps)
    for wrong, what in ((is_twice, "is twice"), (is_far, "jumps")):
        if wrong.any():
            first = int(np.argmax(wrong))
            frames = dict.fromkeys(int(one["frame"][first]) for one in (before, after))
            raise InputError(
                f"{labels.path}: track {before['track_id'][first]} {what} in frames "
                f"{' to '.join(map(str, frames))} (from 0); give each object a track of its own"
            )
