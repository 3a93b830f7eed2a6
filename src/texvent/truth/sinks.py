"""Sinks of ground truth: a folder, whose files other programs read, and a sample of a data set.

`docs/truth.md` and `docs/datasets.md` describe both. A folder has files for each frame, a sample
one member for all. A folder also has optical flow as 16-bit PNG, as DSEC stores it: three channels,
in the order of the file (RGB): `u · 128 + 2¹⁵`, `v · 128 + 2¹⁵`, 1 where the flow is valid. Steps
are 1/128 px; displacements are within ±256 px.

Source: Gehrig et al., E-RAFT: Dense Optical Flow from Event Cameras, 3DV 2021, whose ground truth
DSEC publishes.
"""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import OutputError
from texvent.frames import FrameStream
from texvent.io.arrays.npy_file import growing_array
from texvent.io.atomic import atomic_folder
from texvent.options.values import plain
from texvent.truth.boxes import BOX_RECORD, COCO, PROPHESEE, open_coco
from texvent.truth.event_ids import open_event_ids
from texvent.truth.layout import (
    DIRECTIONS,
    FACTS,
    FORMAT,
    TIMES,
    check_truth_folder,
    is_own_file,
)
from texvent.truth.poses import (
    INTRINSICS_HEADER,
    POSE_HEADER,
    camera_facts,
    intrinsics_row,
    pose_row,
)
from texvent.truth.source import Rows, TruthSource

STEPS_PER_PX = 128.0
ZERO = 2.0**15
HIGHEST = 2**16 - 1
FLOW_HEADER = "# from_timestamp_us, to_timestamp_us\n"
_TABLES = {
    "": {TIMES: ""},
    **{part: {f"flow/{way}_timestamps.txt": FLOW_HEADER} for part, way in DIRECTIONS.items()},
    "poses": {"poses.txt": POSE_HEADER, "intrinsics.txt": INTRINSICS_HEADER},
}
"""Part → its tables in a folder, and how they begin; "" is written with any part."""
HALVED = ("flow", "depth")
"""Arrays that samples hold as float16: 11 bits, an error below 0.05 %."""


