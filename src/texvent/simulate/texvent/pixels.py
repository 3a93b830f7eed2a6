"""The paper's pixel model without a logarithm per pixel: the same events, as fast as memory.

`kernels.scan` explains it. Each frame goes to the kernels of a backend, with the memory of the
pixels; no array as large as a frame is made after the first, unless frames have colour or more than
one type.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import check_balance
from texvent.events import EventStream
from texvent.runtime.read_only import read_only
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.limits import check_event_number
from texvent.simulate.texvent.brightness_cache import CacheSchedule
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.kernels.noise_blocks import PLACE_NOISE, NoiseBlock, NoisePlaces
from texvent.simulate.texvent.kernels.scan import (
    FIND_FIRED,
    NOISE_BLOCK,
    Fired,
    FireRule,
    Intensity,
    Memory,
)
from texvent.simulate.texvent.kernels.timestamping import TIMESTAMP_EVENTS, Timing
from texvent.simulate.texvent.noise import poisson_cumulative
from texvent.simulate.texvent.pixel_state import (
    as_luma,
    keep_levels,
    move_levels,
    remember,
    scan_levels,
    turn_to_float,
)
from texvent.video import Frame, bad_intensity, check_intensity

Int64Array = NDArray[np.int64]
_QUIET = NoisePlaces(np.empty(0, np.int64), np.empty(0), np.empty(0, np.uint8))


class SparsePixels:
    """All pixels of a sensor, by their trigger levels; with the interface of `DensePixels`."""

    def __init__(self, config: TexventConfig, backend: str, frame: Frame, where: str) -> None:
        """Begin with the first frame; see `reference.DensePixels`.

        Args:
            config: options.
            backend: which kernels compute.
            frame: the first frame.
            where: what messages call it.
        """
        check_intensity(frame.pixels, where)
        check_balance(frame.luma, config.balance)
        self._config, self._backend = config, backend
        self._schedule = CacheSchedule(config.cache, config.residual_decay_hz)
        self._schedule.pass_frame(frame.t_us, is_source=frame.is_source)
        self._memory = remember(_native_intensity(frame), config)
        self._levels = scan_levels(config, self._memory)
        self._rule = FireRule(
            threshold=config.contrast_threshold,
            balance=config.balance,
            multi_event=config.multi_event,
            is_step=config.reset == "step",
            is_renewed=False,
            has_line=config.timestamp_rule == "linear",
        )
        self._rule_that_renews = self._rule._replace(is_renewed=True)
        self._timing = timing_of(config)

    def advance(self, frame: Frame, span: FrameInterval, where: str) -> EventStream:
        """What fires until this frame; see `reference.DensePixels.advance`."""
        intensity = self._read(frame, where)
        share = self._schedule.share_after(frame.t_us, is_source=frame.is_source)
        fired = self._fire(intensity, share)
        if fired is None:
            raise bad_intensity(frame.pixels, where)
        self._schedule.pass_frame(frame.t_us, is_source=frame.is_source)
        noise = self._draw_noise(intensity, span)
        timestamp_events = TIMESTAMP_EVENTS.load(self._backend)
        x, y, t, p, label = timestamp_events([fired], noise, self._timing, span, frame.size.shape)
        return EventStream.unchecked(x, y, t, p, size=frame.size, label=label)

    def hold_levels(self) -> Memory:
        """The memory, from now on with the reference brightness of every pixel in `level`."""
        if not self._memory.level.size:
            keep_levels(self._memory, self._config)
            self._levels = scan_levels(self._config, self._memory)
        return self._memory

    def leave_pair(self, frame: Frame) -> None:
        """Note the later frame of a pair in which `hold_levels` was moved along without stepping.

        Args:
            frame: a source frame.
        """
        memory, luma = self._memory, as_luma(_native_intensity(frame))
        share = self._schedule.pass_frame(frame.t_us, is_source=frame.is_source)
        if share:
            move_levels(memory, luma, self._config.balance, share)
        if memory.previous.size:
            memory.previous[:] = luma

    def _fire(self, intensity: Intensity, share: float) -> Fired | None:
        """Eq. 5; None where an intensity is impossible."""
        memory = self._memory
        has_levels = memory.level.size > 0
        rule = self._rule_that_renews if share == 1 and not has_levels else self._rule
        find_fired = FIND_FIRED.load(self._backend)
        fired = find_fired(intensity, memory, self._levels, rule)
        if has_levels and share and fired is not None:
            move_levels(memory, intensity, self._config.balance, share)
        return fired

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

    def _draw_noise(self, intensity: Intensity, span: FrameInterval) -> NoisePlaces:
        """Eq. 6."""

        def luma_of(pixel: Int64Array) -> Intensity:
            luma = intensity[pixel]
            return as_luma(luma) if luma.dtype == np.uint16 else luma

        return draw_noise_places(self._config, span, intensity.size, luma_of, self._backend)


def timing_of(config: TexventConfig) -> Timing:
    """How a configuration gives times to events."""
    return Timing(
        config.timestamp_rule,
        config.timestamp_scale,
        config.contrast_threshold,
        config.multi_event,
        config.noise == "adaptive",
    )


def draw_noise_places(
    config: TexventConfig,
    span: FrameInterval,
    size: int,
    luma_of: Callable[[Int64Array], Intensity],
    backend: str,
) -> NoisePlaces:
    """Noise of Eq. 6 where pixels are dark, or, as ablation E11, anywhere.

    Args:
        config: options.
        span: the sub-interval.
        size: number of pixels.
        luma_of: luma at the end of the sub-interval, 0..255 scale, of pixels given by flat index.
        backend: which kernels draw.
    """
    if not config.has_added_noise:
        return _QUIET
    mean = config.expected_noise(span.duration_s)
    # Drawn for whole blocks, then cut to the frame.
    check_event_number(mean * -(-size // NOISE_BLOCK) * NOISE_BLOCK)
    cumulative = poisson_cumulative(mean * NOISE_BLOCK)
    block = NoiseBlock(span.key, cumulative, config.noise_on_fraction)
    noise = PLACE_NOISE.load(backend)(block, size)
    if config.noise == "random" or not len(noise.pixel):
        return noise
    dark = np.flatnonzero(luma_of(noise.pixel) < config.noise_intensity)
    if not len(dark):
        return _QUIET
    return NoisePlaces(noise.pixel[dark], noise.fraction[dark], noise.p[dark])


def _native_intensity(frame: Frame) -> Intensity:
    """The intensity in the smallest type that holds it: grey integers as they are, else luma."""
    is_grey_integer = frame.pixels.ndim == 2 and frame.pixels.dtype in (np.uint8, np.uint16)
    return read_only((frame.pixels if is_grey_integer else frame.luma).reshape(-1))
