"""A variant of a data set written in another layout, one event file per sample."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from texvent.dataset.contents.made_set import MadeSet, MadeShard
from texvent.dataset.contents.stored_events import read_events
from texvent.dataset.exporting.layouts import EVALUATION, Exported, Layout, find_layout, folder_name
from texvent.dataset.generation.records import SampleRecord
from texvent.errors import InputError, OutputError, one_line
from texvent.io.atomic import atomic_file
from texvent.io.files import save
from texvent.sensor import SensorSize

NOTE_FILE = "texvent-export.json"


@dataclass(frozen=True)
class Exports:
    """What was written."""

    samples: int
    kept: int
    """Of these, how many were there from an earlier run."""
    doubts: tuple[str, ...]
    """What the layout does not hold, and what its readers will not expect."""


def export(
    made: MadeSet,
    format: str,
    folder: Path,
    *,
    variant: str | None = None,
    on_sample: Callable[[SampleRecord], None] = lambda sample: None,
) -> Exports:
    """Write all samples of a variant; a second run goes on where the first was stopped.

    Args:
        made: the data set.
        format: name of a layout; `LAYOUTS` has them.
        folder: to write to; new, or of the same export.
        variant: which; None: the only one.
        on_sample: told of every sample.

    Raises:
        ConfigError: an unknown format.
        InputError: shards are missing, the layout needs classes, or cannot hold a sample.
        OutputError: the folder is of something else, or cannot be written.
    """
    layout, variant = find_layout(format), made.check_variant(variant)
    _check(made, layout, format, variant)
    _begin(made, format, folder, variant)
    exported, kept, labelled = [], 0, False
    for shard in made.shards(variant):
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
    return Exports(len(exported), kept, _doubts(made, layout, variant, labelled=labelled))


def _check(made: MadeSet, layout: Layout, format: str, variant: str) -> None:
    missing = made.missing(variant)
    if missing:
        raise InputError(
            f"{len(missing)} shards are missing, such as {missing[0]}; make them first (texvent "
            "dataset make)"
        )
    if layout.needs_classes and not made.labels:
        raise InputError(
            f"{format} has a folder for each class, and {made.name} has no classes; give its "
            "sources a label, or export to hdf5"
        )
    names: dict[str, str] = {}
    for label in made.labels if layout.needs_classes else ():
        other = names.setdefault(folder_name(label), label)
        if other != label:
            raise InputError(
                f"classes {other!r} and {label!r} would share the folder {folder_name(label)}; "
                "give one of them another name"
            )


def _begin(made: MadeSet, format: str, folder: Path, variant: str) -> None:
    """Note what the folder is, or see that it is the same export.

    Raises:
        OutputError: it is of something else.
    """
    note = {"format": format, "data_set": made.name, "variant": variant, "identity": made.identity}
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


def _write(shard: MadeShard, sample: SampleRecord, layout: Layout, path: Path) -> None:
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


def _doubts(made: MadeSet, layout: Layout, variant: str, *, labelled: bool) -> tuple[str, ...]:
    doubts = [f"it does not hold {layout.lost}"] if layout.lost else []
    if labelled and layout.format not in KEEP_NOISE:
        doubts.append("it does not hold which events are noise")
    evaluation = [split for split in made.splits if split in EVALUATION]
    if len(evaluation) > 1 and layout.has_two_splits:
        doubts.append(f"splits {' and '.join(evaluation)} are written as one")
    if layout.size is not None:
        sizes = {(one.width, one.height) for shard in made.shards(variant) for one in shard.samples}
        width, height = layout.size
        if sizes - {layout.size}:
            doubts.append(
                f"its readers may take {width}x{height} pixels for granted, and these are "
                f"{', '.join(f'{w}x{h}' for w, h in sorted(sizes))}"
            )
    return tuple(doubts)
