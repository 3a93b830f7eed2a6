"""Export: a variant in another layout, sample by sample."""

from __future__ import annotations

import shutil
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from texvent._registry import suggest
from texvent._version import full_version
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.generation.shard_files import SampleRecord
from texvent.dataset.layouts.boxes import ClassList
from texvent.dataset.layouts.checks import (
    check_layout,
    class_numbers,
    doubts_of,
    find_classes,
    find_recipe,
    folder_name,
)
from texvent.dataset.layouts.coco import COCO
from texvent.dataset.layouts.driving import DSEC_DET, GEN1, MEGAPIXEL
from texvent.dataset.layouts.event_files import DVS_GESTURE, HDF5, N_CALTECH101, N_IMAGENET, N_MNIST
from texvent.dataset.layouts.frames import TIMELENS, clip_frames
from texvent.dataset.layouts.layout import Layout, LayoutSample
from texvent.dataset.layouts.rvt import RVT
from texvent.dataset.stored.folder import StoredDataset, StoredShard
from texvent.errors import ConfigError, OutputError, one_line, shown
from texvent.run.ledger import Ledger, describe_differences, read_note, write_note
from texvent.runtime.files.file_names import inside
from texvent.runtime.files.hidden_parts import is_hidden_part
from texvent.truth.boxes import BOX_RECORD

LAYOUTS: Mapping[str, Layout] = {
    "hdf5": HDF5,
    "n-imagenet": N_IMAGENET,
    "n-caltech101": N_CALTECH101,
    "n-mnist": N_MNIST,
    "dvs-gesture": DVS_GESTURE,
    "gen1": GEN1,
    "1mpx": MEGAPIXEL,
    "rvt": RVT,
    "dsec-det": DSEC_DET,
    "coco": COCO,
    "timelens": TIMELENS,
}


def find_layout(name: str) -> Layout:
    """The layout of that name.

    Raises:
        ConfigError: there is none.
    """
    if name not in LAYOUTS:
        raise ConfigError(f"unknown layout {shown(name)}; {suggest(name, tuple(LAYOUTS))}")
    return LAYOUTS[name]


NOTE_FILE, LEDGER_FILE = "texvent-export.json", "texvent-export.jsonl"
REMEDY = "name a new folder with -o"
"""Advice about a folder that cannot go on."""


@dataclass(frozen=True)
class Exports:
    """Counts of an export."""

    samples: int
    kept: int
    """Samples of an earlier run among these."""
    classes: tuple[str, ...]
    """Classes of boxes in the order of their numbers."""
    doubts: tuple[str, ...]
    """Content that the layout does not hold, and surprises for its readers."""


def export(
    dataset: StoredDataset,
    layout: str,
    folder: Path,
    *,
    variant: str | None = None,
    classes: str | None = None,
) -> Exports:
    """Write all samples of a variant; a second run resumes where the first was stopped.

    Args:
        dataset: the data set.
        layout: its name; `LAYOUTS` has them.
        folder: to write to; new, or of the same export.
        variant: which; None: the only one.
        classes: of boxes, as `ClassList.parse` reads them; None: the layout's own, else those of
            the data set.

    Raises:
        ConfigError: an unknown layout, or classes that cannot be read.
        InputError: shards are missing, the layout needs classes, boxes or frames that are not
            there, or cannot hold a sample.
        OutputError: the folder is of something else, or cannot be written.
    """
    chosen, variant = find_layout(layout), dataset.check_variant(variant)
    check_layout(dataset, chosen, layout, variant)
    if classes is not None and not chosen.has_boxes:
        raise ConfigError(f"classes are those of boxes, and layout {layout} holds none")
    listed = find_classes(dataset, chosen, layout, variant, classes)
    recipe, no_frames = find_recipe(dataset, chosen, layout)
    _begin(dataset, layout, folder, variant, listed)
    ledger = Ledger(folder / LEDGER_FILE, remedy=REMEDY)
    samples = partial(_samples, dataset, chosen, variant, listed, recipe)
    ledger.write()
    written, kept, empty, others = 0, 0, 0, {*ledger}
    for sample in samples():
        others.discard(sample.place)
        if ledger.is_complete(sample.place) and ledger.row(sample.place)["of"] == sample.made_of:
            kept += 1
        elif not _write(chosen, sample, folder, ledger):
            empty += 1
            continue
        written += 1
    for place in others:  # of samples that the data set no longer has
        _remove(chosen.files_of(inside(folder, place)))
    ledger.forget(others)
    ledger.write()
    chosen.finish(folder, (one for one in samples() if (folder / one.place).exists()), listed.names)
    doubts = (*no_frames, *doubts_of(dataset, chosen, variant, listed))
    if empty:
        doubts += (f"{empty} samples show no box and are left out; its readers want one",)
    return Exports(written, kept, listed.names, doubts)