class FolderSink:
    """A folder of truth, which appears when it is complete.

    Args:
        path: the folder.
        video: the frames, whose truth is known.
        parts: names of `PARTS`.
        metadata: provenance of the run, stored with the truth.
        overwrite: whether a folder of truth may be replaced.

    Raises:
        ConfigError: the video does not know one of the parts.
        OutputError: the folder exists already, or cannot be written.
    """

    def __init__(
        self,
        path: str | Path,
        video: FrameStream,
        parts: Sequence[str],
        *,
        metadata: Mapping[str, Any],
        overwrite: bool = False,
    ) -> None:
        self._path, self._overwrite = Path(path), overwrite
        check_truth_folder(self._path, overwrite=overwrite)
        self.source, self.facts = TruthSource(video, parts), dict(metadata)
        self._count = 0

    def open(self, stack: ExitStack) -> None:
        """Open the files that grow with the clip; the stack closes them."""
        own, parts = is_own_file(self._path), self.source.parts
        self._part = stack.enter_context(
            atomic_folder(self._path, overwrite=self._overwrite, is_own=own, is_nested=True)
        )
        self._files = stack.enter_context(ExitStack())
        self._tables = {}
        for part in ("", *parts):
            for name, header in _TABLES.get(part, {}).items():
                file = self._place(name).open("w", encoding="ascii")
                self._tables[name] = self._files.enter_context(file)
                file.write(header)
        if "boxes" in parts:
            records = growing_array(self._place(f"boxes/{PROPHESEE}"), dtype=BOX_RECORD)
            info = {"description": str(self.facts.get("prompt") or "")}
            coco = open_coco(self._place(f"boxes/{COCO}"), classes=self.source.classes, info=info)
            self._append_boxes = self._files.enter_context(records)
            self._coco = self._files.enter_context(coco)
        if "events" in parts:
            self._append_ids = self._files.enter_context(open_event_ids(self._part))

    def add(self, t_us: int, rows: Rows) -> None:
        """Write the files of a frame, and its rows of others."""
        number = f"{self._count:06d}"
        self._tables[TIMES].write(f"{t_us}\n")
        for part, row in rows.items():
            if part in DIRECTIONS:
                self._add_flow(DIRECTIONS[part], number, t_us, **row)
            elif part == "depth":
                np.savez_compressed(self._place(f"depth/{number}.npz"), **row)
            elif part == "ids":
                write_png(self._place(f"instance/{number}.png"), row["instance"])
                classes = self.source.class_of(row["instance"])
                write_png(self._place(f"class/{number}.png"), classes)
            elif part == "boxes":
                self._add_boxes(t_us, **row)
            elif part == "poses":
                self._add_pose(t_us, **row)
            else:
                self._append_ids(row["instance"], self.source.class_of(row["instance"]))
        self._count += 1

    def close(self) -> None:
        """Write the facts of the run, the last file."""
        self._files.close()
        source = self.source
        facts = {
            "format": FORMAT,
            "parts": list(source.parts),
            "frames": self._count,
            "width": source.size.width,
            "height": source.size.height,
            "time_unit": "us, on the clock of the events",
            "classes": {str(number): name for number, name in source.classes.items()},
            "instances": {
                str(one): {"class_id": source.class_ids[name], "class": name, **self._id_of(one)}
                for one, name in source.class_names.items()
            },
            "run": plain(self.facts),
        }
        self._write_json(FACTS, facts)

    def _place(self, name: str) -> Path:
        """Path of a file, whose folder exists."""
        path = self._part / name
        path.parent.mkdir(parents=True, exist_ok=True)
        return path

    def _write_json(self, name: str, facts: Mapping[str, Any]) -> None:
        self._place(name).write_text(json.dumps(facts, indent=1) + "\n", encoding="ascii")

    def _add_flow(self, way: str, number: str, t_us: int, to_t: int, **arrays: Any) -> None:
        self._tables[f"flow/{way}_timestamps.txt"].write(f"{t_us}, {to_t}\n")
        write_png(self._place(f"flow/{way}/{number}.png"), encode_flow(arrays["flow"]))
        np.savez_compressed(self._place(f"flow/{way}_npz/{number}.npz"), **arrays)

    def _id_of(self, instance: int) -> dict[str, str]:
        """The id of an object in its scene, where that is not the name of its class."""
        ids = self.source.object_ids
        return {"object": ids[instance]} if instance in ids else {}

    def _add_boxes(self, t_us: int, boxes: Any, visibility: Any, area: Any) -> None:
        self._coco.add_image(self._count, f"{self._count:06d}.png", self.source.size, t_us)
        rows = zip(boxes, visibility.tolist(), area.tolist(), strict=True)
        for box, share, pixels in rows:
            sides = [int(box[side]) for side in "xywh"]
            more: dict[str, Any] = {"track_id": int(box["track_id"])}
            more |= {} if np.isnan(share) else {"visibility": share}
            more |= self._id_of(int(box["track_id"]))
            self._coco.add_box(int(box["class_id"]), sides, pixels, **more)
        self._append_boxes(boxes)

    def _add_pose(self, t_us: int, pose: Any, intrinsics: Any) -> None:
        if self._count == 0 and (camera := self.source.camera_at(t_us)) is not None:
            self._write_json("camera.json", camera_facts(camera, self.source.size))
        self._tables["poses.txt"].write(pose_row(t_us, pose[:3, 3], pose[:3, :3]))
        self._tables["intrinsics.txt"].write(intrinsics_row(t_us, intrinsics))


