"""Layout rvt: sequences as RVT's preprocessing leaves them, and RVT and evlib load them.

    event_representations_v2/stacked_histogram_dt=50_nbins=10/
        event_representations.h5       data: uint8 [windows, 20, H, W]
        timestamps_us.npy              int64 [windows], end of each window, µs
        objframe_idx_2_repr_idx.npy    int64 [frames], window of each labelled frame
    labels_v2/
        labels.npz                     labels: records of all frames; objframe_idx_2_label_idx:
                                       int64 [frames], first record of each frame
        timestamps_us.npy              int64 [frames], µs

Windows of 50 ms follow each other from the first frame on. Both of their ends count, as in RVT: an
event at an instant that two windows share is in both. A labelled frame is the end of a window at
which boxes are known; it has at least one box, which RVT wants.

Boxes are cut at the picture's last pixels, and those with a side below 5 pixels are left out, as
RVT does for 1 Mpx. Representations have the sensor's size, not half of it, packed with gzip.

Source: M. Gehrig, D. Scaramuzza, "Recurrent vision transformers for object detection with event
cameras", CVPR 2023, and its code; evlib.data.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.layouts.boxes import LABEL_RECORD, Boxes, boxes_at, records_of
from texvent.dataset.layouts.layout import USUAL_SPLITS, Layout, LayoutSample
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.atomic import atomic_folder
from texvent.represent.histogram import BINS, stacked_histogram
from texvent.sensor import SensorSize
from texvent.truth.boxes import clip_boxes

WINDOW_US = 50_000
REPRESENTATION = f"stacked_histogram_dt={WINDOW_US // 1000}_nbins={BINS}"
LEAST_SIDE = 5.0
"""Shortest side of a box, pixels."""


def write_rvt(
    folder: Path,
    events: EventStream,
    boxes: Boxes,
    *,
    start_us: int,
    stop_us: int,
    instants_us: NDArray[np.int64] | None = None,
) -> bool:
    """Write one sequence, unless no window of it has a box.

    Args:
        folder: new; it appears when it is complete.
        events: of the sequence.
        boxes: those of its labelled instants; `class_id` counts the detector's classes from 0.
        start_us: start of the first window, µs.
        stop_us: windows end no later than this, µs.
        instants_us: labelled instants, µs; None: those with a box.

    Returns:
        True if it was written.

    Raises:
        InputError: it is shorter than a window.
        OutputError: the folder exists or cannot be written.
    """
    ends = np.arange(start_us + WINDOW_US, stop_us + 1, WINDOW_US, dtype=np.int64)
    if not len(ends):
        raise InputError(
            f"{stop_us - start_us} µs of events are shorter than a window of {WINDOW_US} µs; make "
            "clips of .05 s and more"
        )
    instants = np.unique(boxes["t"]) if instants_us is None else instants_us
    frames = _labelled_frames(boxes, instants, ends, events)
    if not frames:
        return False
    with atomic_folder(folder, overwrite=False, is_own=lambda _: False) as part:
        (part / "labels_v2").mkdir()
        lengths = [len(one) for one in frames.values()]
        np.savez(
            part / "labels_v2" / "labels.npz",
            labels=np.concatenate(list(frames.values())),
            objframe_idx_2_label_idx=np.cumsum([0, *lengths[:-1]], dtype=np.int64),
        )
        windows = np.array(list(frames), dtype=np.int64)
        np.save(part / "labels_v2" / "timestamps_us.npy", ends[windows])
        place = part / "event_representations_v2" / REPRESENTATION
        place.mkdir(parents=True)
        np.save(place / "timestamps_us.npy", ends)
        np.save(place / "objframe_idx_2_repr_idx.npy", windows)
        _write_histograms(place / "event_representations.h5", events, ends)
    return True


def _labelled_frames(
    boxes: Boxes, instants: NDArray[np.int64], ends: NDArray[np.int64], events: EventStream
) -> dict[int, NDArray[np.void]]:
    """Window → its records, of windows with a box."""
    frames = {}
    last = SensorSize(events.size.width - 1, events.size.height - 1)
    for window, end_us in enumerate(ends):
        found = boxes_at(boxes, instants, int(end_us))
        if found is None:
            continue
        clip_boxes(found, last)
        kept = found[(found["w"] >= LEAST_SIDE) & (found["h"] >= LEAST_SIDE)]
        if len(kept):
            frames[window] = records_of(kept, LABEL_RECORD)
    return frames


def _write_histograms(path: Path, events: EventStream, ends: NDArray[np.int64]) -> None:
    import h5py

    shape = (2 * BINS, *events.size.shape)
    with h5py.File(path, "w") as file:
        data = file.create_dataset(
            "data",
            shape=(len(ends), *shape),
            dtype=np.uint8,
            chunks=(1, *shape),
            compression="gzip",
            compression_opts=1,
        )
        for window, end_us in enumerate(map(int, ends)):
            data[window] = stacked_histogram(events.cut(end_us - WINDOW_US, end_us + 1))


def _write(sample: LayoutSample, path: Path) -> bool:
    return write_rvt(
        path,
        sample.read_events(),
        sample.boxes,
        start_us=sample.start_us,
        stop_us=sample.stop_us,
        instants_us=sample.instants_us,
    )


RVT = Layout(
    place="{split}/{key}",
    write=_write,
    splits=USUAL_SPLITS,
    lost="captions, events (only their histograms)",
    has_boxes=True,
    shortest_us=WINDOW_US,
)
