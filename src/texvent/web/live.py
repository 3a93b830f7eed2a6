"""Live events: an event camera steps through the newest frames of a source; drawn and recorded."""

from __future__ import annotations

import contextlib
import sys
import threading
import time
from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from texvent.api.event_camera import EventCamera
from texvent.capture.fit_to_sensor import fit_pixels
from texvent.config import CaptureConfig
from texvent.errors import ConfigError, InputError, OutputError, TexventError, one_line
from texvent.events import EventStream
from texvent.frames import MICROSECONDS, Frame, FrameStream, PixelArray, transfer_of
from texvent.settings.provenance import describe_run
from texvent.simulation.model_options import contrast_threshold_of
from texvent.transfer import Transfer
from texvent.web.recording import LiveRecording

MEASURED_FRAMES = 300
"""Drawn frames over which latency is measured, the latest."""
COMPILING_STEPS = 2
"""First steps of an event camera, which do not count: kernels are compiled."""
LEAVE_S = 2.0
"""Wait at the end for a source that sends nothing, s."""
LONGEST_LATENCY_S = 3600.0


class Shown(NamedTuple):
    """A frame with the events that end at it."""

    frame: Frame
    events: EventStream
    arrived_s: float
    """When the frame arrived, s of `time.perf_counter`."""
    source_us: int
    """Time of the frame since the first of the source, µs; of a recording, in this pass."""


