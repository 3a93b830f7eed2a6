"""The definition of SENPI: one pixel after the other."""

import math

import numpy as np

from texvent.simulation.kernels.elementary import natural_log
from texvent.simulation.packets import FrameInterval, UnsortedEvents
from texvent.simulation.random.poisson_noise import PoissonNoise
from texvent.simulation.senpi.config import SenpiConfig
from texvent.simulation.streaming import IntensityArray


class SenpiPixels:
    """As `senpi.pixels.SenpiPixels`."""

    def __init__(self, config: SenpiConfig, luma: IntensityArray) -> None:
        self._config = config
        self._noise = PoissonNoise(np.full(luma.shape, config.noise_rate_hz))
        self._reference = [natural_log(float(level)) for level in luma.reshape(-1)]
        self._fired_us = [-math.inf] * luma.size

    def advance(self, luma: IntensityArray, interval: FrameInterval) -> UnsortedEvents:
        noise, t_us, fired = self._noise.draw(interval), interval.stop_us - 1, []
        for pixel, at_us in zip(noise.pixel.tolist(), noise.t.tolist(), strict=True):
            self._fired_us[pixel] = max(self._fired_us[pixel], at_us)
        for pixel, level in enumerate(luma.reshape(-1)):
            voltage = natural_log(float(level))
            change = voltage - self._reference[pixel]
            is_on = change > 0
            threshold = (
                self._config.contrast_threshold_on if is_on else self._config.contrast_threshold_off
            )
            is_rested = t_us >= self._fired_us[pixel] + self._config.refractory_period_us
            if abs(change) >= threshold and is_rested:
                fired.append((pixel, is_on))
                self._fired_us[pixel] = t_us
                self._reference[pixel] = voltage
        for pixel in noise.pixel.tolist():
            self._reference[pixel] = natural_log(float(luma.reshape(-1)[pixel]))
        pixel, is_on = np.array(fired, np.int64).reshape(-1, 2).T
        signal = UnsortedEvents.signal(pixel, np.full_like(pixel, t_us), is_on.astype(np.uint8))
        return UnsortedEvents.concat((signal, noise))
