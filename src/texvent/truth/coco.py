"""COCO JSON written image by image: memory does not grow with their number.

Source: the COCO object detection format.
"""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

from texvent.sensor import SensorSize


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
