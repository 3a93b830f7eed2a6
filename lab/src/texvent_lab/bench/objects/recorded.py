"""Recorded events of household objects: frames with boxes from a robot's arm, and turntables.

Sources, on GitHub: eduardoborgesgouveia/widow_x_neuromorphic_rotulation and
eberlawrence/DVS128_BioLab. Neither states a licence, so texvent holds none of their data.
"""

from __future__ import annotations

import re
import zipfile
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path, PurePosixPath

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, shown
from texvent.events import EventStream
from texvent.io.files import open_events
from texvent_lab.bench.detection.clips import bin_pixels

SIDE = 128
"""Pixels along each side of the sensor."""
WINDOW_US = 100_000
TABLE_CLASSES = ("banana", "cup", "fork", "key", "knife", "mug", "orange")
"""Classes of the boxes, in the order of their numbers."""
TURNTABLE_FILES: Mapping[str, str] = {
    "box": "Caixa",
    "mug": "Caneca",
    "cell phone": "Celular",
    "pencil": "Lapiseira",
    "computer mouse": "Mouse",
    "scissors": "Tesoura",
}
"""Noun → name of its recording, DataSet2_NAME.aedat. That of a box cutter has no noun."""
_LEVELS = {0: -1, 127: 0, 255: 1}
LEAST_SIGNAL = 20.0
"""Events in a box above those of an equal area of its frame with which an object is visible."""


@dataclass(frozen=True, eq=False)
class Frames:
    """Windows of 100 ms as networks see them."""

    images: NDArray[np.int8]
    """[n, 128, 128] last polarity of each pixel: −1 OFF, 0 none, 1 ON."""
    classes: NDArray[np.int64]
    """[n] number of the class."""
    boxes: NDArray[np.float32]
    """[n, 4] x, y, width, height, pixels; NaN where there is none."""
    groups: NDArray[np.int64]
    """[n] pose of the arm, recording or clip."""

    def select(self, chosen: NDArray[np.bool_]) -> Frames:
        """Some of the windows."""
        return Frames(*(one[chosen] for one in vars(self).values()))

    @property
    def is_visible(self) -> NDArray[np.bool_]:
        """[n] whether the box holds events enough; see `LEAST_SIGNAL`."""
        found = []
        for image, (x, y, width, height) in zip(self.images != 0, self.boxes, strict=True):
            left, top, right, bottom = np.rint([x, y, x + width, y + height]).astype(int)
            inside = image[max(top, 0) : bottom, max(left, 0) : right]
            found.append(inside.sum() - image.mean() * inside.size >= LEAST_SIGNAL)
        return np.array(found, np.bool_)


def last_polarity(events: EventStream, start_us: int) -> NDArray[np.int8]:
    """Last polarity of each pixel in the window from `start_us`: −1, 1, or 0 without an event."""
    window = events.cut(start_us, start_us + WINDOW_US)
    image = np.zeros(events.size.shape, np.int8)
    image[window.y, window.x] = 2 * window.p.astype(np.int8) - 1  # of equal places the last stays
    return image


def in_cells(images: NDArray[np.int8]) -> NDArray[np.uint8]:
    """ON and OFF pixels in cells of 2×2, as networks see them: [n, H, W] → [n, 2, H / 2, W / 2]."""
    return np.stack([bin_pixels(images == sign, 2) for sign in (1, -1)], axis=1)


