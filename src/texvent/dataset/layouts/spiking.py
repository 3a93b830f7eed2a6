"""Layouts of the data sets that spiking networks are trained on: n-mnist, dvs-gesture.

Each sample is written twice, for the loaders of two libraries, which take the exported folder:

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

from functools import partial
from pathlib import Path

import numpy as np

from texvent.dataset.layouts.event_files import EVALUATION
from texvent.dataset.layouts.layout import Layout, LayoutSample
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.atis import MAX_SIZE, STOP_US, encode_records
from texvent.io.atomic import atomic_file

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
