"""Base classes of pixel models: stepping through a pair, one frame interval at a time; packets."""

from __future__ import annotations

import abc
from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.events import EventStream
from texvent.frames import Frame, StreamChecker
from texvent.pairs.frame_pair import FramePair
from texvent.sensor import SensorSize
from texvent.simulation.packets import FrameInterval, SortedEvents, UnsortedEvents
from texvent.simulation.random.draws import frame_key


class SteppingSimulator(abc.ABC):
    """`advance` and `finish` for a pixel model that only knows how to `step`."""

    @abc.abstractmethod
    def step(self, frame: Frame) -> EventStream:
        """Events in `[t of the frame before, t of this frame)`; see `protocol.Simulator.step`."""

    def advance(self, pair: FramePair) -> Iterator[tuple[Frame, EventStream]]:
        """Every intermediate frame and the later frame, each with the events that end at it."""
        for frame in pair.frames:
            yield frame, self.step(frame)

    def finish(self) -> Iterator[tuple[Frame, EventStream]]:
        """Nothing: every frame was answered at once."""
        yield from ()


Config = TypeVar("Config")
IntensityArray = NDArray[Any]
"""Luma on the 0..255 scale, [H, W], uint8 or float32."""


class StreamingSimulator(SteppingSimulator, Generic[Config]):
    """A pixel model that looks at one frame interval at a time.

    A model sets up its pixels from the first frame (`_begin`) and gives the events until the next
    (`_advance`). This class does the rest, so all models treat bad frames, times and order alike.
    Random draws are keyed by the time since the first frame, so shifting a clip in time shifts
    its events and nothing else.
    """

    config_type: ClassVar[type]
    presets: ClassVar[Mapping[str, Any]]

    def __init__(self, config: Config | None = None, *, seed: int = 0) -> None:
        """Prepare a simulator that has seen no frame.

        Args:
            config: options; default: the first preset.
            seed: of everything random, 0..2⁶³−1.

        Raises:
            ConfigError: the seed is out of range.
        """
        check_range("seed", seed, 0, 2**63 - 1)
        self.config: Config = config if config is not None else next(iter(self.presets.values()))
        self._seed = int(seed)
        self.reset()

    def reset(self) -> None:
        """Forget all frames: the next one is the first."""
        self._checker = StreamChecker()
        self._first_us: int | None = None
        self._last_us = 0

    def step(self, frame: Frame) -> EventStream:
        """Events in `[t of the frame before, t of this frame)`, sorted; none for the first frame.

        Raises:
            InputError: another size than before, a time that does not increase, or an intensity
                that is NaN, infinite or negative.
        """
        interval = self._enter(frame)
        fired: UnsortedEvents | SortedEvents
        if interval.duration_us:
            fired = self._advance(frame.luma, interval)
        else:
            self._begin(frame.luma)
            fired = UnsortedEvents.none()
        if isinstance(fired, UnsortedEvents):
            return make_packet(fired, interval, frame.size)
        x, y, t, p, label = fired
        return EventStream.unchecked(x, y, t, p, size=frame.size, label=label)

    def _enter(self, frame: Frame) -> FrameInterval:
        """The interval that a frame ends, an empty one for the first; bad frames are refused."""
        self._checker.check(frame)
        if self._first_us is None:
            self._first_us = self._last_us = frame.t_us
        key = frame_key(self._seed, frame.t_us - self._first_us)
        interval = FrameInterval(self._last_us, frame.t_us, key)
        self._last_us = frame.t_us
        return interval

    @abc.abstractmethod
    def _begin(self, intensity: IntensityArray) -> None:
        """Set up every pixel from the first frame."""

    @abc.abstractmethod
    def _advance(
        self, intensity: IntensityArray, interval: FrameInterval
    ) -> UnsortedEvents | SortedEvents:
        """Events between the frame before and this one; updates the state of every pixel."""


def make_packet(events: UnsortedEvents, interval: FrameInterval, size: SensorSize) -> EventStream:
    """A packet in its order: by (t, y, x, p), labels included.

    Raises:
        InputError: the interval is too long for a sensor of this size.
    """
    if not len(events.t):  # the first packet of every run: its kernel may not be needed at all
        columns = (np.empty(0, dtype) for dtype in (np.uint16, np.uint16, np.int64, np.uint8))
        return EventStream.unchecked(*columns, size=size, label=np.empty(0, np.uint8))
    span_us = (interval.start_us, interval.stop_us)
    from texvent.simulation.kernels.radix_sort import sort_events  # brings Numba

    x, y, t, p, label = sort_events(events, span_us, size.shape)
    return EventStream.unchecked(x, y, t, p, size=size, label=label)
