"""Labels of a video: read from COCO, MOT or YOLO files, checked, and placed on its events."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from texvent.capture.fit_to_sensor import fit_place
from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.frames import MICROSECONDS, frame_time_us
from texvent.sensor import SensorSize
from texvent.truth.boxes import BOX_RECORD, Label, clip_boxes


def read_coco(path: Path, size: SensorSize) -> tuple[list[Label], set[int]]:
    """Labels and labelled frames of COCO JSON, for pictures of a size; see `read_labels`.

    The `frame_id` of an image (from 0, as in COCO-VID) goes before its place. A `track_id` says
    which object a box is of. Crowds are left out. Source: the COCO object detection format.
    """
    facts = json.loads(path.read_text(encoding="utf-8"))
    for name in ("images", "annotations", "categories"):
        if not isinstance(facts, dict) or not isinstance(facts.get(name), list):
            what = f"has no list {name!r}" if isinstance(facts, dict) else "is not a COCO object"
            raise FileFormatError(f"{path} {what}; COCO has images, annotations, categories")
    names = {one["id"]: str(one["name"]) for one in facts["categories"]}
    images = facts["images"]
    frames = {one["id"]: int(one.get("frame_id", place)) for place, one in enumerate(images)}
    for one in images:
        labelled = SensorSize(int(one["width"]), int(one["height"]))
        if labelled != size:
            raise InputError(
                f"{path} labels pictures of {labelled!s:.40}, and the video has {size}; give the "
                "video that was labelled"
            )
    labels = []
    for one in facts["annotations"]:
        for what, known in (("category_id", names), ("image_id", frames)):
            if one[what] not in known:
                raise InputError(f"{path}: {what} {one[what]!r:.40} of a box is not in its lists")
        if not one.get("iscrowd"):
            track, name = int(one.get("track_id", 0)), names[one["category_id"]]
            labels.append(Label(frames[one["image_id"]], track, name, *map(float, one["bbox"])))
    return labels, set(frames.values())


def read_mot(path: Path, size: SensorSize) -> tuple[list[Label], set[int]]:
    """Labels and labelled frames of MOT text, counted from 1; see `read_labels`.

    A line holds frame, id, left, top, width, height, confidence, class, ... An id or a class of -1
    is none; a confidence of 0 marks a box that is not to be used. Classes are called by their
    numbers. Source: Milan et al., MOT16, arXiv:1603.00831, Table 6.
    """
    del size  # boxes are in pixels
    labels, frames = [], set()
    for frame, track, x, y, w, h, *more in _rows(path, "frame id left top width height", ","):
        confidence, kind = (*more, -1.0, -1.0)[:2]
        frames.add(int(frame) - 1)
        if confidence != 0:
            at = int(frame) - 1, max(int(track), 0), str(int(kind))
            labels.append(Label(*at, x - 1, y - 1, w, h))
    return labels, frames


def read_yolo(path: Path, size: SensorSize) -> tuple[list[Label], set[int]]:
    """Labels and labelled frames of a YOLO folder, for pictures of a size; see `read_labels`.

    A .txt for each labelled frame has lines `class cx cy w h`, in shares of the picture. The number
    at the end of its name is that of the frame; `Labels.place` knows where it begins. Classes are
    called by their numbers. Source: the label format of Darknet and Ultralytics.
    """
    numbered = ((re.search(r"(\d+)\.txt$", one.name), one) for one in sorted(path.iterdir()))
    files = {int(number[1]): one for number, one in numbered if number is not None}
    labels = []
    for number, one in files.items():
        for kind, cx, cy, w, h, *_ in _rows(one, "class cx cy w h"):
            corner = (cx - w / 2) * size.width, (cy - h / 2) * size.height
            sides = w * size.width, h * size.height
            labels.append(Label(number, 0, str(int(kind)), *corner, *sides))
    return labels, set(files)


def _rows(path: Path, names: str, separator: str | None = None) -> Iterator[list[float]]:
    """Numbers of each line that is not blank; at least the columns of these names."""
    for number, line in enumerate(path.read_text(encoding="ascii").splitlines(), start=1):
        columns, wanted = line.split(separator), len(names.split())
        if line.strip() and len(columns) < wanted:
            raise FileFormatError(
                f"{path}: line {number} has {len(columns)} columns; {names} are {wanted}"
            )
        if line.strip():
            yield [float(column) for column in columns]


Reader = Callable[[Path, SensorSize], tuple[list[Label], set[int]]]
READERS: Mapping[str, tuple[str, Reader]] = MappingProxyType(
    {
        ".json": ("COCO JSON", read_coco),
        ".txt": ("MOT text", read_mot),
        "folder": ("a YOLO folder", read_yolo),
    }
)
"""Extension → name of the format, and its reader: boxes, and frames that were labelled."""
DAMAGE = (OSError, ValueError, TypeError, LookupError, AttributeError, ArithmeticError,
          RecursionError)  # fmt: skip
"""Readers raise any of these on a damaged file."""
LARGEST = 1e6
"""Sides of boxes are below this, px."""
FARTHEST = 3.0
"""A box that moves by more of its diagonals from frame to frame is that of another object; a car
that crosses the picture in a quarter of a second moves by less than one."""
FARTHEST_BACK = 1.0
"""As `FARTHEST`, of one that turns back at once: two objects that share a track alternate."""


@dataclass(frozen=True, eq=False)
class Labels:
    """Labels of a video."""

    path: Path
    """Their origin."""
    size: SensorSize
    """Size of the pictures."""
    boxes: NDArray[np.void]
    """[k] records of `BOX_RECORD`, inside the picture; `t` is the number of the frame, as in
    `frames`, and `class_id` the place in `names`."""
    frames: NDArray[np.int64]
    """Numbers of the frames that were labelled, in order; some may show nothing. From 0, or those
    of the files of a YOLO folder."""
    names: tuple[str, ...]
    """Names of the classes."""
    may_count_from_one: bool
    """Whether the numbers are those of files, none of which is 0."""

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
            InputError: more frames are labelled than the video has, or the files of a YOLO folder
                may count from 0 or from 1: none has number 0, and none the number of frames.
        """
        last, count = int(self.frames[-1]), len(times_us)
        first = int(is_whole and self.may_count_from_one and last == count)
        if is_whole and last - first >= count:
            raise InputError(
                f"{self.path} labels more frames ({last + 1 - first}) than the video has ({count})"
                "; give the video that was labelled"
            )
        if self.may_count_from_one and not first:
            raise InputError(
                f"{self.path}: no file says if frames count from zero or one; add an empty file "
                f"of number zero, or {'of the last frame' if is_whole else 'leave out option stop'}"
            )
        numbers = np.array([classes.get(name, -1) for name in self.names])
        places, frames = self.boxes["t"] - first, self.frames - first
        is_kept = (numbers[self.boxes["class_id"]] >= 0) & (places < count)
        boxes = self.boxes[is_kept]
        boxes["class_id"] = numbers[boxes["class_id"]]
        boxes["t"] = times_us[places[is_kept]]
        known = times_us[frames[frames < count]]
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
        row = rows[int(np.argmin(is_inside))]
        is_empty = row.w <= 0 or row.h <= 0
        what = "no width or height" if is_empty else f"no part inside the picture of {size}"
        raise InputError(
            f"{path}: a box of {shown(row.name)} in frame {row.frame} has {what}: left {row.x:g}, "
            f"top {row.y:g}, width {row.w:g}, height {row.h:g} px; correct or remove it"
        )
    _refuse_jumps(path, boxes)
    return Labels(path, size, boxes, frames, names, kind == "folder" and frames[0] > 0)


def _refuse_jumps(path: Path, boxes: NDArray[np.void]) -> None:
    """Refuse a track that is twice in a frame, or moves farther than an object can."""
    boxes = np.sort(boxes[boxes["track_id"] > 0], order=("track_id", "t"))
    before, after = boxes[:-1], boxes[1:]
    steps, is_same = after["t"] - before["t"], before["track_id"] == after["track_id"]
    centres = np.stack([boxes["x"] + boxes["w"] / 2, boxes["y"] + boxes["h"] / 2])
    diagonal = np.hypot(boxes["w"], boxes["h"])
    longest = np.maximum(diagonal[:-1], diagonal[1:]) * np.maximum(steps, 1)
    moves = np.where(is_same, np.diff(centres) / longest, 0)  # diagonals per frame
    moved = np.hypot(*moves)
    turns = (moves[:, :-1] * moves[:, 1:]).sum(axis=0) < 0
    turns &= np.minimum(moved[:-1], moved[1:]) > FARTHEST_BACK
    is_wrong = is_same & ((steps == 0) | (moved > FARTHEST))
    is_wrong[:-1] |= turns
    wrong = np.flatnonzero(is_wrong)
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
