"""Refusals of a layout before anything is written, and contents that it does not hold."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from texvent.dataset.generation.recipe import Recipe, load_recipe
from texvent.dataset.generation.shard_files import SampleRecord
from texvent.dataset.layouts.boxes import ClassList
from texvent.dataset.layouts.layout import Layout
from texvent.dataset.stored.folder import StoredDataset
from texvent.errors import InputError, few, shown
from texvent.runtime.files.file_names import MAX_NAME_BYTES

MOST_CLASSES = 255
"""Their numbers are stored in 8 bits."""


def check_layout(dataset: StoredDataset, layout: Layout, name: str, variant: str) -> None:
    """Refuse a data set that the layout called `name` cannot hold.

    Raises:
        InputError: shards are missing, there are no classes or no boxes, or samples are too short.
    """
    missing = dataset.missing(variant)
    if missing:
        raise InputError(
            f"{len(missing)} shards are missing, such as {missing[0]}; make them first (texvent "
            "dataset make)"
        )
    if layout.needs_classes and not dataset.labels:
        raise InputError(
            f"{name} has a folder for each class, and {dataset.name} has no classes; give its "
            "sources a label, or export to hdf5"
        )
    _check_labels(dataset, layout)
    if layout.most_classes is not None and len(dataset.labels) > layout.most_classes:
        raise InputError(
            f"layout {name} holds {layout.most_classes} classes, and {dataset.name} has "
            f"{len(dataset.labels)}; make a data set of fewer classes, or choose another layout"
        )
    for sample in _samples(dataset, variant):
        if layout.has_boxes and sample.boxes is None:
            raise InputError(
                f"layout {name} holds boxes, and sample {sample.key} has none; write truth = "
                '["boxes"] into the specification and make the data set again'
            )
        if sample.duration_us < layout.shortest_us:
            raise InputError(
                f"layout {name} has windows of {layout.shortest_us} µs, and sample {sample.key} "
                f"lasts {sample.duration_us} µs; make longer clips"
            )


def _samples(dataset: StoredDataset, variant: str) -> Iterator[SampleRecord]:
    return (sample for shard in dataset.shards(variant) for sample in shard.samples)


def _lacking(dataset: StoredDataset, layout: Layout, variant: str) -> Iterator[str]:
    """Splits without some class: readers that number the folders they find number them anew."""
    found: dict[str, set[str | None]] = {}
    for shard in dataset.shards(variant):
        labels = found.setdefault(layout.split_of(shard.record.split), set())
        labels |= {sample.label for sample in shard.samples}
    for split, labels in found.items():
        if gone := [label for label in dataset.labels if label not in labels]:
            yield f"split {split} has no {few(gone)}, so SpikingJelly numbers its classes otherwise"


def folder_name(label: str) -> str:
    """A class as the name of a folder.

    Raises:
        InputError: nothing of it can be one.

    Example:
        >>> folder_name("fire truck/red")
        'fire_truck_red'
    """
    name = re.sub(r"[^\w.-]+", "_", label).strip("._")
    if not name or len(name.encode()) > MAX_NAME_BYTES:
        raise InputError(f"class {shown(label)} cannot name a folder; give it another name")
    return name


def class_numbers(labels: Sequence[str], most: int | None = None) -> dict[str, int]:
    """Class → its number: what it says, where all are numbers below `most`, else its place.

    Example:
        >>> class_numbers(["3", "7"]), class_numbers(["3", "7"], 5), class_numbers(["cat", "dog"])
        ({'3': 3, '7': 7}, {'3': 0, '7': 1}, {'cat': 0, 'dog': 1})
    """
    if all(label.isdecimal() and str(int(label)) == label for label in labels):
        numbers = {label: int(label) for label in labels}
        if most is None or all(number < most for number in numbers.values()):
            return numbers
    return {label: place for place, label in enumerate(labels)}


def _check_labels(dataset: StoredDataset, layout: Layout) -> None:
    names: dict[str, str] = {}
    for label in dataset.labels if layout.names_classes else ():
        # Some file systems do not tell A from a.
        other = names.setdefault(folder_name(label).casefold(), label)
        if other != label:
            raise InputError(
                f"classes {other!r} and {label!r} would share the folder {folder_name(label)}; "
                "give one of them another name"
            )


def find_classes(
    dataset: StoredDataset, layout: Layout, name: str, variant: str, given: str | None
) -> ClassList:
    """The classes of an export: those given, the layout's own, or those of the data set.

    Raises:
        ConfigError: those given cannot be read.
        InputError: there is no box, none of a class given, or the layout has no class for some.
    """
    if not layout.has_boxes:
        return ClassList.of(())
    there = _count_boxes(dataset, variant)
    if not there:
        raise InputError(
            f"layout {name} holds boxes, and no sample shows {few(dataset.box_classes) or 'any'}"
        )
    if given is None and not layout.classes:
        listed = ClassList.of(dataset.box_classes or sorted(there))
    else:
        listed = ClassList.parse(layout.classes if given is None else given)
    others = [one for one in there if one not in listed.numbers]
    if given is None and layout.classes and others:
        raise InputError(
            f"layout {name} has no class for {few(sorted(others))}; choose with --classes, which "
            f'leaves out all others: --classes "{layout.classes}"'
        )
    if len(listed.names) > MOST_CLASSES:
        raise InputError(f"{len(listed.names)} classes; layouts hold {MOST_CLASSES}")
    if given is not None and len(others) == len(there):
        raise InputError(
            f"no box is of the classes {shown(given)}; boxes are of {few(sorted(there))}"
        )
    return listed


def _count_boxes(dataset: StoredDataset, variant: str) -> Counter[str]:
    """Class → its boxes."""
    counts: Counter[str] = Counter()
    for sample in _samples(dataset, variant):
        counts.update({label: sum(sizes) for label, sizes in (sample.boxes or {}).items()})
    return counts


def find_recipe(
    dataset: StoredDataset, layout: Layout, name: str
) -> tuple[Recipe | None, tuple[str, ...]]:
    """Recipe that the frames of the samples can be made of, or None and why, if that is to be said.

    Raises:
        InputError: the layout needs frames, and this folder cannot give them.
    """
    if not layout.takes_frames:
        return None, ()
    try:
        recipe = load_recipe(dataset.folder)
        for item in recipe.items.all:
            if item.video is not None and not Path(item.video).exists():
                raise InputError(f"its video {item.video} is not there")
    except InputError as error:
        if not layout.has_frames:
            return None, (f"it does not hold images: {error}",)
        raise InputError(f"layout {name} holds frames, which are made again: {error}") from error
    return recipe, ()


def doubts_of(
    dataset: StoredDataset, layout: Layout, variant: str, classes: ClassList
) -> tuple[str, ...]:
    """Contents of a variant that the layout does not hold, and surprises for its readers."""
    doubts = [f"it does not hold {layout.lost}"] if layout.lost else []
    if not layout.keeps_noise_labels and any(
        "label.npy" in sample.members for sample in _samples(dataset, variant)
    ):
        doubts.append("it does not hold which events are noise")
    if layout.numbers_classes:
        numbered = class_numbers(dataset.labels, layout.most_classes).items()
        doubts.append(f"its classes are {', '.join(f'{one} {name}' for name, one in numbered)}")
        doubts += _lacking(dataset, layout, variant)
    splits: dict[str, list[str]] = {}
    for split in dataset.splits:
        splits.setdefault(layout.split_of(split), []).append(split)
    doubts += [
        f"splits {' and '.join(one)} are written as one" for one in splits.values() if len(one) > 1
    ]
    sizes = {(one.width, one.height) for one in _samples(dataset, variant)}
    if layout.size is not None and sizes - {layout.size}:
        width, height = layout.size
        doubts.append(
            f"its readers may take {width}x{height} pixels for granted, and these are "
            f"{', '.join(f'{w}x{h}' for w, h in sorted(sizes))}"
        )
    others = [
        f"{label} ({number})"
        for label, number in sorted(_count_boxes(dataset, variant).items())
        if layout.has_boxes and label not in classes.numbers
    ]
    if others:
        doubts.append(f"boxes of other classes are left out: {few(others)}")
    return tuple(doubts)
