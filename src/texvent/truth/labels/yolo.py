"""YOLO folder: a .txt for each labelled frame, lines `class cx cy w h` in shares of the picture.

The number at the end of a name is that of the frame, from 0 where one is 0, else from 1. Classes
are called by their numbers. Source: the label format of Darknet and Ultralytics.
"""

from __future__ import annotations

import re
from pathlib import Path

from texvent.sensor import SensorSize
from texvent.truth.boxes import Label


def read_yolo(path: Path, size: SensorSize) -> tuple[list[Label], set[int]]:
    """Labels and labelled frames of a folder, for pictures of a size; see `read_labels`."""
    numbered = ((re.search(r"(\d+)\.txt$", one.name), one) for one in sorted(path.iterdir()))
    files = {int(number[1]): one for number, one in numbered if number is not None}
    first = min(1, *files, 1)
    labels = []
    for number, one in files.items():
        for line in filter(str.strip, one.read_text(encoding="ascii").splitlines()):
            kind, cx, cy, w, h = map(float, line.split()[:5])
            corner = (cx - w / 2) * size.width, (cy - h / 2) * size.height
            sides = w * size.width, h * size.height
            labels.append(Label(number - first, 0, str(int(kind)), *corner, *sides))
    return labels, {number - first for number in files}
