"""Ground truth of a clip recorded frame by frame, and turned into files for a data set."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.truth.boxes import BOX_RECORD, box_records
from texvent.truth.clip import StoredTruth
from texvent.truth.labels.placing import PlacedLabels
from texvent.truth.poses import intrinsics, pose_matrix
from texvent.truth.source import Snapshot, TruthSource
from texvent.truth.writer import check_instances
from texvent.video import Frame, FrameStream


class TruthRecorder:
    """Records what is true at the source frames of a clip.

    Flow and depth are float16: 11 bits, an error below 0.05 %.

    Args:
        video: the frames, whose truth is known.
        parts: names of `CLIP_FILES`.
        classes: object → its class; only these objects have boxes, and classes are numbered from 0
            in this order. None: all objects, by the class ids of nouns.
        labels: where boxes come from instead of the frames.

    Raises:
        ConfigError: the video does not know one of the parts.
    """

    def __init__(
        self,
        video: FrameStream,
        parts: Sequence[str],
        classes: Mapping[str, str] | None = None,
        *,
        labels: PlacedLabels | None = None,
    ) -> None:
        of_frames = [part for part in parts if labels is None or part != "boxes"]
        self._source, self._of_frames = TruthSource(video, of_frames), of_frames
        self._parts, self._labels = parts, labels
        self._class_of = classes
        self._class_ids = number_classes(classes or {})
        self._pending: Frame | None = None
        self._times: list[int] = []
        self._rows: dict[str, dict[str, list[Any]]] = {}
        self._boxes = [np.empty(0, BOX_RECORD)]
        self._visibility: list[float] = []
        self._stored: StoredTruth | None = None

    def add(self, frame: Frame) -> None:
        """Take a dense frame; truth is recorded of source frames, of each once, until `finish`.

        Raises:
            InputError: the frame does not bring the truth that is wanted.
        """
        if not frame.is_source or self._stored is not None:
            return
        if self._pending is not None:
            if frame.t_us <= self._pending.t_us:
                return
            self._record(self._pending, frame.t_us)
        self._pending = frame

    def finish(self) -> StoredTruth:
        """The truth of all frames."""
        if self._stored is None and self._pending is not None:
            self._record(self._pending, None)
            self._pending = None
        self._stored = self._stored or self._files()
        return self._stored

    def _files(self) -> StoredTruth:
        contents: dict[str, bytes] = {}
        placed = {} if self._labels is None else self._place(self._labels)
        if "boxes" in self._parts:
            contents["boxes.npy"] = _file(np.save, np.concatenate(self._boxes))
            contents["visibility.npy"] = _file(np.save, np.array(self._visibility, np.float32))
        for part, rows in self._rows.items():
            arrays = {name: np.array(values) for name, values in rows.items()}
            contents[f"{part}.npz"] = _file(np.savez_compressed, **arrays)
        classes = self._source.classes
        if self._class_of is not None:
            classes = {number: name for name, number in self._class_ids.items()}
        facts = {
            "parts": list(self._parts),
            "times_us": self._times,
            "classes": {str(number): name for number, name in classes.items()},
            **placed,
            "instances": {str(one): name for one, name in self._source.class_names.items()},
        }
        return StoredTruth(contents, facts)

    def _place(self, labels: PlacedLabels) -> dict[str, Any]:
        """Take the boxes of labels; gives the facts of their times."""
        times = np.array(self._times, np.int64)
        numbers = {name: self._class_ids[one] for name, one in (self._class_of or {}).items()}
        boxes, known = labels.boxes(times, self._source.size, numbers)
        self._boxes, self._visibility = [boxes], [float("nan")] * len(boxes)
        return {"box_times_us": known.tolist()}

    def _record(self, frame: Frame, next_us: int | None) -> None:
        truth = self._source.at(frame, self._times[-1] if self._times else None, next_us)
        self._times.append(truth.t_us)
        if "boxes" in self._of_frames:
            self._record_boxes(truth)
        if "flow" in self._parts and truth.flow is not None:
            more = {} if truth.flow.occluded is None else {"occluded": truth.flow.occluded}
            vectors = truth.flow.vectors.astype(np.float16)
            self._append("flow", truth.t_us, to_t=truth.flow.to_us, flow=vectors, **more)
        if "depth" in self._parts and truth.depth is not None:
            with np.errstate(over="ignore"):  # farther than 65 km is as good as the sky
                self._append("depth", truth.t_us, depth=truth.depth.astype(np.float16))
        if "ids" in self._parts and truth.instance is not None:
            check_instances(truth.instance)
            self._append("ids", truth.t_us, instance=truth.instance.astype(np.uint16))
        if "poses" in self._parts and truth.camera is not None:
            lens = intrinsics(truth.camera, self._source.size)
            pose = pose_matrix(truth.camera)
            self._append("poses", truth.t_us, pose=pose, intrinsics=np.array(lens))

    def _record_boxes(self, truth: Snapshot) -> None:
        boxes, known = truth.boxes, self._class_of
        if known is None:
            instances = np.array([box.instance for box in boxes], np.int64)
            class_ids = self._source.class_of(instances).tolist()
        else:
            boxes = tuple(box for box in boxes if box.class_name in known)
            class_ids = [self._class_ids[known[box.class_name]] for box in boxes]
        self._boxes.append(box_records(truth.t_us, boxes, class_ids))
        self._visibility += [box.visibility for box in boxes]

    def _append(self, part: str, t_us: int, **values: Any) -> None:
        for name, value in {"t": t_us, **values}.items():
            self._rows.setdefault(part, {}).setdefault(name, []).append(value)


def number_classes(classes: Mapping[str, str]) -> dict[str, int]:
    """Class → number from 0, in the order in which the classes are named first.

    Example:
        >>> number_classes({"car": "vehicle", "man": "person", "bus": "vehicle"})
        {'vehicle': 0, 'person': 1}
    """
    return {name: number for number, name in enumerate(dict.fromkeys(classes.values()))}


def _file(save: Callable[..., None], *arrays: NDArray[Any], **named: NDArray[Any]) -> bytes:
    """Content of a file of NumPy; equal arrays give equal bytes."""
    file = io.BytesIO()
    save(file, *arrays, **named)
    return file.getvalue()
