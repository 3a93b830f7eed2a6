"""Live events: an event camera steps through the newest frames of a source; drawn and recorded."""

from __future__ import annotations

import contextlib
import itertools
import sys
import threading
import time
from collections import deque
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from texvent.errors import ConfigError, InputError, OutputError, TexventError
from texvent.event_camera import EventCamera
from texvent.events import EventStream
from texvent.io.block_writer import BlockWriter
from texvent.io.files import open_writer
from texvent.settings.provenance import describe_run
from texvent.simulate.model_options import contrast_threshold_of
from texvent.transfer import Transfer
from texvent.video import Frame, FrameStream, transfer_of
from texvent.web.newest_frames import NewestFrames

MEASURED_FRAMES = 300
"""Drawn frames over which latency is measured, the latest."""
COMPILING_STEPS = 2
"""First steps of an event camera, which do not count: kernels are compiled."""


class Shown(NamedTuple):
    """A frame with the events that end at it."""

    number: int
    frame: Frame
    events: EventStream
    arrived_s: float
    """When the frame arrived, s of `time.perf_counter`."""


class Recording(NamedTuple):
    """An event file that is being written; its times begin at 0."""

    path: Path
    writer: BlockWriter
    start_us: int
    dropped: int
    """Frames that were dropped before it began."""


class LiveEvents:
    """Events of a camera or a recording as its frames arrive, in a thread of their own.

    Args:
        source: the frames.
        options: of `EventCamera`.

    Raises:
        ConfigError, InputError: as `EventCamera`.
    """

    def __init__(self, source: FrameStream, options: Mapping[str, Any]) -> None:
        if transfer_of(source) is Transfer.LINEAR:
            options = {**options, "transfer": "linear"}
        self._source, self._options = source, options
        self._camera = EventCamera(source.size, **options)
        self._steps = self._arrived = self._dropped = 0
        self._numbers = itertools.count(1)
        self._shown: Shown | None = None
        self._latencies_ms: deque[float] = deque(maxlen=MEASURED_FRAMES)
        self._recording: Recording | None = None
        self._error: Exception | None = None
        self._changed = threading.Condition(threading.RLock())
        self._frames = NewestFrames(source)
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End; a recording is completed.

        Raises:
            TexventError: why it could not be, or why the events ended before.
        """
        self._frames.close()
        self._thread.join()
        error = self._error or self._frames.error
        if error is not None:
            raise error

    def wait(self, number: float, timeout_s: float) -> Shown | None:
        """The latest frame, once it is another than `number`; None if none comes in time."""

        def newer() -> Shown | None:
            return self._shown if self._shown and self._shown.number != number else None

        with self._changed:
            return self._changed.wait_for(newer, timeout_s)

    def note_drawn(self, arrived_s: float) -> None:
        """Measure the latency of a frame that a page has drawn just now."""
        if self._steps > COMPILING_STEPS + 1:
            self._latencies_ms.append((time.perf_counter() - arrived_s) * 1e3)

    def change(self, simulator: str, contrast_threshold: float | None) -> None:
        """Use another model from the next frame on; without a threshold, its own.

        Raises:
            ConfigError: as `EventCamera`.
            InputError: as `EventCamera`; or a recording runs, which is of one model.
        """
        model = {"simulator": simulator, "contrast_threshold": contrast_threshold}
        camera = EventCamera(self._source.size, **{**self._options, **model})
        with self._changed:
            self._refuse_recording()
            self._camera, self._steps, self._error = camera, 0, None

    def record(self, path: Path, format: str) -> None:
        """Begin to record the events to a file.

        Raises:
            ConfigError, OutputError: as `open_writer`.
            InputError: a recording runs already, or no frame comes.
        """
        with self._changed:
            self._refuse_recording()
            if self._frames.is_over or self._shown is None:
                raise InputError("no frame comes; there is nothing to record")
            if path.exists():
                raise OutputError(f"{path} exists already; choose another name")
            facts = describe_run(self._camera.settings, prompt=None, source=self._source.metadata)
            writer = open_writer(path, size=self._camera.size, metadata=facts, format=format)
            start_us, dropped = self._shown.frame.t_us, self._frames.dropped
            self._recording = Recording(path, writer.__enter__(), start_us, dropped)

    def _refuse_recording(self) -> None:
        if self._recording is not None:
            raise InputError(f"{self._recording.path} is being recorded; stop it first")

    def stop_recording(self) -> None:
        """Complete the recording, if there is one; its file is dropped while an error is handled.

        Raises:
            OutputError: it cannot be completed.
        """
        with self._changed:
            recording, self._recording = self._recording, None
            if recording is not None:
                lost = self._frames.dropped - recording.dropped
                if lost:
                    recording.writer.add_metadata({"frames_dropped": lost})
                recording.writer.__exit__(*sys.exc_info())

    def describe(self) -> dict[str, Any]:
        """State, JSON-ready."""
        with self._changed:
            frames, recording, latencies = self._frames, self._recording, [*self._latencies_ms]
            state = "running" if self._steps > COMPILING_STEPS else "starting"
            settings, threshold = self._camera.settings, None
            with contextlib.suppress(ConfigError):  # some models have none
                threshold = round(contrast_threshold_of(settings.simulate), 4)
            return {
                "state": "ended" if frames.is_over else state,
                "error": str(self._error or frames.error or ""),
                "simulator": settings.run.simulator,
                "contrast_threshold": threshold,
                "frames": frames.arrived - self._arrived,
                "dropped": frames.dropped - self._dropped,
                "latency_ms": np.percentile(latencies, (50, 95)).tolist() if latencies else [],
                "recording": recording and str(recording.path),
            }

    def _run(self) -> None:
        try:
            while (arrival := self._frames.take()) is not None:
                camera, (frame, arrived_s) = self._camera, arrival
                events = camera.step(frame.pixels, frame.t_us)
                with self._changed:
                    if camera is self._camera:
                        self._show(Shown(next(self._numbers), frame, events, arrived_s))
        except TexventError as error:
            self._error = error
        self._frames.close()
        try:
            self.stop_recording()
        except OutputError as error:
            self._error = error

    def _show(self, shown: Shown) -> None:
        self._shown = shown
        self._changed.notify_all()
        self._steps += 1
        if self._steps <= COMPILING_STEPS:
            self._arrived, self._dropped = self._frames.arrived, self._frames.dropped
            self._latencies_ms.clear()
        if self._recording is not None:
            try:
                since_start = shown.events.t - self._recording.start_us
                self._recording.writer.append(replace(shown.events, t=since_start))
            except (TexventError, OSError) as error:
                self._error = error
                with contextlib.suppress(OutputError):
                    self.stop_recording()
