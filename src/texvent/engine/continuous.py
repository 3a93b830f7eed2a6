"""The continuous-time engine: threshold crossings on each pixel's own path, without frames.

Between two source frames a pixel's brightness is followed along the flow as a function of time: a
chain of straight pieces through samples of the moved and mixed source frames, as many as that pixel
needs. Its crossings are solved for directly. So what a pair costs depends on what moves in it, not
on Eq. 4's K, and no two pixels have to share the instants at which they are looked at.

Source: the sampling of ESIM (Rebecq, Gehrig and Scaramuzza, CoRL 2018, section 3.2), which renders
a frame whenever some pixel's brightness may have changed by more than a threshold or moved by more
than a pixel, taken to each pixel by itself.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Protocol

import numpy as np

from texvent.engine.fused import paths_of
from texvent.events import EventStream
from texvent.interpolate.count import intermediate_times_us
from texvent.interpolate.densify import OnCut, Pair, tell_jump
from texvent.pairs.motion_interpolation import Paths
from texvent.pairs.scene_change import Jump
from texvent.simulate.fused.candidates import CandidateFinder, one_grid
from texvent.simulate.fused.interface import Grids, Int64Array
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import make_packet
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.video import Frame

PIECE_PX = 0.5
"""Longest displacement by the flow within one segment, px; figures: docs/design/simulators.md."""
PIECE_RATIO = 1.5
"""Largest factor by which α + I changes within one piece where a pixel stands: two thresholds of
0.2. Frames that are mixed change in intensity, not in its logarithm."""
MOST_PIECES = 64
"""As many as the frame engine has intermediate frames at most, by default."""


class LinePixelModel(Protocol):
    """A pixel model whose brightness runs in straight pieces."""

    def begin(self, frame: Frame) -> None:
        """Take the first frame."""
        ...

    def fire(
        self, finder: CandidateFinder, paths: Paths, grids: Grids, edges_us: Int64Array
    ) -> UnsortedEvents:
        """Events between two source frames, noise included.

        Args:
            finder: looks for the pieces on which a pixel may fire.
            paths: what the pixels see.
            grids: the pieces.
            edges_us: [G, P + 1] where the pieces of each grid begin and end, µs.
        """
        ...


def step_continuously(
    pairs: Iterable[Pair], pixels: LinePixelModel, on_cut: OnCut | None = None
) -> Iterator[tuple[Frame, EventStream]]:
    """Every source frame with the packet of events between it and the one before.

    Args:
        pairs: source frames; what lies between two of them are `Paths`, or nothing.
        pixels: the pixel model.
        on_cut: told of every jump.
    """
    with CandidateFinder() as finder:
        for pair in pairs:
            tell_jump(pair, on_cut)
            start_us = pair.second.t_us if pair.first is None else pair.first.t_us
            span = FrameInterval(start_us, pair.second.t_us, np.uint64(0))
            if pair.first is None:
                pixels.begin(pair.second)
                fired = UnsortedEvents.none()
            else:
                paths = paths_of(pair)
                grids, edges_us = _pieces(pair, paths, span)
                fired = pixels.fire(finder, paths, grids, edges_us)
            yield pair.second, make_packet(fired, span, pair.second.size)


def _pieces(pair: Pair, paths: Paths, span: FrameInterval) -> tuple[Grids, Int64Array]:
    """The grids of a pair, and their edges."""
    if pair.jump is not Jump.NONE or not len(paths):
        edges = np.array([[span.start_us, *paths.times_us, span.stop_us]])
        return one_grid(paths.positions), edges
    return own_pieces(span)


def own_pieces(span: FrameInterval) -> tuple[Grids, Int64Array]:
    """Grids of 1, 2, 4, ... equal pieces from which every pixel takes what it needs.

    Args:
        span: the pair. Pieces last at least a microsecond.

    Returns:
        The grids, and [G, P + 1] where their pieces begin and end, µs.
    """
    parts = [1]
    while 2 * parts[-1] <= min(MOST_PIECES, span.duration_us):
        parts.append(2 * parts[-1])
    edges = np.full((len(parts), parts[-1] + 1), span.stop_us)
    for grid, number in enumerate(parts):
        inner = intermediate_times_us(span.start_us, span.stop_us, number - 1)
        edges[grid, :number] = [span.start_us, *inner]
    positions = (edges[:, 1:] - span.start_us) / span.duration_us
    number_of = np.array(parts)
    reach2 = np.square(PIECE_PX * number_of)
    return Grids(positions, number_of, reach2, PIECE_RATIO ** number_of.astype(float)), edges
