"""The pixels of SENPI from frame to frame."""

from __future__ import annotations

import numpy as np

from texvent.simulation.crossing.trigger_levels import BrightnessCurve, TriggerLevels
from texvent.simulation.kernels.elementary import natural_log
from texvent.simulation.packets import FrameInterval, UnsortedEvents
from texvent.simulation.random.mismatch import LONG_AGO_US, Thresholds
from texvent.simulation.random.poisson_noise import PoissonNoise
from texvent.simulation.senpi.config import SenpiConfig
from texvent.simulation.streaming import IntensityArray


class SenpiPixels:
    """All pixels of a sensor: voltage at the last event, and its time."""

    def __init__(self, config: SenpiConfig, luma: IntensityArray) -> None:
        """Begin with the first frame, [H, W], of 1..255 levels."""
        self._refractory_us = config.refractory_period_us
        on, off = config.contrast_threshold_on, config.contrast_threshold_off
        self._thresholds = Thresholds(np.array([float(on)]), np.array([float(off)]))
        self._noise = PoissonNoise(np.full(luma.shape, float(config.noise_rate_hz)))
        self._reference = natural_log(luma.reshape(-1).astype(np.float64))
        self._fired_us = np.full(luma.size, LONG_AGO_US)
        self._levels = TriggerLevels(luma, BrightnessCurve(1.0, 0.0))
        self._levels.set_all(self._reference, self._thresholds)

    def advance(self, luma: IntensityArray, interval: FrameInterval) -> UnsortedEvents:
        """Events until a frame: of changes in its last microsecond, of noise at any time."""
        noise = self._noise.draw(interval)
        self._fired_us[noise.pixel] = noise.t  # in order of time: that of the last one stays
        t_us = interval.stop_us - 1
        pixel, _, now = self._levels.find_outside_levels(luma)
        change = natural_log(now.astype(np.float64)) - self._reference[pixel]
        fires = (change >= self._thresholds.on) | (-change >= self._thresholds.off)
        fires &= t_us - self._fired_us[pixel] >= self._refractory_us
        pixel, is_on = pixel[fires], change[fires] > 0
        self._fired_us[pixel] = t_us
        times = np.full(len(pixel), t_us)
        fired = UnsortedEvents.signal(pixel, times, is_on.astype(np.uint8))
        events = UnsortedEvents.concat((fired, noise))
        # Every event, of noise too, memorises the voltage of the frame.
        voltage = natural_log(luma.reshape(-1)[events.pixel].astype(np.float64))
        self._reference[events.pixel] = voltage
        self._levels.set(events.pixel, self._reference, self._thresholds)
        return events
