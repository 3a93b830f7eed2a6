"""The pixels of ESIM between frames, and on pairs whose intermediate frames are not drawn."""

from __future__ import annotations

import functools
import itertools
from typing import NamedTuple

import numpy as np

from texvent.pairs.frame_pair import FramePair
from texvent.simulation.crossing.ramp import RefractoryPeriod
from texvent.simulation.crossing.trigger_levels import (
    BrightnessCurve,
    TriggerLevels,
    trigger_factors,
)
from texvent.simulation.esim.config import WHITE, EsimConfig
from texvent.simulation.esim.crossings import CrossingState, RampPixels, cross_thresholds
from texvent.simulation.fused.bounds import (
    CrossingCandidates,
    Float64Array,
    Int64Array,
    ReferenceLevels,
)
from texvent.simulation.fused.candidates import map_candidates
from texvent.simulation.packets import FrameInterval, SortedEvents
from texvent.simulation.random.mismatch import (
    LONG_AGO_US,
    LOWEST_THRESHOLD,
    Thresholds,
    draw_threshold_pair_at,
)
from texvent.simulation.streaming import IntensityArray

FLOOR = Thresholds(np.array([LOWEST_THRESHOLD]), np.array([LOWEST_THRESHOLD]))
"""The lowest thresholds that are ever drawn, for all pixels."""


class SegmentPixels(NamedTuple):
    """Candidates of one segment and band of rows; [n] each."""

    pixel: Int64Array
    """Flat index, ascending."""
    before: Float64Array
    """Brightness at the start of the segment, log units."""
    now: Float64Array
    """Brightness at its end."""


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
        reference = self._log_intensity(luma).reshape(-1)
        rested = reference.size if config.refractory_period_us else 0
        self._references = CrossingState(reference, np.full(rested, LONG_AGO_US))
        height, width = luma.shape
        self._shape = height, width
        # Of `ReferenceLevels`; made from the references when a pair is fused.
        self._level: Float64Array | None = None
        # Drawn thresholds are never below the floor.
        self._lowest = FLOOR
        if config.threshold_sigma == 0:
            on, off = config.contrast_threshold_on, config.contrast_threshold_off
            self._lowest = Thresholds(np.array([float(on)]), np.array([float(off)]))
        self._triggers: TriggerLevels | None = self._find_triggers(luma)

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

    def fuse(self, pair: FramePair) -> list[SortedEvents]:
        """Events of every segment of a pair, without drawing its frames.

        Args:
            pair: not the first of a stream, with flow.
        """
        edges_us, levels = pair.edges_us.tolist(), self._levels()
        split = functools.partial(self._split_by_segment, segments=len(edges_us) - 1)
        bands = map_candidates(split, levels, pair.motion)
        # Found again from the references when a frame is stepped.
        self._triggers, self._last_luma = None, pair.second.luma
        refractory = RefractoryPeriod(self._config.refractory_period_us, is_level_lost=True)
        events, is_moved = [], np.zeros(levels.reference.size, np.bool_)
        for parts, span_us in zip(
            zip(*bands, strict=True), itertools.pairwise(edges_us), strict=True
        ):
            pixel, before, now = (np.concatenate(columns) for columns in zip(*parts, strict=True))
            pixels = RampPixels(pixel, before, now, None, self._lowest)
            events.append(
                cross_thresholds(pixels, self._references, span_us, refractory, self._shape)
            )
            is_moved[pixel] = True
        moved = np.flatnonzero(is_moved)
        levels.reference.reshape(-1)[moved] = WHITE * np.exp(self._references.reference[moved])
        return events

    def _levels(self) -> ReferenceLevels:
        """Reference levels of the pixels at the start of a pair."""
        config = self._config
        up, down = trigger_factors(config.contrast_threshold_on, config.contrast_threshold_off)
        if self._level is None:
            self._level = WHITE * np.exp(self._references.reference.reshape(self._shape))
        return ReferenceLevels(self._level, config.balance, up, down, is_step=True)

    def _split_by_segment(self, found: CrossingCandidates, *, segments: int) -> list[SegmentPixels]:
        """The candidates of every segment."""
        pixel, segment, before, now = found.take(np.argsort(found.segment, kind="stable"))
        cuts = np.searchsorted(segment, np.arange(segments + 1)).tolist()
        start, stop = self._log_intensity(before), self._log_intensity(now)
        parts = itertools.starmap(slice, itertools.pairwise(cuts))
        return [SegmentPixels(pixel[part], start[part], stop[part]) for part in parts]

    def _find_triggers(self, luma: IntensityArray) -> TriggerLevels:
        """Trigger levels of all pixels, which have seen this luma last, [H, W]."""
        triggers = TriggerLevels(luma, BrightnessCurve(WHITE, -self._config.balance))
        triggers.set_all(self._references.reference, self._lowest)
        return triggers

    def _log_intensity(self, luma: IntensityArray) -> Float64Array:
        return log_intensity(luma, self._config.log_eps)

    def _thresholds(self, pixel: Int64Array, key: np.uint64) -> Thresholds:
        """Thresholds of some pixels in this interval."""
        if self._config.threshold_sigma == 0:
            return self._lowest
        y, x = np.divmod(pixel, self._shape[1])
        return Thresholds(*draw_threshold_pair_at(y, x, key, self._config))


def log_intensity(intensity: IntensityArray, log_eps: float) -> Float64Array:
    """Log intensity `ln(I / 255 + ε)` that ESIM compares.

    Args:
        intensity: 0..255 scale, any shape, uint8 or float.
        log_eps: ε, above 0.

    Returns:
        Of the same shape, float64.
    """
    if intensity.dtype == np.uint8:
        table = np.log(np.arange(256) / WHITE + log_eps)
        return np.asarray(table.take(intensity))
    return np.asarray(np.log(intensity / np.float64(WHITE) + log_eps))
