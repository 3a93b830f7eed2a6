"""The pixels of v2e from frame to frame, and their shot noise."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.elementary import natural_log
from texvent.simulate.packets import FrameInterval, SortedEvents, UnsortedEvents
from texvent.simulate.random.draws import Purpose, draw_normals
from texvent.simulate.random.mismatch import (
    LONG_AGO_US,
    NominalThresholds,
    PixelMismatch,
    draw_rate_factors,
    draw_threshold_pair,
    sensor_key,
    smaller_threshold,
)
from texvent.simulate.random.poisson_noise import PoissonNoise
from texvent.simulate.streaming import IntensityArray
from texvent.simulate.v2e.emit_and_reset import EmissionRules, LastEvents, emit_and_reset
from texvent.simulate.v2e.low_pass import (
    DARK_OFFSET,
    WHITE_LEVEL,
    CrossingPixels,
    LowPassInput,
    apply_low_pass,
    new_state,
)
from texvent.simulate.v2e.simulator import LINEAR_BELOW, V2eConfig
from texvent.video import MICROSECONDS

Float64Array = NDArray[np.float64]

BRIGHT_SHOT_SHARE = 0.25
"""Shot noise at white, as a share of the noise in the dark."""
NOISE_FIT = (-0.0026, -0.036, -0.1949, 0.321)
"""log10(threshold / noise rms) as a cubic in log10(ON rate / bandwidth): v2e's fit to Graça and
Delbruck, "Unraveling the paradox of intensity-dependent DVS pixel noise", 2021, Fig. 3."""


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
        rate_hz = 0.0 if config.photoreceptor_noise else config.shot_noise_rate_hz
        self._shot_noise = ShotNoise(rate_hz, config, (on, off))
        levels = np.arange(256.0)
        self._table = np.stack([lin_log(levels, LINEAR_BELOW), relative_intensity(levels)])
        flat = intensity.reshape(-1).astype(np.float64)
        brightness = lin_log(flat, LINEAR_BELOW)
        self._state = new_state(brightness, has_noise=config.photoreceptor_noise)
        self._seen = intensity.reshape(-1).copy()
        self._start_us = first_us
        self._last = LastEvents(
            np.full(flat.size, LONG_AGO_US),
            np.full(flat.size, self._start_us),
            self._state.noise[0].copy(),
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
        if self._config.photoreceptor_noise:
            self._move_photoreceptor_noise(intensity.shape, interval)
        crossing = self._apply_low_pass(intensity.reshape(-1), interval)
        noise = self._shot_noise.draw(intensity.reshape(-1), interval)
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
            LowPassInput(self._seen, luma, table, LINEAR_BELOW, angle, elapsed_us),
            self._mismatch,
            self._state,
        )

    def _move_photoreceptor_noise(self, shape: tuple[int, ...], interval: FrameInterval) -> None:
        """Move the noise of the photoreceptors to the end of the interval."""
        config, before = self._config, self._state.noise[1]
        rms = photoreceptor_noise_rms(
            config.shot_noise_rate_hz, config.cutoff_hz, smaller_threshold(config)
        )
        now = next_photoreceptor_noise(before, shape, interval, cutoff_hz=config.cutoff_hz, rms=rms)
        self._state = self._state._replace(noise=(before, now))

    def _reset_noisy(self, pixel: NDArray[np.int64], interval: FrameInterval) -> None:
        """A noise event resets its pixel to the present brightness."""
        leaked, leak = np.zeros(len(pixel)), self._mismatch.leak
        if leak.size:
            leaked = leak[pixel].astype(np.float64) * (interval.stop_us - self._start_us)
        self._state.reference[pixel] = self._state.brightness[pixel] + leaked
        self._state.end_quiescence(pixel)
        self._last.interval_us[pixel] = interval.stop_us


def lin_log(intensity: Float64Array, linear_below: float) -> Float64Array:
    """Brightness, linear in the dark and logarithmic above.

    Args:
        intensity: 0..255 scale, any shape.
        linear_below: intensity I₀ where the straight line from 0 meets the logarithm.

    Returns:
        `I · ln(I₀) / I₀` up to I₀ and `ln(I)` above, log units.

    Example:
        >>> lin_log(np.array([0.0, 10.0, 20.0, 40.0]), 20.0).round(4).tolist()
        [0.0, 1.4979, 2.9957, 3.6889]
    """
    slope = math.log(linear_below) / linear_below
    log = natural_log(np.maximum(intensity, linear_below))
    return np.where(intensity <= linear_below, intensity * slope, log)


class ShotNoise:
    """Independent noise events; pixels with low thresholds fire more of them."""

    def __init__(
        self,
        rate_hz: float,
        nominal: NominalThresholds,
        thresholds: tuple[Float64Array, Float64Array],
    ) -> None:
        """Set the rate of every pixel.

        Args:
            rate_hz: events per second in the dark, of a pixel with nominal thresholds.
            nominal: the nominal thresholds.
            thresholds: ON and OFF thresholds of every pixel, [H, W] each, log units.
        """
        more_on = nominal.contrast_threshold_on / thresholds[0]
        more_off = nominal.contrast_threshold_off / thresholds[1]
        self._on_fraction = more_on / (more_on + more_off)
        self._noise = PoissonNoise(rate_hz / 2 * (more_on + more_off))

    def draw(self, luma: NDArray[Any], interval: FrameInterval) -> UnsortedEvents:
        """The noise events of one interval.

        Args:
            luma: at the end of it, [H · W], 0..255 scale.
            interval: where in time; its key decides the draws.
        """
        return self._noise.draw(
            interval,
            rate_fraction=lambda pixel: (
                1.0 - (1.0 - BRIGHT_SHOT_SHARE) * np.minimum(relative_intensity(luma[pixel]), 1.0)
            ),
            on_fraction=self._on_fraction,
        )


def relative_intensity(intensity: NDArray[Any]) -> Float64Array:
    """`(I + 20) / 275`, float64: what bandwidth and shot noise depend on."""
    return np.asarray((intensity + DARK_OFFSET) / WHITE_LEVEL, np.float64)


def next_photoreceptor_noise(
    noise: Float64Array,
    shape: tuple[int, ...],
    interval: FrameInterval,
    *,
    cutoff_hz: float,
    rms: float,
) -> Float64Array:
    """Band-limited Gaussian noise at the end of an interval, [H · W] log units.

    Args:
        noise: that at its start, [H · W].
        shape: (height, width).
        interval: where in time; its key decides the draws.
        cutoff_hz: bandwidth of the noise.
        rms: of the noise, log units.
    """
    y, x = np.ogrid[: shape[0], : shape[1]]
    fresh = draw_normals(interval.key, y, x, Purpose.VOLTAGE.draw()).reshape(-1)
    kept = math.exp(-2 * math.pi * cutoff_hz * interval.duration_s)
    return kept * noise + rms * math.sqrt(1 - kept * kept) * fresh


def photoreceptor_noise_rms(rate_hz: float, cutoff_hz: float, threshold: float) -> float:
    """Rms of the band-limited Gaussian noise that fires `rate_hz` events at a threshold.

    Args:
        rate_hz: noise events per second wanted, ON and OFF together.
        cutoff_hz: bandwidth of the noise.
        threshold: contrast threshold, log units.

    Returns:
        Log units.

    Source: `NOISE_FIT`.
    """
    exponent = float(np.polyval(NOISE_FIT, math.log10(rate_hz / 2 / cutoff_hz)))
    return float(threshold / 10.0**exponent)
