"""MOT text: frame, id, left, top, width, height, confidence, class, visibility; from 1.

Frames, ids and pixels count from 1; an id of -1 is none. A confidence of 0 marks a box that is not
to be used. Without a class, boxes are of pedestrians.

Source: the MOTChallenge formats of 2015 and 2016 (Milan et al., MOT16, arXiv:1603.00831, Table 6).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from texvent.errors import FileFormatError, InputError, one_line
from texvent.truth.labels.labels import Labels, make_labels

CLASSES = (
    "pedestrian", "person on vehicle", "car", "bicycle", "motorbike", "non motorized vehicle",
    "static person", "distractor", "occluder", "occluder on the ground", "occluder full",
    "reflection", "crowd",
)  # fmt: skip
"""Names of the classes 1, 2, ..."""
FEWEST, MOST = 6, 10
"""Columns; those that are not there are not known."""


def read_mot(path: Path) -> Labels:
    """Labels of a MOT file.

    Raises:
        FileFormatError: it is no MOT file.
        InputError: no box, or a class that MOT does not name.
    """
    try:
        table = np.loadtxt(path, delimiter=",", ndmin=2)
    except (OSError, ValueError) as error:
        raise FileFormatError(f"{path} cannot be read as MOT text ({one_line(error)})") from error
    if table.size and not FEWEST <= table.shape[1] <= MOST:
        raise FileFormatError(
            f"{path} has {table.shape[1]} columns; MOT's are frame, id, left, top, width, height, "
            "confidence, class, visibility"
        )
    rows: list[tuple[float, ...]] = []
    for line in table:
        frame, track, x, y, w, h, score, kind = np.pad(line, (0, MOST), constant_values=-1)[:8]
        if frame < 1 or frame != int(frame):
            raise InputError(f"{path} has a frame {frame:g}; MOT counts frames from 1")
        if kind > len(CLASSES) or kind != int(kind):
            raise InputError(f"{path} has a class {kind:g}; MOT has those of 1..{len(CLASSES)}")
        if score == 0:
            continue
        place, number = max(int(kind), 1) - 1, max(int(track), 0)
        confidence = score if 0 < score <= 1 else 1.0
        rows.append((frame - 1, x - 1, y - 1, w, h, place, number, confidence))
    return make_labels(path, rows, CLASSES)
