"""Labels of a video: read from any format, checked, and placed on its events."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from texvent.capture.fit_to_sensor import fit_place
from texvent.errors import FileFormatError, InputError, one_line
from texvent.sensor import SensorSize
from texvent.truth.boxes import BOX_RECORD, Label, clip_boxes
from texvent.truth.labels.coco import read_coco
from texvent.truth.labels.mot import read_mot
from texvent.truth.labels.yolo import read_yolo
from texvent.video import MICROSECONDS, frame_time_us

Reader = Callable[[Path, SensorSize], tuple[list[Label], set[int]]]
READERS: Mapping[str, tuple[str, Reader]] = MappingProxyType(
    {
        ".json": ("COCO JSON", read_coco),
        ".txt": ("MOT text", read_mot),
        "folder": ("a YOLO folder", read_yolo),
    }
)
"""Extension → name of the format, and its reader: boxes, and frames that were labelled, from 0."""
DAMAGE = (OSError, ValueError, TypeError, LookupError, AttributeError, ArithmeticError,
          RecursionError)  # fmt: skip
"""Readers raise any of these on a damaged file."""
LARGEST = 1e6
"""Sides of boxes are below this, px."""
FARTHEST = 3.0
"""A box that moves by more of its diagonals from frame to frame is that of another object; a car
that crosses the picture in a quarter of a second moves by less than one."""


@dataclass(frozen=True, eq=False)
class Labels:
    """Labels of a video."""

    path: Path
    """Where they are from."""
    size: SensorSize
    """Of the pictures."""
    boxes: NDArray[np.void]
    """[k] records of `BOX_RECORD`, inside the picture; `t` is the number of the frame, from 0, and
    `class_id` the place in `names`."""
    frames: NDArray[np.int64]
    """Numbers of the frames that were labelled, in order; some may show nothing."""
    names: tuple[str, ...]
    """Names of the classes."""

    def place(
        self,
        times_us: NDArray[np.int64],
        size: SensorSize,
        classes: Mapping[str, int],
        *,
        fit: str = "stretch",
        rate_hz: Fraction | None = None,
        is_whole: bool = True,
    ) -> tuple[NDArray[np.void], NDArray[np.int64]]:
        """Boxes on the clock and in the pixels of the events.

        Args:
            times_us: of the frames of the clip, from the first of the video, µs.
            size: of the sensor, pixels.
            classes: name of a class → class id; boxes of other classes are left out.
            fit: as `texvent.capture.fit_to_sensor.fit_pixels` fits the frames.
            rate_hz: boxes per second, interpolated along tracks from one labelled frame to the
                next; None: those of the labelled frames.
            is_whole: whether the clip has all frames of the video.

        Returns:
            [k] records of `BOX_RECORD`, those that the sensor sees, by time; and the times at which
            they are known, µs.

        Raises:
            InputError: more frames are labelled than the video has.
        """
        if is_whole and int(self.frames[-1]) >= len(times_us):
            raise InputError(
                f"{self.path} labels frame {self.frames[-1]} (from 0), and the video has "
                f"{len(times_us)} frames; give the video that was labelled"
            )
        numbers = np.array([classes.get(name, -1) for name in self.names])
        is_kept = (numbers[self.boxes["class_id"]] >= 0) & (self.boxes["t"] < len(times_us))
        boxes = self.boxes[is_kept]
        boxes["class_id"] = numbers[boxes["class_id"]]
        boxes["t"] = times_us[boxes["t"]]
        known = times_us[self.frames[self.frames < len(times_us)]]
        if rate_hz is not None and len(known):
            boxes, known = _at_rate(boxes, known, int(times_us[0]), rate_hz)
        scale, shift = fit_place(self.size, size, fit)
        for axis, (start, side) in enumerate((("x", "w"), ("y", "h"))):
            boxes[start] = boxes[start] * scale[axis] + shift[axis]
            boxes[side] = boxes[side] * scale[axis]
        return boxes[clip_boxes(boxes, size)], known


def read_labels(path: Path, size: SensorSize) -> Labels:
    """Labels of a video.

    Args:
        path: of a format of `READERS`.
        size: of the pictures, pixels.

    Raises:
        InputError: there is no such file, no box in it, a box outside the picture, a class that
            the file does not name, or a track that jumps.
        FileFormatError: it is of no such format.
    """
    if not path.exists():
        raise InputError(f"no such labels: {path}; boxes names COCO .json, MOT .txt, a YOLO folder")
    kind = "folder" if path.is_dir() else path.suffix.lower()
    if kind not in READERS:
        raise FileFormatError(f"{path} is neither COCO (.json) nor MOT (.txt) nor a YOLO folder")
    format, read = READERS[kind]
    try:
        rows, numbers = read(path, size)
        names = tuple(sorted({row.name for row in rows}))
        rows.sort()
        if not all(abs(side) < LARGEST for row in rows for side in row[3:]):
            raise ValueError(f"a side of a box is not a number below {LARGEST:g} px")
        boxes = np.array([row.record(names.index(row.name)) for row in rows], BOX_RECORD)
        frames = np.array(sorted(numbers), np.int64)
    except InputError:
        raise
    except DAMAGE as error:
        raise FileFormatError(f"{path} cannot be read as {format} ({one_line(error)})") from error
    if not rows or frames[0] < 0:
        what = "a frame before the first" if rows else "no box"
        raise InputError(f"{path} has {what}; leave its video out, or give it another file")
    is_inside = clip_boxes(boxes, size)
    if not is_inside.all():
        raise InputError(
            f"{path}: {rows[int(np.argmin(is_inside))]!r:.300} has no part inside the picture of "
            f"{size}; correct or remove it"
        )
    _refuse_jumps(path, boxes)
    return Labels(path, size, boxes, frames, names)


def _refuse_jumps(path: Path, boxes: NDArray[np.void]) -> None:
    """Refuse a track that is twice in a frame, or moves farther than an object can."""
    boxes = np.sort(boxes[boxes["track_id"] > 0], order=("track_id", "t"))
    before, after = boxes[:-1], boxes[1:]
    steps, is_same = after["t"] - before["t"], before["track_id"] == after["track_id"]
    centres = np.stack([boxes["x"] + boxes["w"] / 2, boxes["y"] + boxes["h"] / 2])
    moved, diagonal = np.hypot(*np.diff(centres)), np.hypot(boxes["w"], boxes["h"])
    largest = np.maximum(diagonal[:-1], diagonal[1:])
    wrong = np.flatnonzero(is_same & ((steps == 0) | (moved > FARTHEST * largest * steps)))
    if len(wrong):
        first, last = before[wrong[0]], after[wrong[0]]
        what = f"jumps from frame {first['t']} to {last['t']}"
        what = f"is twice in frame {first['t']}" if first["t"] == last["t"] else what
        raise InputError(
            f"{path}: track {first['track_id']} {what} (from 0); give each object its own track"
        )


def _at_rate(
    boxes: NDArray[np.void], known: NDArray[np.int64], start_us: int, rate_hz: Fraction
) -> tuple[NDArray[np.void], NDArray[np.int64]]:
    """Boxes at instants of a regular clock that begins at `start_us`, and these instants, µs.

    Linear between neighbours of the labelled frames, at `known` µs, where both show a track.
    """
    count = int((int(known[-1]) - start_us) * rate_hz / MICROSECONDS) + 2
    ticks = np.array([frame_time_us(number, rate_hz, start_us) for number in range(count)])
    ticks = ticks[(ticks >= known[0]) & (ticks <= known[-1])]
    before = np.searchsorted(known, ticks, side="right") - 1
    after = np.searchsorted(known, ticks)
    parts = [np.empty(0, BOX_RECORD)]
    for track in np.unique(boxes["track_id"]):
        own = boxes[boxes["track_id"] == track]
        is_seen = np.isin(known, own["t"])
        at = ticks[is_seen[before] & is_seen[after]]
        moved = own[np.searchsorted(own["t"], at, side="right") - 1]
        moved["t"] = at
        for side in "xywh":
            moved[side] = np.interp(at, own["t"], own[side])
        parts.append(moved)
    every = np.concatenate(parts)
    return every[np.argsort(every["t"], kind="stable")], ticks
