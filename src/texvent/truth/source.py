"""Ground truth of the frames of a stream, from any source.

* A stream with a method `ground_truth(t0_us, t1_us)`, such as a scene of the embedded generator,
  is asked at any instant. With `camera_at(t_us)` it has poses, with `instances_at(t_us, points)`
  the ids of events are exact, with `class_names` objects have names.
* Frames with `Frame.motion` bring vectors, depth and ids along; they are passed on as they are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from types import MappingProxyType
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from texvent.camera import PosedCamera
from texvent.capture.prepare import PreparedFrames
from texvent.capture.scale_check import CheckedFrames
from texvent.errors import ConfigError, InputError
from texvent.frames import Frame, FrameStream, MotionVectors
from texvent.ground_truth import Box, GroundTruth
from texvent.sensor import SensorSize
from texvent.truth.boxes import box_records
from texvent.truth.class_ids import BACKGROUND, UNNAMED, class_ids_of
from texvent.truth.layout import PARTS
from texvent.truth.poses import intrinsics, pose_matrix
from texvent.view.drawing.panels import GroundTruthStream

ON_FRAMES = {"flow", "flow-back", "depth", "ids", "boxes"}
"""Parts that take an image of the truth."""
UNNAMED_OBJECT = "object"
MOST_INSTANCES = 2**16
"""Ids are stored in 16 bits."""
WHO_KNOWS = (
    "truth is known of scenes of the embedded generator (texvent generate --generator "
    "procedural), and of frames that come with motion vectors, depth or ids"
)


@runtime_checkable
class CameraStream(Protocol):
    """Frames whose camera is known."""

    def camera_at(self, t_us: int) -> PosedCamera:
        """The camera at `t_us`."""
        ...


@runtime_checkable
class InstancesStream(Protocol):
    """Frames of a scene that can be asked what a point of the image shows, at any instant."""

    def instances_at(
        self, t_us: int, points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """Depth in metres and instance id, [k], at the image points [k, 2], pixels."""
        ...


Rows = Mapping[str, Mapping[str, Any]]
"""Part → its values at a frame by name.

* flow, flow-back: `to_t`, `flow`, and `occluded` where it is known; depth: `depth`; ids:
  `instance`; poses: `pose`, `intrinsics`.
