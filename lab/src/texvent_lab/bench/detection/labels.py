"""Boxes of a real recording, labelled by hand: the street of the data set `davis346`.

The labels are COCO JSON; its "info" says how they were made and how exact they are. The recording
itself is fetched by name: `texvent data pull davis346`.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from itertools import groupby
from operator import itemgetter
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.truth.boxes import BOX_RECORD

STREET = Path(__file__).with_name("davis346_street.json")
CLASSES = ("car", "pedestrian")
"""Classes of the labelled boxes."""
COUNTED, IGNORED = 1.0, 0.0
"""Confidence of labelled boxes: a detector has to find it; it may, and is not asked to."""


def read_street_labels(classes: Sequence[str] = CLASSES) -> NDArray[np.void]:
    """Labelled boxes of every frame of the street, by time, then track.

    Cars that drive in the light are counted. Those parked or in deep shade, and pedestrians, who
    are too slow and too small to give events, are ignored.

    Args:
        classes: of a detector; those that the street has are labelled.

    Returns:
        `BOX_RECORD` [N]: `t` on the clock of the events, `class_id` the place in `classes`,
        `class_confidence` `COUNTED` or `IGNORED`.
    """
    coco = json.loads(STREET.read_text(encoding="ascii"))
    names = {category["id"]: category["name"] for category in coco["categories"]}
    times_us = np.array([image["t_us"] for image in coco["images"]])
    tracks = []
    for number, group in groupby(coco["annotations"], key=itemgetter("track_id")):
        keys = list(group)
        name = names[keys[0]["category_id"]]
        if name not in classes:
            continue
        at = [key["image_id"] for key in keys]
        frames = np.arange(at[0], at[-1] + 1)
        boxes = np.zeros(len(frames), dtype=BOX_RECORD)
        boxes["t"], boxes["class_id"] = times_us[frames], classes.index(name)
        boxes["track_id"] = number
        for side, values in zip("xywh", np.array([key["bbox"] for key in keys]).T, strict=True):
            boxes[side] = np.interp(frames, at, values)
        is_counted = np.array([key["moving"] and not key["iscrowd"] for key in keys])
        before = np.searchsorted(at, frames, "right") - 1
        boxes["class_confidence"] = np.where(is_counted[before], COUNTED, IGNORED)
        tracks.append(boxes)
    return np.sort(np.concatenate([np.zeros(0, BOX_RECORD), *tracks]), order=["t", "track_id"])
