"""The pixels of the `physical` model from frame to frame, and their mismatch and noise."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.frames import MICROSECONDS
from texvent.simulation.packets import (
    FrameInterval,
    SortedEvents,
    UnsortedEvents,
    check_event_number,
)
from texvent.simulation.physical.circuit import (
    InputFrames,
    NoiseEvents,
    PhotoreceptorInput,
    new_state,
)
from texvent.simulation.physical.circuit_kernel import advance_pixels
from texvent.simulation.physical.config import PhysicalConfig, parse_noise_curve
from texvent.simulation.physical.readout import ColumnScan
from texvent.simulation.physical.threshold_map import read_threshold_map
from texvent.simulation.random.draws import Purpose, draw_uniforms
from texvent.simulation.random.mismatch import (
    PixelMismatch,
    draw_chosen,
    draw_rate_factors,
    draw_threshold_pair,
    sensor_key,
)
from texvent.simulation.random.poisson_noise import Float64Array, PoissonNoise
from texvent.simulation.streaming import IntensityArray

HOT = 1
"""Number of the noise process of hot pixels."""


class PhysicalPixels:
    """All pixels of a sensor."""

    def __init__(
        self, config: PhysicalConfig, seed: int, intensity: IntensityArray, first_us: int
    ) -> None:
        """Begin with the first frame.

        Args:
            config: options.
            seed: of mismatch, unless the options have one.
            intensity: luma of the first frame, [H, W], 0..255 scale.
            first_us: its time, µs.

        Raises:
            InputError: the threshold map is of another size.
        """
        shape = intensity.shape
        self._config = config
        key = sensor_key(seed if config.sensor_seed is None else config.sensor_seed)
        self._draw_sensor(shape, key)
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
        output, level = self._frames.brightness.copy(), self._frames.brightness.copy()
        if config.initial_phase == "random":
            y, x = np.ogrid[: shape[0], : shape[1]]
            phase = draw_uniforms(sensor_key(seed), y, x, Purpose.PHASE.draw()).reshape(-1)
            on, off = self._mismatch[:2]
            level -= phase * (on + off) - off
        self._state = new_state(output, level, first_us)

    def advance(
        self, intensity: IntensityArray, interval: FrameInterval
    ) -> UnsortedEvents | SortedEvents:
        """Events that leave the sensor until a frame, [H, W]."""
        check_event_number(self._leak_hz * interval.duration_s)
        light = self._frames.until(intensity)
        noise = self._draw_noise(light, interval)
        fired = advance_pixels(
            light,
            self._mismatch,
            self._state,
            noise,
            self._config.refractory_period_us,
            (interval.start_us, interval.stop_us),
        )
        if self._scan is None:
            return fired
        return self._scan.read(fired.unsorted(intensity.shape[1]), interval.stop_us)

    def _draw_sensor(self, shape: tuple[int, ...], key: np.uint64) -> None:
        """Draw mismatch: thresholds, leak, noise factors, hot pixels."""
        config = self._config
        on, off = draw_threshold_pair(shape, key, config)
        if config.threshold_map is not None:
            on, off = read_threshold_map(config.threshold_map).thresholds((on, off), config)
        leak = config.leak_rate_hz * _factors_of_mean_1(
            shape, key, Purpose.LEAK_RATE, config.leak_rate_decades
        )
        self._leak_hz = float(leak.sum())
        leak_per_us = leak * on / MICROSECONDS
        self._mismatch = PixelMismatch(
            *(column.reshape(-1).astype(np.float32) for column in (on, off, leak_per_us))
        )
        self._noise_curve = parse_noise_curve(config.noise_curve)
        factor = _factors_of_mean_1(shape, key, Purpose.NOISE_RATE, config.noise_decades)
        self._noise = PoissonNoise(config.noise_scale * self._noise_curve.highest_hz * factor)
        hot = draw_chosen(shape, key, Purpose.HOT_PIXEL, fraction=config.hot_pixel_fraction)
        self._hot_noise = PoissonNoise(config.hot_pixel_rate_hz * hot, stream=HOT)

    def _draw_noise(self, light: PhotoreceptorInput, interval: FrameInterval) -> NoiseEvents:
        curve, frames = self._noise_curve, self._frames

        def rate_fraction(pixel: NDArray[np.int64]) -> Float64Array:
            """The noise curve at the pixels, the mean over both frames, relative to its top."""
            luma = np.stack((light.before[pixel], light.now[pixel]))
            start, stop = curve.rate_at(frames.intensity(luma))
            return np.asarray((start + stop) / (2.0 * curve.highest_hz))

        on_fraction = self._config.noise_on_fraction
        noise = self._noise.draw(interval, rate_fraction=rate_fraction, on_fraction=on_fraction)
        if not self._hot_noise.is_silent:
            hot = self._hot_noise.draw(interval, on_fraction=on_fraction)
            noise = UnsortedEvents.concat((noise, hot))
        order = np.lexsort((noise.p, noise.t, noise.pixel))
        return NoiseEvents(noise.pixel[order], noise.t[order], noise.p[order])


def _factors_of_mean_1(
    shape: tuple[int, ...], key: np.uint64, purpose: Purpose, decades: float
) -> Float64Array:
    """Log-normal factors between pixels that keep the mean rate what the option says."""
    factors = draw_rate_factors(shape, key, purpose, decades=decades)
    return factors / math.exp((math.log(10) * decades) ** 2 / 2)
