"""The pixels of ESIM between frames, and on pairs whose intermediate frames are not drawn."""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.frame_pair import FramePair
from texvent.simulate.crossing.ramp import RefractoryPeriod
from texvent.simulate.crossing.trigger_levels import (
    BrightnessCurve,
    TriggerLevels,
    look_up,
    trigger_factors,
)
from texvent.simulate.esim.crossings import (
    CrossingRules,
    CrossingState,
    RampPixels,
    Segments,
    cross_segments,
    cross_thresholds,
)
from texvent.simulate.esim.simulator import WHITE, EsimConfig, log_intensity
from texvent.simulate.fused.bounds import (
    RESET_BY_THRESHOLD,
    CrossingCandidates,
    Float64Array,
    Int64Array,
    LumaBounds,
    ReferenceLevels,
)
from texvent.simulate.fused.candidates import find_bounds, map_candidates
from texvent.simulate.packets import FrameInterval, SortedEvents, UnsortedEvents
from texvent.simulate.random.mismatch import (
    LONG_AGO_US,
    LOWEST_THRESHOLD,
    Thresholds,
    draw_threshold_pair_at,
)
from texvent.simulate.streaming import IntensityArray

FLOOR = Thresholds(np.array([LOWEST_THRESHOLD]), np.array([LOWEST_THRESHOLD]))
"""The lowest thresholds that are ever drawn, for all pixels."""


class BandEvents(NamedTuple):
    """Events of a band of rows."""

    fired: UnsortedEvents
    """By pixel, then in time."""
    segment: NDArray[np.int16]
    """[n] the segment, from 0, of each event."""


class EsimPixels:
    """All pixels of a sensor."""

    def __init__(self, config: EsimConfig, luma: IntensityArray) -> None:
        """Begin with the first frame.

        Args:
            config: options.
            luma: of the first frame, [H, W], 0..255 scale, uint8 or float32.
        """
        self._config = config
        self._table = log_intensity(np.arange(256, dtype=np.uint8), config.log_eps)
        of_luma = self._table if luma.dtype == np.uint8 else None
        if of_luma is None:
            reference = self._log_intensity(luma).reshape(-1)
        else:
            reference = look_up(of_luma, luma.reshape(-1))
        rested = reference.size if config.refractory_period_us else 0
        self._references = CrossingState(reference, np.full(rested, LONG_AGO_US))
        height, width = luma.shape
        self._shape = height, width
        self._rules = CrossingRules(
            config.contrast_threshold_on, config.contrast_threshold_off, config.refractory_period_us
        )
        # Of `ReferenceLevels`; made from the references when a pair is fused.
        self._level: Float64Array | None = None
        # Drawn thresholds are never below the floor.
        self._lowest = FLOOR
        if config.threshold_sigma == 0:
            on, off = config.contrast_threshold_on, config.contrast_threshold_off
            self._lowest = Thresholds(np.array([float(on)]), np.array([float(off)]))
        self._triggers: TriggerLevels | None = self._find_triggers(luma, of_luma)

    def advance(self, luma: IntensityArray, interval: FrameInterval) -> SortedEvents:
        """Events until a frame, [H, W], in the order of a packet."""
        triggers = self._triggers or self._find_triggers(self._last_luma)
        pixel, before, now = triggers.find_outside_levels(luma)
        table = self._table if now.dtype == np.uint8 else None
        if table is None:
            before, now = self._log_intensity(before), self._log_intensity(now)
        events = cross_thresholds(
            RampPixels(pixel, before, now, table, self._thresholds(pixel, interval.key)),
            self._references,
            (interval.start_us, interval.stop_us),
            RefractoryPeriod(self._config.refractory_period_us, is_level_lost=True),
            self._shape,
        )
        triggers.set(pixel, self._references.reference, self._lowest)
        self._triggers = triggers
        self._level = None
        return events

    def find_bounds(self, pair: FramePair) -> LumaBounds | None:
        """Luma bounds if the pair is better computed without drawing its frames, else None."""
        return find_bounds(pair.motion, self._levels)

    def fuse(self, pair: FramePair, bounds: LumaBounds) -> list[UnsortedEvents]:
        """Events of every segment of a pair, without drawing its frames.

        Args:
            pair: not the first of a stream, with flow.
            bounds: of `find_bounds`.
        """
        edges_us, levels = pair.edges_us, self._levels()

        def decide(found: CrossingCandidates) -> BandEvents:
            return self._decide(found, levels.reference, edges_us)

        bands = map_candidates(decide, pair.motion, levels=levels, bounds=bounds)
        # Found again from the references when a frame is stepped.
        self._triggers, self._last_luma = None, pair.second.luma
        parts = [_split_by_segment(band, len(edges_us) - 1) for band in bands]
        return [UnsortedEvents.concat(fired) for fired in zip(*parts, strict=True)]

    def _levels(self) -> ReferenceLevels:
        """Reference levels of the pixels at the start of a pair."""
        rules = self._rules
        up, down = trigger_factors(rules.threshold_on, rules.threshold_off)
        if self._level is None:
            self._level = WHITE * np.exp(self._references.reference.reshape(self._shape))
        return ReferenceLevels(self._level, self._config.balance, up, down, RESET_BY_THRESHOLD)

    def _decide(
        self, found: CrossingCandidates, level: Float64Array, edges_us: Int64Array
    ) -> BandEvents:
        """Events of the candidates of a band; moves their references and levels [H, W]."""
        pixel, segment, before, now = found
        segments = Segments(
            pixel,
            edges_us[segment],
            edges_us[segment + 1],
            self._log_intensity(before),
            self._log_intensity(now),
        )
        crossings = cross_segments(segments, self._rules, self._references)
        # Candidates come by pixel: the last one of each says where it is now.
        moved = pixel[np.flatnonzero(np.diff(pixel, append=-1))]
        level.reshape(-1)[moved] = WHITE * np.exp(self._references.reference[moved])
        fired = UnsortedEvents.signal(pixel[crossings.row], crossings.t, crossings.p)
        return BandEvents(fired, segment[crossings.row])

    def _find_triggers(
        self, luma: IntensityArray, of_luma: Float64Array | None = None
    ) -> TriggerLevels:
        """Trigger levels of all pixels; arguments as for `TriggerLevels.set_all`."""
        triggers = TriggerLevels(luma, BrightnessCurve(WHITE, -self._config.balance))
        triggers.set_all(self._references.reference, self._lowest, of_luma=of_luma)
        return triggers

    def _log_intensity(self, luma: IntensityArray) -> Float64Array:
        return log_intensity(luma, self._config.log_eps)

    def _thresholds(self, pixel: Int64Array, key: np.uint64) -> Thresholds:
        """Thresholds of some pixels in this interval."""
        if self._config.threshold_sigma == 0:
            return self._lowest
        y, x = np.divmod(pixel, self._shape[1])
        return Thresholds(*draw_threshold_pair_at(y, x, key, self._config))


def _split_by_segment(band: BandEvents, segments: int) -> list[UnsortedEvents]:
    """The events of each segment."""
    fired, segment = band
    order = np.argsort(segment, kind="stable")
    cuts = np.searchsorted(segment[order], np.arange(segments + 1)).tolist()
    pixel, t, p = fired.pixel[order], fired.t[order], fired.p[order]
    rows = (slice(*cut) for cut in itertools.pairwise(cuts))
    return [UnsortedEvents.signal(pixel[part], t[part], p[part]) for part in rows]
