"""COCO JSON: `images` in the order of the frames, `annotations` with `bbox`, `categories`.

The `frame_id` of an image (from 0, as in COCO-VID) goes before its place. A `track_id` says which
object a box is of. Crowds are left out. Source: the COCO object detection format.
"""

from __future__ import annotations

import json
from pathlib import Path

from texvent.errors import InputError
from texvent.sensor import SensorSize
from texvent.truth.boxes import Label


def read_coco(path: Path, size: SensorSize) -> tuple[list[Label], set[int]]:
    """Labels and labelled frames of a file, for pictures of a size; see `read_labels`."""
    facts = json.loads(path.read_text(encoding="utf-8"))
    names = {one["id"]: str(one["name"]) for one in facts["categories"]}
    images = facts["images"]
    frames = {one["id"]: int(one.get("frame_id", place)) for place, one in enumerate(images)}
    for one in images:
        labelled = SensorSize(int(one["width"]), int(one["height"]))
        if labelled != size:
            raise InputError(
                f"{path} labels pictures of {labelled!s:.40}, and the video has {size}; give the "
                "video that was labelled"
            )
    labels = []
    for one in facts["annotations"]:
        for what, known in (("category_id", names), ("image_id", frames)):
            if one[what] not in known:
                raise InputError(f"{path}: {what} {one[what]!r:.40} of a box is not in its lists")
        if not one.get("iscrowd"):
            track, name = int(one.get("track_id", 0)), names[one["category_id"]]
            labels.append(Label(frames[one["image_id"]], track, name, *map(float, one["bbox"])))
    return labels, set(frames.values())
