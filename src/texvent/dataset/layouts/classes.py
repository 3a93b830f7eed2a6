"""Classes of boxes: which names a layout numbers, and which classes of a data set each gathers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from texvent.dataset.layouts.boxes import Boxes
from texvent.errors import ConfigError, shown

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
            if not name or name in names or not all(gathered) or numbers.keys() & set(gathered):
                raise ConfigError(f"classes has {shown(entry)}, empty or there twice; {HELP}")
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
