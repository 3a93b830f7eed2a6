"""The pixels of v2e from frame to frame, and their shot noise."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.frames import MICROSECONDS
from texvent.simulation.kernels.elementary import natural_log
from texvent.simulation.packets import FrameInterval, SortedEvents, UnsortedEvents
from texvent.simulation.random.draws import Purpose
from texvent.simulation.random.mismatch import (
    LONG_AGO_US,
    PixelMismatch,
    draw_rate_factors,
    draw_threshold_pair,
    sensor_key,
)
from texvent.simulation.random.poisson_noise import PoissonNoise
from texvent.simulation.streaming import IntensityArray
from texvent.simulation.v2e.config import LINEAR_BELOW, V2eConfig
from texvent.simulation.v2e.emit_and_reset import EmissionRules, LastEvents, emit_and_reset
from texvent.simulation.v2e.low_pass import (
    DARK_OFFSET,
    WHITE_LEVEL,
    CrossingPixels,
    LowPassInput,
    apply_low_pass,
    new_state,
)

Float64Array = NDArray[np.float64]

BRIGHT_SHOT_SHARE = 0.25
"""Shot noise at white, as a share of the noise in the dark."""


class V2ePixels:
    """All pixels of a sensor."""

    def __init__(
        self, config: V2eConfig, seed: int, intensity: IntensityArray, first_us: int
    ) -> None:
        """Begin with the first frame.

        Args:
            config: options.
            seed: of mismatch.
            intensity: luma of the first frame, [H, W], 0..255 scale.
            first_us: its time, µs.
        """
        self._config, shape = config, intensity.shape
        key = sensor_key(seed)
        on, off = draw_threshold_pair(shape, key, config)
        self._mismatch = PixelMismatch(
            on.reshape(-1).astype(np.float32),
            off.reshape(-1).astype(np.float32),
            self._draw_leak(shape, key, on.reshape(-1)),
        )
        # Pixels with low thresholds fire more noise.
        more_on = config.contrast_threshold_on / on
        more_off = config.contrast_threshold_off / off
        self._on_fraction = more_on / (more_on + more_off)
        self._shot_noise = PoissonNoise(config.shot_noise_rate_hz / 2 * (more_on + more_off))
        levels = np.arange(256.0)
        self._table = np.stack([lin_log(levels), relative_intensity(levels)])
        flat = intensity.reshape(-1).astype(np.float64)
        brightness = lin_log(flat)
        self._state = new_state(brightness)
        self._seen = intensity.reshape(-1).copy()
        self._start_us = first_us
        self._last = LastEvents(
            np.full(flat.size, LONG_AGO_US),
            np.full(flat.size, self._start_us),
        )

    def _draw_leak(
        self, shape: tuple[int, ...], key: np.uint64, threshold_on: Float64Array
    ) -> NDArray[np.float32]:
        """Leak of the references, log units per µs; [0] without one."""
        config = self._config
        if config.leak_rate_hz == 0:
            return np.empty(0, np.float32)
        factor = draw_rate_factors(shape, key, Purpose.LEAK_RATE, decades=config.leak_rate_decades)
        leak = factor.reshape(-1) * (config.leak_rate_hz / MICROSECONDS) * threshold_on
        return leak.astype(np.float32)

    def advance(self, intensity: IntensityArray, interval: FrameInterval) -> SortedEvents:
        """Events until a frame, [H, W], in the order of a packet."""
        crossing = self._apply_low_pass(intensity.reshape(-1), interval)
        noise = self._draw_shot_noise(intensity.reshape(-1), interval)
        events = emit_and_reset(
            crossing,
            (self._mismatch, self._state),
            self._last,
            noise,
            EmissionRules(interval, self._config.refractory_period_us, intensity.shape),
        )
        self._reset_noisy(noise.pixel, interval)
        return events

    def _apply_low_pass(self, luma: IntensityArray, interval: FrameInterval) -> CrossingPixels:
        """Move the photoreceptors to the end of the interval; which pixels reach a threshold."""
        if luma.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen, luma = self._seen.astype(np.float32), luma.astype(np.float32)
        angle = 2 * math.pi * self._config.cutoff_hz * interval.duration_s or math.inf
        table = self._table if luma.dtype == np.uint8 else None
        start_us, stop_us = interval.start_us - self._start_us, interval.stop_us - self._start_us
        elapsed_us = float(start_us), float(stop_us)
        return apply_low_pass(
            LowPassInput(self._seen, luma, table, angle, elapsed_us),
            self._mismatch,
            self._state,
        )

    def _draw_shot_noise(self, luma: NDArray[Any], interval: FrameInterval) -> UnsortedEvents:
        """Shot noise of the interval, at luma [H · W] of its end; bright pixels fire less."""
        return self._shot_noise.draw(
            interval,
            rate_fraction=lambda pixel: (
                1.0 - (1.0 - BRIGHT_SHOT_SHARE) * np.minimum(relative_intensity(luma[pixel]), 1.0)
            ),
            on_fraction=self._on_fraction,
        )

    def _reset_noisy(self, pixel: NDArray[np.int64], interval: FrameInterval) -> None:
        """A noise event resets its pixel to the present brightness."""
        leaked, leak = np.zeros(len(pixel)), self._mismatch.leak
        if leak.size:
            leaked = leak[pixel].astype(np.float64) * (interval.stop_us - self._start_us)
        self._state.reference[pixel] = self._state.brightness[pixel] + leaked
        self._state.end_quiescence(pixel)
        self._last.interval_us[pixel] = interval.stop_us


def lin_log(intensity: Float64Array) -> Float64Array:
    """Brightness, linear in the dark and logarithmic above.

    Args:
        intensity: 0..255 scale, any shape.

    Returns:
        `I · ln(I₀) / I₀` up to I₀ = 20, where the line meets the logarithm, and `ln(I)` above.

    Example:
        >>> lin_log(np.array([0.0, 10.0, 20.0, 40.0])).round(4).tolist()
        [0.0, 1.4979, 2.9957, 3.6889]
    """
    slope = math.log(LINEAR_BELOW) / LINEAR_BELOW
    log = natural_log(np.maximum(intensity, LINEAR_BELOW))
    return np.where(intensity <= LINEAR_BELOW, intensity * slope, log)


def relative_intensity(intensity: NDArray[Any]) -> Float64Array:
    """`(I + 20) / 275`, float64: what bandwidth and shot noise depend on."""
    return np.asarray((intensity + DARK_OFFSET) / WHITE_LEVEL, np.float64)
