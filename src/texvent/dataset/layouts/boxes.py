"""Boxes as a layout wants them: at its instants, and as its records."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Boxes = NDArray[Any]
"""Records of `texvent.truth.boxes.BOX_RECORD` in time order."""
LABEL_RECORD = np.dtype(
    [
        *[("t", "<u8"), ("x", "<f4"), ("y", "<f4"), ("w", "<f4"), ("h", "<f4")],
        *[("class_id", "u1"), ("class_confidence", "<f4"), ("track_id", "<u4")],
    ]
)
"""As in the files of Prophesee's data sets."""
LONGEST_GAP_US = 100_000
"""Boxes are not moved between instants further apart than this."""
REACH_US = 25_000
"""Where boxes are not moved, they hold this long before and after their instant."""


def boxes_at(boxes: Boxes, instants_us: NDArray[np.int64], t_us: int) -> Boxes | None:
    """Boxes at any instant: those of the nearest labelled one, moved along their tracks.

    A track that is known on both sides moves in a straight line; one that comes or goes in between
    stays at its nearest place.

    Args:
        boxes: those of all labelled instants.
        instants_us: the labelled instants, also those without a box, µs, increasing.
        t_us: the instant.

    Returns:
        Its boxes, with this time, or None where they are not known: the labelled instants around
        it are more than `LONGEST_GAP_US` apart or one is missing, and none is within `REACH_US`.
    """
    place = int(np.searchsorted(instants_us, t_us))
    around = instants_us[max(place - 1, 0) : place + 1]
    if not len(around):
        return None
    near_us, far_us = sorted(map(int, around[[0, -1]]), key=lambda one: abs(one - t_us))
    found = _labelled(boxes, near_us)
    if far_us != near_us and abs(far_us - near_us) <= LONGEST_GAP_US:
        share = (t_us - near_us) / (far_us - near_us)
        found = _moved(found, _labelled(boxes, far_us), share)
    elif abs(near_us - t_us) > REACH_US:
        return None
    found["t"] = t_us
    return found


def _labelled(boxes: Boxes, t_us: int) -> Boxes:
    start, stop = np.searchsorted(boxes["t"], (t_us, t_us + 1))
    return boxes[start:stop].copy()


def _moved(near: Boxes, far: Boxes, share: float) -> Boxes:
    """Boxes moved a share of the way; as they are where tracks do not tell them apart."""
    if any(len(np.unique(one["track_id"])) < len(one) for one in (near, far)):
        return near
    _, own, others = np.intersect1d(near["track_id"], far["track_id"], return_indices=True)
    for side in ("x", "y", "w", "h"):
        near[side][own] += share * (far[side][others] - near[side][own])
    return near


def records_of(boxes: Boxes, dtype: np.dtype[np.void]) -> NDArray[np.void]:
    """The boxes as records of another order or type, by the names of their fields."""
    records = np.empty(len(boxes), dtype)
    for name in dtype.names or ():
        records[name] = boxes[name]
    return records
