"""Labels of a video: the boxes of its frames, whatever format they come in."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.sensor import SensorSize

LABEL = np.dtype(
    {
        "names": ["frame", "x", "y", "w", "h", "class_id", "track_id", "class_confidence"],
        "formats": ["<i8", "<f8", "<f8", "<f8", "<f8", "<u4", "<u4", "<f4"],
    }
)
"""Number of the frame from 0, left, top, width, height; place in `Labels.names`; 0: no track."""


@dataclass(frozen=True, eq=False)
class Labels:
    """Labels of a video."""

    path: Path
    """Where they are from."""
    boxes: NDArray[np.void]
    """[k] records of `LABEL`, by frame and track; px, or shares of the picture."""
    frames: NDArray[np.int64]
    """Numbers of the frames that were labelled, in order; some may show nothing."""
    names: tuple[str, ...]
    """Names of the classes."""
    size: SensorSize | None = None
    """Of the pictures, where the file says it."""
    is_relative: bool = False
    """Whether boxes are in shares of the picture's width and height."""

    @property
    def has_tracks(self) -> bool:
        """Whether every box says which object it is of."""
        return bool((self.boxes["track_id"] > 0).all())

    def inside(self, size: SensorSize) -> NDArray[np.void]:
        """The boxes in pixels, cut at the edges of the picture.

        Args:
            size: of the video's pictures, pixels.

        Raises:
            InputError: nothing is left of one, or pictures of another size were labelled.
        """
        if self.size not in (None, size):
            raise InputError(
                f"{self.path} labels pictures of {self.size}, and the video has {size}; give the "
                "video that was labelled"
            )
        boxes = self.boxes.copy()
        for start, side, whole in (("x", "w", size.width), ("y", "h", size.height)):
            scale = whole if self.is_relative else 1
            ends = (boxes[start] + boxes[side]) * scale
            boxes[start] = np.clip(boxes[start] * scale, 0, whole)
            boxes[side] = np.clip(ends, 0, whole) - boxes[start]
        gone = np.flatnonzero(~((boxes["w"] > 0) & (boxes["h"] > 0)))
        if len(gone):
            raise InputError(
                f"{self.path}: {self.shown(int(gone[0]))} is outside the picture; correct or "
                "remove it"
            )
        return boxes

    def shown(self, number: int) -> str:
        """A box in words, for messages; frames are counted from 0."""
        box = self.boxes[number]
        place = [round(float(box[name]), 4) for name in "xywh"]
        name = self.names[int(box["class_id"])]
        return f"box {place} of class {name!r} in frame {box['frame']}"


def make_labels(
    path: Path,
    rows: list[tuple[float, ...]],
    names: tuple[str, ...],
    *,
    frames: set[int] | None = None,
    size: SensorSize | None = None,
    is_relative: bool = False,
) -> Labels:
    """Labels of rows in any order; `Labels` describes the others.

    Args:
        path: where they are from.
        rows: of the columns of `LABEL`.
        names: of the classes.
        frames: that were labelled; None: those of the rows.
        size: of the pictures.
        is_relative: whether boxes are in shares of the picture.

    Raises:
        InputError: no box, or one that is no box.
    """
    boxes = np.array(rows, LABEL)
    if not len(boxes):
        raise InputError(f"{path} holds no box; leave its video out, or give it another file")
    boxes = boxes[np.lexsort((boxes["track_id"], boxes["frame"]))]
    numbers = frames if frames is not None else set(boxes["frame"].tolist())
    labelled = np.array(sorted(numbers), np.int64)
    labels = Labels(path, boxes, labelled, names, size, is_relative)
    columns = np.stack([boxes[name] for name in "xywh"])
    bad = np.flatnonzero(~(np.isfinite(columns).all(axis=0) & (columns[2:] > 0).all(axis=0)))
    if len(bad):
        raise InputError(f"{path}: {labels.shown(int(bad[0]))} has no size; correct or remove it")
    return labels
