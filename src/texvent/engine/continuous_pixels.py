"""The pixel models that the continuous-time engine can run."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array, balanced_log
from texvent.pairs.motion_interpolation import Paths
from texvent.simulate.esim.simulator import EsimConfig
from texvent.simulate.fused.candidates import CandidateFinder
from texvent.simulate.fused.interface import Grids, Int64Array
from texvent.simulate.fused.line_pixels import LinePixels, esim_pixels
from texvent.simulate.fused.segments import LineRules
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import frame_key
from texvent.simulate.texvent.brightness_cache import BrightnessCache
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.noise import draw_noise, low_light_background
from texvent.video import Frame


class ContinuousEsim:
    """ESIM; see `continuous.LinePixelModel`."""

    def __init__(self, config: EsimConfig, seed: int) -> None:
        del seed  # with thresholds all alike, nothing is random
        self._pixels = esim_pixels(config)

    def begin(self, frame: Frame) -> None:
        """Take the first frame."""
        self._pixels.begin(frame)

    def fire(
        self, finder: CandidateFinder, paths: Paths, grids: Grids, edges_us: Int64Array
    ) -> UnsortedEvents:
        """Events between two source frames."""
        return _joined(self._pixels.cross(finder, paths, grids, edges_us))


class ContinuousTexvent:
    """Texvent with one event per threshold crossed, at the time of the crossing.

    Equation: (5) and (6), section 3.2.2, with reset "step", stamp "linear" and multi_event.
    Deviation: noise is drawn per pair of source frames, in pixels that are dark in the later one
        and did not fire in between, which is how Eq. 6 is written.
    """

    def __init__(self, config: TexventConfig, seed: int) -> None:
        self._config, self._seed = config, seed
        threshold = config.contrast_threshold
        self._pixels = LinePixels(
            LineRules(threshold, threshold, 0), self._brightness_of, balance=config.balance
        )

    def begin(self, frame: Frame) -> None:
        """Take the first frame."""
        config = self._config
        self._pixels.begin(frame)
        self._cache = BrightnessCache(
            self._brightness_of(frame.luma),
            policy=config.cache,
            leak=config.cache_leak,
            reset_pairs=config.cache_reset_pairs,
        )
        # The cache's own array, so that events renew it.
        self._pixels.adopt(self._cache.calibrate(self._brightness_of(frame.luma), is_source=False))

    def fire(
        self, finder: CandidateFinder, paths: Paths, grids: Grids, edges_us: Int64Array
    ) -> UnsortedEvents:
        """Events between two source frames, noise included."""
        self._calibrate(paths)
        fired = _joined(self._pixels.cross(finder, paths, grids, edges_us))
        return fired.joined(self._draw_noise(paths, fired, edges_us))

    def _calibrate(self, paths: Paths) -> None:
        """Let references forget at a source frame what the cache policy says."""
        if self._config.cache == "global" and not self._config.cache_reset_pairs:
            return
        brightness = self._brightness_of(paths.earlier)
        self._pixels.adopt(self._cache.calibrate(brightness, is_source=True))

    def _draw_noise(
        self, paths: Paths, fired: UnsortedEvents, edges_us: Int64Array
    ) -> UnsortedEvents:
        """Eq. 6."""
        config, stop_us = self._config, int(edges_us[0, -1])
        span = FrameInterval(int(edges_us[0, 0]), stop_us, frame_key(self._seed, stop_us))
        mean = config.noise_rate_hz * (config.noise_scale * span.duration_s)
        if config.noise == "none" or mean == 0:
            return UnsortedEvents.none()
        noise = draw_noise(paths.later.size, span, mean=mean, on_fraction=config.noise_on_fraction)
        if config.noise == "random":
            return noise
        kept = low_light_background(
            paths.later, noise.pixel, fired.pixel, intensity=config.noise_intensity
        )
        return noise.take(kept)

    def _brightness_of(self, luma: NDArray[Any]) -> Float64Array:
        return balanced_log(luma, self._config.balance)


def _joined(bands: Iterable[tuple[UnsortedEvents, Any]]) -> UnsortedEvents:
    """The events of all bands."""
    columns = zip(*(fired for fired, _ in bands), strict=True)
    return UnsortedEvents(*(np.concatenate(column) for column in columns))
