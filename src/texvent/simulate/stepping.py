"""The readable way through a pair of frames: draw the intermediate frames, step through them."""

from __future__ import annotations

import abc
from collections.abc import Iterator
from typing import Any, cast

from texvent.events import EventStream
from texvent.pairs.frame_pair import FramePair
from texvent.simulate.protocol import Simulator
from texvent.video import Frame


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


class SteppedPlugIn(SteppingSimulator):
    """A simulator of another package that has `step` but not `advance`."""

    def __init__(self, simulator: Any) -> None:
        """Wrap a simulator that has seen no frame."""
        self._simulator = simulator

    def __getattr__(self, name: str) -> Any:
        return getattr(self._simulator, name)

    def step(self, frame: Frame) -> EventStream:
        """Step the wrapped simulator."""
        packet: EventStream = self._simulator.step(frame)
        return packet


def with_advance(simulator: Any) -> Simulator:
    """The simulator itself if it has `advance`, else one that steps it through every pair."""
    complete: Any = simulator if hasattr(simulator, "advance") else SteppedPlugIn(simulator)
    return cast("Simulator", complete)
