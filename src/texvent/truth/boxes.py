"""Boxes of objects as COCO JSON, and as the records of Prophesee's automotive data sets.

Written frame by frame: memory does not grow with the clip.

Source: the COCO object detection format; Prophesee's automotive dataset toolbox, whose label
files `*_bbox.npy` hold one record per box.
"""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.sensor import SensorSize

if TYPE_CHECKING:
    from texvent.ground_truth import Box

COCO, PROPHESEE = "coco.json", "bbox.npy"
BOX_RECORD = np.dtype(
    {
        "names": ["t", "x", "y", "w", "h", "class_id", "track_id", "class_confidence"],
        "formats": ["<i8", "<f4", "<f4", "<f4", "<f4", "<u4", "<u4", "<f4"],
    }
)
"""Time in µs, left, top, width, height in pixels; `track_id` is the instance."""

SMALL_AREA, MEDIUM_AREA = 32**2, 96**2
"""Areas, px², from which on COCO calls an object medium, and large."""
SIZE_CLASSES = ("small", "medium", "large")


def box_records(t_us: int, boxes: Sequence[Box], class_ids: Sequence[int]) -> NDArray[np.void]:
    """Records of the boxes of one instant, of `BOX_RECORD`.

    Args:
        t_us: the instant, µs.
        boxes: visible objects.
        class_ids: class of each.
    """
    rows = [
        (t_us, box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0, class_id, box.instance, 1.0)
        for box, class_id in zip(boxes, class_ids, strict=True)
    ]
    return np.array(rows, dtype=BOX_RECORD)


class Label(NamedTuple):
    """A box of a labelled frame of a video."""

    frame: int
    """Number of the frame, from 0."""
    track: int
    """Number of the object; 0: not known."""
    name: str
    """Class."""
    x: float
    y: float
    w: float
    h: float

    def record(self, class_id: int) -> tuple[float, ...]:
        """A record of `BOX_RECORD`, with the number of the frame as its time."""
        return (self.frame, *self[3:], class_id, self.track, 1.0)


def clip_boxes(boxes: NDArray[np.void], size: SensorSize) -> NDArray[np.bool_]:
    """Cut boxes at the edges of the picture, in place; whether something is left of each."""
    for start, side, whole in (("x", "w", size.width), ("y", "h", size.height)):
        end = np.clip(boxes[start] + boxes[side], 0, whole)
        boxes[start] = np.clip(boxes[start], 0, whole)
        boxes[side] = end - boxes[start]
    return np.asarray((boxes["w"] > 0) & (boxes["h"] > 0))


def size_classes(boxes: NDArray[np.void]) -> NDArray[np.int64]:
    """Place of each box in `SIZE_CLASSES`, by its area.

    Example:
        >>> size_classes(np.array([(0, 0, 0, 32, 32, 3, 1, 1.0)], BOX_RECORD)).tolist()
        [1]
    """
    area: NDArray[np.float32] = boxes["w"] * boxes["h"]
    return np.searchsorted((SMALL_AREA, MEDIUM_AREA), area, side="right")


def detection_target(boxes: NDArray[np.void]) -> dict[str, NDArray[Any]]:
    """Boxes as detectors take them.

    Args:
        boxes: [k] records of `BOX_RECORD`.

    Returns:
        `boxes`: x0, y0, x1, y1 in pixels, [k, 4] float32; `labels`: class ids, `track_ids`, and
        `times`, µs, [k] int64 each.
    """
    x, y, w, h = (boxes[name] for name in "xywh")
    whole = {"labels": "class_id", "track_ids": "track_id", "times": "t"}
    return {
        "boxes": np.stack([x, y, x + w, y + h], axis=1).astype(np.float32),
        **{name: boxes[column].astype(np.int64) for name, column in whole.items()},
    }


class CocoFile:
    """An open file; use `open_coco`."""

    def __init__(self, images: IO[str], annotations: IO[str]) -> None:
        self._images, self._annotations = images, annotations
        self._image_count = self._box_count = 0

    def add_image(self, number: int, file_name: str, size: SensorSize, t_us: int) -> None:
        """Add an image, whose boxes follow.

        Args:
            number: its id.
            file_name: its path, from where readers look for images.
            size: pixels.
            t_us: its time, µs.
        """
        image = {"id": number, "file_name": file_name, "width": size.width, "height": size.height}
        self._image_count = _append(self._images, self._image_count, {**image, "t_us": t_us})
        self._image = number

    def add_box(self, category: int, sides: Sequence[float], area: float, **more: Any) -> None:
        """Add a box of the image added last.

        Args:
            category: class id.
            sides: left, top, width, height, pixels.
            area: of the object, px².
            more: further facts.
        """
        facts = {
            "id": self._box_count + 1,
            "image_id": self._image,
            "category_id": category,
            "bbox": list(sides),
            "area": area,
            "iscrowd": 0,
        }
        self._box_count = _append(self._annotations, self._box_count, {**facts, **more})


def _append(file: IO[str], count: int, facts: Mapping[str, Any]) -> int:
    file.write((",\n" if count else "") + json.dumps(facts))
    return count + 1


@contextmanager
def open_coco(
    path: Path, *, classes: Mapping[int, str], info: Mapping[str, Any]
) -> Iterator[CocoFile]:
    """A COCO file, complete when the `with` block ends.

    Args:
        path: the file.
        classes: class id → name; read at the end.
        info: facts of the images.
    """
    with (
        path.open("w", encoding="ascii") as file,
        tempfile.TemporaryFile("w+", encoding="ascii", dir=path.parent) as annotations,
    ):
        file.write(f'{{"info": {json.dumps(dict(info))},\n"images": [\n')
        yield CocoFile(file, annotations)
        file.write('\n],\n"annotations": [\n')
        annotations.seek(0)
        shutil.copyfileobj(annotations, file)
        categories = [
            {"id": number, "name": name, "supercategory": "object"}
            for number, name in classes.items()
        ]
        file.write(f'\n],\n"categories": {json.dumps(categories)}}}\n')
