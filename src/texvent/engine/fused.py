"""The frame engine without its frames: a pair costs one flow and one pass over its pixels.

The events are those of the readable path (`densify`, then `Simulator.step`), bit for bit; it stays
for simulators and interpolators that cannot be fused, and as the definition of this one. Pairs that
it would not make cheaper (`CandidateFinder.survey`) are drawn, and go through the simulator.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from texvent.events import EventStream
from texvent.interpolate.densify import OnCut, Pair, tell_jump
from texvent.pairs.motion_interpolation import Paths
from texvent.sensor import SensorSize
from texvent.simulate.fused.candidates import CandidateFinder
from texvent.simulate.fused.interface import Int64Array
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import make_packet
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.video import Frame


class FusedPixels(Protocol):
    """A pixel model that works on candidates."""

    def begin(self, frame: Frame) -> None:
        """Take the first frame."""
        ...

    def fire(self, finder: CandidateFinder, pair: Pair) -> Iterator[tuple[Frame, EventStream]]:
        """Events between two source frames.

        Args:
            finder: looks for the candidates.
            pair: not the first of a stream.

        Yields:
            Each of `undrawn_frames(pair)`, and the packet of the sub-interval that ends at it.
        """
        ...


def step_fused(
    pairs: Iterable[Pair], pixels: FusedPixels, on_cut: OnCut | None = None
) -> Iterator[tuple[Frame, EventStream]]:
    """Every dense frame with the packet of events that ends at it.

    Args:
        pairs: source frames; what lies between two of them are `Paths`, or nothing.
        pixels: the pixel model.
        on_cut: told of every jump.

    Yields:
        As `simulate.look_ahead.step_through` on the dense frames. Intermediate frames are drawn
        when somebody looks at their pixels.
    """
    with CandidateFinder() as finder:
        for pair in pairs:
            tell_jump(pair, on_cut)
            if pair.first is None:
                pixels.begin(pair.second)
                nothing = FrameInterval(pair.second.t_us, pair.second.t_us, np.uint64(0))
                yield pair.second, make_packet(UnsortedEvents.none(), nothing, pair.second.size)
                continue
            yield from pixels.fire(finder, pair)


def paths_of(pair: Pair) -> Paths:
    """What lies between the two frames of a pair; without pictures if there are none."""
    if isinstance(pair.between, Paths):
        return pair.between
    return Paths.between(earlier_of(pair), pair.second, (), None)


def earlier_of(pair: Pair) -> Frame:
    """The earlier frame of a pair that has one."""
    if pair.first is None:
        raise ValueError("the first frame of a stream has nothing before it")
    return pair.first


def undrawn_frames(pair: Pair) -> Iterator[Frame]:
    """The frames between the two of a pair, then the later one; each is made when it is read."""
    if isinstance(pair.between, Paths):
        yield from (UndrawnFrame(pair.between, index) for index in range(len(pair.between)))
    yield pair.second


def edges_of(pair: Pair) -> Int64Array:
    """Times of both source frames and of the pictures between them, [K + 2], µs."""
    between_us = pair.between.times_us if isinstance(pair.between, Paths) else ()
    return np.array([earlier_of(pair).t_us, *between_us, pair.second.t_us])


class UndrawnFrame(Frame):
    """An intermediate frame that is drawn when its pixels are asked for."""

    def __init__(self, paths: Paths, index: int) -> None:
        # A frozen dataclass takes no assignments.
        vars(self).update(t_us=paths.times_us[index], is_source=False)
        vars(self).update(_size=paths.size, _undrawn=(paths, index))

    @cached_property
    def pixels(self) -> Any:
        """[H, W] float32 luma. Drawing it lets the source frames go."""
        paths, index = vars(self).pop("_undrawn")
        return paths.picture(index)

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        size: SensorSize = vars(self)["_size"]
        return size
