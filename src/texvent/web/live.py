"""Live events: the newest frame of a camera simulated, ready to be drawn, and recorded."""

from __future__ import annotations

import threading
import time
from collections import deque
from contextlib import closing
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from texvent.errors import ConfigError, InputError, OutputError, TexventError
from texvent.events import EventStream
from texvent.io.block_writer import BlockWriter
from texvent.io.files import open_writer
from texvent.run.prepare import prepare_video
from texvent.settings.provenance import describe_run
from texvent.settings.resolution import Settings, apply_options, resolve
from texvent.simulate.model_options import contrast_threshold_of
from texvent.video import MICROSECONDS, Frame, FrameStream
from texvent.web.newest_frames import NewestFrames

MEASURED_FRAMES = 300
"""Drawn frames over which latency is measured, the latest."""


class Shown(NamedTuple):
    """A frame with the events that end at it."""

    number: int
    frame: Frame
    events: EventStream
    arrived_s: float | None
    """When the frame arrived, s of `time.perf_counter`; None while kernels are compiled."""


@dataclass
class Recording:
    """An event file that is being written; its times begin at 0."""

    path: Path
    writer: BlockWriter
    start_us: int
    dropped: int
    """Frames that were dropped before it began."""
    changes: list[dict[str, Any]] = field(default_factory=list)
    """Simulator and threshold that it did not begin with, and from when on."""
    events: int = 0
    seconds: float = 0.0

    def append(self, frame: Frame, events: EventStream) -> None:
        """Add the events that end at a frame."""
        self.writer.append(replace(events, t=events.t - self.start_us))
        self.events += len(events)
        self.seconds = (frame.t_us - self.start_us) / MICROSECONDS