def read_table(path: Path) -> Frames:
    """The labelled frames of the robot's arm, by pose and class.

    Args:
        path: the zip, or the folder `Integral` unpacked: images/NAME_POSE.png and
            labels/NAME_POSE.txt (YOLO) anywhere below.

    Raises:
        InputError: it is not there, or a frame has no label.
        FileFormatError: another layout, size or class.
    """
    members = _members(path)
    images = {one: key for key in members if (one := _stem(key, "images", ".png"))}
    labels = {one: key for key in members if (one := _stem(key, "labels", ".txt"))}
    if not images:
        raise FileFormatError(f"{path} has no images/NAME_POSE.png; give the frames as published")
    if lacking := sorted(images.keys() ^ labels.keys()):
        raise InputError(
            f"{path}: {lacking[0]} has no {'label' if lacking[0] in images else 'image'}; "
            "unpack all files"
        )
    rows = []
    for name in images:
        image = cv2.imdecode(np.frombuffer(members[images[name]](), np.uint8), cv2.IMREAD_GRAYSCALE)
        kind, box = _read_label(members[labels[name]](), name)
        if image is None or image.shape != (SIDE, SIDE) or set(np.unique(image)) - set(_LEVELS):
            raise FileFormatError(
                f"{path}: {name}.png is no frame of {SIDE}×{SIDE} pixels of 0, 127 and 255"
            )
        rows.append((int(name.rpartition("_")[2]), kind, (image > 127).astype(np.int8), image, box))
    rows.sort(key=lambda row: row[:2])
    signs = np.stack([row[2] - (row[3] < 127).astype(np.int8) for row in rows])
    poses, classes = (np.array([row[place] for row in rows], np.int64) for place in (0, 1))
    if missing := set(range(len(TABLE_CLASSES))) - set(classes.tolist()):
        raise InputError(f"{path} has no frame of a {TABLE_CLASSES[min(missing)]}; give all files")
    return Frames(signs, classes, np.array([row[4] for row in rows], np.float32), poses)


def _members(path: Path) -> dict[str, Callable[[], bytes]]:
    """Name → its content, of a zip or a folder."""
    if path.is_dir():
        files = [one for one in sorted(path.rglob("*")) if one.is_file()]
        return {one.relative_to(path).as_posix(): one.read_bytes for one in files}
    if not path.exists():
        raise InputError(f"there is no {path}; give the zip or the folder of the labelled frames")
    try:
        archive = zipfile.ZipFile(path)
    except (OSError, zipfile.BadZipFile):
        raise FileFormatError(f"{path} is no zip and no folder of labelled frames") from None
    try:
        damaged = archive.testzip()
    except (OSError, zipfile.BadZipFile, zlib.error):
        damaged = "a file"
    if damaged:
        raise FileFormatError(f"{path} is damaged ({damaged}); fetch it again")
    return {name: partial(archive.read, name) for name in archive.namelist()}


def _stem(name: str, folder: str, extension: str) -> str | None:
    path = PurePosixPath(name)
    is_one = path.parent.name == folder and path.suffix == extension
    return path.stem if is_one and re.fullmatch(r".+_\d+", path.stem) else None


def _read_label(content: bytes, name: str) -> tuple[int, tuple[float, ...]]:
    """Class and box, in pixels, of a YOLO label."""
    try:
        number, *sides = map(float, content.split()[:5])
        x, y, width, height = (SIDE * one for one in sides)
        is_one = number in range(len(TABLE_CLASSES)) and min(width, height) > 0
    except ValueError:
        is_one = False
    if not is_one:
        raise FileFormatError(
            f"the label of {name} is {shown(content.decode(errors='replace'))}; it must be CLASS X "
            f"Y WIDTH HEIGHT, with a class of 0 to {len(TABLE_CLASSES) - 1}: "
            + ", ".join(TABLE_CLASSES)
        )
    return int(number), (x - width / 2, y - height / 2, width, height)


def read_turntables(folder: Path) -> Frames:
    """Windows of the turntable recordings, one after the other.

    Raises:
        InputError: a recording is not there.
        FileFormatError: one is no AEDAT2 of a DVS128.
    """
    paths = [folder / f"DataSet2_{name}.aedat" for name in TURNTABLE_FILES.values()]
    for path in paths:
        if not path.is_file():
            raise InputError(f"there is no {path}; give the folder of DataSet2_*.aedat")
    found = [_windows(path) for path in paths]
    numbers = np.repeat(np.arange(len(found)), [len(one) for one in found])
    boxes = np.full((len(numbers), 4), np.nan, np.float32)
    return Frames(np.concatenate(found), numbers, boxes, numbers)


def _windows(path: Path) -> NDArray[np.int8]:
    events = open_events(path).collect()
    if events.size.shape != (SIDE, SIDE):
        raise FileFormatError(f"{path} has {events.size} pixels; a DVS128 has {SIDE}x{SIDE}")
    starts = _starts(events)
    if not len(starts):
        raise InputError(f"{path} is shorter than {WINDOW_US // 1000} ms")
    return np.stack([last_polarity(events, start_us) for start_us in starts])


def _starts(events: EventStream) -> range:
    if not len(events):
        return range(0)
    return range(int(events.t[0]), int(events.t[-1]) - WINDOW_US, WINDOW_US)
