"""Writer of ground truth during a run; `texvent.truth.layout` describes the files."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, InputError, OutputError
from texvent.events import EventStream
from texvent.io.atomic import AtomicOutput, atomic_folder
from texvent.options.values import plain
from texvent.truth.boxes import open_boxes
from texvent.truth.event_ids import (
    Interval,
    ids_of_frames,
    ids_of_scene,
    open_event_ids,
)
from texvent.truth.layout import (
    DIRECTIONS,
    FACTS,
    FORMAT,
    PARTS,
    TIMES,
    check_truth_folder,
    is_own_file,
    parse_parts,
)
from texvent.truth.loading import encode_flow
from texvent.truth.poses import (
    INTRINSICS_HEADER,
    POSE_HEADER,
    camera_facts,
    intrinsics_row,
    pose_row,
)
from texvent.truth.source import (
    MOST_INSTANCES,
    Flow,
    InstancesStream,
    Snapshot,
    TruthSource,
)
from texvent.video import Frame, FrameStream

_FOLDERS = {
    "flow": ("flow/forward", "flow/forward_npz"),
    "flow-back": ("flow/backward", "flow/backward_npz"),
    "depth": ("depth",),
    "ids": ("instance", "class"),
    "boxes": ("boxes",),
}


class TruthWriter(AtomicOutput):
    """Writes a folder of truth; it appears when the `with` block ends without error.

    Memory holds the events between two source frames, so it does not grow with the clip.

    Args:
        path: the folder.
        video: the frames, whose truth is known.
        parts: parts to write; see `texvent.truth.layout.PARTS`.
        metadata: provenance of the run, stored with the truth.
        overwrite: whether a folder of truth may be replaced.
        on_events: given all events in order, with the ids of their objects, where "events" is among
            the parts; a few frames late.

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
        metadata: Mapping[str, Any] | None = None,
        overwrite: bool = False,
        on_events: Callable[[EventStream], None] | None = None,
    ) -> None:
        super().__init__()
        self._path = Path(path)
        check_truth_folder(self._path, overwrite=overwrite)
        self._source = TruthSource(video, parts)
        self._parts = parts
        self._metadata = dict(metadata or {})
        self._overwrite = overwrite
        self._on_events = on_events
        self._last_us: int | None = None
        self._intervals: list[Interval] = []
        self._pending: tuple[Frame, list[Interval]] | None = None
        self._before: Snapshot | None = None
        self._index = 0

    def add_metadata(self, facts: Mapping[str, Any]) -> None:
        """Store more facts of the run, known only now."""
        self._metadata.update(facts)

    def append(self, frame: Frame, packet: EventStream) -> None:
        """Take a dense frame and the events before it; truth is written of source frames.

        Raises:
            InputError: the frame does not bring the truth that is wanted.
        """
        if len(packet):
            start_us = int(packet.t[0]) if self._last_us is None else self._last_us
            self._intervals.append(Interval(start_us, frame.t_us, packet))
        self._last_us = frame.t_us
        if not frame.is_source:
            return
        if self._pending is not None:
            self._write(*self._pending, frame.t_us)
        self._pending = frame, self._taken_intervals()

    def _open(self, stack: ExitStack) -> None:
        is_own = is_own_file(self._path)
        self._part = stack.enter_context(
            atomic_folder(self._path, overwrite=self._overwrite, is_own=is_own, is_nested=True)
        )
        for part in self._parts:
            for name in _FOLDERS.get(part, ()):
                (self._part / name).mkdir(parents=True, exist_ok=True)
        self._files = stack.enter_context(ExitStack())
        self._boxes = self._add_ids = None
        self._texts = {TIMES: self._text(TIMES)}
        for part, direction in DIRECTIONS.items():
            if part in self._parts:
                name = f"flow/{direction}_timestamps.txt"
                self._texts[part] = self._text(name, "# from_timestamp_us, to_timestamp_us\n")
        if "poses" in self._parts:
            self._texts["poses"] = self._text("poses.txt", POSE_HEADER)
            self._texts["intrinsics"] = self._text("intrinsics.txt", INTRINSICS_HEADER)
        if "boxes" in self._parts:
            context = open_boxes(
                self._part / "boxes",
                size=self._source.size,
                classes=self._source.classes,
                info={"description": str(self._metadata.get("prompt") or "")},
            )
            self._boxes = self._files.enter_context(context)
        if "events" in self._parts:
            ids = open_event_ids(self._part, self._source)
            self._add_ids = self._files.enter_context(ids)

    def _complete(self) -> None:
        if self._pending is None:
            raise InputError("no frame was given, so there is no truth to write")
        self._write(*self._pending, None)
        if self._before is not None:
            self._write_ids(self._before, self._taken_intervals())
        self._files.close()
        facts = {
            "format": FORMAT,
            "parts": list(self._parts),
            "frames": self._index,
            "width": self._source.size.width,
            "height": self._source.size.height,
            "time_unit": "us, on the clock of the events",
            "classes": {str(number): name for number, name in self._source.classes.items()},
            "instances": {
                str(one): {"class_id": self._source.class_ids[name], "class": name}
                for one, name in self._source.class_names.items()
            },
            "run": plain(self._metadata),
        }
        text = json.dumps(facts, indent=1) + "\n"
        (self._part / FACTS).write_text(text, encoding="ascii")

    def _text(self, name: str, header: str = "") -> Any:
        file = self._files.enter_context((self._part / name).open("w", encoding="ascii"))
        file.write(header)
        return file

    def _taken_intervals(self) -> list[Interval]:
        """The events gathered so far; gathering restarts."""
        taken, self._intervals = self._intervals, []
        return taken

    def _write(self, frame: Frame, intervals: list[Interval], next_us: int | None) -> None:
        """Write what is true at a frame, and of the events before it."""
        previous_us = None if self._before is None else self._before.t_us
        truth = self._source.at(frame, previous_us, next_us)
        index, self._index = self._index, self._index + 1
        self._texts[TIMES].write(f"{truth.t_us}\n")
        self._write_maps(truth, f"{index:06d}")
        if truth.camera is not None and "poses" in self._parts:
            self._write_camera(truth, index)
        if self._boxes is not None and truth.instance is not None:
            ids = np.array([box.instance for box in truth.boxes], dtype=np.int32)
            self._boxes.add(
                index,
                truth.t_us,
                truth.boxes,
                class_ids=self._source.class_of(ids).tolist(),
                areas=np.bincount(truth.instance.ravel(), minlength=1)[ids].tolist(),
            )
        self._write_ids(truth, intervals)
        self._before = truth

    def _write_ids(self, truth: Snapshot, intervals: list[Interval]) -> None:
        """Write the instances of the events before a frame, where they are asked for."""
        if self._add_ids is None:
            return
        for interval in intervals:
            ids = self._ids_in(truth, interval)
            check_instances(ids)
            self._add_ids(ids)
            if self._on_events is not None:
                labelled = interval.events.with_ids(
                    ids.astype(np.uint16), self._source.class_of(ids)
                )
                self._on_events(labelled)

    def _ids_in(self, truth: Snapshot, interval: Interval) -> NDArray[np.int32]:
        scene = self._source.video
        if isinstance(scene, InstancesStream):
            return ids_of_scene(scene, interval)
        return ids_of_frames(self._before or truth, truth, interval)

    def _write_maps(self, truth: Snapshot, name: str) -> None:
        """Flow, depth and ids of a frame."""
        part = self._part
        for one, flow in (("flow", truth.flow), ("flow-back", truth.flow_back)):
            if one in self._parts and flow is not None:
                self._write_flow(one, flow, name)
                self._texts[one].write(f"{truth.t_us}, {flow.to_us}\n")
        if "depth" in self._parts and truth.depth is not None:
            np.savez_compressed(part / f"depth/{name}.npz", depth=truth.depth)
        if "ids" in self._parts and truth.instance is not None:
            check_instances(truth.instance)
            write_png(part / f"instance/{name}.png", truth.instance.astype(np.uint16))
            write_png(part / f"class/{name}.png", self._source.class_of(truth.instance))

    def _write_flow(self, part: str, flow: Flow, name: str) -> None:
        folder = self._part / "flow"
        write_png(folder / DIRECTIONS[part] / f"{name}.png", encode_flow(flow.vectors))
        masks: dict[str, Any] = {}
        if flow.occluded is not None:
            masks = {"occluded": flow.occluded}
        path = folder / f"{DIRECTIONS[part]}_npz" / f"{name}.npz"
        np.savez_compressed(path, flow=flow.vectors, **masks)

    def _write_camera(self, truth: Snapshot, index: int) -> None:
        camera, size = truth.camera, self._source.size
        if camera is None:
            return
        if index == 0:
            facts = json.dumps(camera_facts(camera, size), indent=1) + "\n"
            (self._part / "camera.json").write_text(facts, encoding="ascii")
        to_world = np.asarray(camera.rotation).T
        self._texts["poses"].write(pose_row(truth.t_us, camera.position, to_world))
        self._texts["intrinsics"].write(intrinsics_row(truth.t_us, camera, size))


