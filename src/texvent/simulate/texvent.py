"""The paper's simulator: frames → event frames → noise → time stamps (section 3.2.2)."""

from __future__ import annotations

import typing
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal, NamedTuple

import numpy as np

from texvent._registry import suggest
from texvent.brightness import Float64Array, balanced_log
from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.events import NOISE, EventStream
from texvent.simulate.cache import BrightnessCache, CachePolicy, ResetRule
from texvent.simulate.draws import frame_key
from texvent.simulate.event_frame import EventFrame, generate_event_frame, list_activations
from texvent.simulate.firings import Firings, Interval
from texvent.simulate.interval import SubInterval
from texvent.simulate.kernels.interface import Kernels
from texvent.simulate.kernels.select import check_backend, load_kernels
from texvent.simulate.noise import (
    NoiseKind,
    draw_noise,
    draw_voltage_noise,
    low_light_background,
)
from texvent.simulate.timestamps import StampRule, reconstruct_timestamps
from texvent.video import Frame, StreamChecker


@dataclass(frozen=True, kw_only=True)
class TexventConfig:
    """Options of the Texvent pixel model.

    The defaults are the paper's, or our choice where it gives none; docs/equations.md says which.

    Raises:
        ConfigError: an option is out of range, or two contradict each other.
    """

    contrast_threshold: float = 0.2
    """Contrast threshold δ: change of brightness ln(α + I) that fires an event."""
    balance: float = 30.0
    """Balance α, in levels of 0..255: what is added to intensities before the logarithm, so that
    dark pixels do not fire more easily than bright ones."""
    cache: CachePolicy = "local"
    """How long a pixel that has not fired remembers its reference brightness: within a pair of
    source frames (local), for the whole video (global), not at all (none), or with a loss at each
    source frame (leaky)."""
    cache_reset_pairs: int = 0
    """With --cache global or leaky: forget all references every this many pairs of source frames;
    0 is never. (Local forgets at every pair by itself.)"""
    cache_leak: float = 0.1
    """With --cache leaky: share of the way, 0..1, by which a reference moves to the brightness of
    each source frame; 0 is global, 1 is local."""
    reset: ResetRule = "current"
    """Where a pixel fires, its reference becomes the current brightness (current), or moves by one
    threshold per event, as in the circuit (step)."""
    multi_event: bool = False
    """Fire one event per threshold crossed, not one per frame; needs a --stamp other than eq7."""
    noise: NoiseKind = "adaptive"
    """Background activity: in dark, resting pixels (adaptive, Eq. 6); as Gaussian noise on the
    brightness (gaussian); at any pixel (random); or none."""
    noise_rate_hz: float = 0.1
    """Noise events per pixel and second, where there is noise (λ1)."""
    noise_scale: float = 1.0
    """Sensor factor on the noise rate, such as the ratio of two fill factors (in λ2)."""
    noise_intensity: float = 80.0
    """Pixels darker than this level of 0..255 are low-light (σ); with --noise adaptive."""
    noise_on_fraction: float = 0.5
    """Share of ON among noise events, 0..1; Gaussian noise decides polarity by itself."""
    stamp: StampRule = "eq7"
    """Time of an event between two frames: larger change earlier (eq7), random, where a straight
    line crosses the threshold (linear), where a ramp from the reference does (hyperbolic), evenly
    spaced (even), or at the end (end)."""
    stamp_scale: float = 1.0
    """Scale γ of --stamp eq7, above 0 up to 1: the share of the interval that events
    spread over."""

    def __post_init__(self) -> None:
        check_range("contrast_threshold", self.contrast_threshold, 1e-4, 10.0)
        check_range("balance", self.balance, 0.0, 1e6)
        check_range("cache_reset_pairs", self.cache_reset_pairs, 0)
        check_range("cache_leak", self.cache_leak, 0.0, 1.0)
        check_range("noise_rate_hz", self.noise_rate_hz, 0.0, 1e4)
        check_range("noise_scale", self.noise_scale, 0.0, 1e3)
        check_range("noise_intensity", self.noise_intensity, 0.0, 1e6)
        check_range("noise_on_fraction", self.noise_on_fraction, 0.0, 1.0)
        check_range("stamp_scale", self.stamp_scale, 1e-6, 1.0)
        self._check_choices()
        if self.cache_reset_pairs > 0 and self.cache in ("local", "none"):
            raise ConfigError(
                f"cache_reset_pairs is {self.cache_reset_pairs}, but cache {self.cache!r} forgets "
                "at every pair already; use cache 'global' or 'leaky', or leave it 0"
            )
        if self.multi_event and self.stamp == "eq7":
            raise ConfigError(
                "stamp 'eq7' gives a pixel one time per frame, but multi_event lets it fire "
                "several times; use stamp 'linear', 'hyperbolic', 'even', 'random' or 'end'"
            )

    def _check_choices(self) -> None:
        for name, hint in typing.get_type_hints(type(self)).items():
            allowed = typing.get_args(hint)
            if typing.get_origin(hint) is Literal and getattr(self, name) not in allowed:
                value = getattr(self, name)
                raise ConfigError(f"{name} is {value!r}; {suggest(str(value), allowed)}")

    @property
    def reset_step(self) -> float | None:
        """By how much an event moves its reference, log units; None: to the current brightness."""
        return self.contrast_threshold if self.reset == "step" else None


