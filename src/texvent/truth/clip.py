"""Ground truth of a clip as a data set stores it: NumPy files, read when they are asked for."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.io.arrays.npz import NPZ_DAMAGE
from texvent.sensor import SensorSize
from texvent.truth.boxes import BOX_RECORD

EDGE_PX = 1e-3
"""Rounding of a right or lower edge that is summed in float32."""


@dataclass(frozen=True, eq=False)
class StoredTruth:
    """Ground truth of a clip as files, and what is to be known to read them."""

    files: Mapping[str, bytes]
    """Name → content."""
    facts: Mapping[str, Any]
    """Parts, times, classes and instances, ready for JSON."""

    @property
    def read(self) -> ClipTruth:
        """The same, read back."""
        return ClipTruth(self.facts, self.files.__getitem__, "the clip")


@dataclass(frozen=True, eq=False, repr=False)
class ClipTruth:
    """Ground truth of a clip; arrays are read when they are asked for.

    N frames have times. A part that is not stored raises InputError.
    """

    facts: Mapping[str, Any]
    """As `StoredTruth.facts`; nothing where no truth is stored."""
    read_file: Callable[[str], bytes]
    """Content of a file by name."""
    where: str
    """What it is the truth of, for messages."""

    def __repr__(self) -> str:
        return f"ClipTruth({len(self.times_us)} frames, {', '.join(self.parts) or 'nothing'})"

    @property
    def parts(self) -> tuple[str, ...]:
        """Names of the parts that are stored."""
        return tuple(self.facts.get("parts", ()))

    @property
    def times_us(self) -> NDArray[np.int64]:
        """[N] times of the frames, µs, on the clock of the events."""
        return np.array(self.facts.get("times_us", ()), np.int64)

    @property
    def box_times_us(self) -> NDArray[np.int64]:
        """Times at which boxes are known, µs; at some of them nothing may be in view."""
        return np.array(self.facts.get("box_times_us", self.times_us), np.int64)

    @property
    def classes(self) -> dict[int, str]:
        """Class id → name: all of the data set where it names its classes, else of the clip."""
        return {int(number): name for number, name in self.facts.get("classes", {}).items()}

    @property
    def instances(self) -> dict[int, str]:
        """Instance id → name of the object, of the objects of the clip that have a name."""
        return {int(number): name for number, name in self.facts.get("instances", {}).items()}

    @cached_property
    def boxes(self) -> NDArray[np.void]:
        """[k] records t (µs), x, y, w, h (px), class_id, track_id, class_confidence, in order of t.

        `track_id` is the instance; 0 where it is not known.
        """
        boxes: NDArray[np.void] = self._load("boxes", "boxes.npy")
        if boxes.dtype != BOX_RECORD or boxes.ndim != 1:
            raise self._damaged("boxes.npy", f"its type is {boxes.dtype}")
        return boxes

    @cached_property
    def visibility(self) -> NDArray[np.float32]:
        """[k] visible share of the object of each box; NaN where it is not known."""
        visibility: NDArray[np.float32] = self._load("boxes", "visibility.npy")
        return visibility

    @property
    def flow(self) -> NDArray[np.float32]:
        """[N − 1, H, W, 2] px from each frame to the next; NaN where it is not known."""
        return self._array("flow", "flow").astype(np.float32)

    @property
    def occluded(self) -> NDArray[np.bool_]:
        """[N − 1, H, W] whether the next frame hides it.

        Raises:
            InputError: the source of the frames does not tell.
        """
        if "occluded" not in self._archive("flow"):
            raise InputError(f"{self.where}: its source does not tell what is occluded")
        return self._array("flow", "occluded").astype(np.bool_)

    @property
    def depth(self) -> NDArray[np.float32]:
        """[N, H, W] m along the optical axis; inf for the sky."""
        return self._array("depth", "depth").astype(np.float32)

    @property
    def instance(self) -> NDArray[np.int32]:
        """[N, H, W] instance ids; 0 is the background."""
        return self._array("ids", "instance").astype(np.int32)

    @property
    def poses(self) -> NDArray[np.float64]:
        """[N, 4, 4] camera-to-world, m; camera axes x right, y down, z forward."""
        return self._array("poses", "pose").astype(np.float64)

    @property
    def intrinsics(self) -> NDArray[np.float64]:
        """[N, 4] fx, fy, cx, cy, px; pixel centres have whole coordinates."""
        return self._array("poses", "intrinsics").astype(np.float64)

    def _array(self, part: str, name: str) -> NDArray[Any]:
        arrays = self._archive(part)
        if name not in arrays:
            raise self._damaged(f"{part}.npz", f"it has no {name}")
        return arrays[name]

    def _archive(self, part: str) -> dict[str, NDArray[Any]]:
        arrays: dict[str, NDArray[Any]] = self._load(part, f"{part}.npz")
        return arrays

    def _load(self, part: str, name: str) -> Any:
        if part not in self.parts:
            stored = ", ".join(self.parts) or "none"
            raise InputError(
                f"{self.where} has no {part}: the truth that its data set stores is {stored}; name "
                f"{part} in `truth` of its specification, and make it again"
            )
        try:
            loaded = np.load(io.BytesIO(self.read_file(name)), allow_pickle=False)
            return loaded if isinstance(loaded, np.ndarray) else dict(loaded)
        except NPZ_DAMAGE as error:
            raise self._damaged(name, one_line(error)) from error

    def _damaged(self, name: str, why: str) -> FileFormatError:
        return FileFormatError(f"{self.where} is damaged: {name}: {why}")

    def check(self, size: SensorSize) -> None:
        """Refuse truth that cannot be that of a clip.

        Args:
            size: of the sensor, pixels.

        Raises:
            FileFormatError: times out of order, boxes outside the sensor, ids that no object has,
                or arrays of another size.
        """
        try:
            self._check(size)
        except (ValueError, TypeError, AttributeError, KeyError) as error:
            if isinstance(error, FileFormatError):
                raise
            raise self._damaged("json", one_line(error)) from error

    def _check(self, size: SensorSize) -> None:
        frames = len(self.times_us)
        for name, times in (("frames", self.times_us), ("boxes", self.box_times_us)):
            if (np.diff(times) <= 0).any():
                raise self._damaged("json", f"times of {name} do not increase")
        if "boxes" in self.parts:
            self._check_boxes(size)
        shapes = {"flow": (frames - 1, *size.shape, 2), "depth": (frames, *size.shape),
                  "ids": (frames, *size.shape), "poses": (frames, 4, 4)}  # fmt: skip
        names = {"ids": "instance", "poses": "pose"}
        for part in self.parts:
            if part in shapes and self._array(part, names.get(part, part)).shape != shapes[part]:
                found = self._array(part, names.get(part, part)).shape
                raise self._damaged(f"{part}.npz", f"shape {found}, and not {shapes[part]}")
        if "ids" in self.parts and self.instances:
            self._check_known("ids.npz", "instance", np.unique(self.instance), {0, *self.instances})

    def _check_boxes(self, size: SensorSize) -> None:
        boxes, name = self.boxes, "boxes.npy"
        if (np.diff(boxes["t"]) < 0).any():
            raise self._damaged(name, "its times are not in order")
        if len(self.visibility) != len(boxes):
            raise self._damaged("visibility.npy", f"{len(self.visibility)} of {len(boxes)} boxes")
        right, bottom = boxes["x"] + boxes["w"], boxes["y"] + boxes["h"]
        is_inside = (boxes["x"] >= 0) & (boxes["y"] >= 0) & (boxes["w"] > 0) & (boxes["h"] > 0)
        is_inside &= (right <= size.width + EDGE_PX) & (bottom <= size.height + EDGE_PX)
        if not is_inside.all():
            first = boxes[int(np.argmin(is_inside))]
            place = [float(first[one]) for one in "xywh"]
            raise self._damaged(name, f"box {place} at {first['t']} µs is not inside {size}")
        self._check_known(name, "time", boxes["t"], set(self.box_times_us.tolist()))
        self._check_known(name, "class", boxes["class_id"], set(self.classes))
        if self.instances:
            self._check_known(name, "track", boxes["track_id"], {0, *self.instances})

    def _check_known(self, name: str, what: str, found: NDArray[Any], known: set[int]) -> None:
        strange = set(found.tolist()) - known
        if strange:
            raise self._damaged(name, f"{what} {shown(min(strange))} is not known")
