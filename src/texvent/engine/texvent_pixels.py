"""The Texvent pixel model (Eqs. 5-7) on candidates instead of pictures: the same events."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import balanced_log
from texvent.engine.candidates import CandidateFinder, one_grid, pictures_of
from texvent.engine.kernels.candidates_cpu import show_pixels
from texvent.engine.kernels.interface import (
    FOLLOWS,
    STEPS,
    STEPS_ONCE,
    TAKES,
    Candidates,
    Float64Array,
    Levels,
)
from texvent.interpolate.paths import Paths
from texvent.simulate.cache import BrightnessCache
from texvent.simulate.draws import frame_key
from texvent.simulate.event_frame import EventFrame, list_activations
from texvent.simulate.firings import Firings, Interval
from texvent.simulate.interval import SubInterval
from texvent.simulate.noise import draw_noise
from texvent.simulate.texvent import TexventConfig
from texvent.simulate.timestamps import reconstruct_timestamps
from texvent.video import Frame


class FusedTexvent:
    """Texvent on the pictures of the frame engine; see `fused.FusedPixels`.

    Equation: (5)-(7), section 3.2.2; see `simulate.texvent.TexventSimulator`, whose events these
        are.
    """

    def __init__(self, config: TexventConfig, seed: int) -> None:
        self._config, self._seed = config, seed

    def begin(self, frame: Frame) -> None:
        """Take the first frame."""
        config = self._config
        self._is_kept = config.cache in ("global", "leaky")
        self._cache = BrightnessCache(
            balanced_log(frame.luma, config.balance),
            policy=config.cache if self._is_kept else "global",
            leak=config.cache_leak,
            reset_pairs=config.cache_reset_pairs if self._is_kept else 0,
        )
        # Only candidates are ever written to these, and only they are read.
        self._previous, self._brightness = np.zeros((2, *frame.size.shape))

    def fire(
        self, finder: CandidateFinder, paths: Paths, edges_us: Sequence[int]
    ) -> Iterator[Firings]:
        """Events of each sub-interval, noise included."""
        reference = self._calibrate(paths)
        levels = self._levels(np.exp(reference) if self._is_kept else np.empty((0, 0)))
        found = finder.find(paths, one_grid(paths.positions), levels)
        if not self._is_kept:
            own = paths.earlier.reshape(-1)[found.pixel]
            reference.reshape(-1)[found.pixel] = self._brightness_of(own)
        by_piece = np.argsort(found.piece, kind="stable")
        cuts = np.searchsorted(found.piece[by_piece], np.arange(len(edges_us)))
        for piece, (start_us, stop_us) in enumerate(itertools.pairwise(edges_us)):
            rows = by_piece[cuts[piece] : cuts[piece + 1]]
            span = Interval(start_us, stop_us, frame_key(self._seed, stop_us))
            interval = SubInterval(span, self._previous, self._brightness, reference)
            fired = self._generate_event_frame(found.take(rows), interval)
            timed = self._reconstruct_timestamps(fired, interval)
            self._cache.update(fired, self._brightness, step=self._config.reset_step)
            yield timed.joined(self._draw_noise(paths, piece, fired.pixel, span))

    def _calibrate(self, paths: Paths) -> Float64Array:
        """The references that a pair starts with; not for a cache that forgets at every pair."""
        if not self._is_kept:
            return self._cache.calibrate(self._brightness, is_source=False)
        brightness = balanced_log(paths.earlier, self._config.balance)
        return self._cache.calibrate(brightness, is_source=True)

    def _levels(self, reference: Float64Array) -> Levels:
        """What `kernels.interface` calls levels, for balanced levels [H, W] or the frame's own."""
        config = self._config
        if config.cache == "none":
            rule = FOLLOWS
        elif config.reset == "current":
            rule = TAKES
        else:
            rule = STEPS if config.multi_event else STEPS_ONCE
        up, down = math.exp(config.contrast_threshold), math.exp(-config.contrast_threshold)
        return Levels(reference, config.balance, up, down, rule)

    def _generate_event_frame(self, found: Candidates, interval: SubInterval) -> EventFrame:
        """Eq. 5, for the pixels that may fire."""
        config, pixel = self._config, found.pixel
        before, now = self._brightness_of(found.before), self._brightness_of(found.now)
        interval.previous.reshape(-1)[pixel] = before
        interval.brightness.reshape(-1)[pixel] = now
        reference = interval.reference.reshape(-1)
        if config.cache == "none":
            reference[pixel] = before
        change = now - reference[pixel]
        number = np.floor(np.abs(change) / config.contrast_threshold).astype(np.int64)
        fires = np.abs(change) >= config.contrast_threshold
        if not config.multi_event:
            number = np.ones_like(number)
        return EventFrame(pixel[fires], change[fires], number[fires])

    def _reconstruct_timestamps(self, fired: EventFrame, interval: SubInterval) -> Firings:
        """Eq. 7."""
        config, activations = self._config, list_activations(fired)
        t = reconstruct_timestamps(
            activations,
            interval,
            stamp=config.stamp,
            threshold=config.contrast_threshold,
            scale=config.stamp_scale,
        )
        return Firings.signal(activations.pixel, t, activations.polarity)

    def _draw_noise(
        self, paths: Paths, piece: int, fired: NDArray[np.int64], span: Interval
    ) -> Firings:
        """Eq. 6: drawn for all pixels, kept where its mask lets noise be."""
        config = self._config
        mean = config.noise_rate_hz * (config.noise_scale * span.duration_s)
        if config.noise == "none" or mean == 0:
            return Firings.none()
        noise = draw_noise(
            paths.earlier.size, span, mean=mean, on_fraction=config.noise_on_fraction
        )
        if config.noise == "random":
            return noise
        if piece < len(paths):
            luma = show_pixels(pictures_of(paths), paths.positions[piece], noise.pixel)
        else:
            luma = paths.later.reshape(-1)[noise.pixel]
        kept = (luma < config.noise_intensity) & ~np.isin(noise.pixel, fired)
        return noise.where(kept)

    def _brightness_of(self, luma: NDArray[np.float32]) -> Float64Array:
        return balanced_log(luma, self._config.balance)
