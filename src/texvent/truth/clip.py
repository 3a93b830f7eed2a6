"""Ground truth of a clip read back, from a folder or from a sample of a data set.

Both are read by one class, part by part, when they are asked for.
"""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.io.arrays.npz import NPZ_DAMAGE
from texvent.sensor import SensorSize, checked_size
from texvent.truth.boxes import BOX_RECORD
from texvent.truth.layout import CLIP_FILES, DIRECTIONS

EDGE_PX = 1e-3
"""Rounding of a right or lower edge that is summed in float32."""
SOME_KNOW = {"occluded": "what is occluded", "class_id": "the class of pixels"}
"""Arrays that not every source brings."""
_NAMED = ("classes", "instances", "objects")
"""Facts that are numbers with names."""
FACT_DAMAGE = (ValueError, TypeError, AttributeError, KeyError, OverflowError, RecursionError)


@dataclass(frozen=True, eq=False, repr=False)
class ClipTruth:
    """Ground truth of a clip; arrays are read when they are asked for.

    There are N frames, numbered from 0. A method that takes `index` gives the array of that frame,
    without it those of all frames, stacked. A part that is not stored raises InputError, a damaged
    file FileFormatError.
    """

    read_file: Callable[[str], bytes]
    """Content of a file by name. The `json` of a sample has the facts, under `truth`; KeyError:
    there is no such file."""
    where: str
    """The folder or the sample, for messages."""
    _held: dict[str, NDArray[Any]] = field(default_factory=dict, init=False)
    """Arrays of all frames that have been read."""

    def __repr__(self) -> str:
        return f"ClipTruth({len(self)} frames, {', '.join(self.parts) or 'nothing'})"

    def __len__(self) -> int:
        """Number of frames."""
        return len(self.times_us)

    @cached_property
    def facts(self) -> Mapping[str, Any]:
        """Parts, times, classes, instances and size; no parts where no truth is stored."""
        try:
            facts = self._read_facts()
            for name in ("times_us", "box_times_us"):
                np.array(facts.get(name, ()), np.int64)
            named = [one for of in _NAMED for one in facts.get(of, {}).items()]
            texts = [*facts.get("parts", ()), *(name for number, name in named if int(number) >= 0)]
        except FileFormatError:
            raise
        except FACT_DAMAGE as error:
            raise FileFormatError(f"{self.where} is damaged ({one_line(error)})") from error
        self._refuse(not all(isinstance(one, str) for one in texts), "its truth has no names")
        return facts

    @property
    def parts(self) -> tuple[str, ...]:
        """Names of the parts that are stored."""
        return tuple(self.facts.get("parts", ()))

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        sides = [self.facts[name] for name in ("width", "height")]
        self._refuse(not all(isinstance(side, int) for side in sides), "it does not say its size")
        return checked_size(*sides)

    @property
    def metadata(self) -> Mapping[str, Any]:
        """Provenance: prompt, seed, options, version."""
        run: Mapping[str, Any] = self.facts["run"]
        return run

    @cached_property
    def times_us(self) -> NDArray[np.int64]:
        """[N] times of the frames, µs, on the clock of the events."""
        return np.array(self.facts.get("times_us", ()), np.int64)

    @property
    def box_times_us(self) -> NDArray[np.int64]:
        """Times at which boxes are known, µs; at some of them nothing may be in view."""
        return np.array(self.facts.get("box_times_us", self.times_us), np.int64)

    @property
    def classes(self) -> dict[int, str]:
        """Class id → name: all of the data set where it names its classes, else of the clip.

        0, the background, is not among those of the clip.
        """
        return {int(number): name for number, name in self.facts.get("classes", {}).items()}

    @property
    def instances(self) -> dict[int, str]:
        """Instance id → name of the object, of the objects of the clip that have a name."""
        return {int(number): name for number, name in self.facts.get("instances", {}).items()}

    @property
    def objects(self) -> dict[int, str]:
        """Instance id → id of its object in the scene, such as "taxi" or "tree 2".

        The name of its class, where the scene gives it no other; copies of an object share its id.
        """
        ids = {int(number): name for number, name in self.facts.get("objects", {}).items()}
        return {**self.instances, **ids}

    def flow(self, index: int | None = None) -> NDArray[np.float32]:
        """[H, W, 2] px from frame `index` to the next, N − 1 of them; NaN where not known."""
        return self._frames("flow", "flow", index).astype(np.float32)

    def flow_back(self, index: int | None = None) -> NDArray[np.float32]:
        """[H, W, 2] px from frame `index` to the one before, from 1 on; NaN where not known."""
        return self._frames("flow-back", "flow", index).astype(np.float32)

    def occluded(self, index: int | None = None, part: str = "flow") -> NDArray[np.bool_]:
        """[H, W] whether what frame `index` shows is hidden at the next.

        Args:
            index: number of the frame.
            part: "flow-back": hidden at the frame before.

        Raises:
            InputError: the source of the frames does not tell.
        """
        if part not in DIRECTIONS:
            raise InputError(f"part is {shown(part)}; it must be one of {', '.join(DIRECTIONS)}")
        return self._frames(part, "occluded", index).astype(np.bool_)

    def depth(self, index: int | None = None) -> NDArray[np.float32]:
        """[H, W] m along the optical axis; inf for the sky."""
        return self._frames("depth", "depth", index).astype(np.float32)

    def instance(self, index: int | None = None) -> NDArray[np.int32]:
        """[H, W] instance ids; 0 is the background."""
        return self._frames("ids", "instance", index).astype(np.int32)

    def class_id(self, index: int | None = None) -> NDArray[np.int32]:
        """[H, W] class ids; 0 is the background. Samples of data sets do not store it."""
        return self._frames("ids", "class_id", index).astype(np.int32)

    @cached_property
    def boxes(self) -> NDArray[np.void]:
        """[k] records t (µs), x, y, w, h (px), class_id, track_id, class_confidence, in order of t.

        `track_id` is the instance; 0 where it is not known.
        """
        boxes = self._whole("boxes", "boxes")
        is_wrong = boxes.dtype != BOX_RECORD or boxes.ndim != 1
        self._refuse(is_wrong, f"boxes.npy holds {boxes.dtype} {boxes.shape}")
        return boxes

    def boxes_at(self, index: int) -> NDArray[np.void]:
        """The boxes at the time of one frame."""
        self._check_frame("boxes", range(len(self)), index)
        return np.asarray(self.boxes[self.boxes["t"] == self.times_us[index]])

    @cached_property
    def visibility(self) -> NDArray[np.float32]:
        """[k] visible share of the object of each box; NaN where it is not known."""
        return self._whole("boxes", "visibility")

    @cached_property
    def poses(self) -> NDArray[np.float64]:
        """[N, 4, 4] camera-to-world, m; camera axes x right, y down, z forward."""
        return self._whole("poses", "pose")

    @cached_property
    def intrinsics(self) -> NDArray[np.float64]:
        """[N, 4] fx, fy, cx, cy, px; pixel centres have whole coordinates."""
        return self._whole("poses", "intrinsics")

    @property
    def camera_matrices(self) -> NDArray[np.float64]:
        """[N, 3, 3] the same intrinsics as matrices."""
        matrices = np.tile(np.eye(3), (len(self.intrinsics), 1, 1))
        matrices[:, [0, 1, 0, 1], [0, 1, 2, 2]] = self.intrinsics
        return matrices

    @cached_property
    def event_instance(self) -> NDArray[np.uint16]:
        """[n] instance of each event, in the order of the event file."""
        return self._whole("events", "instance")

    @cached_property
    def event_class_id(self) -> NDArray[np.uint16]:
        """[n] class of each event, in the order of the event file."""
        return self._whole("events", "class_id")

    def check(self, size: SensorSize) -> None:
        """Refuse truth that cannot be that of a clip.

        Args:
            size: of the sensor, pixels.

        Raises:
            FileFormatError: times out of order, boxes outside the sensor, ids that no object has,
                or images of another size.
        """
        frames = len(self)
        shapes = {"flow": (frames - 1, *size.shape, 2), "depth": (frames, *size.shape),
                  "instance": (frames, *size.shape), "poses": (frames, 4, 4),
                  "intrinsics": (frames, 4)}  # fmt: skip
        parts = {"instance": "ids", "intrinsics": "poses"}
        for name, shape in shapes.items():
            if parts.get(name, name) in self.parts:
                value = getattr(self, name)
                found = np.shape(value() if callable(value) else value)
                self._refuse(found != shape, f"{name} has the shape {found}, not {shape}")
        objects = {0, *self.instances}
        if "ids" in self.parts and self.instances:
            self._refuse_unknown("object", self.instance(), objects)
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

    def _check_frame(self, part: str, numbers: range, index: int | None) -> None:
        """Refuse a part that is not stored, and a frame that there is not."""
        if part not in self.parts:
            raise InputError(
                f"{self.where} has no {part}: the truth that it stores is "
                f"{', '.join(self.parts) or 'none'}; {self._remedy(part)}"
            )
        if index is not None and index not in numbers:
            there = f"{numbers.start}..{numbers.stop - 1}" if numbers else "none"
            raise InputError(f"frame {index} has no {part}; there are those of {there}")

    def _frames(self, part: str, name: str, index: int | None) -> NDArray[Any]:
        """An array of one frame, or of all that have it."""
        numbers = range(int(part == "flow-back"), len(self) - int(part == "flow"))
        self._check_frame(part, numbers, index)
        if not numbers:
            return np.zeros((0, *self.size.shape, *(2,) * (name == "flow")))
        return self._stored(part, name, numbers, index)

    def _whole(self, part: str, name: str) -> NDArray[Any]:
        """An array that is not one of frames."""
        self._check_frame(part, range(0), None)
        return self._table(part, name)

    def _remedy(self, part: str) -> str:
        if part not in CLIP_FILES:
            return "only folders that --truth writes have it"
        return f"name {part} in `truth` of the specification, and make the data set again"

    def _read_facts(self) -> dict[str, Any]:
        run = json.loads(self.read_file("json"))
        size = {name: run.get(name) for name in ("width", "height")}
        return {**size, "run": run, **run.get("truth", {})}

    def _stored(self, part: str, name: str, numbers: range, index: int | None) -> NDArray[Any]:
        if name not in self._held:
            rows = self._load(f"{part}.npz", name)
            is_wrong = rows.shape[:1] != (len(numbers),)
            what = f"{name} has the shape {rows.shape}, and {len(numbers)} frames have it"
            self._refuse(is_wrong, what)
            self._held[name] = rows
        return self._held[name] if index is None else self._held[name][index]

    def _table(self, part: str, name: str) -> NDArray[Any]:
        if part == "boxes":
            return self._load(f"{name}.npy")
        return self._load(f"{part}.npz", name)

    def _load(self, file: str, name: str = "") -> NDArray[Any]:
        """An array of a file; `name` in an archive."""
        try:
            loaded = self._open(file)
            if name not in SOME_KNOW or name in loaded:
                return np.asarray(loaded[name] if name else loaded)
        except FileFormatError:
            raise
        except (InputError, *NPZ_DAMAGE) as error:
            raise FileFormatError(
                f"{self.where}: {file} holds no {name or 'array'} ({one_line(error)})"
            ) from error
        raise InputError(f"{self.where} does not say {SOME_KNOW[name]}: its source did not")

    def _open(self, file: str) -> Any:
        return np.load(io.BytesIO(self.read_file(file)), allow_pickle=False)
