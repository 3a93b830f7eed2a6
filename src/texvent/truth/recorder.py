"""Ground truth of a clip recorded frame by frame, and turned into files for a data set."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.truth.boxes import BOX_RECORD, box_records
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
            in this order. Empty: all objects, by the class ids of nouns.
        place_labels: `Labels.place` of the video, where boxes are those of its labels.

    Attributes:
        facts: of the truth, for the `json` of the sample.

    Raises:
        ConfigError: the video does not know one of the parts.
    """

    def __init__(
        self,
        video: FrameStream,
        parts: Sequence[str],
        classes: Mapping[str, str],
        *,
        place_labels: Callable[..., tuple[NDArray[np.void], NDArray[np.int64]]] | None = None,
    ) -> None:
        self._parts = tuple(dict.fromkeys(parts))
        of_frames = [part for part in self._parts if place_labels is None or part != "boxes"]
        self._source = TruthSource(video, of_frames)
        self._place_labels = place_labels
        self._names = tuple(dict.fromkeys(classes.values()))
        self._numbers = {noun: self._names.index(name) for noun, name in classes.items()}
        self._pending: Frame | None = None
        self._times: list[int] = []
        self._rows: dict[str, dict[str, list[Any]]] = {}
        self._boxes, self._visibility = np.empty(0, BOX_RECORD), np.empty(0, np.float32)
        self.facts: dict[str, Any] = {}

    def add(self, frame: Frame) -> None:
        """Take a dense frame; truth is recorded of source frames.

        Raises:
            InputError: the frame does not bring the truth that is wanted.
        """
        if not frame.is_source:
            return
        if self._pending is not None:
            self._record(self._pending, frame.t_us)
        self._pending = frame

    def finish(self) -> dict[str, bytes]:
        """Files of the truth of all frames, name → content; `facts` are known from now on.

        Raises:
            InputError: as `add`, and as `Labels.place`.
        """
        if self._pending is not None:
            self._record(self._pending, None)
        source = self._source
        classes = dict(enumerate(self._names)) if self._names else source.classes
        self.facts = {
            "parts": list(self._parts),
            "times_us": self._times,
            "classes": {str(number): name for number, name in classes.items()},
            "instances": {str(one): name for one, name in source.class_names.items()},
        }
        if self._place_labels is not None:
            times = np.array(self._times, np.int64)
            self._boxes, known = self._place_labels(times, source.size, self._numbers)
            self._visibility = np.full(len(self._boxes), np.nan, np.float32)
            self.facts["box_times_us"] = known.tolist()
        files = {
            f"{part}.npz": _content(np.savez_compressed, **rows)
            for part, rows in self._rows.items()
        }
        if "boxes" in self._parts:
            files["boxes.npy"] = _content(np.save, self._boxes)
            files["visibility.npy"] = _content(np.save, self._visibility)
        return files

    def _record(self, frame: Frame, next_us: int | None) -> None:
        truth = self._source.at(frame, None, next_us)
        self._times.append(truth.t_us)
        values: dict[str, dict[str, Any]] = {}
        if truth.flow is not None:
            values["flow"] = {"to_t": truth.flow.to_us, "flow": np.float16(truth.flow.vectors)}
            if truth.flow.occluded is not None:
                values["flow"]["occluded"] = truth.flow.occluded
        if truth.depth is not None:
            with np.errstate(over="ignore"):  # farther than 65 km is as good as the sky
                values["depth"] = {"depth": truth.depth.astype(np.float16)}
        if truth.instance is not None:
            check_instances(truth.instance)
            values["ids"] = {"instance": truth.instance.astype(np.uint16)}
            self._record_boxes(truth)
        if truth.camera is not None:
            lens = np.array(intrinsics(truth.camera, self._source.size))
            values["poses"] = {"pose": pose_matrix(truth.camera), "intrinsics": lens}
        for part in self._parts:
            for name, value in {"t": truth.t_us, **values.get(part, {})}.items():
                if part in values:
                    self._rows.setdefault(part, {}).setdefault(name, []).append(value)

    def _record_boxes(self, truth: Snapshot) -> None:
        boxes = truth.boxes
        if self._names:
            boxes = tuple(box for box in boxes if box.class_name in self._numbers)
            class_ids = [self._numbers[box.class_name] for box in boxes]
        else:
            instances = np.array([box.instance for box in boxes], np.int64)
            class_ids = self._source.class_of(instances).tolist()
        records = box_records(truth.t_us, boxes, class_ids)
        visibility = np.array([box.visibility for box in boxes], np.float32)
        self._boxes = np.append(self._boxes, records)
        self._visibility = np.append(self._visibility, visibility)


def _content(save: Callable[..., None], *arrays: Any, **named: Any) -> bytes:
    """Content of a file of NumPy; equal arrays give equal bytes."""
    file = io.BytesIO()
    save(file, *arrays, **named)
    return file.getvalue()