class _Seen(NamedTuple):
    """What is kept of a frame until the next one comes."""

    t_us: int
    is_source: bool
    brightness: Float64Array
    cache: BrightnessCache


class TexventSimulator:
    """Texvent's pixel model (Eqs. 5-7); see `simulate.protocol.Simulator`.

    Example:
        >>> simulator = TexventSimulator(TexventConfig(noise="none"), backend="reference")
        >>> dark, bright = np.full((1, 2), 50, np.uint8), np.array([[50, 90]], np.uint8)
        >>> len(simulator.step(Frame(dark, t_us=0)))  # nothing to compare with yet
        0
        >>> events = simulator.step(Frame(bright, t_us=1000))
        >>> events.x.tolist(), events.t.tolist(), events.polarity.tolist()
        ([1], [500], [1])
    """

    config_type: ClassVar[type] = TexventConfig
    presets: ClassVar[Mapping[str, TexventConfig]] = {
        "paper": TexventConfig(),
        # Measured against true and recorded events (docs/benchmark.md): a reference that outlives
        # the frame and moves by whole thresholds, and more than one event per frame. A global
        # cache is .005 STPP better on exact scenes, and .018 worse on a recording: it drifts.
        "accurate": TexventConfig(cache="leaky", reset="step", multi_event=True, stamp="linear"),
    }

    def __init__(
        self, config: TexventConfig | None = None, *, seed: int = 0, backend: str = "auto"
    ) -> None:
        """Prepare a simulator that has seen no frame.

        Args:
            config: options; default: the preset "paper".
            seed: of noise and random times, 0..2⁶³−1.
            backend: "auto", "cpu" or "reference": which kernels scan the pixels. All give the same
                events.

        Raises:
            ConfigError: the seed is out of range or the backend unknown.
        """
        check_range("seed", seed, 0, 2**63 - 1)
        self.config = config or TexventConfig()
        self._seed = int(seed)
        self._backend = check_backend(backend)
        self.reset()

    @property
    def contrast_threshold(self) -> float:
        """δ, log units."""
        return self.config.contrast_threshold

    @property
    def balance(self) -> float:
        """α, on the 0..255 scale."""
        return self.config.balance

    def reset(self) -> None:
        """Forget all frames: the next one is the first."""
        self._checker = StreamChecker()
        self._seen: _Seen | None = None

    def step(self, frame: Frame) -> EventStream:
        """Events in `[t of the frame before, t of this frame)`, sorted; none for the first frame.

        Raises:
            InputError: another size than before, a time that does not increase, an intensity that
                is NaN, infinite or negative, or Gaussian noise of one event per frame or more.
            ConfigError: the balance is 0 and a pixel is black.
        """
        self._checker.check(frame)
        brightness = balanced_log(frame.luma, self.balance)
        if self._seen is None:
            self._seen = _Seen(frame.t_us, frame.is_source, brightness, self._new_cache(brightness))
            return _nothing().packet(Interval(frame.t_us, frame.t_us, np.uint64(0)), frame.size)
        cache = self._seen.cache
        interval = self._compare_with_cache(frame, brightness, self._seen)  # κ ⋄ I^{j−1}
        events = self._generate_event_frame(interval.brightness, interval)  # Eq. 5
        noise = self._add_noise(frame, events, interval)  # Eq. 6
        signal = self._without_voltage_noise(events, brightness, interval)
        timed = self._reconstruct_timestamps(events, signal, interval)  # Eq. 7
        cache.update(signal, brightness, step=self.config.reset_step)
        self._seen = _Seen(frame.t_us, frame.is_source, brightness, cache)
        return timed.joined(noise).packet(interval.span, frame.size)

    @property
    def _kernels(self) -> Kernels:
        # Looked up, not kept: modules cannot be copied, and a simulator can be, with its state.
        return load_kernels(self._backend)

    def _new_cache(self, brightness: Float64Array) -> BrightnessCache:
        config = self.config
        return BrightnessCache(
            brightness,
            policy=config.cache,
            leak=config.cache_leak,
            reset_pairs=config.cache_reset_pairs,
        )

    def _compare_with_cache(
        self, frame: Frame, brightness: Float64Array, before: _Seen
    ) -> SubInterval:
        """Set the calibrated frame `κ ⋄ I^{j−1}` against this one, with voltage noise if asked."""
        span = Interval(before.t_us, frame.t_us, frame_key(self._seed, frame.t_us))
        reference = before.cache.calibrate(before.brightness, is_source=before.is_source)
        if self.config.noise == "gaussian":
            mean = self._expected_noise(span)
            brightness = brightness + draw_voltage_noise(
                brightness.shape, span.key, threshold=self.contrast_threshold, mean=mean
            )
        return SubInterval(span, before.brightness, brightness, reference)

    def _generate_event_frame(self, brightness: Float64Array, interval: SubInterval) -> EventFrame:
        """Eq. 5."""
        return generate_event_frame(
            self._kernels,
            brightness,
            interval.reference,
            threshold=self.contrast_threshold,
            multi_event=self.config.multi_event,
        )

    def _add_noise(self, frame: Frame, events: EventFrame, interval: SubInterval) -> Firings:
        """Eq. 6, or its ablation E11 ("random"). E10 ("gaussian") has shaken the brightness."""
        config = self.config
        mean = self._expected_noise(interval.span)
        if config.noise in ("none", "gaussian") or mean == 0:
            return _nothing()
        if config.noise == "random":
            mask = np.ones(frame.size.shape, np.bool_)
        else:
            mask = low_light_background(frame.luma, events.pixel, intensity=config.noise_intensity)
        return draw_noise(
            self._kernels, mask, interval.span, mean=mean, on_fraction=config.noise_on_fraction
        )

    def _expected_noise(self, span: Interval) -> float:
        """λ1 · λ2: noise events per pixel in a sub-interval."""
        return self.config.noise_rate_hz * (self.config.noise_scale * span.duration_s)

    def _without_voltage_noise(
        self, events: EventFrame, brightness: Float64Array, interval: SubInterval
    ) -> EventFrame:
        """What would have fired without Gaussian noise: only this renews the reference."""
        if self.config.noise != "gaussian":
            return events
        return self._generate_event_frame(brightness, interval)

    def _reconstruct_timestamps(
        self, events: EventFrame, signal: EventFrame, interval: SubInterval
    ) -> Firings:
        """Eq. 7. Events that only voltage noise let fire are labelled as noise."""
        activations = list_activations(events)
        t = reconstruct_timestamps(
            activations,
            interval,
            stamp=self.config.stamp,
            threshold=self.contrast_threshold,
            scale=self.config.stamp_scale,
        )
        fired = Firings.signal(activations.pixel, t, activations.polarity)
        if signal is not events:
            fired.label[~np.isin(activations.pixel, signal.pixel)] = NOISE
        return fired


def _nothing() -> Firings:
    empty = np.empty(0, np.int64)
    return Firings.noise(empty, empty, empty.astype(np.uint8))
