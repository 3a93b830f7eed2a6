"""Options of the `physical` pixel model."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from texvent.config import check_choices, check_range
from texvent.errors import ConfigError, shown
from texvent.simulate.physical.arbitration.arbiter import ArbiterKind, ArbiterRules
from texvent.simulate.physical.arbitration.row_arbiter import RowRules
from texvent.simulate.physical.cameras.biases import BiasEffect, bias_effect, check_camera
from texvent.simulate.physical.cameras.constants import constants_for_biases
from texvent.simulate.physical.noise_curve import DAVIS346_NOISE, parse_noise_curve
from texvent.simulate.physical.readout import ReadoutRules
from texvent.simulate.physical.readout_filters import check_readout_filters
from texvent.simulate.random.mismatch import LOWEST_THRESHOLD


@dataclass(frozen=True, kw_only=True)
class PhysicalConfig:
    """Options of the physical pixel model.

    Raises:
        ConfigError: an option is out of range, or two contradict each other.
    """

    gamma: float = 2.2
    """Exponent that turns the levels of ordinary video into linear light; 1 for frames that are
    linear already, such as those of a DAVIS. Frames that say so themselves, such as OpenEXR, are
    taken as they are whatever it is."""
    balance: float = 10.0
    """Balance α, in linear levels of 0..255: what is added to intensities before the logarithm,
    as the current that flows in the dark."""
    contrast_threshold: float = 0.3
    """Contrast threshold δ: change of brightness ln(α + I) that fires an event; the mean over
    pixels, and the geometric mean of ON and OFF."""
    on_off_ratio: float = 1.0
    """ON threshold divided by OFF threshold."""
    threshold_sigma: float = 0.03
    """Standard deviation of both thresholds between pixels, log units; none is below 0.01."""
    threshold_map: Path | None = None
    """Thresholds of each pixel of one sensor, over their mean: a file of texvent calibrate --scene
    flicker. Pixels that it does not know have drawn ones."""
    initial_phase: Literal["random", "zero"] = "zero"
    """How far each pixel is from its next event at the first frame: anywhere between its
    thresholds, as in a sensor that was on before, for frames without grain (random), or just reset
    (zero); leak then begins to fire after 1 / leak_rate_hz."""
    residual_decay_hz: float = 0.0
    """Rate at which a pixel forgets change that has not fired yet, per second; 0 is never."""
    cutoff_hz: float = 250.0
    """Bandwidth of the photoreceptor at white; proportionally less at lower intensity. 0 is
    unlimited."""
    cutoff_limit_hz: float = 0.0
    """Bandwidth that bright light does not exceed, that of the circuit behind the photodiode; 0 is
    unlimited."""
    refractory_period_us: int = 300
    """Time for which an event holds its pixel in reset; changes in it are lost."""
    leak_rate_hz: float = 0.01
    """ON events per pixel and second from junction leakage: the mean over pixels."""
    leak_rate_decades: float = 0.1
    """Standard deviation of log10 of the leak rate between pixels."""
    noise_curve: str = DAVIS346_NOISE
    """Noise events per pixel and second by linear intensity, as points LEVEL:RATE; log-linear
    between them."""
    noise_scale: float = 0.2
    """Sensor factor on the noise rate; 0 is no noise."""
    noise_decades: float = 0.25
    """Standard deviation of log10 of the noise rate between pixels."""
    noise_on_fraction: float = 0.53
    """Share of ON among noise events, 0..1."""
    noise_resets: bool = True
    """A noise event resets its pixel, as any event does."""
    hot_pixel_fraction: float = 0.0
    """Share of pixels that fire all the time, 0..1."""
    hot_pixel_rate_hz: float = 20.0
    """Noise events per second of such a pixel."""
    sensor_seed: int | None = None
    """Seed of everything fixed to a pixel (thresholds, noise and leak rates, hot pixels); without
    it, the run's seed. Set it to record many clips with one sensor."""
    arbiter: ArbiterKind = "none"
    """What reads the pixels: all at once (none), row by row in the order in which rows ask (rows,
    as in a DAVIS or Prophesee's sensors), or a scan of the columns (scan, as in a DVXplorer).
    What a pixel fires while its event waits is lost."""
    arbiter_row_ns: int = 300
    """With --arbiter rows: how long a row takes, and in addition..."""
    arbiter_event_ns: int = 80
    """... each of its events."""
    scan_period_ns: int = 197_150
    """With --arbiter scan: from one scan to the next; the columns follow each other evenly."""
    readout_latency_us: int = 0
    """Delay between an event and its time stamp."""
    readout_jitter_us: int = 0
    """Longest random delay that is added to the latency."""
    clock_step_us: int = 1
    """Period of the time stamp clock; events get the time of its next tick."""
    rate_limit_hz: float = 0.0
    """Events per second of the whole sensor above which events are dropped at random; 0 is
    never."""
    rate_limit_window_us: int = 1000
    """Window of the rate limit: what was counted in one decides how many are dropped in the
    next."""
    readout_filters: tuple[str, ...] = ()
    """Filters of the readout, in order, before the rate limit: event-trail, anti-flicker and more,
    such as event-trail:mode=trail,threshold_us=5000."""
    bias_camera: str | None = None
    """Camera whose biases `bias` names; the presets of cameras set it."""
    bias: str | None = None
    """Biases in the camera's units, such as diff_on=400,diff_off=200; refused where what they do is
    not published."""

    def __post_init__(self) -> None:
        for name, (low, high) in RANGES.items():
            check_range(name, getattr(self, name), low, high)
        check_choices(self)
        if self.sensor_seed is not None:
            check_range("sensor_seed", self.sensor_seed, 0, 2**63 - 1)
        parse_noise_curve(self.noise_curve)
        check_readout_filters(self.readout_filters)
        self._check_bias()

    @property
    def bias_effect(self) -> BiasEffect:
        """What the biases do to a pixel."""
        return BiasEffect() if self.bias is None else bias_effect(self.bias_camera, self.bias)

    @property
    def contrast_threshold_on(self) -> float:
        """Mean ON threshold, log units."""
        effect = self.bias_effect
        on = self.contrast_threshold * math.sqrt(self.on_off_ratio) * effect.scale_on
        return max(on if effect.threshold_on is None else effect.threshold_on, LOWEST_THRESHOLD)

    @property
    def contrast_threshold_off(self) -> float:
        """Mean OFF threshold, log units."""
        effect = self.bias_effect
        off = self.contrast_threshold / math.sqrt(self.on_off_ratio) * effect.scale_off
        return max(off if effect.threshold_off is None else effect.threshold_off, LOWEST_THRESHOLD)

    @property
    def refractory_us(self) -> int:
        """Refractory period, µs: that of the biases, or the option."""
        period = self.bias_effect.refractory_us
        return self.refractory_period_us if period is None else period

    @property
    def arbitration(self) -> ArbiterRules:
        """The arbiter's share of the options."""
        return ArbiterRules(
            self.arbiter,
            RowRules(self.arbiter_row_ns, self.arbiter_event_ns),
            self.scan_period_ns,
        )

    @property
    def readout(self) -> ReadoutRules:
        """The readout's share of the options."""
        return ReadoutRules(
            latency_us=self.readout_latency_us,
            jitter_us=self.readout_jitter_us,
            clock_us=self.clock_step_us,
            rate_limit_hz=self.rate_limit_hz,
            rate_limit_window_us=self.rate_limit_window_us,
            filters=self.readout_filters,
        )

    def _check_bias(self) -> None:
        """Refuse biases without a meaning, and options that say the same as a bias.

        Raises:
            ConfigError: see `biases.bias_effect`; or an option differs from the camera's preset
                although a bias sets its value.
        """
        check_camera(self.bias_camera)
        effect = self.bias_effect
        set_by_bias = {
            "contrast_threshold": effect.threshold_on,
            "on_off_ratio": effect.threshold_on,
            "refractory_period_us": effect.refractory_us,
        }
        known = {one.option: one.value for one in constants_for_biases(self.bias_camera)}
        for name, value in set_by_bias.items():
            stated = known.get(name, type(self).__dataclass_fields__[name].default)
            if value is not None and getattr(self, name) != stated:
                raise ConfigError(
                    f"{name} is {getattr(self, name):g}, but bias {shown(self.bias)} sets it too; "
                    "leave one of them out"
                )


