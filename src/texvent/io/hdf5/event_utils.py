"""HDF5 of event_utils: events in separate columns, and frames in the same file.

    events/xs i2   events/ys i2   events/ts f8, s   events/ps bool
    images/image000000000 ... u1 [H, W] or [H, W, 3] BGR, with attributes timestamp (s), size,
                              event_idx = number of events before it
    root attributes           num_events, num_pos, num_neg, num_imgs, duration, t0, tk,
                              sensor_resolution [H, W]

texvent adds width, height and its metadata. Seconds in f8 keep every µs for 71 years.

Source: Stoffregen et al., Reducing the Sim-to-Real Gap for Event Cameras, ECCV 2020, and its
event_utils.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any, ClassVar

import h5py
import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.event_packets import EventPackets
from texvent.io.atomic import atomic_file
from texvent.io.block_writer import Columns, FileTarget
from texvent.io.files import save
from texvent.io.hdf5.attributes import write_metadata
from texvent.io.hdf5.dsec import CHUNK_EVENTS, GZIP, Hdf5Codec, OffsetLimits, StoredColumns
from texvent.io.hdf5.storage import append_chunks
from texvent.io.reading import LARGEST_FLOAT, MICROSECONDS

COLUMNS = {"xs": "<i2", "ys": "<i2", "ts": "<f8", "ps": "?"}


class EventUtilsColumns:
    """Appends to the columns; counts are written at the end."""

    def __init__(self, file: Any, target: FileTarget) -> None:
        self._file, self._written, self._on_events = file, 0, 0
        file.attrs["width"], file.attrs["height"] = target.size
        file.attrs["sensor_resolution"] = np.array(target.size.shape)
        write_metadata(file, target.metadata)
        for name, dtype in COLUMNS.items():
            file.create_dataset(
                f"events/{name}", (0,), dtype, maxshape=(None,), chunks=(CHUNK_EVENTS,), **GZIP
            )

    def store(self, columns: Columns) -> None:
        """As `StoredColumns.store`."""
        for name, values in columns.items():
            stored = values / MICROSECONDS if name == "t" else values
            append_chunks(self._file[f"events/{name}s"], stored.astype(COLUMNS[f"{name}s"]))
        self._written += len(columns["t"])
        self._on_events += int(np.count_nonzero(columns["p"]))

    def complete(self) -> None:
        """As `StoredColumns.complete`."""
        attributes, times = self._file.attrs, self._file["events/ts"]
        first, last = (times[0], times[-1]) if self._written else (0.0, 0.0)
        attributes["num_events"], attributes["num_pos"] = self._written, self._on_events
        attributes["num_neg"] = self._written - self._on_events
        attributes["t0"], attributes["tk"], attributes["duration"] = first, last, last - first
        attributes["num_imgs"] = 0


class EventUtilsCodec(Hdf5Codec):
    """HDF5 as event_utils and its readers have it."""

    name: ClassVar[str] = "event-utils"
    extensions: ClassVar[tuple[str, ...]] = ()
    limits: ClassVar[OffsetLimits] = OffsetLimits("event_utils HDF5", 1 << 15, LARGEST_FLOAT)

    def layout(self, file: Any, target: FileTarget) -> StoredColumns:
        """As `Hdf5Codec.layout`."""
        return EventUtilsColumns(file, target)


def save_with_frames(
    path: Path,
    events: EventPackets,
    images: Iterable[tuple[int, NDArray[np.uint8]]],
    *,
    overwrite: bool = False,
) -> int:
    """Events and frames in one file of this layout; returns the number of frames.

    Args:
        path: the file.
        events: the recording.
        images: time, µs on the clock of the events, and [H, W] or [H, W, 3] RGB, in time order.
        overwrite: whether an existing file may be replaced.

    Raises:
        OutputError: it exists already, or cannot be written.
        InputError: a frame has another size than the events.
    """
    with atomic_file(path, overwrite=overwrite) as part:
        save(part, events, format=EventUtilsCodec.name, overwrite=True)
        with h5py.File(part, "r+") as file:
            times, count = file["events/ts"][()], 0
            for t_us, image in images:
                if image.shape[:2] != events.size.shape:
                    height, width = image.shape[:2]
                    raise InputError(
                        f"frame {count} is {width}x{height}, the events are {events.size}; give "
                        "frames of the same sensor"
                    )
                stored = image if image.ndim == 2 else image[..., ::-1]
                data = file.create_dataset(f"images/image{count:09d}", data=stored, **GZIP)
                seconds = t_us / MICROSECONDS
                data.attrs["timestamp"], data.attrs["size"] = seconds, np.array(stored.shape)
                data.attrs["event_idx"] = int(np.searchsorted(times, seconds))
                count += 1
            file.attrs["num_imgs"] = count
    return count
