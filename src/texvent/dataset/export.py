"""Export: a variant in another layout, one event file per sample."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from texvent._registry import suggest
from texvent.dataset.generation.shards import SampleRecord
from texvent.dataset.reading.stored_dataset import StoredDataset, StoredShard
from texvent.dataset.reading.stored_events import read_events
from texvent.errors import ConfigError, InputError, OutputError, one_line, shown
from texvent.io.atomic import atomic_file
from texvent.io.files import save

EVALUATION = ("val", "valid", "validation", "test", "testing")
"""Names of splits that N-ImageNet knows as val."""


@dataclass(frozen=True, kw_only=True)
class Layout:
    """Layout of an exported data set."""

    format: str
    """Name of the codec of event files."""
    place: str
    """Path of a sample in the exported folder, of its {split}, {label} and {key}."""
    list_file: str = ""
    """Name of a file, of the {split}, that lists the samples of each split; "": none."""
    lists_absolute: bool = False
    """Whether the lists hold absolute paths: the layout's loader opens them from anywhere."""
    has_two_splits: bool = False
    """Whether all splits of `EVALUATION` become val."""
    size: tuple[int, int] | None = None
    """Width and height that its readers take for granted, pixels."""
    lost: str = ""
    """Content that the layout cannot hold."""

    @property
    def needs_classes(self) -> bool:
        """True if each class has a folder."""
        return "{label}" in self.place

    def split_of(self, split: str) -> str:
        """The layout's name of a split."""
        return "val" if self.has_two_splits and split in EVALUATION else split


LAYOUTS: Mapping[str, Layout] = {
    "hdf5": Layout(format="hdf5", place="{split}/{key}.h5"),
    "n-imagenet": Layout(
        format="n-imagenet",
        place="extracted_{split}/{label}/{key}.npz",
        list_file="{split}_list.txt",
        lists_absolute=True,
        has_two_splits=True,
        size=(640, 480),
        lost="captions (its readers have classes alone)",
    ),
    "n-caltech101": Layout(
        format="atis",
        place="Caltech101/{label}/{key}.bin",
        list_file="{split}.txt",
        lost="captions, splits (lists beside it say them), sensors over 256x240, times from "
        "8.39 s on",
    ),
}


def folder_name(label: str) -> str:
    """A class as the name of a folder.

    Raises:
        InputError: nothing of it can be one.

    Example:
        >>> folder_name("fire truck/red")
        'fire_truck_red'
    """
    name = re.sub(r"[^\w.-]+", "_", label).strip("._")
    if not name:
        raise InputError(f"class {shown(label)} cannot name a folder; give it another name")
    return name


def find_layout(name: str) -> Layout:
    """The layout of that name.

    Raises:
        ConfigError: there is none.
    """
    if name not in LAYOUTS:
        raise ConfigError(f"unknown format {shown(name)}; {suggest(name, tuple(LAYOUTS))}")
    return LAYOUTS[name]


NOTE_FILE = "texvent-export.json"


@dataclass(frozen=True)
class Exports:
    """Counts of an export."""

    samples: int
    kept: int
    """Samples of an earlier run among these."""
    doubts: tuple[str, ...]
    """Content that the layout does not hold, and surprises for its readers."""


