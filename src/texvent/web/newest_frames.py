"""Newest frame of a source: what comes while the reader is busy is dropped, never queued."""

from __future__ import annotations

import threading
import time
from dataclasses import replace

from texvent.errors import TexventError
from texvent.video import MICROSECONDS, Frame, FrameStream

LEAVE_S = 2.0
"""How long a camera that sends nothing is waited for at the end."""


class NewestFrames:
    """Frames that a thread of its own reads; at most one waits.

    A recording is played at its own rate, again and again, its times running on.

    Args:
        source: a camera or a recording.
    """

    def __init__(self, source: FrameStream) -> None:
        self.arrived = 0
        self.dropped = 0
        """Frames that newer ones replaced before they were taken."""
        self.is_over = False
        self.error: TexventError | None = None
        """Why the source failed, if it did."""
        self._source = source
        self._waiting: tuple[Frame, float] | None = None
        self._changed = threading.Condition()
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def take(self) -> tuple[Frame, float] | None:
        """The newest frame and when it arrived, s of `time.perf_counter`; None at the end."""
        with self._changed:
            self._changed.wait_for(lambda: self._waiting is not None or self.is_over)
            waiting, self._waiting = self._waiting, None
            return None if self._stop.is_set() else waiting

    def close(self) -> None:
        """Stop reading."""
        self._stop.set()
        self._end()
        self._thread.join(LEAVE_S)

    def _end(self) -> None:
        with self._changed:
            self.is_over = True
            self._changed.notify_all()

    def _read(self) -> None:
        begun_s, shift_us = time.perf_counter(), 0
        try:
            while not self._stop.is_set():
                shift_us += self._play(begun_s, shift_us)
                if self._source.is_live:
                    break
        except TexventError as error:
            self.error = error
        finally:
            self._end()

    def _play(self, begun_s: float, shift_us: int) -> int:
        """Read the source once; returns how long it lasts, its last frame included, µs."""
        first_us, last_us, interval_us = None, 0, 0
        for frame in self._source:
            first_us = frame.t_us if first_us is None else first_us
            if not self._source.is_live:
                due_s = begun_s + (frame.t_us - first_us + shift_us) / MICROSECONDS
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
