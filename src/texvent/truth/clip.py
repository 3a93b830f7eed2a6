"""Ground truth of a clip as a data set stores it: NumPy files, read when they are asked for."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, one_line
from texvent.io.arrays.npz import NPZ_DAMAGE
from texvent.sensor import SensorSize
from texvent.truth.boxes import BOX_RECORD

EDGE_PX = 1e-3
"""Rounding of a right or lower edge that is summed in float32."""


@dataclass(frozen=True, eq=False, repr=False)
class ClipTruth:
    """Ground truth of a clip; arrays are read when they are asked for.

    There are N frames. A part that is not stored raises InputError, a damaged file FileFormatError.
    """

    read_file: Callable[[str], bytes]
    """Content of a file of the sample by name; KeyError: there is none. Its `json` has the facts,
    under `truth`."""
    where: str
    """What it is the truth of, for messages."""

    def __repr__(self) -> str:
        return f"ClipTruth({len(self.times_us)} frames, {', '.join(self.parts) or 'nothing'})"

    @cached_property
    def facts(self) -> Mapping[str, Any]:
        """Parts, times, classes and instances; nothing where no truth is stored."""
        try:
            facts: Mapping[str, Any] = json.loads(self.read_file("json")).get("truth", {})
            for name in ("times_us", "box_times_us"):
                np.array(facts.get(name, ()), np.int64)
            named = [one for of in ("classes", "instances") for one in facts.get(of, {}).items()]
            texts = [*facts.get("parts", ()), *(name for number, name in named if int(number) >= 0)]
        except (ValueError, TypeError, AttributeError, KeyError, OverflowError) as error:
            raise FileFormatError(f"{self.where} is damaged ({one_line(error)})") from error
        self._refuse(not all(isinstance(one, str) for one in texts), "its truth has no names")
        return facts

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
        boxes = self._load("boxes", "boxes.npy")
        is_wrong = boxes.dtype != BOX_RECORD or boxes.ndim != 1
        self._refuse(is_wrong, f"boxes.npy holds {boxes.dtype} {boxes.shape}")
        return boxes

    @cached_property
    def visibility(self) -> NDArray[np.float32]:
        """[k] visible share of the object of each box; NaN where it is not known."""
        return self._load("boxes", "visibility.npy")

    @property
    def flow(self) -> NDArray[np.float32]:
        """[N − 1, H, W, 2] px from each frame to the next; NaN where it is not known."""
        return self._load("flow", "flow.npz", "flow").astype(np.float32)

    @property
    def occluded(self) -> NDArray[np.bool_]:
        """[N − 1, H, W] whether the next frame hides it; refused where the source does not tell."""
        return self._load("flow", "flow.npz", "occluded")

    @property
    def depth(self) -> NDArray[np.float32]:
        """[N, H, W] m along the optical axis; inf for the sky."""
        return self._load("depth", "depth.npz", "depth").astype(np.float32)

    @property
    def instance(self) -> NDArray[np.int32]:
        """[N, H, W] instance ids; 0 is the background."""
        return self._load("ids", "ids.npz", "instance").astype(np.int32)

    @property
    def poses(self) -> NDArray[np.float64]:
        """[N, 4, 4] camera-to-world, m; camera axes x right, y down, z forward."""
        return self._load("poses", "poses.npz", "pose")

    @property
    def intrinsics(self) -> NDArray[np.float64]:
        """[N, 4] fx, fy, cx, cy, px; pixel centres have whole coordinates."""
        return self._load("poses", "poses.npz", "intrinsics")

    def _load(self, part: str, file: str, name: str = "") -> NDArray[Any]:
        """An array of a file; `name` in an archive."""
        if part not in self.parts:
            stored = ", ".join(self.parts) or "none"
            raise InputError(
                f"{self.where} has no {part}: the truth that its data set stores is {stored}; name "
                f"{part} in `truth` of its specification, and make it again"
            )
        try:
            loaded = np.load(io.BytesIO(self.read_file(file)), allow_pickle=False)
            return np.asarray(loaded[name] if name else loaded)
        except NPZ_DAMAGE as error:
            raise FileFormatError(
                f"{self.where}: {file} holds no {name or 'array'} ({one_line(error)})"
            ) from error

    def check(self, size: SensorSize) -> None:
        """Refuse truth that cannot be that of a clip.

        Args:
            size: of the sensor, pixels.

        Raises:
            FileFormatError: times out of order, boxes outside the sensor, ids that no object has,
                or images of another size.
        """
        frames = len(self.times_us)
        shapes = {"flow": (frames - 1, *size.shape, 2), "depth": (frames, *size.shape),
                  "instance": (frames, *size.shape), "poses": (frames, 4, 4)}  # fmt: skip
        for name, shape in shapes.items():
            if ("ids" if name == "instance" else name) in self.parts:
                found = getattr(self, name).shape
                self._refuse(found != shape, f"{name} has the shape {found}, not {shape}")
        objects = {0, *self.instances}
        if "ids" in self.parts and self.instances:
            self._refuse_unknown("object", self.instance, objects)
        if "boxes" not in self.parts:
            return
        boxes, known = self.boxes, self.box_times_us
        right, bottom = boxes["x"] + boxes["w"], boxes["y"] + boxes["h"]
        is_inside = (boxes["x"] >= 0) & (boxes["y"] >= 0) & (boxes["w"] > 0) & (boxes["h"] > 0)
        is_inside &= (right <= size.width + EDGE_PX) & (bottom <= size.height + EDGE_PX)
        strange = boxes[~is_inside][:1].tolist()
        self._refuse(bool(strange), f"box {strange} is not inside {size}")
        is_ordered = (np.diff(known) > 0).all() and (np.diff(boxes["t"]) >= 0).all()
        self._refuse(not is_ordered, "times of boxes are not in order")
        self._refuse(len(self.visibility) != len(boxes), "visibility is not that of its boxes")
        self._refuse_unknown("time", boxes["t"], set(known.tolist()))
        self._refuse_unknown("class", boxes["class_id"], set(self.classes))
        if self.instances:
            self._refuse_unknown("object", boxes["track_id"], objects)

    def _refuse(self, is_wrong: bool, why: str) -> None:
        if is_wrong:
            raise FileFormatError(f"{self.where} is damaged: {why}")

    def _refuse_unknown(self, what: str, found: NDArray[Any], known: set[int]) -> None:
        strange = set(np.unique(found).tolist()) - known
        self._refuse(bool(strange), f"{what} {min(strange, default=0)} is not known")
