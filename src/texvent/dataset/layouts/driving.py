"""Layouts of recordings from cars, with boxes: gen1, 1mpx, dsec-det.

Gen1 and 1mpx, of Prophesee:

    train|val|test/KEY_td.dat      events
    train|val|test/KEY_bbox.npy    boxes: records t (µs), x, y, w, h (px), class_id,
                                   class_confidence, track_id

Both differ in their classes and in the sensor that readers expect. Small boxes stay: Prophesee's
evaluation leaves them out itself, with all boxes of a recording's first .5 s. A sample without
boxes has a file without records.

DSEC-Detection:

    train|test/KEY/events/left/events.h5             events/x, y u2, t u4, p u1; ms_to_idx; t_offset
    train|test/KEY/images/timestamps.txt             µs, of the images
    train|test/KEY/images/left/distorted/000000.png  images
    train|test/KEY/object_detections/left/tracks.npy boxes: records t (µs), x, y, h, w (px),
                                                     class_id, class_confidence, track_id
    train_val_test_split.yaml                        sequences of each split; those of val lie in
                                                     train

Its readers find the boxes of an image by its time, so boxes are given at the times of the images,
or of the labelled instants where frames cannot be made again. `ms_to_idx` spans all of them: entry
m is the first event at or after m ms from `t_offset`, which is the first image or event. A sequence
without boxes has a file without records.

Sources: Prophesee's automotive dataset toolbox; P. de Tournemire et al., "A large scale event-based
detection dataset for automotive", 2020; E. Perot et al., "Learning to detect objects with a 1
megapixel event camera", NeurIPS 2020; D. Gehrig, D. Scaramuzza, "Low-latency
automotive vision with event cameras", Nature 2024, and its description of files; M. Gehrig et al.,
"DSEC: a stereo event camera dataset for driving scenarios", RA-L 2021.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np
import yaml
from numpy.typing import NDArray

from texvent.dataset.layouts.boxes import LABEL_RECORD, boxes_at, records_of
from texvent.dataset.layouts.frames import write_frames
from texvent.dataset.layouts.layout import USUAL_SPLITS, Layout, LayoutSample
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.atomic import atomic_file, atomic_folder
from texvent.io.files import save
from texvent.runtime.files.file_names import inside

EVENTS_END, BOXES_END = "_td.dat", "_bbox.npy"
LARGE = "pedestrian,two wheeler,car,truck,bus,traffic sign,traffic light"


def _boxes_beside(path: Path) -> Path:
    return path.with_name(path.name.removesuffix(EVENTS_END) + BOXES_END)


def _write_prophesee(sample: LayoutSample, path: Path) -> bool:
    """Write the boxes, then the events, whose file says that both are there."""
    with atomic_file(_boxes_beside(path), overwrite=True) as part, part.open("wb") as file:
        np.save(file, records_of(sample.boxes, LABEL_RECORD))
    events = replace(sample.read_events(), label=None, metadata={})
    save(path, events, format="dat")
    return True


GEN1 = Layout(
    place="{split}/{key}" + EVENTS_END,
    write=_write_prophesee,
    beside=_boxes_beside,
    splits=USUAL_SPLITS,
    size=(304, 240),
    lost="captions",
    has_boxes=True,
    classes="car,pedestrian",
)
MEGAPIXEL = replace(GEN1, size=(1280, 720), classes=LARGE)


TRACK_RECORD = np.dtype(
    [
        *[("t", "<u8"), ("x", "<f8"), ("y", "<f8"), ("h", "<f8"), ("w", "<f8")],
        *[("class_id", "u1"), ("class_confidence", "<f8"), ("track_id", "<u8")],
    ]
)
CLASSES = "pedestrian,rider,car,bus,truck,bicycle,motorcycle,train"
SPLIT_FILE = "train_val_test_split.yaml"
MILLISECOND_US = 1000
LONGEST_US = 1 << 32


def _write_dsec_det(sample: LayoutSample, path: Path) -> bool:
    with atomic_folder(path, overwrite=False, is_own=lambda _: False) as part:
        times = sample.instants_us
        if sample.read_frames is not None:
            with sample.read_frames() as frames:
                times = write_frames(frames, part / "images/left/distorted")
        images, events, labels = (
            part / one for one in ("images", "events/left", "object_detections/left")
        )
        for folder in (images, events, labels):
            folder.mkdir(parents=True, exist_ok=True)
        np.savetxt(images / "timestamps.txt", times, fmt="%d")
        found = [boxes_at(sample.boxes, sample.instants_us, int(one)) for one in times]
        boxes = np.concatenate([sample.boxes[:0], *(one for one in found if one is not None)])
        np.save(labels / "tracks.npy", records_of(boxes, TRACK_RECORD))
        write_dsec_events(events / "events.h5", sample.read_events(), times)
    return True


def write_dsec_events(path: Path, events: EventStream, times_us: NDArray[np.int64]) -> None:
    """Events as DSEC's HDF5, whose index covers all of `times_us`, µs, increasing.

    Raises:
        InputError: they span more than 71 minutes.
    """
    import h5py

    first = min([*times_us[:1].tolist(), *events.t[:1].tolist()], default=0)
    last = max([*times_us[-1:].tolist(), *events.t[-1:].tolist()], default=0)
    if last - first >= LONGEST_US:
        raise InputError(f"{last - first} µs do not fit into DSEC's times; make shorter clips")
    since = events.t - first
    milliseconds = np.arange((last - first) // MILLISECOND_US + 2) * MILLISECOND_US
    columns = {"x": events.x, "y": events.y, "t": since.astype(np.uint32), "p": events.p}
    with h5py.File(path, "w") as file:
        for name, values in columns.items():
            file.create_dataset(f"events/{name}", data=values, compression="gzip", shuffle=True)
        file["ms_to_idx"] = np.searchsorted(since, milliseconds).astype(np.uint64)
        file["t_offset"] = np.int64(first)


def _write_splits(folder: Path, samples: Iterable[LayoutSample], classes: tuple[str, ...]) -> None:
    splits: dict[str, list[str]] = {}
    for sample in samples:
        splits.setdefault(sample.split, []).append(sample.key)
    with atomic_file(inside(folder, SPLIT_FILE), overwrite=True) as part:
        part.write_text(yaml.safe_dump(splits, sort_keys=False), encoding="utf-8")


DSEC_DET = Layout(
    place="{folder}/{key}",
    write=_write_dsec_det,
    finish=_write_splits,
    splits=USUAL_SPLITS,
    folders={"val": "train"},
    size=(640, 480),
    lost="captions",
    has_boxes=True,
    takes_frames=True,
    classes=CLASSES,
)
