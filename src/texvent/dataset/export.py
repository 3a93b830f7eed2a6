"""Export: a variant in another layout, one event file per sample."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from texvent._registry import suggest
from texvent.dataset.generation.shards import SampleRecord
from texvent.dataset.reading.stored_dataset import StoredDataset, StoredShard
from texvent.dataset.reading.stored_events import read_events
from texvent.errors import ConfigError, InputError, OutputError, one_line, shown
from texvent.io.atomic import atomic_file
from texvent.io.files import save
from texvent.sensor import SensorSize

Files = Mapping[str, str]
"""Path in the exported folder → content."""
EVALUATION = ("val", "valid", "validation", "test", "testing")
"""Names of splits that N-ImageNet and DSEC know under one name only."""


@dataclass(frozen=True)
class Exported:
    """A sample that was written."""

    path: Path
    """In the exported folder."""
    split: str
    label: str | None


@dataclass(frozen=True, kw_only=True)
class Layout:
    """Layout of an exported data set."""

    format: str
    """Name of the codec of event files."""
    place: Callable[[str, str | None, str], Path]
    """Split, class and key of a sample → its path in the exported folder."""
    lists: Callable[[Path, list[Exported]], Files] = lambda folder, exported: {}
    """Exported folder and what is in it → further files."""
    needs_classes: bool = False
    has_two_splits: bool = False
    """Whether all splits of `EVALUATION` become one."""
    size: tuple[int, int] | None = None
    """Width and height that its readers take for granted, pixels."""
    lost: str = ""
    """Content that the layout cannot hold."""


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


def _train_or(name: str, split: str) -> str:
    """The two splits of others; further ones keep their names."""
    if split == "train":
        return "train"
    return name if split in EVALUATION else split


def _n_imagenet(split: str, label: str | None, key: str) -> Path:
    folder = f"extracted_{_train_or('val', split)}"
    return Path(folder) / folder_name(label or "") / f"{key}.npz"


def _n_imagenet_lists(folder: Path, exported: list[Exported]) -> Files:
    """Absolute paths, as its own lists have them: its loader opens them from anywhere."""
    lines: dict[str, list[str]] = {"train": [], "val": []}
    for one in exported:
        lines.setdefault(_train_or("val", one.split), []).append(str(folder / one.path))
    return {f"{name}_list.txt": "".join(f"{line}\n" for line in lines[name]) for name in lines}


def _n_caltech101(split: str, label: str | None, key: str) -> Path:
    return Path("Caltech101") / folder_name(label or "") / f"{key}.bin"


def _split_lists(folder: Path, exported: list[Exported]) -> Files:
    """The layout has no splits, so lists beside it say them."""
    lines: dict[str, list[str]] = {}
    for one in exported:
        lines.setdefault(one.split, []).append(str(one.path))
    return {f"{split}.txt": "".join(f"{line}\n" for line in lines[split]) for split in lines}


LAYOUTS: Mapping[str, Layout] = {
    "hdf5": Layout(format="hdf5", place=lambda split, label, key: Path(split) / f"{key}.h5"),
    "n-imagenet": Layout(
        format="n-imagenet",
        place=_n_imagenet,
        has_two_splits=True,
        lists=_n_imagenet_lists,
        needs_classes=True,
        size=(640, 480),
        lost="captions (its readers have classes alone)",
    ),
    "dsec": Layout(
        format="dsec",
        has_two_splits=True,
        place=lambda split, label, key: (
            Path(_train_or("test", split)) / key / "events" / "left" / "events.h5"
        ),
        size=(640, 480),
        lost="captions and classes; there is one camera, and no images, disparity or flow",
    ),
    "n-caltech101": Layout(
        format="atis",
        place=_n_caltech101,
        lists=_split_lists,
        needs_classes=True,
        lost="captions, splits (lists beside it say them), sensors over 256x240, times from "
        "8.39 s on",
    ),
}


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
    on_sample: Callable[[SampleRecord], None] = lambda sample: None,
) -> Exports:
    """Write all samples of a variant; a second run goes on where the first was stopped.

    Args:
        dataset: the data set.
        format: name of a layout; `LAYOUTS` has them.
        folder: to write to; new, or of the same export.
        variant: which; None: the only one.
        on_sample: called for every sample.

    Raises:
        ConfigError: an unknown format.
        InputError: shards are missing, the layout needs classes, or cannot hold a sample.
        OutputError: the folder is of something else, or cannot be written.
    """
    layout, variant = find_layout(format), dataset.check_variant(variant)
    _check(dataset, layout, format, variant)
    _begin(dataset, format, folder, variant)
    exported, kept, labelled = [], 0, False
    for shard in dataset.shards(variant):
        for sample in shard.samples:
            path = layout.place(shard.record.split, sample.label, sample.key)
            labelled = labelled or "label.npy" in sample.members
            if (folder / path).exists():
                kept += 1
            else:
                _write(shard, sample, layout, folder / path)
            exported.append(Exported(path, shard.record.split, sample.label))
            on_sample(sample)
    for name, text in layout.lists(folder.absolute(), exported).items():
        with atomic_file(folder / name, overwrite=True) as part:
            part.write_text(text, encoding="utf-8")
    return Exports(len(exported), kept, _doubts(dataset, layout, variant, labelled=labelled))


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
    if layout.format not in KEEP_NOISE:
        events = replace(events, label=None)
    path.parent.mkdir(parents=True, exist_ok=True)
    save(path, events, format=layout.format)
    if layout.format == "dsec":
        _write_identity_map(path.with_name("rectify_map.h5"), events.size)


KEEP_NOISE = ("hdf5", "dsec")
"""Codecs that store which events are noise."""


def _write_identity_map(path: Path, size: SensorSize) -> None:
    """DSEC's map from pixels to rectified ones; a simulated lens has no distortion."""
    import h5py

    columns, rows = np.meshgrid(
        np.arange(size.width, dtype=np.float32), np.arange(size.height, dtype=np.float32)
    )
    # Through an open file: HDF5 cannot lock what atomic_file has locked.
    with (
        atomic_file(path, overwrite=True) as part,
        part.open("wb") as place,
        h5py.File(place, "w") as file,
    ):
        file.create_dataset("rectify_map", data=np.stack([columns, rows], axis=-1))


def _doubts(
    dataset: StoredDataset, layout: Layout, variant: str, *, labelled: bool
) -> tuple[str, ...]:
    doubts = [f"it does not hold {layout.lost}"] if layout.lost else []
    if labelled and layout.format not in KEEP_NOISE:
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