RANGES: Mapping[str, tuple[float, float]] = {
    "gamma": (0.1, 10.0),
    "balance": (1e-3, 1e6),
    "contrast_threshold": (LOWEST_THRESHOLD, 10.0),
    "on_off_ratio": (0.1, 10.0),
    "threshold_sigma": (0.0, 10.0),
    "residual_decay_hz": (0.0, 1e6),
    "cutoff_hz": (0.0, 1e6),
    "cutoff_limit_hz": (0.0, 1e6),
    "refractory_period_us": (0, 10**9),
    "leak_rate_hz": (0.0, 1e3),
    "leak_rate_decades": (0.0, 1.0),
    "noise_scale": (0.0, 1e3),
    "noise_decades": (0.0, 1.0),
    "noise_on_fraction": (0.0, 1.0),
    "hot_pixel_fraction": (0.0, 1.0),
    "hot_pixel_rate_hz": (0.0, 1e5),
    "arbiter_row_ns": (0, 10**9),
    "arbiter_event_ns": (0, 10**9),
    "scan_period_ns": (1, 10**9),
    "readout_latency_us": (0, 10**6),
    "readout_jitter_us": (0, 10**6),
    "clock_step_us": (1, 10**6),
    "rate_limit_hz": (0.0, 1e12),
    "rate_limit_window_us": (1, 10**6),
}
"""Lowest and highest value of every numeric option."""
