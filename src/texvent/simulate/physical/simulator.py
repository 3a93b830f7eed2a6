"""The `physical` pixel model: what a DVS pixel does, from linear light to the readout.

Per frame interval, for every pixel:

1. intensity I = 255 · (luma / 255)^gamma, brightness L = ln(α + I), a straight line between
   frames;
2. the photoreceptor follows L as a first-order low-pass whose cutoff grows with I;
3. the change since the last reset, leak included, fires where and when it crosses a threshold of
   the pixel; every event resets the pixel;
4. noise events come at a rate that depends on intensity, and reset the pixel too;
5. if asked to, an arbiter or a scan lets events wait, and the readout delays them, rounds their
   times, filters them and limits their rate.

Rates are per second and the low-pass is integrated exactly, so neither the frame rate nor the
number of intermediate frames changes what is simulated.
docs/simulators/physical.md gives the equations.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.networks.weight_files import describe_file
from texvent.sensor import SensorSize
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.limits import check_event_number
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.physical.arbitration.arbiter import Arbiter
from texvent.simulate.physical.cameras.constants import CAMERAS
from texvent.simulate.physical.cameras.presets import PRESETS
from texvent.simulate.physical.circuit import (
    ADVANCE_PIXELS,
    WHITE,
    NoiseEvents,
    PhotoreceptorInput,
    new_state,
)
from texvent.simulate.physical.config import PhysicalConfig
from texvent.simulate.physical.noise_curve import parse_noise_curve
from texvent.simulate.physical.photoreceptor import InputFrames
from texvent.simulate.physical.readout import Readout
from texvent.simulate.physical.refractory import ResetRules
from texvent.simulate.physical.threshold_map import read_threshold_map
from texvent.simulate.random.draws import Purpose, draw_uniforms
from texvent.simulate.random.mismatch import (
    PixelMismatch,
    draw_chosen,
    draw_rate_factors,
    draw_threshold_pair,
    sensor_key,
)
from texvent.simulate.random.poisson_noise import Float64Array, PoissonNoise
from texvent.simulate.streaming import IntensityArray, StreamingSimulator
from texvent.video import MICROSECONDS

HOT = 1
"""Number of the noise process of hot pixels."""


class PhysicalSimulator(StreamingSimulator[PhysicalConfig]):
    """A DVS pixel on video frames; see `simulate.protocol.Simulator`.

    Example:
        >>> from texvent.video import Frame
        >>> simulator = PhysicalSimulator(PhysicalSimulator.presets["clean"], backend="reference")
        >>> dark, bright = np.array([[100]], np.uint8), np.array([[160]], np.uint8)
        >>> len(simulator.step(Frame(dark, t_us=0)))  # nothing to compare with yet
        0
        >>> events = simulator.step(Frame(bright, t_us=1000))  # I: 32.5 → 91.5, L rises by 0.870
        >>> events.t.tolist(), events.polarity.tolist()
        ([229, 459, 689, 919], [1, 1, 1, 1])
    """

    config_type: ClassVar[type] = PhysicalConfig
    takes_linear: ClassVar[bool] = True
    bytes_per_pixel: ClassVar[int] = 190
    gains_from_frames: ClassVar[bool] = True
    presets: ClassVar[Mapping[str, PhysicalConfig]] = PRESETS
    known_constants: ClassVar[Mapping[str, tuple[str, ...]]] = {
        name: tuple(one.option for one in camera.constants) for name, camera in CAMERAS.items()
    }
    """Preset of a camera → its options that have a source."""

    @staticmethod
    def provenance(config: PhysicalConfig) -> dict[str, str]:
        """Name and sha256 of the threshold map, if there is one; stored with the events.

        Raises:
            InputError: there is no such file.
            FileFormatError: it is no threshold map.
        """
        if config.threshold_map is None:
            return {}
        read_threshold_map(config.threshold_map)
        return describe_file(config.threshold_map)

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold divided by gamma: what Eq. 4 should count with, log units.

        Eq. 4 looks at gamma-coded frames, where the logarithm is smaller by that factor.
        """
        config = self.config
        return min(config.contrast_threshold_on, config.contrast_threshold_off) / config.gamma

    @property
    def balance(self) -> float:
        """The gamma-coded level of the balance: with it, Eq. 4 sees about the model's changes."""
        return WHITE * math.pow(self.config.balance / WHITE, 1.0 / self.config.gamma)

    def _begin(self, intensity: IntensityArray) -> None:
        config, shape = self.config, intensity.shape
        self._draw_sensor(shape)
        size = SensorSize(shape[1], shape[0])
        self._arbiter = Arbiter(
            config.arbitration, first_us=self._last_us, shape=shape, backend=self._backend
        )
        self._readout = Readout(config.readout, first_us=self._last_us, size=size)
        self._frames = InputFrames(
            intensity,
            gamma=config.gamma,
            balance=config.balance,
            cutoff_hz=config.cutoff_hz,
            cutoff_limit_hz=config.cutoff_limit_hz,
        )
        output = self._frames.brightness()
        level = output.copy()
        if config.initial_phase == "random":
            y, x = np.ogrid[: shape[0], : shape[1]]
            phase = draw_uniforms(sensor_key(self._seed), y, x, Purpose.PHASE.draw()).reshape(-1)
            on, off = self._mismatch[:2]
            level -= phase * (on + off) - off
        self._state = new_state(output, level, self._last_us)

    def _advance(
        self, intensity: IntensityArray, interval: FrameInterval
    ) -> UnsortedEvents | SortedEvents:
        check_event_number(self._leak_hz * interval.duration_s)
        light = self._frames.until(intensity)
        noise = self._draw_noise(light, interval)
        rules = ResetRules(self.config.refractory_us, self.config.noise_resets)
        fired = ADVANCE_PIXELS.load(self._backend)(
            light, self._mismatch, self._state, noise, rules, (interval.start_us, interval.stop_us)
        )
        self._decay_residual(interval)
        if self.config.arbiter == "none" and self.config.readout.is_ideal:
            return fired
        if not isinstance(fired, UnsortedEvents):
            fired = fired.unsorted(intensity.shape[1])
        return self._readout.read(self._arbiter.read(fired, interval.stop_us), interval)

    def _draw_sensor(self, shape: tuple[int, ...]) -> None:
        """Draw mismatch: thresholds, leak, noise factors, hot pixels."""
        config = self.config
        key = sensor_key(self._seed if config.sensor_seed is None else config.sensor_seed)
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
            start, stop = (
                curve.rate_at(frames.intensity(luma[pixel])) for luma in (light.before, light.now)
            )
            return np.asarray((start + stop) / (2.0 * curve.highest_hz))

        on_fraction, backend = self.config.noise_on_fraction, self._backend
        noise = self._noise.draw(
            interval, rate_fraction=rate_fraction, on_fraction=on_fraction, backend=backend
        )
        if not self._hot_noise.is_silent:
            hot = self._hot_noise.draw(interval, on_fraction=on_fraction, backend=backend)
            noise = UnsortedEvents.concat((noise, hot))
        order = np.lexsort((noise.p, noise.t, noise.pixel))
        return NoiseEvents(noise.pixel[order], noise.t[order], noise.p[order])

    def _decay_residual(self, interval: FrameInterval) -> None:
        """Let change that has not fired decay, whether leak or light caused it."""
        if self.config.residual_decay_hz > 0:
            kept = math.exp(-self.config.residual_decay_hz * interval.duration_s)
            state, stop_us = self._state, interval.stop_us
            state.level[:] += (1.0 - kept) * (state.output - state.level)
            age = np.rint(kept * (stop_us - state.since_us)).astype(np.int64)
            is_free = state.since_us <= stop_us
            state.since_us[is_free] = stop_us - age[is_free]
            state.quiescent_until_us[:] = stop_us


def _factors_of_mean_1(
    shape: tuple[int, ...], key: np.uint64, purpose: Purpose, decades: float
) -> Float64Array:
    """Log-normal factors between pixels that keep the mean rate what the option says."""
    factors = draw_rate_factors(shape, key, purpose, decades=decades)
    return factors / math.exp((math.log(10) * decades) ** 2 / 2)
