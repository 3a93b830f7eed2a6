"""Pixels that fire wherever brightness, in straight pieces, crosses a threshold; ESIM's are."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.engine.fused import earlier_of, edges_of, paths_of, undrawn_frames
from texvent.events import EventStream
from texvent.interpolate.densify import Pair
from texvent.pairs.motion_interpolation import Paths
from texvent.simulate.esim.simulator import WHITE, EsimConfig, EsimSimulator, log_intensity
from texvent.simulate.fused.candidates import CandidateFinder, one_grid
from texvent.simulate.fused.interface import (
    STEPS,
    Candidates,
    Cells,
    Float64Array,
    Grids,
    Int64Array,
    Levels,
)
from texvent.simulate.fused.load import load_kernels
from texvent.simulate.fused.segments import LineCrossings, LineRules, LineState, Pieces
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import make_packet
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.mismatch import LONG_AGO_US
from texvent.video import Frame


class LinePixels:
    """All pixels of a sensor; see `kernels.pieces_reference.cross_pieces`."""

    def __init__(
        self,
        rules: LineRules,
        brightness_of: Callable[[NDArray[Any]], Float64Array],
        *,
        balance: float,
        unit: float = 1.0,
    ) -> None:
        """Pixels that have seen no frame.

        Args:
            rules: when they fire.
            brightness_of: luma → brightness, `ln((balance + I) / unit)`.
            balance: α on the 0..255 scale.
            unit: the balanced level whose brightness is 0.
        """
        self._rules = rules
        self._brightness_of = brightness_of
        self._balance, self._unit = balance, unit
        self._level: Float64Array | None = None

    def begin(self, frame: Frame) -> None:
        """Set every reference to the first frame."""
        reference = self._brightness_of(frame.luma)
        self._fired_us = np.full(reference.size, LONG_AGO_US, np.int64)
        self.adopt(reference)

    def hand_over(self) -> LineState:
        """References and times, to somebody who will move them until `levels` is asked for."""
        self._level = None
        return self._state

    def adopt(self, reference: Float64Array) -> None:
        """Use these references from now on; call again when somebody else has changed them.

        Args:
            reference: brightness, [H, W], log units; events move it.
        """
        self._state, self._shape = LineState(reference.reshape(-1), self._fired_us), reference.shape
        self._level = None

    def levels(self) -> Levels:
        """What the pixels compare with now."""
        rules = self._rules
        up, down = math.exp(rules.threshold_on), math.exp(-rules.threshold_off)
        if self._level is None:
            self._level = self._unit * np.exp(self._state.reference.reshape(self._shape))
        return Levels(self._level, self._balance, up, down, STEPS)

    def cross(
        self,
        finder: CandidateFinder,
        paths: Paths,
        grids: Grids,
        edges_us: Int64Array,
        *,
        cells: Cells | None = None,
    ) -> Iterator[tuple[UnsortedEvents, NDArray[np.int16]]]:
        """What fires between two source frames, in bands of rows from the top.

        Args:
            finder: looks for the pieces on which a pixel may fire.
            paths: what the pixels see.
            grids: the pieces.
            edges_us: [G, P + 1] where the pieces of each grid begin and end, µs.
            cells: of `CandidateFinder.survey`, if there was one.

        Yields:
            The events of a band by pixel, then in time; and the piece, from 0, that each lies on.
        """
        levels = self.levels()

        def settle(found: Candidates) -> tuple[UnsortedEvents, NDArray[np.int16]]:
            return self._settle(found, levels.reference, edges_us)

        yield from finder.map(settle, paths, grids=grids, levels=levels, cells=cells)

    def _settle(
        self, found: Candidates, level: Float64Array, edges_us: Int64Array
    ) -> tuple[UnsortedEvents, NDArray[np.int16]]:
        """What the candidates of a band fire; moves their references and levels [H, W]."""
        pixel, grid, piece, before, now = found
        pieces = Pieces(
            pixel,
            edges_us[grid, piece],
            edges_us[grid, piece + 1],
            self._brightness_of(before),
            self._brightness_of(now),
        )
        cross_pieces = load_kernels("segments").cross_pieces
        crossings: LineCrossings = cross_pieces(pieces, self._rules, self._state)
        # Candidates come by pixel: the last one of each says where it is now.
        moved = pixel[np.flatnonzero(np.diff(pixel, append=-1))]
        level.reshape(-1)[moved] = self._unit * np.exp(self._state.reference[moved])
        fired = UnsortedEvents.signal(pixel[crossings.row], crossings.t, crossings.p)
        return fired, piece[crossings.row]


def esim_pixels(config: EsimConfig) -> LinePixels:
    """The pixels of `simulate.esim.simulator`, whose thresholds are all alike."""
    rules = LineRules(
        config.contrast_threshold_on, config.contrast_threshold_off, config.refractory_period_us
    )
    return LinePixels(
        rules,
        lambda luma: log_intensity(luma, config.log_eps),
        balance=WHITE * config.log_eps,
        unit=WHITE,
    )


class FusedEsim:
    """ESIM on the pictures of the frame engine; see `fused.FusedPixels`."""

    def __init__(self, config: EsimConfig, seed: int) -> None:
        del seed  # with thresholds all alike, nothing is random
        self._config = config
        self._pixels = esim_pixels(config)
        self._watching: EsimSimulator | None = None
        """What saw the last pair, if it was drawn: it moves the pixels' references."""

    def begin(self, frame: Frame) -> None:
        """Take the first frame."""
        self._pixels.begin(frame)

    def fire(self, finder: CandidateFinder, pair: Pair) -> Iterator[tuple[Frame, EventStream]]:
        """Events of each sub-interval."""
        cells = finder.survey(pair, self._pixels.levels)
        if cells is None:
            yield from self._watch(pair)
            return
        self._watching = None
        paths, edges_us = paths_of(pair), edges_of(pair)
        grids = one_grid(paths.positions)
        crossed = self._pixels.cross(finder, paths, grids, edges_us[np.newaxis], cells=cells)
        bands = [_cut_by_piece(*band, len(edges_us) - 1) for band in crossed]
        spans = itertools.pairwise(edges_us.tolist())
        for piece, (frame, span_us) in enumerate(zip(undrawn_frames(pair), spans, strict=True)):
            parts = zip(*(band[piece] for band in bands), strict=True)
            fired = UnsortedEvents(*(np.concatenate(column) for column in parts))
            yield frame, make_packet(fired, FrameInterval(*span_us, np.uint64(0)), paths.size)

    def _watch(self, pair: Pair) -> Iterator[tuple[Frame, EventStream]]:
        """The same from pictures."""
        state, watching = self._pixels.hand_over(), self._watching
        if watching is None:
            watching = self._watching = EsimSimulator(self._config)
            watching.resume(earlier_of(pair), *state)
        for frame in pair.frames:
            yield frame, watching.step(frame)


def _cut_by_piece(
    fired: UnsortedEvents, piece_of: NDArray[np.int16], pieces: int
) -> list[UnsortedEvents]:
    """The events of each piece."""
    order = np.argsort(piece_of, kind="stable")
    cuts = np.searchsorted(piece_of[order], np.arange(pieces + 1)).tolist()
    pixel, t, p = fired.pixel[order], fired.t[order], fired.p[order]
    rows = (slice(*cut) for cut in itertools.pairwise(cuts))
    return [UnsortedEvents.signal(pixel[part], t[part], p[part]) for part in rows]
