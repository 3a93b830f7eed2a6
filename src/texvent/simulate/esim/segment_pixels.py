"""Pixels whose brightness is piecewise linear between two frames and fires at every threshold."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.motion_interpolation import MotionInterpolation
from texvent.simulate.crossing.trigger_levels import trigger_factors
from texvent.simulate.esim.segments import (
    CROSS_SEGMENTS,
    CrossingRules,
    CrossingState,
    Segments,
)
from texvent.simulate.fused.candidates import map_candidates
from texvent.simulate.fused.definitions import (
    STEPS,
    CrossingCandidates,
    Float64Array,
    Int64Array,
    LumaBounds,
    ReferenceLevels,
)
from texvent.simulate.packets.unsorted_events import UnsortedEvents


class LogScale(NamedTuple):
    """How a model computes brightness from luma: `ln((balance + I) / unit)`."""

    brightness_of: Callable[[NDArray[Any]], Float64Array]
    """The model's own function, whose bits decide."""
    balance: float
    """α on the 0..255 scale."""
    unit: float = 1.0
    """The balanced level whose brightness is 0."""


class BandEvents(NamedTuple):
    """Events of a band of rows."""

    fired: UnsortedEvents
    """By pixel, then in time."""
    segment: NDArray[np.int16]
    """[n] the segment, from 0, that each event lies on."""


class SegmentPixels:
    """Threshold crossings of all pixels of a sensor; see `segments_reference.cross_segments`."""

    def __init__(self, rules: CrossingRules, scale: LogScale) -> None:
        """Pixels without a state; `watch` gives them one.

        Args:
            rules: when they fire.
            scale: brightness of luma.
        """
        self._rules, self._scale = rules, scale

    def watch(self, state: CrossingState, shape: tuple[int, ...]) -> None:
        """Use a state, and change it from now on; to be called again when it was changed elsewhere.

        Args:
            state: references and event times of all pixels.
            shape: (height, width).
        """
        self._state, self._shape = state, shape
        self._level: Float64Array | None = None

    def levels(self) -> ReferenceLevels:
        """What the pixels are compared with now."""
        rules, scale = self._rules, self._scale
        up, down = trigger_factors(rules.threshold_on, rules.threshold_off)
        if self._level is None:
            self._level = scale.unit * np.exp(self._state.reference.reshape(self._shape))
        return ReferenceLevels(self._level, scale.balance, up, down, STEPS)

    def cross(
        self,
        motion: MotionInterpolation,
        edges_us: Int64Array,
        bounds: LumaBounds,
    ) -> list[BandEvents]:
        """Events between two source frames, in bands of rows from the top; changes the state.

        Args:
            motion: what lies between the two frames; with flow.
            edges_us: [K + 2] where the segments begin and end, µs.
            bounds: of `candidates.find_bounds`.
        """
        levels = self.levels()

        def decide(found: CrossingCandidates) -> BandEvents:
            return self._decide(found, levels.reference, edges_us)

        return map_candidates(decide, motion, levels=levels, bounds=bounds)

    def _decide(
        self, found: CrossingCandidates, level: Float64Array, edges_us: Int64Array
    ) -> BandEvents:
        """The events of the candidates of a band; moves their references and levels [H, W]."""
        pixel, segment, before, now = found
        segments = Segments(
            pixel,
            edges_us[segment],
            edges_us[segment + 1],
            self._scale.brightness_of(before),
            self._scale.brightness_of(now),
        )
        crossings = CROSS_SEGMENTS.load()(segments, self._rules, self._state)
        # Candidates come by pixel: the last one of each says where it is now.
        moved = pixel[np.flatnonzero(np.diff(pixel, append=-1))]
        level.reshape(-1)[moved] = self._scale.unit * np.exp(self._state.reference[moved])
        fired = UnsortedEvents.signal(pixel[crossings.row], crossings.t, crossings.p)
        return BandEvents(fired, segment[crossings.row])
