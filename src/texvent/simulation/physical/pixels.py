"""The pixels of the `physical` model from frame to frame, and their noise."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.simulation.packets import FrameInterval, SortedEvents, UnsortedEvents
from texvent.simulation.physical.circuit import (
    InputFrames,
    NoiseEvents,
    PhotoreceptorInput,
    new_state,
)
from texvent.simulation.physical.circuit_kernel import advance_pixels
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.drawn_sensor import draw_sensor
from texvent.simulation.physical.readout import ColumnScan
from texvent.simulation.random.poisson_noise import Float64Array
from texvent.simulation.streaming import IntensityArray


class PhysicalPixels:
    """All pixels of a sensor."""

    def __init__(
        self, config: PhysicalConfig, seed: int, intensity: IntensityArray, first_us: int
    ) -> None:
        """Begin with the first frame.

        Args:
            config: options.
            seed: of the run; of mismatch, unless the options have one.
            intensity: luma of the first frame, [H, W], 0..255 scale.
            first_us: its time, µs.

        Raises:
            InputError: the threshold map is of another size.
        """
        shape = intensity.shape
        self._config = config
        self._sensor = draw_sensor(config, seed, shape)
        self._scan = None
        if config.scan_period_ns > 0:
            self._scan = ColumnScan(config.scan_period_ns, first_us=first_us, width=shape[1])
        self._frames = InputFrames(
            intensity,
            gamma=config.gamma,
            balance=config.balance,
            cutoff_hz=config.cutoff_hz,
            cutoff_limit_hz=config.cutoff_limit_hz,
        )
        output = self._frames.brightness.copy()
        self._state = new_state(output, output - self._sensor.phase, first_us)

    def advance(
        self, intensity: IntensityArray, interval: FrameInterval
    ) -> UnsortedEvents | SortedEvents:
        """Events that leave the sensor until a frame, [H, W]."""
        self._sensor.check_duration(interval.duration_s)
        light = self._frames.until(intensity)
        noise = self._draw_noise(light, interval)
        fired = advance_pixels(
            light,
            self._sensor.mismatch,
            self._state,
            noise,
            self._config.refractory_period_us,
            (interval.start_us, interval.stop_us),
        )
        if self._scan is None:
            return fired
        return self._scan.read(fired.unsorted(intensity.shape[1]), interval.stop_us)

    def _draw_noise(self, light: PhotoreceptorInput, interval: FrameInterval) -> NoiseEvents:
        curve, frames = self._sensor.curve, self._frames

        def rate_fraction(pixel: NDArray[np.int64]) -> Float64Array:
            """The noise curve at the pixels, the mean over both frames, relative to its top."""
            luma = np.stack((light.before[pixel], light.now[pixel]))
            start, stop = curve.rate_at(frames.intensity(luma))
            return np.asarray((start + stop) / (2.0 * curve.highest_hz))

        on_fraction = self._config.noise_on_fraction
        noise = self._sensor.noise.draw(
            interval, rate_fraction=rate_fraction, on_fraction=on_fraction
        )
        if not self._sensor.hot.is_silent:
            hot = self._sensor.hot.draw(interval, on_fraction=on_fraction)
            noise = UnsortedEvents.concat((noise, hot))
        order = np.lexsort((noise.p, noise.t, noise.pixel))
        return NoiseEvents(noise.pixel[order], noise.t[order], noise.p[order])