class SampleSink:
    """Members of a sample of a data set.

    Args:
        video: the frames, whose truth is known.
        parts: names of `CLIP_FILES`.
        classes: as `TruthSource` takes them.
        place_labels: `Labels.place` of the video, where boxes are those of its labels.
        labelled: names of the classes that these labels show.

    Attributes:
        unboxed: objects that are there, and have no boxes because `classes` leaves them out.
        members: file → content, known at the end; equal truth gives equal bytes.
        facts: of the truth, for the `json` of the sample, known at the end.

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
        labelled: Iterable[str] = (),
    ) -> None:
        self._parts = tuple(dict.fromkeys(parts))
        of_frames = [part for part in self._parts if place_labels is None or part != "boxes"]
        self.source = TruthSource(video, of_frames, classes)
        self._place_labels = place_labels
        there = self.source.class_names.values() if place_labels is None else labelled
        boxed = set(classes) if "boxes" in self._parts and classes else set(there)
        self.unboxed = tuple(sorted(set(there) - boxed))
        self._times: list[int] = []
        self._rows: dict[str, dict[str, list[Any]]] = {}
        self.members: dict[str, bytes] = {}
        self.facts: dict[str, Any] = {}

    def open(self, stack: ExitStack) -> None:
        """Nothing is open before the end."""

    def add(self, t_us: int, rows: Rows) -> None:
        """Gather the rows of a frame."""
        self._times.append(t_us)
        for part, row in rows.items():
            for name, value in {"t": t_us, **row}.items():
                with np.errstate(over="ignore"):  # farther than 65 km is as good as the sky
                    stored = np.float16(value) if name in HALVED else value
                self._rows.setdefault(part, {}).setdefault(name, []).append(stored)

    def close(self) -> None:
        """Make the members; labels are placed on the frames.

        Raises:
            InputError: as `Labels.place`.
        """
        source = self.source
        self.facts |= {
            "parts": list(self._parts),
            "times_us": self._times,
            "classes": {str(number): name for number, name in source.classes.items()},
            "instances": {str(one): name for one, name in source.class_names.items()},
        }
        if source.object_ids:
            self.facts["objects"] = {str(one): id for one, id in source.object_ids.items()}
        rows = self._rows.pop("boxes", {})
        tables = {name: np.concatenate(rows[name]) for name in ("boxes", "visibility") if rows}
        if self._place_labels is not None:
            times = np.array(self._times, np.int64)
            boxes, known = self._place_labels(times, source.size, source.numbers)
            tables = {"boxes": boxes, "visibility": np.full(len(boxes), np.nan)}
            self.facts["box_times_us"] = known.tolist()
        for part, arrays in self._rows.items():
            self.members[f"{part}.npz"] = _content(np.savez_compressed, **arrays)
        if tables:
            self.members["boxes.npy"] = _content(np.save, tables["boxes"])
            shares = tables["visibility"].astype(np.float32)
            self.members["visibility.npy"] = _content(np.save, shares)


def _content(save: Callable[..., None], *arrays: Any, **named: Any) -> bytes:
    file = io.BytesIO()
    save(file, *arrays, **named)
    return file.getvalue()


def encode_flow(flow: NDArray[np.floating[Any]]) -> NDArray[np.uint16]:
    """Flow as DSEC's pixels.

    Args:
        flow: [H, W, 2] x and y, pixels; NaN where it is not known.

    Returns:
        [H, W, 3] RGB. Where the flow is not known, or beyond ±256 px, it is 0 and not valid.

    Example:
        >>> encode_flow(np.array([[[1.0, -0.5], [np.nan, np.nan]]])).tolist()
        [[[32896, 32704, 1], [32768, 32768, 0]]]
    """
    steps = np.rint(flow.astype(np.float64) * STEPS_PER_PX + ZERO)
    is_valid = np.logical_and(steps >= 0, steps <= HIGHEST).all(axis=2)
    pixels = np.full((*flow.shape[:2], 3), ZERO, dtype=np.uint16)
    pixels[is_valid, :2] = steps[is_valid]
    pixels[..., 2] = is_valid
    return pixels


def write_png(path: Path, pixels: NDArray[np.uint16]) -> None:
    """Write 16-bit pixels, [H, W] or [H, W, 3] RGB.

    Raises:
        OutputError: OpenCV refuses them.
    """
    import cv2

    done, data = cv2.imencode(".png", pixels if pixels.ndim == 2 else pixels[..., ::-1])
    if not done:
        raise OutputError(f"pixels of shape {pixels.shape} cannot be written as PNG")
    path.write_bytes(data.tobytes())