def check_instances(instance: NDArray[np.int32]) -> None:
    """Refuse ids that 16 bits do not hold.

    Raises:
        InputError: there is one.
    """
    if instance.size and not 0 <= int(instance.min()) <= int(instance.max()) < MOST_INSTANCES:
        raise InputError(
            f"instance ids run from {int(instance.min())} to {int(instance.max())}; files hold "
            f"0..{MOST_INSTANCES - 1}"
        )


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


OF_FRAMES = ",".join(part for part in PARTS if part != "events")
"""Parts that are known without events."""


def save_truth(
    video: FrameStream,
    folder: str | Path,
    parts: str | Iterable[str] = OF_FRAMES,
    *,
    overwrite: bool = False,
) -> Path:
    """Write what is true of a video's scene into a folder, as `texvent generate --truth` does.

    Args:
        video: frames whose truth is known: those of `texvent.video(prompt)`, or a stream of yours
            with `ground_truth(t0_us, t1_us)`, or with `Frame.motion`.
        folder: where to, such as "out.truth".
        parts: flow, flow-back, depth, ids, boxes, poses, with commas between; default:
            all of them.
        overwrite: whether a folder of truth may be replaced.

    Returns:
        The folder, for `load_truth`.

    Raises:
        ConfigError: an unknown part, or one that the video does not know.
        InputError: a frame does not bring the truth that is asked for.
        OutputError: the folder exists already, or cannot be written.

    Example:
        >>> import tempfile, texvent
        >>> frames = texvent.video("a red ball bounces", sensor="48x36", duration=0.1)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     truth = texvent.load_truth(save_truth(frames, f"{folder}/ball.truth", "boxes"))
        ...     truth, truth.boxes["w"].max() > 0
        (Truth(3 frames, 48x36, boxes), np.True_)
    """
    wanted = parse_parts(parts)
    if not wanted or "events" in wanted:
        raise ConfigError(
            f"parts is {parts!r:.80}; give some of {OF_FRAMES}: instances and classes of events "
            "are written by a run, texvent.generate(..., truth_folder=...)"
        )
    nothing = EventStream.empty(video.size)
    with TruthWriter(
        folder, video, wanted, metadata={"source": video.metadata}, overwrite=overwrite
    ) as writer:
        for frame in video:
            writer.append(frame, nothing)
    return Path(folder)
