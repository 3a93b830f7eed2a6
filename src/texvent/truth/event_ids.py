"""Object of each event.

A simulator compares the brightness of two instants, the dense frames before and after an event;
where in between it puts the event is its own rule. So an event belongs to what its pixel sees at
these two instants: through its middle and its four corners, of all objects met the nearest. An
event at a contour then belongs to the object before, and none to the background that has an
object in its pixel.

Frames with ids alone are moved along their vectors to these instants.

Noise events get the id of what their pixel sees. Shadows have the id of what they fall on.
"""

from __future__ import annotations

import shutil
import zipfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.arrays.npy_file import growing_array
from texvent.truth.source import InstancesStream, Snapshot

CORNER = 0.5 - 1e-6
"""From the middle of a pixel to its corners, which belong to it alone, pixels."""
RAYS = np.array(
    [(0.0, 0.0), (-CORNER, -CORNER), (CORNER, -CORNER), (-CORNER, CORNER), (CORNER, CORNER)]
)
"""[5, 2] x and y from the middle of the pixel."""
FILE = "events.npz"
COLUMNS = ("instance", "class_id")
COPY_BYTES = 2**20

Ids = NDArray[np.int32]
Float32Array = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class FrameSpan:
    """The events between two instants that a simulator compared."""

    start_us: int
    stop_us: int
    events: EventStream


def ids_of_scene(scene: InstancesStream, interval: FrameSpan) -> Ids:
    """The instance that each event shows, [n], 0 for none."""
    events = interval.events
    if not len(events):
        return np.zeros(0, dtype=np.int32)
    middles = np.stack([events.x, events.y], axis=1) + 0.5
    points = (middles[:, None, :] + RAYS).reshape(-1, 2)
    seen = [scene.instances_at(t_us, points) for t_us in (interval.start_us, interval.stop_us)]
    depth = np.concatenate([one.reshape(len(events), -1) for one, _ in seen], axis=1)
    instance = np.concatenate([one.reshape(len(events), -1) for _, one in seen], axis=1)
    nearest = np.where(instance > 0, depth, np.inf).argmin(axis=1)
    # Where no ray meets an object, argmin gives the first, whose id is 0.
    return np.asarray(instance[np.arange(len(events)), nearest], dtype=np.int32)


def ids_of_frames(before: Snapshot, after: Snapshot, interval: FrameSpan) -> Ids:
    """The instance that each event between two frames shows, from the ids of the frames.

    Pixels of the earlier frame move along their vectors, nearer ones over farther ones; a pixel
    that none reaches has the id of the later frame. Without vectors, the id of the frame that is
    closer in time.
    """
    events, span_us = interval.events, max(after.t_us - before.t_us, 1)
    if before.motion.instance is None or after.motion.instance is None or not len(events):
        return np.zeros(len(events), dtype=np.int32)
    found = []
    for t_us in (interval.start_us, interval.stop_us):
        share = min(max((t_us - before.t_us) / span_us, 0.0), 1.0)
        ids, depth = moved_ids(before, after, share)
        found.append((ids[events.y, events.x], depth[events.y, events.x]))
    (first, near), (second, far) = found
    is_first = (first > 0) & ((second == 0) | (near <= far))
    return np.where(is_first, first, second)


def moved_ids(before: Snapshot, after: Snapshot, share: float) -> tuple[Ids, Float32Array]:
    """Ids and depth [H, W] at a share of the way from one frame to the next.

    Without depth, every object is in front of the background.
    """
    ids, depth = _with_depth(before)
    later, later_depth = _with_depth(after)
    vectors = before.motion.forward
    if vectors is None:
        return (later, later_depth) if share >= 0.5 else (ids, depth)
    height, width = later.shape
    grid: NDArray[np.int64] = np.indices(later.shape, dtype=np.int64)
    row, column = grid[0], grid[1]
    is_known = np.isfinite(vectors).all(axis=2)
    # Far ones first: what is written later, over them, is nearer.
    order = np.argsort(-depth[is_known], kind="stable")
    source = np.flatnonzero(is_known)[order]
    x = (column[is_known] + share * vectors[is_known][:, 0])[order]
    y = (row[is_known] + share * vectors[is_known][:, 1])[order]
    columns, rows = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    # All pixels that the moved one overlaps; pixel by pixel, so that far to near holds.
    across = np.stack([columns, columns + (x > columns)], axis=1)[:, [0, 1, 0, 1]].ravel()
    down = np.stack([rows, rows + (y > rows)], axis=1)[:, [0, 0, 1, 1]].ravel()
    inside = (across >= 0) & (across < width) & (down >= 0) & (down < height)
    origin = np.full(later.shape, -1, dtype=np.int64)
    origin[down[inside], across[inside]] = np.repeat(source, 4)[inside]
    is_reached = origin >= 0
    moved, moved_depth = later.copy(), later_depth.copy()
    moved[is_reached] = ids.ravel()[origin[is_reached]]
    moved_depth[is_reached] = depth.ravel()[origin[is_reached]]
    return moved, moved_depth


def _with_depth(truth: Snapshot) -> tuple[Ids, Float32Array]:
    """Ids and depth of a frame that has ids."""
    instance, depth = truth.motion.instance, truth.motion.depth
    if instance is None:
        raise InputError(f"the ids of the frame at {truth.t_us} µs are not known")
    if depth is None:
        depth = np.where(instance > 0, 1.0, 2.0).astype(np.float32)
    return instance, depth


@contextmanager
def open_event_ids(folder: Path) -> Iterator[Callable[..., None]]:
    """`events.npz` in a folder: arrays `instance` and `class_id`, one row per event.

    Args:
        folder: where it is written; complete when the `with` block ends.

    Yields:
        A function that takes the columns of further events.
    """
    parts = {name: folder / f"events-{name}.part" for name in COLUMNS}
    with ExitStack() as stack:
        append = [stack.enter_context(growing_array(one, dtype="<u2")) for one in parts.values()]

        def add(*columns: NDArray[np.uint16]) -> None:
            for append_rows, rows in zip(append, columns, strict=True):
                append_rows(rows)

        yield add
    with zipfile.ZipFile(folder / FILE, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, part in parts.items():
            with part.open("rb") as rows, archive.open(f"{name}.npy", "w", force_zip64=True) as to:
                shutil.copyfileobj(rows, to, COPY_BYTES)
            part.unlink()