class LiveEvents:
    """Events of a camera, or of a recording at its own rate, as the frames arrive.

    One thread reads, another simulates the newest frame. What comes while that one is busy is
    dropped and counted, never queued.

    Args:
        source: the frames; a recording is played again and again, its times running on.
        options: of `EventCamera`.

    Raises:
        ConfigError, InputError: as `EventCamera`.
    """

    def __init__(self, source: FrameStream, options: Mapping[str, Any]) -> None:
        if transfer_of(source) is Transfer.LINEAR:
            options = {**options, "transfer": "linear"}
        self._source, self._options = source, options
        self._camera = EventCamera(source.size, **options)
        self._steps = self._arrived = self._dropped = self._lost = 0
        self._waiting: tuple[Frame, int, float] | None = None
        self._shown: Shown | None = None
        self._latencies_ms: deque[float] = deque(maxlen=MEASURED_FRAMES)
        self._recording: LiveRecording | None = None
        self._error: TexventError | None = None
        self._is_over = False
        self._changed = threading.Condition(threading.RLock())
        self._stop = threading.Event()
        self._threads = [
            threading.Thread(target=one, daemon=True) for one in (self._run, self._read)
        ]
        for thread in self._threads:
            thread.start()

    def close(self) -> None:
        """End; a recording is completed.

        Raises:
            TexventError: why it could not be, or why the events ended before.
        """
        self._stop.set()
        self._end()
        self._threads[0].join()
        self._threads[1].join(LEAVE_S)
        if self._error is not None:
            raise self._error

    def picture(self, shown: Shown) -> PixelArray:
        """Pixels of a frame as the sensor sees them: of its size, point by point."""
        fit = getattr(self._camera.settings.source, "fit", CaptureConfig.fit)
        return fit_pixels(shown.frame.pixels, shown.events.size, fit)

    def wait(self, after_us: float, timeout_s: float) -> Shown | None:
        """The latest frame, once there is one of a later time; None if none comes in time."""

        def newer() -> Shown | None:
            return self._shown if self._shown and self._shown.frame.t_us > after_us else None

        with self._changed:
            return self._changed.wait_for(newer, timeout_s)

    def note_drawn(self, arrived_s: float) -> None:
        """Measure the latency of a frame that a page has drawn just now."""
        latency_s = time.perf_counter() - arrived_s
        if self._steps > COMPILING_STEPS + 1 and 0.0 <= latency_s < LONGEST_LATENCY_S:
            self._latencies_ms.append(latency_s * 1e3)

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
            InputError: a recording runs already, or no events come.
        """
        with self._changed:
            self._refuse_recording()
            if self._state != "running" or self._shown is None:
                raise InputError(f"no events come ({self._state}); there is nothing to record")
            self._recording = LiveRecording(
                path,
                size=self._camera.size,
                metadata=describe_run(
                    self._camera.settings, prompt=None, source=self._source.metadata
                ),
                format=format,
                start_us=self._shown.frame.t_us,
            )
            self._lost, self._error = 0, None

    def stop_recording(self) -> None:
        """Complete the recording, if there is one; while an error is handled, drop its file."""
        with self._changed:
            recording, self._recording = self._recording, None
            if recording is None:
                return
            try:
                recording.close(
                    {"frames_dropped": self._lost} if self._lost else {}, *sys.exc_info()
                )
            except Exception as error:  # noqa: BLE001  # of any library; the events go on
                self._error = _reported(error, recording)

    def describe(self) -> dict[str, Any]:
        """State, JSON-ready."""
        with self._changed:
            settings, threshold = self._camera.settings, None
            with contextlib.suppress(ConfigError):  # some models have none
                threshold = round(contrast_threshold_of(settings.simulate), 4)
            latencies = [*self._latencies_ms]
            return {
                "state": self._state,
                "error": str(self._error or ""),
                "simulator": settings.run.simulator,
                "contrast_threshold": threshold,
                "frames": self._arrived,
                "dropped": self._dropped,
                "latency_ms": np.percentile(latencies, (50, 95)).tolist() if latencies else [],
                "recording": self._recording and str(self._recording.path),
            }

    @property
    def _state(self) -> str:
        if self._is_over:
            return "ended"
        return "running" if self._steps > COMPILING_STEPS else "starting"

    def _refuse_recording(self) -> None:
        if self._recording is not None:
            raise InputError(f"{self._recording.path} is being recorded; stop it first")

    def _read(self) -> None:
        try:
            for frame, source_us in self._arriving() if self._source.is_live else self._play():
                with self._changed:
                    self._arrived += 1
                    self._dropped += self._waiting is not None
                    self._lost += self._waiting is not None
                    self._waiting = frame, source_us, time.perf_counter()
                    self._changed.notify_all()
                if self._stop.is_set():
                    break
        except Exception as error:  # noqa: BLE001  # of any library; the page must hear of it
            self._error = _reported(error)
        self._end()

    def _arriving(self) -> Iterator[tuple[Frame, int]]:
        """Frames of a camera, each with its time since the first."""
        first_us = None
        for frame in self._source:
            first_us = frame.t_us if first_us is None else first_us
            yield frame, frame.t_us - first_us

    def _play(self) -> Iterator[tuple[Frame, int]]:
        """Frames when they are due; the first at 0, each pass one interval after the one before."""
        begun_s, t_us, last_us, start_us = time.perf_counter(), 0, 0, 0
        while not self._stop.is_set():
            shift_us = None
            for frame in self._source:
                shift_us = start_us - frame.t_us if shift_us is None else shift_us
                last_us, t_us = t_us, frame.t_us + shift_us
                self._stop.wait(max(0.0, begun_s + t_us / MICROSECONDS - time.perf_counter()))
                yield replace(frame, t_us=t_us), t_us - start_us
            start_us = 2 * t_us - last_us

    def _end(self) -> None:
        with self._changed:
            self._is_over = True
            self._changed.notify_all()

    def _take(self) -> tuple[Frame, int, float] | None:
        """The newest frame, its time in the source, and when it arrived; None at the end."""
        with self._changed:
            self._changed.wait_for(lambda: self._waiting is not None or self._is_over)
            waiting, self._waiting = self._waiting, None
            return None if self._stop.is_set() else waiting

    def _run(self) -> None:
        try:
            while (waiting := self._take()) is not None:
                camera, (frame, source_us, arrived_s) = self._camera, waiting
                events = camera.step(frame.pixels, frame.t_us)
                with self._changed:
                    if camera is self._camera:
                        self._show(Shown(frame, events, arrived_s, source_us))
        except Exception as error:  # noqa: BLE001  # as above
            self._error = _reported(error)
        self._stop.set()
        self._end()
        self.stop_recording()

    def _show(self, shown: Shown) -> None:
        self._shown = shown
        self._changed.notify_all()
        self._steps += 1
        if self._steps <= COMPILING_STEPS:
            self._arrived = self._dropped = 0
            self._latencies_ms.clear()
        if self._recording is not None:
            try:
                self._recording.append(shown.events)
            except Exception as error:  # noqa: BLE001  # as above
                self._error = _reported(error, self._recording)
                self.stop_recording()


def _reported(error: Exception, recording: LiveRecording | None = None) -> TexventError:
    """An error in one line, with the place of the events that it could not spoil."""
    if not isinstance(error, TexventError):
        error = TexventError(f"{type(error).__name__}: {one_line(error)}")
    if recording is None:
        return error
    return OutputError(f"{error}; its events until then are in {recording.copy}")
