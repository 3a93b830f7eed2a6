"""MOT text: frame, id, left, top, width, height, confidence, class, ..., counted from 1.

An id or a class of -1 is none. A confidence of 0 marks a box that is not to be used. Classes are
called by their numbers. Source: Milan et al., MOT16, arXiv:1603.00831, Table 6.
"""

from __future__ import annotations

from pathlib import Path

from texvent.sensor import SensorSize
from texvent.truth.boxes import Label


def read_mot(path: Path, size: SensorSize) -> tuple[list[Label], set[int]]:
    """Labels and labelled frames of a file; see `read_labels`."""
    del size  # boxes are in pixels
    labels, frames = [], set()
    for line in filter(str.strip, path.read_text(encoding="ascii").splitlines()):
        frame, track, x, y, w, h, *more = map(float, line.split(","))
        confidence, kind = (*more, -1.0, -1.0)[:2]
        frames.add(int(frame) - 1)
        if confidence != 0:
            at = int(frame) - 1, max(int(track), 0), str(int(kind))
            labels.append(Label(*at, x - 1, y - 1, w, h))
    return labels, frames
