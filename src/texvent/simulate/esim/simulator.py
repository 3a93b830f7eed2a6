"""ESIM's pixel model: log intensity runs in straight lines, every threshold crossing is an event.

Source: H. Rebecq, D. Gehrig, D. Scaramuzza, "ESIM: an open event camera simulator", CoRL 2018,
and D. Gehrig et al., "Video to events: recycling video datasets for event cameras", CVPR 2020,
which runs it on video frames. docs/simulators.md gives the equations and the deviations.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from texvent._registry import load_object
from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.simulate.backend.select import GPU
from texvent.simulate.crossing.levels import Curve, Thresholds, load_look_up
from texvent.simulate.crossing.ramp import Candidates, Levels, Rest, load_cross_levels
from texvent.simulate.crossing.trigger_levels import (
    TriggerLevels,
    sensor_thresholds,
    thresholds_at,
)
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.random.mismatch import (
    LONG_AGO_US,
    LOWEST_THRESHOLD,
    Float64Array,
    draw_threshold_pair_at,
)
from texvent.simulate.streaming import IntensityArray, StreamingSimulator
from texvent.video import Frame

WHITE = 255.0
FLOOR = Thresholds(np.array([LOWEST_THRESHOLD]), np.array([LOWEST_THRESHOLD]))
"""The lowest that are ever drawn, for all pixels."""


@dataclass(frozen=True, kw_only=True)
class EsimConfig:
    """Options of the ESIM pixel model; the defaults are those of VID2E.

    Raises:
        ConfigError: an option is out of range.
    """

    contrast_threshold_on: float = 0.2
    """Rise of ln(I/255 + log eps) that fires an ON event."""
    contrast_threshold_off: float = 0.2
    """Fall of ln(I/255 + log eps) that fires an OFF event."""
    threshold_sigma: float = 0.0
    """Standard deviation of both thresholds, log units; drawn thresholds are at least 0.01."""
    threshold_redraw: Literal["frame", "never"] = "frame"
    """With a threshold sigma: draw thresholds anew for every pixel and frame, as ESIM describes
    it (frame), or once per pixel, as mismatch between pixels (never)."""
    log_eps: float = 1e-3
    """Added to intensities on the 0..1 scale before the logarithm, above 0."""
    refractory_period_us: int = 0
    """Time after an event in which the pixel cannot fire; crossings in it are lost."""

    def __post_init__(self) -> None:
        check_range("contrast_threshold_on", self.contrast_threshold_on, LOWEST_THRESHOLD, 10.0)
        check_range("contrast_threshold_off", self.contrast_threshold_off, LOWEST_THRESHOLD, 10.0)
        check_range("threshold_sigma", self.threshold_sigma, 0.0, 10.0)
        check_range("log_eps", self.log_eps, 1e-9, 1.0)
        check_range("refractory_period_us", self.refractory_period_us, 0, 10**9)
        if self.threshold_redraw not in ("frame", "never"):
            raise ConfigError(
                f"threshold_redraw is {self.threshold_redraw!r}; allowed: frame, never"
            )


class EsimSimulator(StreamingSimulator[EsimConfig]):
    """ESIM on video frames; see `simulate.protocol.Simulator`.

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
    presets: ClassVar[Mapping[str, EsimConfig]] = {
        "default": EsimConfig(),
        "peer-common": EsimConfig(),
    }

    has_gpu: ClassVar[bool] = True

    def reset(self) -> None:
        """Forget all frames: the next one is the first."""
        super().reset()
        self._on_gpu: Any = None
        if self._backend == GPU:
            steps = load_object("texvent.simulate.gpu.frame_steps:FrameSteps")
            self._on_gpu = steps(self.config, self._seed)

    def step(self, frame: Frame) -> EventStream:
        """Events in `[t of the frame before, t of this frame)`; see `StreamingSimulator.step`."""
        if self._on_gpu is None:
            return super().step(frame)
        self._enter(frame)
        packet: EventStream = self._on_gpu.step(frame)
        return packet

    def resume(self, frame: Frame, reference: Float64Array, fired_us: NDArray[np.int64]) -> None:
        """Go on from a frame, before any other, until which somebody else followed the pixels.

        Args:
            frame: the last frame that they saw.
            reference: brightness at the last event of each, [H · W]; kept, and moved along.
            fired_us: time of the last event of each, [H · W], µs; likewise.

        Raises:
            InputError: as `step`.
        """
        self._enter(frame)
        self._begin(frame.luma)
        self._levels = Levels(reference, fired_us)
        self._triggers.set_all(reference, self._fixed)

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold, log units."""
        return min(self.config.contrast_threshold_on, self.config.contrast_threshold_off)

    @property
    def balance(self) -> float:
        """`255 · log_eps`: with it, Eq. 4's logarithm is the model's own."""
        return WHITE * self.config.log_eps

    def _begin(self, intensity: IntensityArray) -> None:
        config = self.config
        self._table = log_intensity(np.arange(256, dtype=np.uint8), config.log_eps)
        of_luma = self._table if intensity.dtype == np.uint8 else None
        if of_luma is None:
            reference = log_intensity(intensity, config.log_eps).reshape(-1)
        else:
            reference = load_look_up(self._backend)(of_luma, intensity.reshape(-1))
        rested = reference.size if config.refractory_period_us else 0
        self._levels = Levels(reference, np.full(rested, LONG_AGO_US))
        height, width = intensity.shape
        self._shape = height, width
        self._is_redrawn = config.threshold_sigma > 0 and config.threshold_redraw == "frame"
        # Any threshold may be drawn anew, but none below the floor.
        self._fixed = FLOOR
        if not self._is_redrawn:
            self._fixed = sensor_thresholds(intensity.shape, self._seed, config)
        curve = Curve(WHITE, -WHITE * config.log_eps)
        self._triggers = TriggerLevels(intensity, curve, backend=self._backend)
        self._triggers.set_all(reference, self._fixed, of_luma=of_luma)

    def _advance(self, intensity: IntensityArray, interval: FrameInterval) -> SortedEvents:
        pixel, before, now = self._triggers.find_outside(intensity)
        table = self._table if now.dtype == np.uint8 else None
        if table is None:
            before, now = (log_intensity(one, self.config.log_eps) for one in (before, now))
        cross_levels = load_cross_levels(now.dtype, self._backend)
        columns = cross_levels(
            Candidates(pixel, before, now, table, self._thresholds(pixel, interval.key)),
            self._levels,
            (interval.start_us, interval.stop_us),
            Rest(self.config.refractory_period_us, is_level_lost=True),
            self._shape,
        )
        fixed = thresholds_at(pixel, self._fixed)
        self._triggers.set(pixel, self._levels.reference, fixed)
        return columns

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
