"""The paper's pixel model without a logarithm per pixel: the same events, as fast as memory.

`pixel_memory` explains it. No array as large as a frame is made after the first, unless frames have
colour or more than one type.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import check_balance
from texvent.events import EventStream
from texvent.runtime.read_only import read_only
from texvent.simulate.packets import FrameInterval
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.event_frame import CacheSchedule
from texvent.simulate.texvent.noise import NoisePlaces, draw_noise
from texvent.simulate.texvent.pixel_memory import (
    FiredPixels,
    FireRule,
    Intensity,
    Memory,
    as_luma,
    init_memory,
    scan_levels,
    store_reference,
    turn_to_float,
    update_reference,
)
from texvent.simulate.texvent.scan import detect_events
from texvent.simulate.texvent.timestamps import Timing, timestamp_events
from texvent.video import Frame, bad_intensity, check_intensity

Int64Array = NDArray[np.int64]


class SparsePixels:
    """All pixels of a sensor, by their trigger levels; with the interface of `DensePixels`."""

    def __init__(self, config: TexventConfig, frame: Frame, where: str) -> None:
        """Begin with the first frame; see `reference.DensePixels`.

        Args:
            config: options.
            frame: the first frame.
            where: what messages call it.
        """
        check_intensity(frame.pixels, where)
        check_balance(frame.luma, config.balance)
        self._config = config
        self._schedule = CacheSchedule(config.cache, config.residual_decay_hz)
        self._schedule.pass_frame(frame.t_us, is_source=frame.is_source)
        self._memory = init_memory(_native_intensity(frame), config)
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
        """Events until this frame; see `DensePixels.advance`."""
        intensity = self._read(frame, where)
        share = self._schedule.share_after(frame.t_us, is_source=frame.is_source)
        fired = self._fire(intensity, share)
        if fired is None:
            raise bad_intensity(frame.pixels, where)
        self._schedule.pass_frame(frame.t_us, is_source=frame.is_source)
        noise = self._draw_noise(intensity, span)
        x, y, t, p, label = timestamp_events([fired], noise, self._timing, span, frame.size.shape)
        return EventStream.unchecked(x, y, t, p, size=frame.size, label=label)

    def ensure_reference(self) -> Memory:
        """The memory, from now on with the reference brightness of every pixel in `level`."""
        if not self._memory.level.size:
            store_reference(self._memory, self._config)
            self._levels = scan_levels(self._config, self._memory)
        return self._memory

    def advance_to(self, frame: Frame) -> None:
        """Move to the later frame of a pair whose references were moved without stepping.

        Args:
            frame: a source frame.
        """
        memory, luma = self._memory, as_luma(_native_intensity(frame))
        share = self._schedule.pass_frame(frame.t_us, is_source=frame.is_source)
        if share:
            update_reference(memory, luma, self._config.balance, share)
        if memory.previous.size:
            memory.previous[:] = luma

    def _fire(self, intensity: Intensity, share: float) -> FiredPixels | None:
        """Eq. 5; None where an intensity is impossible."""
        memory = self._memory
        has_levels = memory.level.size > 0
        rule = self._rule_that_renews if share == 1 and not has_levels else self._rule
        fired = detect_events(intensity, memory, self._levels, rule)
        if has_levels and share and fired is not None:
            update_reference(memory, intensity, self._config.balance, share)
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

        return draw_noise(self._config, span, intensity.size, luma_of)


def timing_of(config: TexventConfig) -> Timing:
    """Timing rules of a configuration."""
    return Timing(
        config.timestamp_rule,
        config.timestamp_scale,
        config.contrast_threshold,
        config.multi_event,
        config.noise == "adaptive",
    )


def _native_intensity(frame: Frame) -> Intensity:
    """The intensity in the smallest type that holds it: grey integers as they are, else luma."""
    is_grey_integer = frame.pixels.ndim == 2 and frame.pixels.dtype in (np.uint8, np.uint16)
    return read_only((frame.pixels if is_grey_integer else frame.luma).reshape(-1))
