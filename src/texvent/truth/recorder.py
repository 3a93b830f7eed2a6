"""Ground truth recorded frame by frame, during a run or of frames alone."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.frames import Frame, FrameStream
from texvent.io.atomic import AtomicOutput
from texvent.truth.event_ids import FrameSpan, ids_of_frames, ids_of_scene
from texvent.truth.layout import PARTS, parse_parts
from texvent.truth.sinks import FolderSink, SampleSink
from texvent.truth.source import InstancesStream, Snapshot, as_ids

OF_FRAMES = ",".join(part for part in PARTS if part != "events")
"""Parts that are known without events."""
Sink = TypeVar("Sink", bound=FolderSink | SampleSink)


class TruthRecorder(AtomicOutput, Generic[Sink]):
    """Records what is true at the source frames of a clip, and of the events before them.

    Files of a folder are complete when the `with` block ends without error; members of a sample
    when `finish` returns. Memory holds the events between two source frames.

    Args:
        sink: knows the truth of the frames, and writes it.
        on_events: given all events in order, with the ids of their objects, where "events" is among
            the parts; a few frames late.
    """

    def __init__(
        self, sink: Sink, *, on_events: Callable[[EventStream], None] | None = None
    ) -> None:
        super().__init__()
        self._sink: Sink = sink
        self._on_events = on_events
        self._last_us: int | None = None
        self._intervals: list[FrameSpan] = []
        self._pending: tuple[Frame, list[FrameSpan]] | None = None
        self._before: Snapshot | None = None

    def add_metadata(self, facts: Mapping[str, Any]) -> None:
        """Store more facts of the run, known only now."""
        self._sink.facts.update(facts)

    def append(self, frame: Frame, packet: EventStream | None = None) -> None:
        """Take a dense frame and the events before it; truth is recorded of source frames.

        Raises:
            InputError: the frame does not bring the truth that is wanted.
        """
        if packet is not None and len(packet):
            start_us = int(packet.t[0]) if self._last_us is None else self._last_us
            self._intervals.append(FrameSpan(start_us, frame.t_us, packet))
        self._last_us = frame.t_us
        if not frame.is_source:
            return
        if self._pending is not None:
            self._record(*self._pending, frame.t_us)
        self._pending = frame, self._taken_intervals()

    def finish(self) -> Sink:
        """Record the last frame, and what is known at the end; the sink is complete.

        Raises:
            InputError: as `append`; or no frame was given.
        """
        if self._pending is None:
            raise InputError("no frame was given, so there is no truth to write")
        self._record(*self._pending, None)
        self._sink.close()
        return self._sink

    def _open(self, stack: ExitStack) -> None:
        self._sink.open(stack)

    def _complete(self) -> None:
        self.finish()

    def _taken_intervals(self) -> list[FrameSpan]:
        """The events gathered so far; gathering restarts."""
        taken, self._intervals = self._intervals, []
        return taken

    def _record(self, frame: Frame, intervals: list[FrameSpan], next_us: int | None) -> None:
        """Record what is true at a frame, and of the events before it; after the last, too."""
        source, before = self._sink.source, self._before
        truth = source.at(frame, None if before is None else before.t_us, next_us)
        rows = dict(truth.rows)
        if "events" in source.parts:
            ids = [self._ids(before or truth, truth, one) for one in intervals]
            if next_us is None:
                ids += [self._ids(truth, truth, one) for one in self._taken_intervals()]
            rows["events"] = {"instance": np.concatenate([np.zeros(0, np.uint16), *ids])}
        self._sink.add(truth.t_us, rows)
        self._before = truth

    def _ids(self, before: Snapshot, after: Snapshot, interval: FrameSpan) -> NDArray[np.uint16]:
        """Instances of the events between two frames, which are handed on with them."""
        source = self._sink.source
        if isinstance(source.video, InstancesStream):
            ids = as_ids(ids_of_scene(source.video, interval))
        else:
            ids = as_ids(ids_of_frames(before, after, interval))
        if self._on_events is not None:
            self._on_events(interval.events.with_ids(ids, source.class_of(ids)))
        return ids


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
        >>> import texvent
        >>> frames = texvent.video("a red ball bounces", sensor="48x36", duration=0.1)
        >>> truth = texvent.load_truth(texvent.save_truth(frames, "ball.truth", "boxes"))
        >>> truth, truth.boxes["w"].max() > 0
        (ClipTruth(3 frames, boxes), np.True_)
    """
    wanted = parse_parts(parts)
    if not wanted or "events" in wanted:
        raise ConfigError(
            f"parts is {parts!r:.80}; give some of {OF_FRAMES}: instances and classes of events "
            "are written by a run, texvent.generate(..., truth_folder=...)"
        )
    sink = FolderSink(
        folder, video, wanted, metadata={"source": video.metadata}, overwrite=overwrite
    )
    with TruthRecorder(sink) as recorder:
        for frame in video:
            recorder.append(frame)
    return Path(folder)