def _samples(
    dataset: StoredDataset, layout: Layout, variant: str, classes: ClassList, recipe: Recipe | None
) -> Iterator[LayoutSample]:
    numbers = class_numbers(dataset.labels, layout.most_classes)
    for shard in dataset.shards(variant):
        for sample in shard.samples:
            number = numbers.get(sample.label or "", 0)
            yield _layout_sample(shard, sample, layout, number, classes, recipe)


def _layout_sample(
    shard: StoredShard,
    sample: SampleRecord,
    layout: Layout,
    number: int,
    classes: ClassList,
    recipe: Recipe | None,
) -> LayoutSample:
    split, files = layout.split_of(shard.record.split), shard.files(sample)
    label = folder_name(sample.label or "") if layout.names_classes else ""
    boxes, instants = np.empty(0, BOX_RECORD), np.empty(0, np.int64)
    if layout.has_boxes:
        truth = files.truth()
        boxes, instants = classes.renumbered(truth.boxes, truth.classes), truth.box_times_us
    return LayoutSample(
        key=sample.key,
        split=split,
        place=layout.place.format(
            split=split,
            folder=layout.folders.get(split, split),
            label=label,
            number=number,
            key=sample.key,
        ),
        size=files.size,
        start_us=sample.start_us,
        stop_us=sample.start_us + sample.duration_us,
        boxes=boxes,
        instants_us=instants,
        made_of=shard.record.sha256,
        read_events=files.events,
        read_frames=None if recipe is None else partial(clip_frames, recipe, shard, sample),
    )


def _write(layout: Layout, sample: LayoutSample, folder: Path, ledger: Ledger) -> bool:
    """Write a sample in place of what is there; False if the layout cannot hold it."""
    path = inside(folder, sample.place)
    files = layout.files_of(path)
    _remove(files)
    path.parent.mkdir(parents=True, exist_ok=True)
    is_written = layout.write(sample, path)
    if is_written:
        ledger.add(sample.place, files, of=sample.made_of)
    return is_written


def _remove(files: Iterable[Path]) -> None:
    for one in files:
        shutil.rmtree(one) if one.is_dir() else one.unlink(missing_ok=True)


def _begin(
    dataset: StoredDataset, layout: str, folder: Path, variant: str, classes: ClassList
) -> None:
    """Note what the folder is, or see that it is the same export.

    Raises:
        OutputError: it is of something else.
        FileFormatError: its note is damaged.
    """
    kind = LAYOUTS[layout]
    first, labels = kind.first_class, dataset.labels if kind.numbers_classes else ()
    numbers = class_numbers(labels, kind.most_classes)
    note = {
        "texvent_version": full_version(),
        "layout": layout,
        "data_set": dataset.name,
        "variant": variant,
        "identity": dataset.identity,
        "classes": list(classes.names),
        "class_numbers": {
            **{name: first + one for name, one in classes.numbers.items()},
            **numbers,
        },
    }
    try:
        before = read_note(folder / NOTE_FILE, remedy=REMEDY)
        if before == note:
            return
        if before is not None:
            change = describe_differences(before, note)
            raise OutputError(f"{folder} is another export: {change}; {REMEDY}")
        found = folder.iterdir() if folder.exists() else ()
        if not all(map(is_hidden_part, found)):  # a part is all that a kill before the note leaves
            raise OutputError(f"{folder} holds something else; {REMEDY}")
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot go on in {folder} ({one_line(error)}); {REMEDY}") from error
    write_note(folder / NOTE_FILE, note)
