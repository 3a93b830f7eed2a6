"""Frames through a pixel model, also one that must see later frames before it can answer."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Protocol, runtime_checkable

from texvent.events import EventStream
from texvent.simulate.protocol import Simulator
from texvent.video import Frame


@runtime_checkable
class LookAheadSimulator(Protocol):
    """A simulator whose events depend on frames after them, such as a network over time."""

    def steps(self, frames: Iterable[Frame]) -> Iterator[tuple[Frame, EventStream]]:
        """Every frame with its packet, as `Simulator.step` has it, some frames later.

        Raises:
            InputError: as `Simulator.step`.
        """
        ...


def step_through(
    simulator: Simulator, frames: Iterable[Frame]
) -> Iterator[tuple[Frame, EventStream]]:
    """Every frame, in order, with the packet of events that ends at it."""
    if isinstance(simulator, LookAheadSimulator):
        yield from simulator.steps(frames)
        return
    for frame in frames:
        yield frame, simulator.step(frame)
