"""Frames as pairs without intermediate frames, for tests that drive a simulator directly."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from texvent.events import EventStream
from texvent.frames import Frame
from texvent.pairs.frame_pair import FramePair
from texvent.pairs.scene_change import SceneChange
from texvent.simulation.protocol import Simulator


def pairs_of(frames: Iterable[Frame]) -> Iterator[FramePair]:
    before: Frame | None = None
    for frame in frames:
        yield FramePair(before, frame, SceneChange.NONE, (), ())
        before = frame


def advance_through(
    simulator: Simulator, frames: Iterable[Frame]
) -> Iterator[tuple[Frame, EventStream]]:
    """Every frame with its packet, as a run gets them."""
    for pair in pairs_of(frames):
        yield from simulator.advance(pair)
    yield from simulator.finish()
