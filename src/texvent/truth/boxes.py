"""Boxes of objects as COCO JSON, and as the records of Prophesee's automotive data sets.

Written frame by frame: memory does not grow with the clip.

Source: the COCO object detection format; Prophesee's automotive dataset toolbox, whose label
files `*_bbox.npy` hold one record per box.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from texvent.io.arrays.npy_file import growing_array
from texvent.scenes.raycast.ground_truth import Box
from texvent.sensor import SensorSize

COCO, PROPHESEE = "coco.json", "bbox.npy"
BOX_RECORD = np.dtype(
    {
        "names": ["t", "x", "y", "w", "h", "class_id", "track_id", "class_confidence"],
        "formats": ["<i8", "<f4", "<f4", "<f4", "<f4", "<u4", "<u4", "<f4"],
    }
)
"""Time in µs, left, top, width, height in pixels; `track_id` is the instance."""


@dataclass(frozen=True)
class LabelledBox:
    """A box, with what COCO wants to know besides."""

    box: Box
    class_id: int
    area: int
    """Visible pixels."""


class BoxFiles:
    """Open box files; use `open_boxes`."""

    def __init__(self, size: SensorSize, images: IO[str], annotations: IO[str], append: Any):
        self._size = size
        self._images, self._annotations, self._append = images, annotations, append
        self._numbers = count(1)

    def add(self, index: int, t_us: int, boxes: Sequence[LabelledBox]) -> None:
        """Write the boxes of a frame."""
        image = {
            "id": index,
            "file_name": f"{index:06d}.png",
            "width": self._size.width,
            "height": self._size.height,
            "t_us": t_us,
        }
        _write_item(self._images, image)
        for one in boxes:
            _write_item(self._annotations, self._annotation(index, one))
        self._append(np.array([_record(t_us, one) for one in boxes], dtype=BOX_RECORD))

    def _annotation(self, index: int, one: LabelledBox) -> Mapping[str, Any]:
        box = one.box
        facts = {
            "id": next(self._numbers),
            "image_id": index,
            "category_id": one.class_id,
            "bbox": [box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0],
            "area": one.area,
            "iscrowd": 0,
            "track_id": box.instance,
        }
        return facts if np.isnan(box.visibility) else {**facts, "visibility": box.visibility}


@contextmanager
def open_boxes(
    folder: Path, *, size: SensorSize, classes: Mapping[int, str], info: Mapping[str, Any]
) -> Iterator[BoxFiles]:
    """Box files in a folder, complete when the `with` block ends.

    Args:
        folder: an empty folder.
        size: of the images, pixels.
        classes: class id → name, of all objects; read at the end.
        info: facts of the run; COCO's "info".
    """
    parts = [folder / "images.part", folder / "annotations.part"]
    with ExitStack() as stack:
        append = stack.enter_context(growing_array(folder / PROPHESEE, dtype=BOX_RECORD))
        images, annotations = (
            stack.enter_context(part.open("w", encoding="ascii")) for part in parts
        )
        yield BoxFiles(size, images, annotations, append)
    categories = [
        {"id": number, "name": name, "supercategory": "object"} for number, name in classes.items()
    ]
    with (folder / COCO).open("w", encoding="ascii") as file:
        file.write(f'{{"info": {json.dumps(info)},\n"categories": {json.dumps(categories)}')
        for part in parts:
            file.write(f',\n"{part.stem}": [\n')
            with part.open(encoding="ascii") as items:
                shutil.copyfileobj(items, file)
            file.write("\n]")
            part.unlink()
        file.write("}\n")


def labelled(
    boxes: Sequence[Box],
    instance: NDArray[np.int32],
    class_of: Callable[[NDArray[np.int32]], NDArray[np.uint16]],
) -> list[LabelledBox]:
    """The boxes with class and visible area.

    Args:
        boxes: of an instant.
        instance: [H, W] ids at the same instant.
        class_of: instance ids → class ids.
    """
    area = np.bincount(instance.ravel())
    classes = class_of(np.array([box.instance for box in boxes], dtype=np.int32))
    return [
        LabelledBox(box, int(number), int(area[box.instance]))
        for box, number in zip(boxes, classes, strict=True)
    ]


def _record(t_us: int, one: LabelledBox) -> tuple[float, ...]:
    box = one.box
    sides = box.x1 - box.x0, box.y1 - box.y0
    return (t_us, box.x0, box.y0, *sides, one.class_id, box.instance, 1.0)


def _write_item(file: IO[str], facts: Mapping[str, Any]) -> None:
    file.write((",\n" if file.tell() else "") + json.dumps(facts))
