"""Boxes of objects as COCO JSON, and as the records of Prophesee's automotive data sets.

Written frame by frame: memory does not grow with the clip.

Source: the COCO object detection format; Prophesee's automotive dataset toolbox, whose label
files `*_bbox.npy` hold one record per box.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from itertools import count
from pathlib import Path
from typing import IO, Any

import numpy as np

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


class BoxFiles:
    """Open box files; use `open_boxes`."""

    def __init__(self, size: SensorSize, images: IO[str], annotations: IO[str], append: Any):
        self._size = size
        self._images, self._annotations, self._append = images, annotations, append
        self._numbers = count(1)

    def add(
        self,
        index: int,
        t_us: int,
        boxes: Sequence[Box],
        *,
        class_ids: Sequence[int],
        areas: Sequence[int],
    ) -> None:
        """Write the boxes of a frame.

        Args:
            index: of the frame, from 0.
            t_us: its time, µs.
            boxes: visible objects.
            class_ids: class of each.
            areas: visible pixels of each.
        """
        image = {
            "id": index,
            "file_name": f"{index:06d}.png",
            "width": self._size.width,
            "height": self._size.height,
            "t_us": t_us,
        }
        _write_item(self._images, image)
        records = []
        for box, class_id, area in zip(boxes, class_ids, areas, strict=True):
            sides = box.x1 - box.x0, box.y1 - box.y0
            facts = {
                "id": next(self._numbers),
                "image_id": index,
                "category_id": class_id,
                "bbox": [box.x0, box.y0, *sides],
                "area": area,
                "iscrowd": 0,
                "track_id": box.instance,
            }
            if not np.isnan(box.visibility):
                facts["visibility"] = box.visibility
            _write_item(self._annotations, facts)
            records.append((t_us, box.x0, box.y0, *sides, class_id, box.instance, 1.0))
        self._append(np.array(records, dtype=BOX_RECORD))


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


def _write_item(file: IO[str], facts: Mapping[str, Any]) -> None:
    file.write((",\n" if file.tell() else "") + json.dumps(facts))
