"""Boxes as a layout wants them: at its instants, as its records, and in its classes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, InputError, shown

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
"""Time before and after its instant for which a box that is not moved holds, µs."""


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
    """The boxes as records of another order or type, by the names of their fields.

    Raises:
        InputError: their times cannot be held.
    """
    if len(boxes) and dtype["t"].kind == "u" and boxes["t"].min() < 0:
        raise InputError(
            f"a box at {boxes['t'].min()} µs cannot be held, for times of the layout begin at 0; "
            "let its video begin there"
        )
    records = np.empty(len(boxes), dtype)
    for name in dtype.names or ():
        records[name] = boxes[name]
    return records


HELP = "give names with commas, and what a name gathers where it is not usual: vehicle=car+bus,man"
GATHERED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "car": ("suv", "taxi", "police car", "van", "pickup"),
        "pedestrian": ("person", "man", "woman", "child", "runner", "worker"),
        "rider": ("cyclist", "motorcyclist"),
        "traffic sign": ("sign",),
        "truck": ("fire engine",),
        "two wheeler": ("bicycle", "motorcycle", "cyclist", "motorcyclist"),
    }
)
"""Name in automotive data sets → nouns that they count under it."""


@dataclass(frozen=True)
class ClassList:
    """Names in the order of their numbers."""

    names: tuple[str, ...]
    numbers: Mapping[str, int]
    """Class of the data set → number of its name, from 0."""

    @classmethod
    def of(cls, names: Iterable[str]) -> ClassList:
        """A list whose names gather nothing."""
        listed = tuple(names)
        return cls(listed, {name: number for number, name in enumerate(listed)})

    @classmethod
    def parse(cls, text: str) -> ClassList:
        """A list such as "car,vehicle=bus+truck"; `GATHERED` says what a name alone gathers.

        Raises:
            ConfigError: a name or class is empty, or there twice.

        Example:
            >>> ClassList.parse("car=car+taxi,rider").numbers
            {'car': 0, 'taxi': 0, 'rider': 1, 'cyclist': 1, 'motorcyclist': 1}
        """
        names: list[str] = []
        usual: list[str] = []
        numbers: dict[str, int] = {}
        for entry in text.split(","):
            name, has_classes, classes = (part.strip() for part in entry.partition("="))
            gathered = [one.strip() for one in classes.split("+")] if has_classes else [name]
            again = [name] if name in names else sorted(numbers.keys() & set(gathered))
            if not name or not all(gathered) or again:
                wrong = f"{shown(again[0])} twice" if again else "nothing after = or around +"
                wrong = wrong if name else "an entry without a name"
                raise ConfigError(f"classes has {wrong}, in {shown(text)}; {HELP}")
            numbers |= dict.fromkeys(gathered, len(names))
            if not has_classes:
                usual.append(name)
            names.append(name)
        for name in usual:
            for one in GATHERED.get(name, ()):
                numbers.setdefault(one, names.index(name))
        return cls(tuple(names), numbers)

    def renumbered(self, boxes: Boxes, classes: Mapping[int, str]) -> Boxes:
        """Boxes with the numbers of this list; those of other classes are left out.

        Args:
            boxes: `class_id` is a key of `classes`.
            classes: class id → name.
        """
        numbers = [self.numbers.get(classes.get(one, ""), -1) for one in boxes["class_id"].tolist()]
        found = np.array(numbers, np.int64)
        kept = boxes[found >= 0].copy()
        kept["class_id"] = found[found >= 0]
        return kept
