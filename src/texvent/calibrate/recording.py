"""A recording of a sensor that delivers frames and events: what a model of it is fitted to."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from texvent._registry import INTERPOLATORS
from texvent.capture.frame_source import FrameSource
from texvent.config import InterpolateConfig
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.frames import MICROSECONDS, Frame, FrameStream
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.pairing import pair_frames
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.simulator import PhysicalSimulator

WARM_UP_US = 100_000
"""Simulated before a span, so that pixels have left their initial phase, µs."""
LEAST_SHARED_US = 150_000
"""Time that frames and events must share after the warm-up, µs."""


class TimeSpan(NamedTuple):
    """A part of a recording, `[start_us, stop_us)`."""

    start_us: int
    stop_us: int

    @property
    def seconds(self) -> float:
        """Length, s."""
        return (self.stop_us - self.start_us) / MICROSECONDS

    def first(self, seconds: float) -> TimeSpan:
        """The start of the span, at most this long."""
        return TimeSpan(
            self.start_us, min(self.stop_us, self.start_us + round(seconds * MICROSECONDS))
        )


@dataclass(frozen=True, eq=False)
class CalibrationRecording:
    """Frames and events of one sensor on one clock.

    Raises:
        InputError: their sizes differ.
    """

    frames: FrameStream
    events: EventStream
    interpolate: InterpolateConfig
    """Interpolation of intermediate frames."""

    def __post_init__(self) -> None:
        if self.frames.size != self.events.size:
            raise InputError(
                f"frames are {self.frames.size}, events {self.events.size}; calibration compares "
                "pixels, so both must come from one sensor"
            )
        if self.frames.is_live:
            raise InputError("calibration needs frames that can be read again; record them first")

    def halves(self) -> tuple[TimeSpan, TimeSpan]:
        """The two halves of what frames and events share.

        Raises:
            InputError: they share less than 0.15 s after the first 0.1 s.
        """
        times = [frame.t_us for frame in self.frames]
        if not times or not len(self.events):
            raise InputError("calibration needs frames and events; this recording lacks one")
        start = max(times[0] + WARM_UP_US, int(self.events.t[0]))
        stop = min(times[-1], int(self.events.t[-1]))
        middle = (start + stop) // 2
        if stop - start < LEAST_SHARED_US:
            raise InputError(
                f"frames and events share {max(stop - start, 0) / MICROSECONDS:.3f} s after the "
                f"first {WARM_UP_US / MICROSECONDS:g} s; calibration needs "
                f"{LEAST_SHARED_US / MICROSECONDS:g} s or more. Do they run on the same clock?"
            )
        return TimeSpan(start, middle), TimeSpan(middle, stop)

    def dense_frames(self, span: TimeSpan, config: PhysicalConfig) -> list[Frame]:
        """Frames of a span and of the time before it that a simulation needs, in memory."""
        model = PhysicalSimulator(config)
        interpolator = INTERPOLATORS.load(self.interpolate.interpolate)(
            self.interpolate, self.frames
        )
        part = _Part(self.frames, span)
        policy = CountPolicy(
            self.interpolate,
            part,
            interpolator,
            balance=model.balance,
            contrast_threshold=model.contrast_threshold,
            counts_motion=model.benefits_from_denser_frames,
        )
        pairs = pair_frames(part, interpolator, self.interpolate, policy)
        return [frame for pair in pairs for frame in pair.frames]


class _Part(FrameSource):
    """The frames around a span, as a stream."""

    def __init__(self, whole: FrameStream, span: TimeSpan) -> None:
        super().__init__(whole.size, whole.fps, None, whole.metadata)
        self._whole = whole
        self._span = span

    def __iter__(self) -> Iterator[Frame]:
        margin = 2 * WARM_UP_US
        for frame in self._whole:
            if frame.t_us >= self._span.stop_us + margin:
                return
            if frame.t_us >= self._span.start_us - margin:
                yield frame


def simulate_span(
    frames: list[Frame], span: TimeSpan, config: PhysicalConfig, *, offset_us: int = 0
) -> EventStream:
    """Simulated events of a span.

    Args:
        frames: of `CalibrationRecording.dense_frames`.
        span: which events are wanted.
        config: the model.
        offset_us: what is added to the times of the frames.
    """
    simulator = PhysicalSimulator(config)
    packets = []
    for frame in frames:
        t_us = frame.t_us + offset_us
        if t_us >= span.start_us - WARM_UP_US:
            packets.append(simulator.step(Frame(frame.pixels, t_us, frame.is_source)))
        if t_us >= span.stop_us:
            break
    return EventStream.concat(packets).cut(*span)
