"""COCO JSON: `images` in the order of the frames, `annotations` with `bbox`, `categories`.

Where images have a `frame_id` (from 0, as in COCO-VID) it is the number of the frame. A `track_id`
or `instance_id` says which object a box is of. Crowds are left out.

Source: the COCO object detection format.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.sensor import SensorSize
from texvent.truth.labels.labels import Labels, make_labels


def read_coco(path: Path) -> Labels:
    """Labels of a COCO file.

    Raises:
        FileFormatError: it is no COCO file.
        InputError: no box, or one of a class or an image that the file does not name.
    """
    try:
        facts = json.loads(path.read_text(encoding="utf-8"))
        images, categories = facts["images"], facts["categories"]
        names = {int(one["id"]): str(one["name"]) for one in categories}
        frames = {
            int(image["id"]): int(image.get("frame_id", place))
            for place, image in enumerate(images)
        }
        sizes = {SensorSize(int(one["width"]), int(one["height"])) for one in images}
        places = {number: place for place, number in enumerate(names)}
        rows = [
            _row(path, one, frames, places)
            for one in facts["annotations"]
            if not one.get("iscrowd")
        ]
    except (OSError, ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        if isinstance(error, InputError):
            raise
        raise FileFormatError(f"{path} cannot be read as COCO JSON ({one_line(error)})") from error
    if len(sizes) > 1:
        found = ", ".join(map(str, sorted(sizes)))
        raise InputError(f"{path} labels images of {found}; those of a video have one size")
    size = next(iter(sizes), None)
    return make_labels(path, rows, tuple(names.values()), frames=set(frames.values()), size=size)


def _row(
    path: Path, one: Mapping[str, Any], frames: Mapping[int, int], places: Mapping[int, int]
) -> tuple[float, ...]:
    for what, known in (("category_id", places), ("image_id", frames)):
        if int(one[what]) not in known:
            raise InputError(
                f"{path}: annotation {shown(one.get('id'))} has {what} {shown(one[what])}, which "
                "the file does not name"
            )
    x, y, w, h = map(float, one["bbox"])
    track = int(one.get("track_id", one.get("instance_id", 0)))
    place, score = places[int(one["category_id"])], float(one.get("score", 1.0))
    return frames[int(one["image_id"])], x, y, w, h, place, track, score