def export(
    dataset: StoredDataset,
    format: str,
    folder: Path,
    *,
    variant: str | None = None,
) -> Exports:
    """Write all samples of a variant; a second run goes on where the first was stopped.

    Args:
        dataset: the data set.
        format: name of a layout; `LAYOUTS` has them.
        folder: to write to; new, or of the same export.
        variant: which; None: the only one.

    Raises:
        ConfigError: an unknown format.
        InputError: shards are missing, the layout needs classes, or cannot hold a sample.
        OutputError: the folder is of something else, or cannot be written.
    """
    layout, variant = find_layout(format), dataset.check_variant(variant)
    _check(dataset, layout, format, variant)
    _begin(dataset, format, folder, variant)
    lists: dict[str, list[str]] = {layout.split_of(split): [] for split in dataset.splits}
    samples, kept, labelled = 0, 0, False
    for shard in dataset.shards(variant):
        split = layout.split_of(shard.record.split)
        for sample in shard.samples:
            label = folder_name(sample.label or "") if layout.needs_classes else ""
            place = layout.place.format(split=split, label=label, key=sample.key)
            lists[split].append(str(folder.absolute() / place) if layout.lists_absolute else place)
            labelled = labelled or "label.npy" in sample.members
            if (folder / place).exists():
                kept += 1
            else:
                _write(shard, sample, layout, folder / place)
            samples += 1
    for split, places in lists.items() if layout.list_file else ():
        path = folder / layout.list_file.format(split=split)
        with atomic_file(path, overwrite=True) as part:
            part.write_text("".join(f"{place}\n" for place in places), encoding="utf-8")
    return Exports(samples, kept, _doubts(dataset, layout, variant, labelled=labelled))


def _check(dataset: StoredDataset, layout: Layout, format: str, variant: str) -> None:
    missing = dataset.missing(variant)
    if missing:
        raise InputError(
            f"{len(missing)} shards are missing, such as {missing[0]}; make them first (texvent "
            "dataset make)"
        )
    if layout.needs_classes and not dataset.labels:
        raise InputError(
            f"{format} has a folder for each class, and {dataset.name} has no classes; give its "
            "sources a label, or export to hdf5"
        )
    names: dict[str, str] = {}
    for label in dataset.labels if layout.needs_classes else ():
        other = names.setdefault(folder_name(label), label)
        if other != label:
            raise InputError(
                f"classes {other!r} and {label!r} would share the folder {folder_name(label)}; "
                "give one of them another name"
            )


def _begin(dataset: StoredDataset, format: str, folder: Path, variant: str) -> None:
    """Note what the folder is, or see that it is the same export.

    Raises:
        OutputError: it is of something else.
    """
    note = {
        "format": format,
        "data_set": dataset.name,
        "variant": variant,
        "identity": dataset.identity,
    }
    path = folder / NOTE_FILE
    try:
        if path.is_file() and json.loads(path.read_text("utf-8")) == note:
            return
        if folder.exists() and any(folder.iterdir()):
            raise OutputError(f"{folder} holds something else; name a new folder with -o")
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        raise OutputError(f"cannot write to {folder} ({one_line(error)})") from error
    with atomic_file(path, overwrite=True) as part:
        part.write_text(json.dumps(note, indent=1) + "\n", encoding="utf-8")


def _write(shard: StoredShard, sample: SampleRecord, layout: Layout, path: Path) -> None:
    events = read_events(shard.path, sample)
    if layout.format != "hdf5":
        events = replace(events, label=None)
    path.parent.mkdir(parents=True, exist_ok=True)
    save(path, events, format=layout.format)


def _doubts(
    dataset: StoredDataset, layout: Layout, variant: str, *, labelled: bool
) -> tuple[str, ...]:
    doubts = [f"it does not hold {layout.lost}"] if layout.lost else []
    if labelled and layout.format != "hdf5":
        doubts.append("it does not hold which events are noise")
    evaluation = [split for split in dataset.splits if split in EVALUATION]
    if len(evaluation) > 1 and layout.has_two_splits:
        doubts.append(f"splits {' and '.join(evaluation)} are written as one")
    if layout.size is not None:
        sizes = {
            (one.width, one.height) for shard in dataset.shards(variant) for one in shard.samples
        }
        width, height = layout.size
        if sizes - {layout.size}:
            doubts.append(
                f"its readers may take {width}x{height} pixels for granted, and these are "
                f"{', '.join(f'{w}x{h}' for w, h in sorted(sizes))}"
            )
    return tuple(doubts)
