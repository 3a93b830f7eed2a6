"""v2e's pixel model: lin-log, photoreceptor bandwidth, mismatch, leak, shot noise, refractory.

Source: Y. Hu, S.-C. Liu, T. Delbruck, "v2e: from video frames to realistic DVS events", CVPRW
2021, and the options its program documents. docs/simulators.md gives the equations and where this
model departs from the program: event times above all.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.events import NOISE, SIGNAL
from texvent.simulate.draws import Purpose, draw_normals
from texvent.simulate.firings import Firings, Interval
from texvent.simulate.kernels.ramp import Ramp, RampCrossings, Rest, load_cross_ramp
from texvent.simulate.pixel_maps import (
    LONG_AGO_US,
    LOWEST_THRESHOLD,
    Float64Array,
    draw_rate_factors,
    draw_threshold_pair,
    sensor_key,
)
from texvent.simulate.rate_noise import NoiseRates
from texvent.simulate.streaming import IntensityArray, StreamingSimulator

DARK_OFFSET, WHITE_LEVEL = 20.0, 275.0
"""Bandwidth and shot noise depend on (I + 20) / 275, which is never 0."""
BRIGHT_SHOT_SHARE = 0.25
"""Shot noise at white, as a share of the noise in the dark."""
NOISE_FIT = (-0.0026, -0.036, -0.1949, 0.321)
"""log10(threshold / noise rms) as a cubic in log10(ON rate / bandwidth): v2e's fit to Graça and
Delbruck, "Unraveling the paradox of intensity-dependent DVS pixel noise", 2021, Fig. 3."""
NOISE_FIT_RANGE = (1e-5, 1.0)
"""ON rate / bandwidth over which that fit was made."""


@dataclass(frozen=True, kw_only=True)
class V2eConfig:
    """Options of the v2e pixel model; the defaults are those of its command line.

    Raises:
        ConfigError: an option is out of range, or two contradict each other.
    """

    contrast_threshold_on: float = 0.2
    """Rise of the lin-log brightness that fires an ON event: the mean over pixels."""
    contrast_threshold_off: float = 0.2
    """Fall of the lin-log brightness that fires an OFF event: the mean over pixels."""
    threshold_sigma: float = 0.03
    """Standard deviation of both thresholds between pixels, log units; none is below 0.01."""
    linear_below: float = 20.0
    """Intensity, in levels of 0..255, below which brightness is linear instead of logarithmic."""
    cutoff_hz: float = 300.0
    """Bandwidth of the photoreceptor at white; less at lower intensity. 0 is unlimited."""
    leak_rate_hz: float = 0.01
    """ON events per pixel and second from junction leakage."""
    leak_rate_decades: float = 0.1
    """Standard deviation of log10 of the leak rate between pixels."""
    shot_noise_rate_hz: float = 0.001
    """Noise events per pixel and second in the dark; a quarter of it at white."""
    photoreceptor_noise: bool = False
    """Make shot noise as Gaussian noise of the photoreceptor within its bandwidth, which
    alternates ON and OFF, instead of as independent events."""
    refractory_period_us: int = 500
    """Time after an event in which the pixel cannot fire; the change is kept for later."""

    def __post_init__(self) -> None:
        check_range("contrast_threshold_on", self.contrast_threshold_on, LOWEST_THRESHOLD, 10.0)
        check_range("contrast_threshold_off", self.contrast_threshold_off, LOWEST_THRESHOLD, 10.0)
        check_range("threshold_sigma", self.threshold_sigma, 0.0, 10.0)
        check_range("linear_below", self.linear_below, 2.0, 255.0)
        check_range("cutoff_hz", self.cutoff_hz, 0.0, 1e6)
        check_range("leak_rate_hz", self.leak_rate_hz, 0.0, 1e3)
        check_range("leak_rate_decades", self.leak_rate_decades, 0.0, 1.0)
        check_range("shot_noise_rate_hz", self.shot_noise_rate_hz, 0.0, 1e3)
        check_range("refractory_period_us", self.refractory_period_us, 0, 10**9)
        if self.photoreceptor_noise:
            self._check_photoreceptor_noise()

    def _check_photoreceptor_noise(self) -> None:
        low, high = NOISE_FIT_RANGE
        ratio = self.shot_noise_rate_hz / 2 / self.cutoff_hz if self.cutoff_hz else 0.0
        if not low <= ratio <= high:
            raise ConfigError(
                f"photoreceptor_noise needs shot_noise_rate_hz / 2 between {low:g} and {high:g} "
                f"times cutoff_hz; it is {self.shot_noise_rate_hz:g} Hz at "
                f"{self.cutoff_hz:g} Hz: change one of them, or leave photoreceptor_noise off"
            )


class V2eSimulator(StreamingSimulator[V2eConfig]):
    """v2e on video frames; see `simulate.protocol.Simulator`.

    Example:
        >>> from texvent.video import Frame
        >>> simulator = V2eSimulator(V2eSimulator.presets["peer-common"], backend="reference")
        >>> len(simulator.step(Frame(np.array([[40]], np.uint8), t_us=0)))
        0
        >>> events = simulator.step(Frame(np.array([[60]], np.uint8), t_us=1000))
        >>> list(zip(events.t.tolist(), events.polarity.tolist()))  # ln(60 / 40) = 0.4055
        [(493, 1), (986, 1)]
    """

    config_type: ClassVar[type] = V2eConfig
    presets: ClassVar[Mapping[str, V2eConfig]] = {
        "default": V2eConfig(),
        "noisy": V2eConfig(
            threshold_sigma=0.05,
            cutoff_hz=30.0,
            leak_rate_hz=0.1,
            shot_noise_rate_hz=5.0,
            refractory_period_us=0,
        ),
        "peer-common": V2eConfig(
            threshold_sigma=0.0,
            cutoff_hz=0.0,
            leak_rate_hz=0.0,
            shot_noise_rate_hz=0.0,
            refractory_period_us=0,
        ),
    }

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold, log units."""
        return min(self.config.contrast_threshold_on, self.config.contrast_threshold_off)

    @property
    def balance(self) -> float:
        """The α whose logarithm is as steep at black as the lin-log curve."""
        return self.config.linear_below / math.log(self.config.linear_below)

    def _begin(self, intensity: IntensityArray) -> None:
        config = self.config
        key, shape = sensor_key(self._seed), intensity.shape
        self._threshold_on, self._threshold_off = draw_threshold_pair(shape, key, config)
        self._leak_hz = config.leak_rate_hz * draw_rate_factors(
            shape, key, Purpose.LEAK_RATE, decades=config.leak_rate_decades
        )
        on = config.contrast_threshold_on / self._threshold_on
        off = config.contrast_threshold_off / self._threshold_off
        self._on_fraction = on / (on + off)
        self._noise = NoiseRates(config.shot_noise_rate_hz / 2 * (on + off))
        self._brightness = lin_log(intensity, config.linear_below)
        self._reference = self._brightness.copy()
        self._voltage_noise = np.zeros(shape)
        self._noise_since_event = np.zeros(shape)
        self._fired_us = np.full(shape, LONG_AGO_US)

    def _advance(self, intensity: IntensityArray, interval: Interval) -> Firings:
        start = self._brightness + self._voltage_noise - self._reference
        self._follow_light(intensity, interval)
        self._leak(interval)
        stop = self._brightness + self._voltage_noise - self._reference
        may_fire = (stop >= self._threshold_on) | (-stop >= self._threshold_off)
        pixel = np.flatnonzero(may_fire)
        columns = (start, stop, self._threshold_on, self._threshold_off)
        crossings = load_cross_ramp(self._backend)(
            Ramp(pixel, *(column.reshape(-1)[pixel] for column in columns)),
            self._fired_us.reshape(-1),
            (interval.start_us, interval.stop_us),
            Rest(self.config.refractory_period_us, is_level_lost=False),
        )
        fired = self._label(pixel, crossings)
        return fired.joined(self._add_shot_noise(intensity, interval))

    def _follow_light(self, intensity: IntensityArray, interval: Interval) -> None:
        """Move the photoreceptor, and its noise if it has any, to the end of the interval."""
        config = self.config
        brightness = lin_log(intensity, config.linear_below)
        if config.cutoff_hz > 0:
            angle = 2 * math.pi * config.cutoff_hz * interval.duration_s
            weight = np.minimum(relative_intensity(intensity) * angle, 1.0)
            brightness = self._brightness + weight * (brightness - self._brightness)
        self._brightness = brightness
        if config.photoreceptor_noise:
            y, x = np.ogrid[: intensity.shape[0], : intensity.shape[1]]
            fresh = draw_normals(interval.key, y, x, Purpose.VOLTAGE.draw())
            kept = math.exp(-2 * math.pi * config.cutoff_hz * interval.duration_s)
            rms = photoreceptor_noise_rms(
                config.shot_noise_rate_hz, config.cutoff_hz, self.contrast_threshold
            )
            noise = kept * self._voltage_noise + rms * math.sqrt(1 - kept * kept) * fresh
            self._noise_since_event += noise - self._voltage_noise
            self._voltage_noise = noise

    def _leak(self, interval: Interval) -> None:
        if self.config.leak_rate_hz > 0:
            leaked = self._leak_hz * interval.duration_s * self._threshold_on
            self._reference -= leaked
            self._noise_since_event += leaked

    def _label(self, pixel: NDArray[np.int64], crossings: RampCrossings) -> Firings:
        """Move the references, and tell the events that noise and leak made from the others."""
        steps = crossings.steps
        on, off = (one.reshape(-1)[pixel] for one in (self._threshold_on, self._threshold_off))
        moved = steps * np.where(steps > 0, on, off)
        self._reference.reshape(-1)[pixel] += moved
        since_event = self._noise_since_event.reshape(-1)
        is_noise = since_event[pixel] * np.sign(steps) >= 0.5 * np.abs(moved)
        since_event[pixel[steps != 0]] = 0.0
        label = np.where(is_noise, NOISE, SIGNAL)[np.searchsorted(pixel, crossings.pixel)]
        return Firings(crossings.pixel, crossings.t, crossings.p, label.astype(np.uint8))

    def _add_shot_noise(self, intensity: IntensityArray, interval: Interval) -> Firings:
        """Independent noise events; each makes its pixel memorise the present brightness."""
        config = self.config
        if config.shot_noise_rate_hz == 0 or config.photoreceptor_noise:
            return Firings.none()
        flat = intensity.reshape(-1)
        noise = self._noise.draw(
            interval,
            share=lambda pixel: (
                1.0 - (1.0 - BRIGHT_SHOT_SHARE) * np.minimum(relative_intensity(flat[pixel]), 1.0)
            ),
            on_fraction=self._on_fraction,
            backend=self._backend,
        )
        self._reference.reshape(-1)[noise.pixel] = self._brightness.reshape(-1)[noise.pixel]
        self._noise_since_event.reshape(-1)[noise.pixel] = 0.0
        return noise


def lin_log(intensity: IntensityArray, linear_below: float) -> Float64Array:
    """Brightness, linear in the dark and logarithmic above.

    Args:
        intensity: 0..255 scale, [H, W], uint8 or float.
        linear_below: intensity I₀ where the straight line from 0 meets the logarithm.

    Returns:
        `I · ln(I₀) / I₀` up to I₀ and `ln(I)` above, [H, W] float64, log units.

    Example:
        >>> lin_log(np.array([[0, 10, 20, 40]], np.uint8), 20.0).round(4).tolist()
        [[0.0, 1.4979, 2.9957, 3.6889]]
    """
    if intensity.dtype == np.uint8:
        table = lin_log(np.arange(256, dtype=np.float64), linear_below)
        return np.asarray(table[intensity])
    exact = intensity.astype(np.float64, copy=False)
    slope = math.log(linear_below) / linear_below
    return np.where(exact <= linear_below, exact * slope, np.log(np.maximum(exact, linear_below)))


def relative_intensity(intensity: IntensityArray) -> Float64Array:
    """`(I + 20) / 275`, [H, W] float64: what bandwidth and shot noise depend on."""
    return np.asarray((intensity + DARK_OFFSET) / WHITE_LEVEL, np.float64)


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
