"""v2e's pixel model: lin-log, photoreceptor bandwidth, mismatch, leak, shot noise, refractory.

Source: Y. Hu, S.-C. Liu, T. Delbruck, "v2e: from video frames to realistic DVS events", CVPRW
2021, and the options its program documents. docs/simulators/v2e.md gives the equations and where
this model departs from the program: event times above all.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import Purpose
from texvent.simulate.random.mismatch import (
    LONG_AGO_US,
    Float64Array,
    PixelMismatch,
    draw_rate_factors,
    draw_threshold_pair,
    sensor_key,
    smaller_threshold,
)
from texvent.simulate.streaming import IntensityArray, StreamingSimulator
from texvent.simulate.v2e.config import PRESETS, V2eConfig
from texvent.simulate.v2e.emit_and_reset import EMIT_AND_RESET, EmissionRules, LastEvents
from texvent.simulate.v2e.low_pass import (
    APPLY_LOW_PASS,
    CrossingPixels,
    LowPassInput,
    new_state,
)
from texvent.simulate.v2e.reference import lin_log
from texvent.simulate.v2e.shot_noise import (
    ShotNoise,
    next_photoreceptor_noise,
    photoreceptor_noise_rms,
    relative_intensity,
)
from texvent.video import MICROSECONDS


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
    takes_linear: ClassVar[bool] = True
    bytes_per_pixel: ClassVar[int] = 190
    gains_from_frames: ClassVar[bool] = True
    presets: ClassVar[Mapping[str, V2eConfig]] = PRESETS
    frame_bound_presets: ClassVar[frozenset[str]] = frozenset({"noisy"})

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold, log units."""
        return smaller_threshold(self.config)

    @property
    def balance(self) -> float:
        """The α whose logarithm is as steep at black as the lin-log curve."""
        return self.config.linear_below / math.log(self.config.linear_below)

    def _begin(self, intensity: IntensityArray) -> None:
        config, shape = self.config, intensity.shape
        key = sensor_key(self._seed)
        on, off = draw_threshold_pair(shape, key, config)
        self._mismatch = PixelMismatch(
            on.reshape(-1).astype(np.float32),
            off.reshape(-1).astype(np.float32),
            self._draw_leak(shape, key, on.reshape(-1)),
        )
        rate_hz = 0.0 if config.photoreceptor_noise else config.shot_noise_rate_hz
        self._shot_noise = ShotNoise(rate_hz, config, (on, off), backend=self._backend)
        levels = np.arange(256.0)
        self._table = np.stack([lin_log(levels, config.linear_below), relative_intensity(levels)])
        flat = intensity.reshape(-1).astype(np.float64)
        brightness = lin_log(flat, config.linear_below)
        self._state = new_state(brightness, has_noise=config.photoreceptor_noise)
        self._seen = intensity.reshape(-1).copy()
        self._start_us = self._last_us
        self._last = LastEvents(
            np.full(flat.size, LONG_AGO_US),
            np.full(flat.size, self._start_us),
            self._state.noise[0].copy(),
        )

    def _draw_leak(
        self, shape: tuple[int, ...], key: np.uint64, threshold_on: Float64Array
    ) -> NDArray[np.float32]:
        """By how much references sink, log units per µs; [0] if they do not."""
        config = self.config
        if config.leak_rate_hz == 0:
            return np.empty(0, np.float32)
        factor = draw_rate_factors(shape, key, Purpose.LEAK_RATE, decades=config.leak_rate_decades)
        leak = factor.reshape(-1) * (config.leak_rate_hz / MICROSECONDS) * threshold_on
        return leak.astype(np.float32)

    def _advance(
        self, intensity: IntensityArray, interval: FrameInterval
    ) -> UnsortedEvents | SortedEvents:
        if self.config.photoreceptor_noise:
            self._move_photoreceptor_noise(intensity.shape, interval)
        crossing = self._apply_low_pass(intensity.reshape(-1), interval)
        noise = self._shot_noise.draw(intensity.reshape(-1), interval)
        events = EMIT_AND_RESET.load(self._backend)(
            crossing,
            (self._mismatch, self._state),
            self._last,
            noise,
            EmissionRules(interval, self.config.refractory_period_us, intensity.shape),
        )
        self._reset_noisy(noise.pixel, interval)
        return events

    def _apply_low_pass(self, luma: IntensityArray, interval: FrameInterval) -> CrossingPixels:
        """Move the photoreceptors to the end of the interval; which pixels reach a threshold."""
        if luma.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen, luma = self._seen.astype(np.float32), luma.astype(np.float32)
        angle = 2 * math.pi * self.config.cutoff_hz * interval.duration_s or math.inf
        table = self._table if luma.dtype == np.uint8 else None
        start_us, stop_us = interval.start_us - self._start_us, interval.stop_us - self._start_us
        elapsed_us = float(start_us), float(stop_us)
        return APPLY_LOW_PASS.load(self._backend)(
            LowPassInput(self._seen, luma, table, self.config.linear_below, angle, elapsed_us),
            self._mismatch,
            self._state,
        )

    def _move_photoreceptor_noise(self, shape: tuple[int, ...], interval: FrameInterval) -> None:
        """Move the noise of the photoreceptors to the end of the interval."""
        config, before = self.config, self._state.noise[1]
        rms = photoreceptor_noise_rms(
            config.shot_noise_rate_hz, config.cutoff_hz, self.contrast_threshold
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
