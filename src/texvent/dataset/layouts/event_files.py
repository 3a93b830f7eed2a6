"""Layouts of one event file per sample: hdf5, n-imagenet, n-caltech101."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from pathlib import Path

from texvent.dataset.layouts.layout import Layout, LayoutSample
from texvent.io.atomic import atomic_file
from texvent.io.files import save
from texvent.io.metadata import sidecar_path
from texvent.runtime.files.file_names import inside

EVALUATION = ("val", "valid", "validation", "test", "testing")
"""Names of splits that N-ImageNet knows as val."""


def _write(format: str, sample: LayoutSample, path: Path) -> bool:
    """Write the events in an event format; only hdf5 holds which are noise."""
    events = sample.read_events()
    save(path, events if format == "hdf5" else replace(events, label=None), format=format)
    return True


def _write_lists(
    name: str,
    folder: Path,
    samples: Iterable[LayoutSample],
    classes: tuple[str, ...],
    *,
    are_absolute: bool,
) -> None:
    """A text file per split that lists its samples; `name` has the {split}."""
    lists: dict[str, list[str]] = {}
    for sample in samples:
        place = str(folder.absolute() / sample.place) if are_absolute else sample.place
        lists.setdefault(sample.split, []).append(place)
    for split, places in lists.items():
        with atomic_file(inside(folder, name.format(split=split)), overwrite=True) as part:
            part.write_text("".join(f"{place}\n" for place in places), encoding="utf-8")


HDF5 = Layout(place="{split}/{key}.h5", write=partial(_write, "hdf5"), keeps_noise_labels=True)
N_IMAGENET = Layout(
    place="extracted_{split}/{label}/{key}.npz",
    write=partial(_write, "n-imagenet"),
    # Its loader opens the listed paths from anywhere.
    finish=partial(_write_lists, "{split}_list.txt", are_absolute=True),
    splits=dict.fromkeys(EVALUATION, "val"),
    size=(640, 480),
    lost="captions (its readers have classes alone)",
)
N_CALTECH101 = Layout(
    place="Caltech101/{label}/{key}.bin",
    write=partial(_write, "atis"),
    beside=sidecar_path,
    finish=partial(_write_lists, "{split}.txt", are_absolute=False),
    lost="captions, splits (lists beside it say them), sensors over 256x240, times from 8.39 s on",
)
