"""Stream of the newest frame of a source: what comes while the reader is busy is dropped."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from texvent.errors import TexventError
from texvent.sensor import SensorSize
from texvent.video import MICROSECONDS, Frame, FrameStream

LEAVE_S = 2.0
"""How long a camera that sends nothing is waited for at the end."""


class NewestFrames:
    """Live stream of the frames that a thread of its own reads; at most one waits.

    A recording is played at its own rate, again and again, its times running on.

    Args:
        source: a camera or a recording.
    """

    frame_count: int | None = None
    is_live = True

    def __init__(self, source: FrameStream) -> None:
        self.size: SensorSize = source.size
        self.fps: Fraction | None = source.fps
        self.metadata: Mapping[str, Any] = source.metadata
        self.arrived = 0
        """Frames so far."""
        self.dropped = 0
        """Frames that were replaced by newer ones before they were read."""
        self.is_over = False
        """Whether no frame will come any more."""
        self.error: TexventError | None = None
        """Why the source ended, where it failed."""
        self._source = source
        self._waiting: tuple[Frame, float] | None = None
        self._arrivals: dict[int, float] = {}
        self._changed = threading.Condition()
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._read, daemon=True)

    def start(self) -> None:
        """Begin to read."""
        self._thread.start()

    def __iter__(self) -> Iterator[Frame]:
        """The newest frame each time, until the source ends; may be begun again."""
        self._arrivals.clear()
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._waiting is not None or self.is_over)
                if self.is_over:
                    return
                assert self._waiting is not None
                (frame, arrived_s), self._waiting = self._waiting, None
            self._arrivals[frame.t_us] = arrived_s
            yield frame

    def arrival_s(self, t_us: int) -> float | None:
        """When the frame of that time arrived, s of `time.perf_counter`; to be asked once."""
        return self._arrivals.pop(t_us, None)

    def close(self) -> None:
        """Stop reading."""
        self._stop.set()
        self._end()
        if self._thread.is_alive():
            self._thread.join(LEAVE_S)

    def _end(self) -> None:
        with self._changed:
            self.is_over = True
            self._changed.notify_all()

    def _read(self) -> None:
        shift_us = 0
        try:
            while not self._stop.is_set():
                span_us = self._play(shift_us)
                if self._source.is_live:
                    break
                shift_us += span_us
        except TexventError as error:
            self.error = error
        finally:
            self._end()

    def _play(self, shift_us: int) -> int:
        """Read the source once; returns how long it lasts, its last frame included, µs."""
        begun_s, first_us, last_us, interval_us = time.perf_counter(), None, 0, 0
        for frame in self._source:
            first_us = frame.t_us if first_us is None else first_us
            if not self._source.is_live:
                due_s = begun_s + (frame.t_us - first_us) / MICROSECONDS
                self._stop.wait(max(0.0, due_s - time.perf_counter()))
            if self._stop.is_set():
                break
            with self._changed:
                self.arrived += 1
                self.dropped += self._waiting is not None
                moved = replace(frame, t_us=frame.t_us + shift_us)
                self._waiting = moved, time.perf_counter()
                self._changed.notify_all()
            interval_us, last_us = frame.t_us - last_us, frame.t_us
        return last_us - (first_us or 0) + interval_us