* boxes: `boxes`, records of `BOX_RECORD`, `visibility`, and `area`, visible pixels.
"""


@dataclass(frozen=True, eq=False)
class Snapshot:
    """Ground truth of a frame."""

    t_us: int
    motion: MotionVectors
    """As far as it is known; vectors to frames that are not there are None."""
    rows: Rows
    """Values of the parts that are wanted and known."""


_Known = tuple[MotionVectors, dict[str, dict[str, Any]], tuple[Box, ...]]
"""Motion, masks of what is hidden by part, and boxes."""


class TruthSource:
    """Ground truth of a stream, frame by frame.

    Args:
        video: the frames.
        parts: names of the parts that are wanted.
        classes: object → its class; only these objects have boxes, and classes are numbered from 0
            in this order. Empty: all objects, by the class ids of nouns.

    Attributes:
        video: the frames, or the scene that knows their truth.
        parts: as given.
        class_names: instance id → class name.
        object_ids: instance id → id of its object in the scene, where that is not the class name.
        class_ids: class name → id, of all objects that have a name.
        classes: class id → name; objects without a name join when one is seen.
        numbers: object → class id, of the classes given.

    Raises:
        ConfigError: the stream does not know one of the parts.
    """

    def __init__(
        self,
        video: FrameStream,
        parts: Sequence[str],
        classes: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        self.video, self.parts = without_preparation(video), parts
        names: Mapping[int, str] = dict(getattr(self.video, "class_names", {}))
        self.class_names = names
        ids: Mapping[int, str] = getattr(self.video, "object_ids", {})
        self.object_ids = {one: id for one, id in ids.items() if id != names.get(one)}
        self.class_ids: Mapping[str, int] = class_ids_of(names.values())
        self.classes = dict(sorted((number, name) for name, number in self.class_ids.items()))
        self.numbers: dict[str, int] = {}
        if classes:
            chosen = tuple(dict.fromkeys(classes.values()))
            self.classes = dict(enumerate(chosen))
            self.numbers = {noun: chosen.index(name) for noun, name in classes.items()}
        if "poses" in self.parts and not isinstance(self.video, CameraStream):
            others = ",".join(part for part in PARTS if part != "poses")
            raise ConfigError(
                "truth 'poses' needs a known camera, which these frames do not have; ask for some "
                f"of the others: {others}"
            )
        if "poses" in self.parts and isinstance(self.video, FittedScene):
            self.video.camera_at(0)  # refused before any work
        highest = max(names, default=0)
        if highest >= MOST_INSTANCES:
            raise ConfigError(f"instance id {highest} is too large; at most {MOST_INSTANCES - 1}")

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        return self.video.size

    def class_of(self, instance: NDArray[Any]) -> NDArray[np.uint16]:
        """Class ids of instance ids, of any shape."""
        table = np.full(max(int(instance.max(initial=0)), *self.class_names, 0) + 1, UNNAMED)
        table[0] = BACKGROUND
        for one, name in self.class_names.items():
            table[one] = self.class_ids[name]
        found = np.asarray(table[instance], dtype=np.uint16)
        if (found == UNNAMED).any():
            self.classes[UNNAMED] = UNNAMED_OBJECT
        return found

    def camera_at(self, t_us: int) -> PosedCamera | None:
        """The camera at an instant; None where it is not known."""
        return self.video.camera_at(t_us) if isinstance(self.video, CameraStream) else None

    def at(self, frame: Frame, previous_us: int | None, next_us: int | None) -> Snapshot:
        """Ground truth of a source frame.

        Args:
            frame: the frame.
            previous_us: time of the source frame before, µs; None: it is the first.
            next_us: time of the next source frame, µs; None: it is the last.

        Raises:
            InputError: the frame does not bring what is wanted, or an id does not fit.
        """
        if isinstance(self.video, GroundTruthStream):
            motion, hidden, boxes = self._of_scene(self.video, frame.t_us, previous_us, next_us)
        else:
            motion, hidden, boxes = self._of_frame(frame, previous_us, next_us)
        found: dict[str, dict[str, Any]] = {}
        for part, vectors, to_us in (
            ("flow", motion.forward, next_us),
            ("flow-back", motion.backward, previous_us),
        ):
            if vectors is not None:
                found[part] = {"to_t": to_us, "flow": vectors, **hidden.get(part, {})}
        if motion.depth is not None:
            found["depth"] = {"depth": motion.depth}
        if "ids" in self.parts and motion.instance is not None:
            found["ids"] = {"instance": as_ids(motion.instance)}
        if "boxes" in self.parts and motion.instance is not None:
            found["boxes"] = self._box_row(frame.t_us, boxes, motion.instance)
        if "poses" in self.parts and (camera := self.camera_at(frame.t_us)) is not None:
            lens = np.array(intrinsics(camera, self.size))
            found["poses"] = {"pose": pose_matrix(camera), "intrinsics": lens}
        rows = {part: found[part] for part in self.parts if part in found}
        return Snapshot(frame.t_us, motion, rows)

    def _box_row(
        self, t_us: int, boxes: Sequence[Box], instance: NDArray[np.int32]
    ) -> dict[str, Any]:
        if self.numbers:
            boxes = [box for box in boxes if box.class_name in self.numbers]
        ids = np.array([box.instance for box in boxes], np.int64)
        class_ids = [self.numbers.get(box.class_name, 0) for box in boxes]
        return {
            "boxes": box_records(
                t_us, boxes, class_ids if self.numbers else self.class_of(ids).tolist()
            ),
            "visibility": np.array([box.visibility for box in boxes], np.float64),
            "area": np.bincount(instance.ravel(), minlength=1)[ids],
        }

    def _of_scene(
        self, video: GroundTruthStream, t_us: int, previous_us: int | None, next_us: int | None
    ) -> _Known:
        needed = ON_FRAMES if isinstance(video, InstancesStream) else {*ON_FRAMES, "events"}
        if not needed & set(self.parts):
            return MotionVectors(), {}, ()
        to_us = next_us if "flow" in self.parts else None
        truth = video.ground_truth(t_us, t_us if to_us is None else to_us)
        hidden, back = {"flow": {"occluded": truth.occluded}}, None
        if "flow-back" in self.parts and previous_us is not None:
            past = video.ground_truth(t_us, previous_us)
            back, hidden["flow-back"] = past.flow, {"occluded": past.occluded}
        forward = None if to_us is None else truth.flow
        return MotionVectors(forward, back, truth.depth, truth.instance), hidden, truth.boxes

    def _of_frame(self, frame: Frame, previous_us: int | None, next_us: int | None) -> _Known:
        motion = frame.motion if frame.motion is not None else MotionVectors()
        missing = {
            "flow": motion.forward is None and next_us is not None,
            "flow-back": motion.backward is None and previous_us is not None,
            "depth": motion.depth is None,
            **dict.fromkeys(("ids", "boxes", "events"), motion.instance is None),
        }
        lacking = [part for part in self.parts if missing.get(part)]
        if lacking:
            raise InputError(
                f"truth {lacking[0]!r} is not known of the frame at {frame.t_us} µs: {WHO_KNOWS}"
            )
        boxes: tuple[Box, ...] = ()
        if "boxes" in self.parts and motion.instance is not None:
            boxes = boxes_of(motion.instance, self.class_names)
        forward = None if next_us is None else motion.forward
        back = None if previous_us is None else motion.backward
        return replace(motion, forward=forward, backward=back), {}, boxes


def as_ids(instance: NDArray[np.int32]) -> NDArray[np.uint16]:
    """Instance ids in the 16 bits in which they are stored.

    Raises:
        InputError: one does not fit.
    """
    if instance.size and not 0 <= int(instance.min()) <= int(instance.max()) < MOST_INSTANCES:
        raise InputError(
            f"instance ids run from {int(instance.min())} to {int(instance.max())}; files hold "
            f"0..{MOST_INSTANCES - 1}"
        )
    return instance.astype(np.uint16)


def without_preparation(video: FrameStream) -> FrameStream:
    """The stream that was cut in time, which knows the truth; fitted to a sensor as its frames.

    Raises:
        ConfigError: its frames were fitted, and it cannot be asked at points or has no camera.
    """
    source, fit = video, "cover"
    while isinstance(source, PreparedFrames | CheckedFrames):
        fit = getattr(source, "fit", fit)
        source = source.source
    if not isinstance(source, GroundTruthStream):
        return video
    if source.size == video.size:
        return source
    if not (isinstance(source, CameraStream) and isinstance(source, InstancesStream)):
        raise ConfigError(
            f"truth is known of frames of {source.size}, and these were fitted to {video.size}; "
            "leave `sensor` out, or give a generator this size"
        )
    return FittedScene(source, video, fit)


class FittedScene:
    """A scene that knows its truth, of whose image a sensor sees a part, larger or smaller.

    Args:
        scene: knows the truth of its own frames.
        video: its fitted frames.
        fit: how they were fitted.
    """

    def __init__(self, scene: GroundTruthStream, video: FrameStream, fit: str) -> None:
        from texvent.capture.fit_to_sensor import fit_motion, fit_place  # brings OpenCV

        self._scene, self._video = scene, video
        self.size, self.fps, self.is_live = video.size, video.fps, video.is_live
        self.frame_count, self.metadata = video.frame_count, video.metadata
        self.class_names: Mapping[int, str] = getattr(scene, "class_names", {})
        self.object_ids: Mapping[int, str] = getattr(scene, "object_ids", {})
        self._fitted: Callable[..., Any] = partial(fit_motion, size=self.size, fit=fit)
        self._scale, self._shift = fit_place(scene.size, self.size, fit)
        self._is_even = fit != "stretch"

    def __iter__(self) -> Iterator[Frame]:
        """The fitted frames."""
        return iter(self._video)

    def ground_truth(self, t0_us: int, t1_us: int) -> GroundTruth:
        """Truth of the fitted frames; visibility is that in the whole image."""
        truth = self._scene.ground_truth(t0_us, t1_us)
        seen = self._fitted(MotionVectors(truth.flow, None, truth.depth, truth.instance))
        hidden = self._fitted(MotionVectors(instance=truth.occluded.astype(np.int32))).instance > 0
        rows, columns = np.indices(self.size.shape) + 0.5
        hidden |= ~_inside(np.stack([columns, rows], axis=-1) + seen.forward, self.size)
        known = {box.instance: box for box in truth.boxes}
        names = {number: box.class_name for number, box in known.items()}
        boxes = tuple(
            replace(box, visibility=known[box.instance].visibility)
            for box in boxes_of(seen.instance, names)
            if box.instance in known
        )
        return GroundTruth(seen.depth, seen.instance, seen.forward, hidden, boxes)

    def instances_at(self, t_us: int, points: NDArray[np.float64]) -> Any:
        """Depth and instance at image points [k, 2] of the fitted frames; inf and 0 in bars."""
        scene: Any = self._scene
        places = (points - self._shift) / self._scale
        seen = _inside(places, scene.size)
        depth, instance = np.full(len(points), np.inf), np.zeros(len(points), np.int32)
        depth[seen], instance[seen] = scene.instances_at(t_us, places[seen])
        return depth, instance

    def camera_at(self, t_us: int) -> PosedCamera:
        """The camera of the fitted frames; its centre is to half a pixel of the scene's.

        Raises:
            ConfigError: the frames were stretched, or the lens distorts.
        """
        scene: Any = self._scene
        camera: PosedCamera = scene.camera_at(t_us)
        if camera.lens is not None or not self._is_even:
            raise ConfigError(
                "truth 'poses' is not known of frames that were stretched, or fitted behind a lens "
                "that distorts; leave `sensor` out"
            )
        width = self._scene.size.width * float(self._scale[0])
        return replace(camera, focal=camera.focal * width / self.size.width)


def _inside(points: NDArray[np.floating[Any]], size: SensorSize) -> NDArray[np.bool_]:
    """Whether points [..., 2] are in an image of this size; NaN is not."""
    return np.asarray(((points >= 0) & (points < np.array(size))).all(axis=-1))


def boxes_of(instance: NDArray[np.int32], class_names: Mapping[int, str]) -> tuple[Box, ...]:
    """Boxes around the visible pixels of each id but 0; how much is hidden is not known (NaN).

    Args:
        instance: [H, W] ids.
        class_names: instance id → class name.

    Example:
        >>> boxes_of(np.array([[0, 0], [0, 7]], dtype=np.int32), {7: "car"})[0].x0
        1
    """
    found = []
    for one in np.unique(instance[instance > 0]):
        rows, columns = np.nonzero(instance == one)
        name = class_names.get(int(one), "")
        x0, y0, x1, y1 = columns.min(), rows.min(), columns.max() + 1, rows.max() + 1
        found.append(Box(int(one), name, int(x0), int(y0), int(x1), int(y1), float("nan")))
    return tuple(found)
