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
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import Purpose, draw_normals
from texvent.simulate.random.mismatch import (
    LONG_AGO_US,
    LOWEST_THRESHOLD,
    Float64Array,
    draw_rate_factors,
    draw_threshold_pair,
    sensor_key,
)
from texvent.simulate.random.rate_noise import NoiseRates
from texvent.simulate.streaming import IntensityArray, StreamingSimulator
from texvent.simulate.v2e.kernels.emit_and_reset import LastEvents, Rules, load_fire_and_memorise
from texvent.simulate.v2e.kernels.low_pass import (
    DARK_OFFSET,
    WHITE_LEVEL,
    Float32Array,
    Light,
    Pixels,
    Restless,
    load_follow_light,
    new_state,
)
from texvent.simulate.v2e.kernels.low_pass_reference import lin_log
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
        self._pixels = Pixels(
            on.astype(np.float32), off.astype(np.float32), self._draw_leak(shape, key, on)
        )
        more_on, more_off = config.contrast_threshold_on / on, config.contrast_threshold_off / off
        self._on_fraction = more_on / (more_on + more_off)
        rate_hz = config.shot_noise_rate_hz / 2 * (more_on + more_off)
        self._noise = NoiseRates(rate_hz.reshape(shape))
        levels = np.arange(256.0)
        self._table = np.stack([lin_log(levels, config.linear_below), relative_intensity(levels)])
        flat = intensity.reshape(-1).astype(np.float64)
        brightness = lin_log(flat, config.linear_below)
        voltage, voltage_then = None, None
        if config.photoreceptor_noise:
            voltage, voltage_then = (np.zeros(flat.size), np.zeros(flat.size)), np.zeros(flat.size)
        self._state = new_state(brightness, voltage)
        self._seen = intensity.reshape(-1).copy()
        self._start_us = self._last_us
        self._last = LastEvents(
            np.full(flat.size, LONG_AGO_US), np.full(flat.size, self._start_us), voltage_then
        )

    def _draw_leak(
        self, shape: tuple[int, ...], key: np.uint64, threshold_on: Float64Array
    ) -> Float32Array | None:
        """By how much references sink, log units per µs."""
        config = self.config
        if config.leak_rate_hz == 0:
            return None
        factor = draw_rate_factors(shape, key, Purpose.LEAK_RATE, decades=config.leak_rate_decades)
        leak = factor.reshape(-1) * (config.leak_rate_hz / MICROSECONDS) * threshold_on
        return leak.astype(np.float32)

    def _advance(
        self, intensity: IntensityArray, interval: FrameInterval
    ) -> UnsortedEvents | SortedEvents:
        if self.config.photoreceptor_noise:
            self._shake(intensity.shape, interval)
        restless = self._follow(intensity.reshape(-1), interval)
        noise = self._draw_shot_noise(intensity.reshape(-1), interval)
        fired = load_fire_and_memorise(self._backend)(
            restless,
            (self._pixels, self._state),
            self._last,
            noise,
            Rules(interval, self.config.refractory_period_us, intensity.shape),
        )
        self._memorise_noise(noise.pixel, interval)
        return fired

    def _follow(self, luma: IntensityArray, interval: FrameInterval) -> Restless:
        """Move the photoreceptors to the end of the interval; who has reached a threshold then."""
        if luma.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen, luma = self._seen.astype(np.float32), luma.astype(np.float32)
        angle = 2 * math.pi * self.config.cutoff_hz * interval.duration_s or math.inf
        table = self._table if luma.dtype == np.uint8 else None
        return load_follow_light(luma.dtype, self._backend)(
            Light(self._seen, luma, table, self.config.linear_below, angle),
            self._pixels,
            self._state,
            (float(interval.start_us - self._start_us), float(interval.stop_us - self._start_us)),
        )

    def _shake(self, shape: tuple[int, ...], interval: FrameInterval) -> None:
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

    def _draw_shot_noise(self, luma: IntensityArray, interval: FrameInterval) -> UnsortedEvents:
        """Independent noise events."""
        config = self.config
        if config.shot_noise_rate_hz == 0 or config.photoreceptor_noise:
            return UnsortedEvents.none()
        return self._noise.draw(
            interval,
            share=lambda pixel: (
                1.0 - (1.0 - BRIGHT_SHOT_SHARE) * np.minimum(relative_intensity(luma[pixel]), 1.0)
            ),
            on_fraction=self._on_fraction,
            backend=self._backend,
        )

    def _memorise_noise(self, pixel: NDArray[np.int64], interval: FrameInterval) -> None:
        """A noise event makes its pixel memorise the present brightness."""
        leaked, leak = np.zeros(len(pixel)), self._pixels.leak
        if leak is not None:
            leaked = leak[pixel].astype(np.float64) * (interval.stop_us - self._start_us)
        self._state.reference[pixel] = self._state.brightness[pixel] + leaked
        self._state.disturb(pixel)
        self._last.interval_us[pixel] = interval.stop_us


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
