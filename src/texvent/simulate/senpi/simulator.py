"""SENPI's pixel model: photons to voltage, at most one event per pixel and frame.

Source: J. L. Greene et al., "A PyTorch-enabled tool for synthetic event camera data generation and
algorithm development", SPIE 2025, and the parameters its program (SENPI) documents.
docs/simulators/senpi.md gives the equations and where this model departs from the program: above
all in noise.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from texvent.config import check_range
from texvent.simulate.packets import FrameInterval, UnsortedEvents
from texvent.simulate.random.mismatch import (
    LONG_AGO_US,
    Float64Array,
    check_nominal_thresholds,
    sensor_thresholds,
    smaller_threshold,
    thresholds_at,
)
from texvent.simulate.streaming import IntensityArray, StreamingSimulator

WHITE = 255.0
WELL_CAPACITY = 15_000.0
"""Photons of a white pixel."""
FULL_SCALE = 0.9616
"""SENPI's threshold of 0.1 in its unit of ln(15000): 0.96158 in natural-log units."""


@dataclass(frozen=True, kw_only=True)
class SenpiConfig:
    """Options of the SENPI pixel model; the defaults are those of its program, per second.

    Raises:
        ConfigError: an option is out of range.
    """

    contrast_threshold_on: float = FULL_SCALE
    """Rise of ln(photons) that fires an ON event: the mean over pixels."""
    contrast_threshold_off: float = FULL_SCALE
    """Fall of ln(photons) that fires an OFF event: the mean over pixels."""
    threshold_sigma: float = 0.0
    """Standard deviation of both thresholds between pixels, log units; none is below 0.01."""
    noise_rate_hz: float = 1.2
    """Noise events per pixel and second; SENPI's 0.05 per frame, at 24 frames per second."""
    refractory_period_us: int = 50
    """Time after an event in which a change cannot fire the pixel."""

    def __post_init__(self) -> None:
        check_nominal_thresholds(self)
        check_range("noise_rate_hz", self.noise_rate_hz, 0.0, 1e4)
        check_range("refractory_period_us", self.refractory_period_us, 0, 10**9)


PRESETS: Mapping[str, SenpiConfig] = {
    "default": SenpiConfig(),
    "peer-common": SenpiConfig(
        contrast_threshold_on=0.2,
        contrast_threshold_off=0.2,
        noise_rate_hz=0.0,
        refractory_period_us=0,
    ),
}
"""Name → options."""

DARKEST = 1.0
"""Intensity below which all pixels count as equally dark, levels of 0..255."""


class SenpiSimulator(StreamingSimulator[SenpiConfig]):
    """SENPI on video frames; see `simulate.protocol.Simulator`.

    Example:
        >>> from texvent.video import Frame
        >>> simulator = SenpiSimulator(SenpiSimulator.presets["peer-common"])
        >>> len(simulator.step(Frame(np.array([[40]], np.uint8), t_us=0)))
        0
        >>> events = simulator.step(Frame(np.array([[90]], np.uint8), t_us=1000))
        >>> list(zip(events.t.tolist(), events.polarity.tolist()))  # once, however large
        [(999, 1)]
    """

    config_type: ClassVar[type] = SenpiConfig
    takes_linear: ClassVar[bool] = True
    bytes_per_pixel: ClassVar[int] = 60
    presets: ClassVar[Mapping[str, SenpiConfig]] = PRESETS
    frame_bound_presets: ClassVar[frozenset[str]] = frozenset(PRESETS)

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold, log units."""
        return smaller_threshold(self.config)

    @property
    def balance(self) -> float:
        """1: the logarithm of `1 + I` is about as steep at black as that of `max(I, 1)`."""
        return DARKEST

    def _begin(self, intensity: IntensityArray) -> None:
        # Both bring Numba.
        from texvent.simulate.crossing.trigger_levels import BrightnessCurve, TriggerLevels
        from texvent.simulate.random.poisson_noise import PoissonNoise

        self._thresholds = sensor_thresholds(intensity.shape, self._seed, self.config)
        self._noise = PoissonNoise(np.full(intensity.shape, self.config.noise_rate_hz))
        self._reference = np.log(photons(intensity)).reshape(-1)
        self._fired_us = np.full(intensity.size, LONG_AGO_US)
        # Below the darkest level all voltages are equal, so one that is lower is never reached.
        darkest = math.log(DARKEST / WHITE * WELL_CAPACITY)
        curve = BrightnessCurve(WHITE / WELL_CAPACITY, 0.0, darkest)
        self._levels = TriggerLevels(intensity, curve)
        self._levels.set_all(self._reference, self._thresholds)

    def _advance(self, intensity: IntensityArray, interval: FrameInterval) -> UnsortedEvents:
        noise = self._noise.draw(interval)
        # A pixel's last event counts: noise is in order of time, and a change fires at the end.
        self._fired_us[noise.pixel] = noise.t
        fired = self._compare(intensity, interval)
        self._fired_us[fired.pixel] = fired.t
        # Every event resets its pixel to the present voltage.
        pixel = np.concatenate([fired.pixel, noise.pixel])
        self._reference[pixel] = self._voltage(intensity.reshape(-1)[pixel])
        self._levels.set(pixel, self._reference, thresholds_at(pixel, self._thresholds))
        return UnsortedEvents.concat((fired, noise))

    def _compare(self, intensity: IntensityArray, interval: FrameInterval) -> UnsortedEvents:
        """At most one event per pixel, in the interval's last microsecond."""
        t_us = interval.stop_us - 1
        pixel, _, now = self._levels.find_outside_levels(intensity)
        change = self._voltage(now) - self._reference[pixel]
        threshold = np.where(change > 0, *thresholds_at(pixel, self._thresholds))
        is_rested = t_us - self._fired_us[pixel] >= self.config.refractory_period_us
        fires = (np.abs(change) >= threshold) & is_rested
        pixel, is_on = pixel[fires], change[fires] > 0
        return UnsortedEvents.signal(pixel, np.full(len(pixel), t_us), is_on.astype(np.uint8))

    def _voltage(self, intensity: IntensityArray) -> Float64Array:
        return np.asarray(np.log(photons(intensity)))


def photons(intensity: IntensityArray) -> Float64Array:
    """Photons that pixels receive, `max(I, 1) / 255 · well capacity`, float64.

    Example:
        >>> photons(np.array([[0, 1, 255]], np.uint8)).round(2).tolist()
        [[58.82, 58.82, 15000.0]]
    """
    exact = intensity.astype(np.float64, copy=False)
    return np.asarray(np.maximum(exact, DARKEST) / WHITE * WELL_CAPACITY)
