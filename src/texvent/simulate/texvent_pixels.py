"""The paper's pixel model without a logarithm per pixel: the same events, as fast as memory.

`kernels.texvent` tells how. This hands each frame to the kernels of a backend, together with what
the pixels remember; no array as large as a frame is made after the first, unless frames have
colour or more than one type.
"""

from __future__ import annotations

import numpy as np

from texvent.brightness import check_balance
from texvent.events import EventStream
from texvent.simulate.cache import CacheSchedule
from texvent.simulate.firings import Interval
from texvent.simulate.kernels.noise import Block, NoisePlaces, load_place_noise
from texvent.simulate.kernels.order import read_only
from texvent.simulate.kernels.stamp import Timing, load_stamp_events
from texvent.simulate.kernels.texvent import NOISE_BLOCK, FireRule, Intensity, load_find_fired
from texvent.simulate.noise import poisson_cumulative
from texvent.simulate.texvent_config import TexventConfig
from texvent.simulate.texvent_memory import (
    as_luma,
    leak_levels,
    remember,
    renew_levels,
    scan_levels,
    turn_to_float,
)
from texvent.video import Frame, bad_intensity, check_intensity

_QUIET = NoisePlaces(np.empty(0, np.int64), np.empty(0), np.empty(0, np.uint8))


class SparsePixels:
    """All pixels of a sensor, by their trigger levels; see `texvent.TexventPixels`."""

    def __init__(self, config: TexventConfig, backend: str, frame: Frame, where: str) -> None:
        """Begin with the first frame; arguments as for `advance`."""
        check_intensity(frame.pixels, where)
        check_balance(frame.luma, config.balance)
        self._config, self._backend = config, backend
        self._schedule = CacheSchedule(config.cache, config.cache_reset_pairs)
        self._schedule.pass_frame(is_source=frame.is_source)
        self._memory = remember(_native_intensity(frame), config)
        self._levels = scan_levels(config, self._memory)
        self._rule = FireRule(
            threshold=config.contrast_threshold,
            balance=config.balance,
            multi_event=config.multi_event,
            is_step=config.reset == "step",
            is_renewed=False,
            has_line=config.stamp == "linear",
        )
        self._timing = Timing(
            config.stamp,
            config.stamp_scale,
            config.contrast_threshold,
            config.multi_event,
            config.noise == "adaptive",
        )

    def advance(self, frame: Frame, span: Interval, where: str) -> EventStream:
        """What fires until this frame; see `texvent.TexventPixels.advance`."""
        intensity = self._read(frame, where)
        has_levels = self._memory.level.size > 0
        renewal = self._schedule.renewal_after(is_source=frame.is_source)
        rule = self._rule
        if renewal == "renew" and not has_levels:
            rule = rule._replace(is_renewed=True)
        find_fired = load_find_fired(self._backend, intensity.dtype.str)
        fired = find_fired(intensity, self._memory, self._levels, rule)
        if fired is None:
            raise bad_intensity(frame.pixels, where)
        self._schedule.pass_frame(is_source=frame.is_source)
        if has_levels and renewal == "renew":
            renew_levels(self._memory, intensity, self._config)
        elif has_levels and renewal == "leak":
            leak_levels(self._memory, intensity, self._config)
        noise = self._draw_noise(intensity, span)
        stamp_events = load_stamp_events(self._backend)
        x, y, t, p, label = stamp_events(fired, noise, self._timing, span, frame.size.shape)
        return EventStream.unchecked(x, y, t, p, size=frame.size, label=label)

    def _read(self, frame: Frame, where: str) -> Intensity:
        """The intensity of a frame in the type of the memory, [n] read-only."""
        if frame.pixels.ndim != 2 or frame.pixels.dtype != np.float32:
            # The kernels look at float32 luma themselves.
            check_intensity(frame.pixels, where)
        if self._config.balance == 0:
            check_balance(frame.luma, 0.0)
        intensity = _native_intensity(frame)
        if intensity.dtype == self._memory.reference.dtype:
            return intensity
        if self._memory.reference.dtype != np.float32:
            turn_to_float(self._memory)
            self._levels = scan_levels(self._config, self._memory)
        return read_only(as_luma(intensity))

    def _draw_noise(self, intensity: Intensity, span: Interval) -> NoisePlaces:
        """Noise of Eq. 6 where pixels are dark, or, as ablation E11, anywhere."""
        config = self._config
        if not config.has_added_noise:
            return _QUIET
        cumulative = poisson_cumulative(config.expected_noise(span.duration_s) * NOISE_BLOCK)
        block = Block(span.key, cumulative, config.noise_on_fraction)
        noise = load_place_noise(self._backend)(block, intensity.size)
        if config.noise == "random" or not len(noise.pixel):
            return noise
        luma = intensity[noise.pixel]
        if luma.dtype == np.uint16:
            luma = as_luma(luma)
        is_dark = luma < config.noise_intensity
        return NoisePlaces(noise.pixel[is_dark], noise.fraction[is_dark], noise.p[is_dark])


def _native_intensity(frame: Frame) -> Intensity:
    """The intensity in the smallest type that holds it: grey integers as they are, else luma."""
    is_grey_integer = frame.pixels.ndim == 2 and frame.pixels.dtype in (np.uint8, np.uint16)
    return read_only(frame.pixels if is_grey_integer else frame.luma)
