"""The Texvent pixel model (Eqs. 5 and 6) in continuous time; see `simulate.fused.continuous`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array, balanced_log
from texvent.events import EventStream
from texvent.pairs.frame_pair import FramePair
from texvent.simulate.fused.continuous import plan_segments
from texvent.simulate.fused.segment_pixels import LogScale, SegmentPixels
from texvent.simulate.fused.segments import CrossingRules, CrossingState
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import make_packet
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import frame_key
from texvent.simulate.texvent.brightness_cache import BrightnessCache
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.reference import add_noise
from texvent.video import Frame


def continuous_misfit(config: TexventConfig) -> str | None:
    """What the options must be in continuous time, if they are not."""
    wanted = {"multi_event": True, "reset": "step", "timestamp_rule": "linear"}
    if any(getattr(config, name) != value for name, value in wanted.items()):
        return "with multi_event, reset 'step' and timestamp_rule 'linear' only (preset accurate)"
    if config.cache == "none":
        return "with cache local, leaky or global: 'none' forgets at every frame"
    if config.noise == "gaussian":
        return "with noise adaptive, random or none: 'gaussian' shakes every frame"
    return None


class ContinuousPixels:
    """Texvent with one event per threshold crossed, at the time of the crossing.

    Equation: (5) and (6), section 3.2.2; multi_event, reset "step", timestamp_rule "linear".
    Deviation: noise is drawn per pair of source frames, in pixels that are dark in the later one
        and did not fire in between, which is how Eq. 6 is written.
    """

    def __init__(self, config: TexventConfig, seed: int, frame: Frame) -> None:
        """Begin with the first frame.

        Args:
            config: options.
            seed: of the noise.
            frame: the first frame.
        """
        self._config, self._seed = config, seed
        threshold = config.contrast_threshold
        self._segments = SegmentPixels(
            CrossingRules(threshold, threshold, 0),
            LogScale(self._brightness_of, balance=config.balance),
        )
        brightness = self._brightness_of(frame.luma)
        self._cache = BrightnessCache(
            brightness,
            policy=config.cache,
            leak=config.cache_leak,
            reset_pairs=config.cache_reset_pairs,
        )
        self._watch(self._cache.calibrate(brightness, is_source=False))

    def advance(self, pair: FramePair) -> EventStream:
        """All events of a pair, noise included."""
        plan = plan_segments(pair)
        if self._config.cache != "global" or self._config.cache_reset_pairs:
            brightness = self._brightness_of(pair.motion.earlier)
            self._watch(self._cache.calibrate(brightness, is_source=True))
        bands = self._segments.cross(pair.motion, plan.grids, plan.edges_us)
        fired = UnsortedEvents.concat(band.fired for band in bands)
        key = frame_key(self._seed, pair.second.t_us)
        span = FrameInterval(pair.earlier.t_us, pair.second.t_us, key)
        noise = add_noise(self._config, pair.motion.later, fired.pixel, span)  # Eq. 6
        return make_packet(UnsortedEvents.concat((fired, noise)), span, pair.second.size)

    def _watch(self, reference: Float64Array) -> None:
        """Let events move the references [H, W]: the array of the cache itself."""
        state = CrossingState(reference.reshape(-1), np.empty(0, np.int64))
        self._segments.watch(state, reference.shape)

    def _brightness_of(self, luma: NDArray[Any]) -> Float64Array:
        return balanced_log(luma, self._config.balance)
