"""Layouts of a file or two per sample: hdf5, n-imagenet, n-caltech101, n-mnist, dvs-gesture.

The last two are data sets that spiking networks are trained on. Each of their samples is written
twice, for the loaders of two libraries, which take the exported folder:

    n-mnist      NMNIST/Train/3/KEY.bin   tonic.datasets.NMNIST: five bytes an event
    dvs-gesture  DVSGesture/ibmGestureTrain/user0_KEY/3.npy
                                                           tonic.datasets.DVSGesture, [n, 4]: x, y,
                                                           p, t in ms
    both         events_np/train/3/KEY.npz                 spikingjelly.datasets, columns t, x, y, p

where 3 is the number of the class. Tonic multiplies times by 1000 and cuts off what is below a µs,
so a quarter of a µs is added, and they come out as they were.

Source: tonic 1.7 and SpikingJelly 2.0, their loaders.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from texvent.dataset.layouts.layout import Layout, LayoutSample
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.atis import MAX_SIZE, STOP_US, encode_records
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


PARSED_US = 0.25
LOST = "captions, validation beside test (its readers have train and test)"
TO_TEST = dict.fromkeys(EVALUATION, "test")


def _beside_nmnist(path: Path) -> Path:
    split, number = path.parts[-3].lower(), path.parts[-2]
    return path.parents[3] / "events_np" / split / number / f"{path.stem}.npz"


def _beside_gesture(path: Path) -> Path:
    split, key = path.parts[-3].removeprefix("ibmGesture").lower(), path.parts[-2].split("_", 1)[1]
    return path.parents[3] / "events_np" / split / path.stem / f"{key}.npz"


def _write_nmnist(sample: LayoutSample, path: Path) -> bool:
    events = sample.read_events()
    size = events.size
    if size.width > MAX_SIZE.width or size.height > MAX_SIZE.height or events.t[-1:] >= STOP_US:
        raise InputError(
            f"cannot write {path}: n-mnist holds sensors up to {MAX_SIZE} and times below "
            f"{STOP_US} µs; choose another layout"
        )
    with atomic_file(path, overwrite=True) as part:
        part.write_bytes(encode_records(events.columns()))
    return _write_columns(events, _beside_nmnist(path))


def _write_gesture(sample: LayoutSample, path: Path) -> bool:
    events = sample.read_events()
    rows = np.stack([events.x, events.y, events.p, (events.t + PARSED_US) / 1000], axis=1)
    with atomic_file(path, overwrite=True) as part, part.open("wb") as file:
        np.save(file, rows.astype(np.float64))
    return _write_columns(events, _beside_gesture(path))


def _write_columns(events: EventStream, path: Path) -> bool:
    path.parent.mkdir(parents=True, exist_ok=True)
    with atomic_file(path, overwrite=True) as part, part.open("wb") as file:
        np.savez(file, **{name: getattr(events, name) for name in "txyp"})
    return True


_layout = partial(Layout, splits=TO_TEST, lost=LOST)
N_MNIST = _layout(
    place="NMNIST/{folder}/{number}/{key}.bin",
    write=_write_nmnist,
    beside=_beside_nmnist,
    folders={"train": "Train", "test": "Test"},
    size=(34, 34),
    most_classes=10,
)
DVS_GESTURE = _layout(
    place="DVSGesture/{folder}/user0_{key}/{number}.npy",
    write=_write_gesture,
    beside=_beside_gesture,
    folders={"train": "ibmGestureTrain", "test": "ibmGestureTest"},
    size=(128, 128),
    most_classes=11,
)
