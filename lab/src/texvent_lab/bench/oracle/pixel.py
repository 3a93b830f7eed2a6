"""The pixels of the oracle: an ideal one and a noisy one, fed at 4,800 frames per second.

They are written for the benchmark alone and share no code with `texvent.simulation` but its hash,
so that no simulator is its own judge.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.sensor import SensorSize
from texvent.simulation.random.draws import draw_normals, draw_uniforms, frame_key

Float64Array = NDArray[np.float64]

SENSOR_SEED, OTHER_SENSOR_SEED = 1000, 1001
"""Seeds of what is fixed to a pixel: that of the sensor of every recording but one, and that of
another sensor of the same kind."""
THRESHOLD_ON_DRAW, THRESHOLD_OFF_DRAW, LEAK_DRAW, PHASE_DRAW = 0, 2, 4, 6
SHOT_DRAW, POLARITY_DRAW = 0, 1
LEAST_THRESHOLD = 0.06


@dataclass(frozen=True, kw_only=True)
class PixelModel:
    """Parameters of the pixels of a recording."""

    dark_level: float = 0.004
    """Radiance added before the logarithm: the dark current."""
    threshold: float = 0.2
    """Mean ON and OFF threshold, log units."""
    threshold_sigma: float = 0.0
    cutoff_hz: float = math.inf
    """Bandwidth at radiance 0.5 and above; proportionally less below."""
    refractory_us: float = 0.0
    """Reset after an event, µs."""
    leak_hz: float = 0.0
    shot_hz: float = 0.0
    """Noise events per second of a dark pixel; a quarter of it at radiance 0.8 and above."""
    shot_on_share: float = 0.42
    has_random_phase: bool = False
    """Start anywhere between the two thresholds, not just reset."""
    sensor_seed: int = SENSOR_SEED
    """Seed of the fixed pattern."""


IDEAL = PixelModel()
NOISY = PixelModel(
    threshold_sigma=0.03,
    cutoff_hz=250.0,
    refractory_us=300.0,
    leak_hz=0.1,
    shot_hz=1.5,
    has_random_phase=True,
)
TARGETS: Mapping[str, PixelModel] = {"noisy": NOISY, "ideal": IDEAL}
"""Kinds of pixels whose events count as true."""
REFERENCE_SEED, FLOOR_SEED, OTHER_SEED = 1, 2, 3
"""Noise seeds of the reference, of the second recording and of that of another sensor."""
PATTERN_DECADES = 0.25
"""Fixed pattern of leak and shot rates: sd of their log10 between pixels."""


class PixelArray:
    """Pixels that turn radiance into events, one step of time after the other."""

    def __init__(self, model: PixelModel, size: SensorSize, seed: int) -> None:
        """Draw what is fixed to each pixel.

        Args:
            model: what the pixels do.
            size: width and height, px.
            seed: of this recording: initial phase and shot noise.
        """
        self._model, self._size, self._seed = model, size, seed
        self._y, self._x = (one.ravel() for one in np.indices(size.shape))
        sensor = frame_key(model.sensor_seed, 0)
        self._on, self._off = (
            np.maximum(
                model.threshold
                + model.threshold_sigma * draw_normals(sensor, self._y, self._x, draw),
                LEAST_THRESHOLD,
            )
            for draw in (THRESHOLD_ON_DRAW, THRESHOLD_OFF_DRAW)
        )
        self._pattern = 10 ** (PATTERN_DECADES * draw_normals(sensor, self._y, self._x, LEAK_DRAW))
        self._step = 0
        self._t_us = 0.0
        self._level = np.zeros(len(self._y))
        self._reference = self._level
        self._free_us = np.full(len(self._y), -math.inf)
        self._found: list[tuple[NDArray[np.int64], Float64Array, NDArray[np.bool_]]] = []

    def expose(self, radiance: Float64Array, t_us: int) -> None:
        """Show the pixels the radiance at `t_us`, [H, W]; the first call sets them at rest."""
        light = radiance.ravel() + self._model.dark_level
        if self._step == 0:
            self._start(np.log(light))
        else:
            level = self._filter(light, t_us - self._t_us)
            self._reference = self._reference - self._leak(t_us - self._t_us)
            fired = self._cross(level, t_us)
            if self._model.shot_hz:
                self._shoot(radiance.ravel(), level, fired, t_us)
            self._level = level
        self._t_us = t_us
        self._step += 1

    def events(self) -> EventStream:
        """All events so far, in time order."""
        if not self._found:
            return EventStream.empty(self._size)
        pixel, t, is_on = (
            np.concatenate([one[index] for one in self._found]) for index in range(3)
        )
        t_us = np.floor(t).astype(np.int64)
        order = np.lexsort((is_on, self._x[pixel], self._y[pixel], t_us))
        pixel = pixel[order]
        return EventStream(
            self._x[pixel], self._y[pixel], t_us[order], is_on[order].astype(np.uint8), self._size
        )

    def _start(self, level: Float64Array) -> None:
        self._level = level
        self._reference = level.copy()
        if self._model.has_random_phase:
            phase = draw_uniforms(frame_key(self._seed, 0), self._y, self._x, PHASE_DRAW)
            self._reference += phase * (self._on + self._off) - self._on

    def _filter(self, light: Float64Array, duration_us: float) -> Float64Array:
        """First-order low-pass whose bandwidth follows the light."""
        if math.isinf(self._model.cutoff_hz):
            return np.log(light)
        cutoff_hz = self._model.cutoff_hz * np.minimum(1.0, light / 0.5)
        share = -np.expm1(-2 * math.pi * cutoff_hz * duration_us / MICROSECONDS)
        return self._level + share * (np.log(light) - self._level)

    def _leak(self, duration_us: float) -> Float64Array | float:
        """Fall of the reference, log units: ON events at the leak rate where nothing moves."""
        if not self._model.leak_hz:
            return 0.0
        return self._model.leak_hz * duration_us / MICROSECONDS * self._on * self._pattern

    def _cross(self, level: Float64Array, t_us: int) -> NDArray[np.bool_]:
        """Events where the level, straight between the steps, crosses a threshold."""
        duration = t_us - self._t_us
        start = (self._free_us - self._t_us) / duration
        released = np.flatnonzero((start > 0) & (start < 1))
        slope = level[released] - self._level[released]
        self._reference[released] = self._level[released] + slope * start[released]
        fired = np.zeros(len(level), np.bool_)
        while True:
            change = level - self._reference
            is_on, is_off = change >= self._on, change <= -self._off
            pixel = np.flatnonzero((is_on | is_off) & (start < 1))
            if not pixel.size:
                return fired
            rises = is_on[pixel]
            crossed = self._reference[pixel] + np.where(rises, self._on[pixel], -self._off[pixel])
            span = level[pixel] - self._level[pixel]
            # Where a leaking reference, not the level, moved across, the end of the step is right.
            share = np.divide(
                crossed - self._level[pixel], span, out=np.ones(pixel.size), where=span != 0
            )
            t = self._t_us + duration * np.clip(share, np.maximum(start[pixel], 0.0), 1.0 - 1e-9)
            self._found.append((pixel, t, rises))
            self._free_us[pixel] = t + self._model.refractory_us
            start[pixel] = (self._free_us[pixel] - self._t_us) / duration
            # Held in reset, a pixel wakes at the level of that moment; otherwise at the threshold.
            woken = self._level[pixel] + span * np.minimum(start[pixel], 1.0)
            self._reference[pixel] = woken if self._model.refractory_us else crossed
            fired[pixel] = True

    def _shoot(
        self, radiance: Float64Array, level: Float64Array, fired: NDArray[np.bool_], t_us: int
    ) -> None:
        """Shot noise: an event from nothing, which resets the pixel."""
        duration = t_us - self._t_us
        key = frame_key(self._seed, self._step)
        rate = self._model.shot_hz * (1 - 0.75 * np.minimum(1.0, radiance / 0.8)) * self._pattern
        chance = draw_uniforms(key, self._y, self._x, SHOT_DRAW)
        likely = rate * duration / MICROSECONDS
        pixel = np.flatnonzero((chance < likely) & ~fired & (self._free_us <= self._t_us))
        if not pixel.size:
            return
        side = draw_uniforms(key, self._y[pixel], self._x[pixel], POLARITY_DRAW)
        # Given that it is below `likely`, the chance is uniform: it serves as the time too.
        t = self._t_us + duration * chance[pixel] / likely[pixel]
        self._found.append((pixel, t, side < self._model.shot_on_share))
        self._reference[pixel] = level[pixel]
        self._free_us[pixel] = t + self._model.refractory_us
