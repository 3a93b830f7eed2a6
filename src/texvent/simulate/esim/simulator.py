"""ESIM's pixel model: log intensity runs in straight lines, every threshold crossing is an event.

Source: H. Rebecq, D. Gehrig, D. Scaramuzza, "ESIM: an open event camera simulator", CoRL 2018,
and D. Gehrig et al., "Video to events: recycling video datasets for event cameras", CVPR 2020,
which runs it on video frames. docs/simulators.md gives the equations and the deviations.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.pairs.frame_pair import FramePair
from texvent.simulate.backend.select import AUTO, GPU
from texvent.simulate.crossing.ramp import RefractoryPeriod
from texvent.simulate.crossing.trigger_levels import LOOK_UP, BrightnessCurve, TriggerLevels
from texvent.simulate.esim.config import WHITE, EsimConfig
from texvent.simulate.esim.crossings import CROSS_THRESHOLDS, RampPixels
from texvent.simulate.esim.segment_pixels import BandEvents, LogScale, SegmentPixels
from texvent.simulate.esim.segments import CrossingRules, CrossingState
from texvent.simulate.fused.candidates import find_bounds
from texvent.simulate.fused.definitions import Float64Array, LumaBounds
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents, make_packet
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.mismatch import (
    LONG_AGO_US,
    LOWEST_THRESHOLD,
    Thresholds,
    draw_threshold_pair_at,
    sensor_thresholds,
    thresholds_at,
)
from texvent.simulate.streaming import IntensityArray, StreamingSimulator
from texvent.video import Frame

__all__ = ["EsimConfig", "EsimSimulator"]

FLOOR = Thresholds(np.array([LOWEST_THRESHOLD]), np.array([LOWEST_THRESHOLD]))
"""The lowest that are ever drawn, for all pixels."""


class EsimSimulator(StreamingSimulator[EsimConfig]):
    """ESIM on video frames; see `simulate.protocol.Simulator`.

    A pair whose intermediate frames would be moved by optical flow is computed without drawing
    them where few pixels may fire; the events are the same.

    Example:
        >>> from texvent.video import Frame
        >>> simulator = EsimSimulator(EsimConfig(contrast_threshold_on=0.5), backend="reference")
        >>> dark, bright = np.array([[50]], np.uint8), np.array([[200]], np.uint8)
        >>> len(simulator.step(Frame(dark, t_us=0)))  # nothing to compare with yet
        0
        >>> events = simulator.step(Frame(bright, t_us=1000))  # ln(200.255 / 50.255) = 1.3825
        >>> list(zip(events.t.tolist(), events.polarity.tolist()))
        [(361, 1), (723, 1)]
    """

    config_type: ClassVar[type] = EsimConfig
    takes_linear: ClassVar[bool] = True
    bytes_per_pixel: ClassVar[int] = 90
    gains_from_frames: ClassVar[bool] = True
    presets: ClassVar[Mapping[str, EsimConfig]] = {
        "default": EsimConfig(),
        "peer-common": EsimConfig(),
    }

    has_gpu: ClassVar[bool] = True

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold, log units."""
        return self.config.contrast_threshold

    @property
    def balance(self) -> float:
        """`255 · log_eps`: with it, Eq. 4's logarithm is the model's own."""
        return self.config.balance

    def reset(self) -> None:
        """Forget all frames: the next one is the first."""
        super().reset()
        self._on_gpu: Any = None
        if self._backend == GPU:
            from texvent.simulate.gpu.frame_steps import FrameSteps  # brings torch

            self._on_gpu = FrameSteps(self.config, self._seed)
        config = self.config
        rules = CrossingRules(
            config.contrast_threshold_on, config.contrast_threshold_off, config.refractory_period_us
        )
        scale = LogScale(self._log_intensity, balance=config.balance, unit=WHITE)
        self._segments = SegmentPixels(rules, scale)
        self._triggers: TriggerLevels | None = None

    def step(self, frame: Frame) -> EventStream:
        """Events in `[t of the frame before, t of this frame)`; see `StreamingSimulator.step`."""
        if self._on_gpu is None:
            return super().step(frame)
        self._enter(frame)
        packet: EventStream = self._on_gpu.step(frame)
        return packet

    def advance(self, pair: FramePair) -> Iterator[tuple[Frame, EventStream]]:
        """Events between two frames; see `simulate.protocol.Simulator.advance`."""
        bounds = None if pair.first is None else self._find_bounds(pair)
        yield from super().advance(pair) if bounds is None else self._fuse(pair, bounds)

    def _find_bounds(self, pair: FramePair) -> LumaBounds | None:
        """Luma bounds if the pair is better computed without drawing its frames, else None."""
        if self._backend not in (AUTO, "cpu") or self.config.threshold_sigma > 0:
            return None
        return find_bounds(pair.motion, self._segments.levels)

    def _fuse(self, pair: FramePair, bounds: LumaBounds) -> Iterator[tuple[Frame, EventStream]]:
        """The packets of `step` for every frame of a pair, without drawing them."""
        motion, edges_us = pair.motion, pair.edges_us
        bands = self._segments.cross(motion, edges_us, bounds)
        self._leave_pair(pair)
        parts = [_split_by_segment(band, len(edges_us) - 1) for band in bands]
        spans = itertools.pairwise(edges_us.tolist())
        for frame, span_us, fired in zip(
            pair.undrawn_frames, spans, zip(*parts, strict=True), strict=True
        ):
            interval = FrameInterval(*span_us, np.uint64(0))
            yield frame, make_packet(UnsortedEvents.concat(fired), interval, motion.size)

    def _leave_pair(self, pair: FramePair) -> None:
        """Note that the pixels have seen the later frame of a pair, though no frame was stepped."""
        self._enter(pair.second)
        # Found again from the references when a frame is stepped.
        self._triggers = None
        self._last_luma = pair.second.luma

    def _begin(self, intensity: IntensityArray) -> None:
        config = self.config
        self._table = log_intensity(np.arange(256, dtype=np.uint8), config.log_eps)
        of_luma = self._table if intensity.dtype == np.uint8 else None
        if of_luma is None:
            reference = self._log_intensity(intensity).reshape(-1)
        else:
            reference = LOOK_UP.load(self._backend)(of_luma, intensity.reshape(-1))
        rested = reference.size if config.refractory_period_us else 0
        self._references = CrossingState(reference, np.full(rested, LONG_AGO_US))
        height, width = intensity.shape
        self._shape = height, width
        self._segments.watch(self._references, self._shape)
        self._is_redrawn = config.threshold_sigma > 0 and config.threshold_redraw == "frame"
        # Any threshold may be drawn anew, but none below the floor.
        self._fixed = FLOOR
        if not self._is_redrawn:
            self._fixed = sensor_thresholds(intensity.shape, self._seed, config)
        self._triggers = self._find_triggers(intensity, of_luma)

    def _find_triggers(
        self, intensity: IntensityArray, of_luma: Float64Array | None = None
    ) -> TriggerLevels:
        """The trigger levels of all pixels; arguments as for `TriggerLevels.set_all`."""
        curve = BrightnessCurve(WHITE, -self.config.balance)
        triggers = TriggerLevels(intensity, curve, backend=self._backend)
        triggers.set_all(self._references.reference, self._fixed, of_luma=of_luma)
        return triggers

    def _advance(self, intensity: IntensityArray, interval: FrameInterval) -> SortedEvents:
        triggers = self._triggers or self._find_triggers(self._last_luma)
        pixel, before, now = triggers.find_outside(intensity)
        table = self._table if now.dtype == np.uint8 else None
        if table is None:
            before, now = self._log_intensity(before), self._log_intensity(now)
        cross_thresholds = CROSS_THRESHOLDS.load(self._backend)
        columns = cross_thresholds(
            RampPixels(pixel, before, now, table, self._thresholds(pixel, interval.key)),
            self._references,
            (interval.start_us, interval.stop_us),
            RefractoryPeriod(self.config.refractory_period_us, is_level_lost=True),
            self._shape,
        )
        triggers.set(pixel, self._references.reference, thresholds_at(pixel, self._fixed))
        self._triggers = triggers
        # The references have moved.
        self._segments.watch(self._references, self._shape)
        return columns

    def _log_intensity(self, intensity: IntensityArray) -> Float64Array:
        return log_intensity(intensity, self.config.log_eps)

    def _thresholds(self, pixel: NDArray[np.int64], key: np.uint64) -> Thresholds:
        """Thresholds of some pixels in this interval."""
        if self._is_redrawn:
            y, x = np.divmod(pixel, self._shape[1])
            return Thresholds(*draw_threshold_pair_at(y, x, key, self.config))
        return thresholds_at(pixel, self._fixed)


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
        return np.asarray(table[intensity])
    return np.asarray(np.log(intensity / np.float64(WHITE) + log_eps))


def _split_by_segment(band: BandEvents, segments: int) -> list[UnsortedEvents]:
    """The events of each segment."""
    fired, segment = band
    order = np.argsort(segment, kind="stable")
    cuts = np.searchsorted(segment[order], np.arange(segments + 1)).tolist()
    pixel, t, p = fired.pixel[order], fired.t[order], fired.p[order]
    rows = (slice(*cut) for cut in itertools.pairwise(cuts))
    return [UnsortedEvents.signal(pixel[part], t[part], p[part]) for part in rows]
