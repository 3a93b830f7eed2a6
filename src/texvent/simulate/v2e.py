"""v2e's pixel model: lin-log, photoreceptor bandwidth, mismatch, leak, shot noise, refractory.

Source: Y. Hu, S.-C. Liu, T. Delbruck, "v2e: from video frames to realistic DVS events", CVPRW
2021, and the options its program documents. docs/simulators.md gives the equations and where this
model departs from the program: event times above all.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.events import NOISE, SIGNAL
from texvent.simulate.draws import Purpose, draw_normals
from texvent.simulate.firings import Firings, Interval
from texvent.simulate.kernels.follow import (
    DARK_OFFSET,
    WHITE_LEVEL,
    Light,
    Pixels,
    PixelState,
    load_follow_light,
)
from texvent.simulate.kernels.follow_reference import lin_log
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
from texvent.video import MICROSECONDS

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
        on, off = (one.reshape(-1) for one in draw_threshold_pair(shape, key, config))
        self._pixels = Pixels(on, off, self._draw_leak(shape, key, on))
        more_on, more_off = config.contrast_threshold_on / on, config.contrast_threshold_off / off
        self._on_fraction = more_on / (more_on + more_off)
        rate_hz = config.shot_noise_rate_hz / 2 * (more_on + more_off)
        self._noise = NoiseRates(rate_hz.reshape(shape))
        levels = np.arange(256.0)
        self._table = np.stack([lin_log(levels, config.linear_below), relative_intensity(levels)])
        flat = intensity.reshape(-1).astype(np.float64)
        brightness = lin_log(flat, config.linear_below)
        self._state = PixelState(brightness, brightness.copy(), None)
        if config.photoreceptor_noise:
            self._state = self._state._replace(voltage=(np.zeros(flat.size), np.zeros(flat.size)))
            self._voltage_at_event = np.zeros(flat.size)
        self._start_us = self._last_us
        self._event_us = np.full(flat.size, self._start_us)
        self._fired_us = np.full(flat.size, LONG_AGO_US)

    def _draw_leak(
        self, shape: tuple[int, ...], key: np.uint64, threshold_on: Float64Array
    ) -> Float64Array | None:
        """By how much references sink, log units per µs."""
        config = self.config
        if config.leak_rate_hz == 0:
            return None
        factor = draw_rate_factors(shape, key, Purpose.LEAK_RATE, decades=config.leak_rate_decades)
        return factor.reshape(-1) * (config.leak_rate_hz / MICROSECONDS) * threshold_on

    def _advance(self, intensity: IntensityArray, interval: Interval) -> Firings:
        if self.config.photoreceptor_noise:
            self._shake(intensity.shape, interval)
        luma = intensity.reshape(-1)
        angle = 2 * math.pi * self.config.cutoff_hz * interval.duration_s or math.inf
        table = self._table if luma.dtype == np.uint8 else None
        restless = load_follow_light(luma.dtype, self._backend)(
            Light(luma, table, self.config.linear_below, angle),
            self._pixels,
            self._state,
            (float(interval.start_us - self._start_us), float(interval.stop_us - self._start_us)),
        )
        pixel = restless.pixel
        on, off = self._pixels.threshold_on[pixel], self._pixels.threshold_off[pixel]
        ramp = Ramp(pixel, restless.start, restless.stop, on, off)
        crossings = load_cross_ramp(self._backend)(
            ramp,
            self._fired_us,
            (interval.start_us, interval.stop_us),
            Rest(self.config.refractory_period_us, is_level_lost=False),
        )
        fired = self._label(ramp, crossings, interval.stop_us)
        return fired.joined(self._add_shot_noise(luma, interval))

    def _shake(self, shape: tuple[int, ...], interval: Interval) -> None:
        """Move the noise of the photoreceptors, if they have any, to the end of the interval."""
        config = self.config
        _, voltage = self._state.voltage or (np.empty(0), np.empty(0))
        y, x = np.ogrid[: shape[0], : shape[1]]
        fresh = draw_normals(interval.key, y, x, Purpose.VOLTAGE.draw()).reshape(-1)
        kept = math.exp(-2 * math.pi * config.cutoff_hz * interval.duration_s)
        rms = photoreceptor_noise_rms(
            config.shot_noise_rate_hz, config.cutoff_hz, self.contrast_threshold
        )
        now = kept * voltage + rms * math.sqrt(1 - kept * kept) * fresh
        self._state = self._state._replace(voltage=(voltage, now))

    def _leaked(self, pixel: NDArray[np.int64], us: NDArray[np.int64] | int) -> Float64Array:
        """What the references of some pixels leak in a time."""
        leak = self._pixels.leak
        return np.zeros(len(pixel)) if leak is None else leak[pixel] * us

    def _label(self, ramp: Ramp, crossings: RampCrossings, stop_us: int) -> Firings:
        """Move the references, and tell the events that noise and leak made from the others."""
        pixel, steps = ramp.pixel, crossings.steps
        moved = steps * np.where(steps > 0, ramp.threshold_on, ramp.threshold_off)
        self._state.reference[pixel] += moved
        by_noise = self._leaked(pixel, stop_us - self._event_us[pixel])
        fired = pixel[steps != 0]
        if self._state.voltage is not None:
            voltage = self._state.voltage[1]
            by_noise += voltage[pixel] - self._voltage_at_event[pixel]
            self._voltage_at_event[fired] = voltage[fired]
        is_noise = by_noise * np.sign(steps) >= 0.5 * np.abs(moved)
        self._event_us[fired] = stop_us
        # A step is an event here, and events come by pixel.
        label = np.repeat(np.where(is_noise, NOISE, SIGNAL).astype(np.uint8), np.abs(steps))
        return Firings(crossings.pixel, crossings.t, crossings.p, label)

    def _add_shot_noise(self, luma: IntensityArray, interval: Interval) -> Firings:
        """Independent noise events; each makes its pixel memorise the present brightness."""
        config = self.config
        if config.shot_noise_rate_hz == 0 or config.photoreceptor_noise:
            return Firings.none()
        noise = self._noise.draw(
            interval,
            share=lambda pixel: (
                1.0 - (1.0 - BRIGHT_SHOT_SHARE) * np.minimum(relative_intensity(luma[pixel]), 1.0)
            ),
            on_fraction=self._on_fraction,
            backend=self._backend,
        )
        pixel, stop_us = noise.pixel, interval.stop_us
        leaked = self._leaked(pixel, stop_us - self._start_us)
        self._state.reference[pixel] = self._state.brightness[pixel] + leaked
        self._event_us[pixel] = stop_us
        return noise


def relative_intensity(intensity: NDArray[Any]) -> Float64Array:
    """`(I + 20) / 275`, float64: what bandwidth and shot noise depend on."""
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
