"""The pixels of the paper's model from frame to frame.

`SparsePixels` takes no logarithm per pixel; `pixel_memory` explains how. It makes no array as large
as a frame after the first, unless frames have colour or more than one type. `GaussianPixels` is the
ablation with Gaussian noise, which moves every pixel.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array, bad_intensity, balanced_log, check_intensity
from texvent.events import NOISE, EventStream
from texvent.frames import Frame
from texvent.runtime.kernel_arrays import read_only
from texvent.simulation.packets import FrameInterval
from texvent.simulation.texvent.brightness_cache import CacheSchedule
from texvent.simulation.texvent.config import TexventConfig
from texvent.simulation.texvent.noise import (
    QUIET,
    NoisePlaces,
    draw_noise,
    draw_voltage_noise,
    is_background,
)
from texvent.simulation.texvent.pixel_memory import (
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
from texvent.simulation.texvent.scan import detect_events
from texvent.simulation.texvent.timestamps import timestamp_events

Int64Array = NDArray[np.int64]


class SparsePixels:
    """All pixels of a sensor, by their trigger levels."""

    def __init__(self, config: TexventConfig, frame: Frame, where: str) -> None:
        """Begin with the first frame.

        Args:
            config: options.
            frame: the first frame.
            where: what messages call it.
        """
        check_intensity(frame.pixels, where)
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

    def advance(self, frame: Frame, span: FrameInterval, where: str) -> EventStream:
        """Events until this frame.

        Args:
            frame: the next frame, of the same size.
            span: time since the frame before, and the key of its random draws.
            where: which frame it is, for messages.

        Raises:
            InputError: an intensity is NaN, infinite or negative; the pixels are then as they were.
        """
        if frame.pixels.ndim != 2 or frame.pixels.dtype != np.float32:
            # The kernels look at float32 luma themselves.
            check_intensity(frame.pixels, where)
        intensity = self._read(frame)
        share = self._schedule.share_after(frame.t_us, is_source=frame.is_source)
        fired = self._fire(intensity, share)
        if fired is None:
            raise bad_intensity(frame.pixels, where)
        self._schedule.pass_frame(frame.t_us, is_source=frame.is_source)
        noise = self._draw_noise(intensity, span)
        x, y, t, p, label = timestamp_events(fired, noise, self._config, span, frame.size.shape)
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
        memory, intensity = self._memory, self._read(frame)
        share = self._schedule.pass_frame(frame.t_us, is_source=frame.is_source)
        if share:
            update_reference(memory, intensity, self._config.balance, share)
        if memory.previous.size:
            memory.previous[:] = intensity

    def _fire(self, intensity: Intensity, share: float) -> FiredPixels | None:
        """Eq. 5; None where an intensity is impossible."""
        memory = self._memory
        has_levels = memory.level.size > 0
        rule = self._rule_that_renews if share == 1 and not has_levels else self._rule
        fired = detect_events(intensity, memory, self._levels, rule)
        if has_levels and share and fired is not None:
            update_reference(memory, intensity, self._config.balance, share)
        return fired

    def _read(self, frame: Frame) -> Intensity:
        """The intensity of a frame in the type of those that the memory has seen, [n] read-only."""
        intensity, kind = _native_intensity(frame), self._memory.previous.dtype
        if intensity.dtype == kind:
            return intensity
        if kind != np.float32:
            turn_to_float(self._memory)
            self._levels = scan_levels(self._config, self._memory)
        return read_only(as_luma(intensity))

    def _draw_noise(self, intensity: Intensity, span: FrameInterval) -> NoisePlaces:
        """Eq. 6."""

        def luma_of(pixel: Int64Array) -> Intensity:
            luma = intensity[pixel]
            return as_luma(luma) if luma.dtype == np.uint16 else luma

        return draw_noise(self._config, span, intensity.size, luma_of)


class GaussianPixels:
    """All pixels of a sensor under Gaussian noise (ablation E10), as whole frames of brightness."""

    def __init__(self, config: TexventConfig, frame: Frame, where: str) -> None:
        """Begin with the first frame; arguments as for `SparsePixels`."""
        check_intensity(frame.pixels, where)
        self._config = config
        self._schedule = CacheSchedule(config.cache, config.residual_decay_hz)
        self._t_us, self._is_source = frame.t_us, frame.is_source
        self._brightness = balanced_log(frame.luma, config.balance).reshape(-1)
        self._reference = self._brightness.copy()

    def advance(self, frame: Frame, span: FrameInterval, where: str) -> EventStream:
        """Events until this frame; those that only the noise let fire are labelled as noise.

        Arguments as for `SparsePixels.advance`; so are the errors, and an `InputError` if the noise
        would fire a pixel every time. References move as if there were no noise.
        """
        check_intensity(frame.pixels, where)
        config, shape = self._config, frame.size.shape
        brightness = balanced_log(frame.luma, config.balance)
        mean = config.expected_noise(span.duration_s)
        noise = draw_voltage_noise(shape, span.key, threshold=config.contrast_threshold, mean=mean)
        now, shaken = brightness.reshape(-1), (brightness + noise).reshape(-1)
        share = self._schedule.pass_frame(self._t_us, is_source=self._is_source)
        before, reference = self._brightness, self._reference
        if share == 1:
            reference[:] = before
        elif share:
            reference += share * (before - reference)
        pixel, change = self._compare(shaken)
        fired = FiredPixels(pixel, change, before[pixel], shaken[pixel], reference[pixel])
        x, y, t, p, label = timestamp_events(fired, QUIET, config, span, shape)
        signal, change = self._compare(now)
        label[is_background(y.astype(np.int64) * shape[1] + x, signal)] = NOISE
        if config.reset == "current":
            reference[signal] = now[signal]
        else:
            size = np.abs(change) / config.contrast_threshold
            number = np.floor(size) if config.multi_event else 1.0
            reference[signal] += np.sign(change) * (number * config.contrast_threshold)
        self._brightness, self._t_us, self._is_source = now, frame.t_us, frame.is_source
        return EventStream.unchecked(x, y, t, p, size=frame.size, label=label)

    def _compare(self, brightness: Float64Array) -> tuple[Int64Array, Float64Array]:
        """Eq. 5: the pixels that fire, [n] ascending, and their changes, log units."""
        change = brightness - self._reference
        pixel = np.flatnonzero(np.abs(change) >= self._config.contrast_threshold)
        return pixel, change[pixel]


def _native_intensity(frame: Frame) -> Intensity:
    """The intensity in the smallest type that holds it: grey integers as they are, else luma."""
    is_grey_integer = frame.pixels.ndim == 2 and frame.pixels.dtype in (np.uint8, np.uint16)
    return read_only((frame.pixels if is_grey_integer else frame.luma).reshape(-1))