class LiveEvents:
    """Events of a camera or a recording as its frames arrive, in a thread of their own.

    Args:
        source: the frames.
        settings: all options; simulator and contrast threshold may be changed later.
        overwrite: whether recordings may replace files.
    """

    def __init__(self, source: FrameStream, settings: Settings, *, overwrite: bool = False) -> None:
        self.frames = NewestFrames(source)
        self._overwrite = overwrite
        self._settings = self._working = settings
        self._error: TexventError | None = None
        self._latest: Shown | None = None
        self._arrivals: dict[int, float] = {}
        self._latencies_ms: deque[float] = deque(maxlen=MEASURED_FRAMES)
        self._is_ready = False
        self._arrived = self._dropped = 0
        self._recording: Recording | None = None
        self._recorded = ""
        self._changed = threading.Condition(threading.RLock())
        self._thread = threading.Thread(target=self._run, daemon=True)

    def start(self) -> None:
        """Begin."""
        self.frames.start()
        self._thread.start()

    def close(self) -> None:
        """End; a recording is completed."""
        self.frames.close()
        if self._thread.is_alive():
            self._thread.join()
        self.stop_recording()

    def wait(self, number: int, timeout_s: float) -> Shown | None:
        """The latest frame, once it is another than `number`; None if none comes in time."""

        def newer() -> Shown | None:
            latest = self._latest
            return None if latest is None or latest.number == number else latest

        with self._changed:
            shown = self._changed.wait_for(newer, timeout_s)
            if shown is not None and shown.arrived_s is not None:
                if len(self._arrivals) > MEASURED_FRAMES:  # of pages that went
                    self._arrivals.clear()
                self._arrivals[shown.number] = shown.arrived_s
        return shown

    def note_drawn(self, number: int) -> None:
        """Measure the latency of a frame that a page has drawn."""
        arrived_s = self._arrivals.pop(number, None)
        if arrived_s is not None:
            self._latencies_ms.append((time.perf_counter() - arrived_s) * 1e3)

    def change(self, simulator: str, contrast_threshold: float | None) -> None:
        """Use another simulator, at its defaults, or threshold, from the next frame on.

        Raises:
            ConfigError: there is no such simulator, or it does not allow the threshold.
        """
        settings = self._settings
        if simulator != settings.run.simulator:
            other = resolve("simulate", {"simulator": simulator})
            run = replace(settings.run, simulator=simulator, preset=other.run.preset)
            settings = replace(settings, run=run, simulate=other.simulate)
        if contrast_threshold is not None:
            options = {"contrast_threshold": contrast_threshold}
            settings = apply_options(settings, options, where="the page")
        with self._changed:
            self._settings, self._error = settings, None

    def record(self, path: Path, format: str | None = None) -> None:
        """Begin to record the events to a file.

        Raises:
            ConfigError, OutputError: as `open_writer`.
            InputError: a recording runs already, or the source has ended.
        """
        with self._changed:
            if self._recording is not None:
                raise InputError(f"{self._recording.path} is being recorded; stop it first")
            if self.frames.is_over:
                raise InputError("the source has ended; there is nothing to record")
            facts = describe_run(self._settings, prompt=None, source=self.frames.metadata)
            writer = open_writer(
                path,
                size=self.frames.size,
                metadata=facts,
                format=format,
                overwrite=self._overwrite,
            )
            start_us = 0 if self._latest is None else self._latest.frame.t_us
            self._recording = Recording(path, writer.__enter__(), start_us, self.frames.dropped)
            self._error, self._recorded = None, ""

    def stop_recording(self, failure: Exception | None = None) -> None:
        """Complete the recording, if there is one; after a failure its file is dropped."""
        with self._changed:
            recording, self._recording = self._recording, None
            if recording is None:
                return
            lost, changes = self.frames.dropped - recording.dropped, recording.changes
            try:
                if failure is None and (lost or changes):
                    facts = {"frames_dropped": lost, "changes": changes}
                    recording.writer.add_metadata({"live": facts})
                recording.writer.__exit__(failure and type(failure), failure, None)
            except (TexventError, OSError) as error:
                failure = error
            if failure is None:
                self._recorded = f"{recording.path} ({recording.events:,} events)"
            else:
                self._error = OutputError(f"{recording.path} was dropped: {failure}")

    def describe(self) -> dict[str, Any]:
        """State, JSON-ready."""
        with self._changed:
            frames, recording = self.frames, self._recording
            error, latencies = self._error or frames.error, list(self._latencies_ms)
            text = self._recorded and f"recorded {self._recorded}"
            if recording is not None:
                text = f"recording {recording.path}: {recording.seconds:.1f} s"
                text += f", {recording.events:,} events"
            state = "running" if self._is_ready else "starting"
            return {
                "state": "ended" if frames.is_over else state,
                "error": str(error) if error else "",
                "simulator": self._settings.run.simulator,
                "threshold": _threshold(self._settings),
                "frames": frames.arrived - self._arrived,
                "dropped": frames.dropped - self._dropped,
                "latency_ms": np.percentile(latencies, (50, 95)).tolist() if latencies else [],
                "is_recording": recording is not None,
                "recording": text,
            }

    def _run(self) -> None:
        while not self.frames.is_over:
            settings = self._settings
            try:
                self._simulate(settings)
            except TexventError as error:
                with self._changed:
                    self._error = error
                    if settings is self._working:
                        self.frames.close()
                    elif settings is self._settings:
                        self._settings = self._working
        self.stop_recording()

    def _simulate(self, settings: Settings) -> None:
        """Simulate frames until the settings change or there are no more."""
        simulation = prepare_video(self.frames, settings)
        shown, packets = 0, [EventStream.empty(self.frames.size)]
        with closing(simulation.steps()) as steps:
            for frame, packet in steps:
                packets.append(packet)
                if frame.is_source:
                    with self._changed:
                        self._show(frame, EventStream.concat(packets), settings, shown)
                        if self._settings is not settings:
                            return
                    shown, packets = shown + 1, packets[:1]

    def _show(self, frame: Frame, events: EventStream, settings: Settings, shown: int) -> None:
        """Publish and record a frame; `shown` frames came before it with these settings."""
        number = 1 if self._latest is None else self._latest.number + 1
        arrived_s, self._is_ready = self.frames.arrival_s(frame.t_us), shown > 0
        if shown < 2:  # kernels are compiled for the first pair
            arrived_s, self._arrived, self._dropped = None, self.frames.arrived, self.frames.dropped
            self._latencies_ms.clear()
        self._latest = Shown(number, frame, events, arrived_s)
        self._changed.notify_all()
        recording, is_change = self._recording, settings is not self._working
        self._working = settings
        if recording is None:
            return
        if is_change:
            fact = {
                "t_us": frame.t_us - recording.start_us,
                "simulator": settings.run.simulator,
                "contrast_threshold": _threshold(settings),
            }
            recording.changes.append(fact)
        try:
            recording.append(frame, events)
        except (TexventError, OSError) as error:
            self.stop_recording(error)


def _threshold(settings: Settings) -> float | None:
    """Contrast threshold; None of a model that has none."""
    try:
        return round(contrast_threshold_of(settings.simulate), 4)
    except ConfigError:
        return None
