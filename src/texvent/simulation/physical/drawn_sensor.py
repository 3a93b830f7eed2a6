"""Everything that is fixed to the pixels of one sensor of the `physical` model, drawn once."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from texvent.frames import MICROSECONDS
from texvent.simulation.packets import check_event_number
from texvent.simulation.physical.config import NoiseCurve, PhysicalConfig, parse_noise_curve
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

HOT = 1
"""Number of the noise process of hot pixels."""


class DrawnSensor(NamedTuple):
    """Mismatch, rates and initial phases of the pixels of a sensor."""

    mismatch: PixelMismatch
    """Thresholds and leak, [n] each."""
    leak_hz: float
    """Leak events of all pixels, per second."""
    curve: NoiseCurve
    noise: PoissonNoise
    """Noise at the highest rate of the curve."""
    hot: PoissonNoise
    """Noise of hot pixels, whatever the intensity."""
    phase: Float64Array | float
    """[n] change of each pixel at the first frame, log units, with its sign turned; or 0."""

    def check_duration(self, duration_s: float) -> None:
        """Refuse an interval in which leak or noise alone fire more events than memory holds.

        Raises:
            InputError: they do.
        """
        for rate_hz in (self.leak_hz, self.noise.total_hz, self.hot.total_hz):
            check_event_number(rate_hz * duration_s)


def draw_sensor(config: PhysicalConfig, seed: int, shape: tuple[int, ...]) -> DrawnSensor:
    """Draw the pixels of a sensor.

    Args:
        config: options.
        seed: of the run; of mismatch, unless the options have one.
        shape: (height, width).

    Raises:
        InputError: the threshold map is of another size.
    """
    key = sensor_key(seed if config.sensor_seed is None else config.sensor_seed)
    thresholds = draw_threshold_pair(shape, key, config)
    if config.threshold_map is not None:
        thresholds = read_threshold_map(config.threshold_map).thresholds(thresholds, config)
    leak = config.leak_rate_hz * _factors_of_mean_1(
        shape, key, Purpose.LEAK_RATE, config.leak_rate_decades
    )
    columns = (*thresholds, leak * thresholds[0] / MICROSECONDS)
    mismatch = PixelMismatch(*(column.reshape(-1).astype(np.float32) for column in columns))
    factor = _factors_of_mean_1(shape, key, Purpose.NOISE_RATE, config.noise_decades)
    curve = parse_noise_curve(config.noise_curve)
    noise = PoissonNoise(config.noise_scale * curve.highest_hz * factor)
    hot = draw_chosen(shape, key, Purpose.HOT_PIXEL, fraction=config.hot_pixel_fraction)
    phase: Float64Array | float = 0.0
    if config.initial_phase == "random":
        y, x = np.ogrid[: shape[0], : shape[1]]
        phase = draw_uniforms(sensor_key(seed), y, x, Purpose.PHASE.draw()).reshape(-1)
        phase = phase * (mismatch.threshold_on + mismatch.threshold_off) - mismatch.threshold_off
    hot_noise = PoissonNoise(config.hot_pixel_rate_hz * hot, stream=HOT)
    return DrawnSensor(mismatch, float(leak.sum()), curve, noise, hot_noise, phase)


def _factors_of_mean_1(
    shape: tuple[int, ...], key: np.uint64, purpose: Purpose, decades: float
) -> Float64Array:
    """Log-normal factors between pixels that keep the mean rate what the option says."""
    factors = draw_rate_factors(shape, key, purpose, decades=decades)
    return factors / math.exp((math.log(10) * decades) ** 2 / 2)
